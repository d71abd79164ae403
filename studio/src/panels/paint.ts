/** What the tool in hand paints, how wide, how hard, and mirrored at which planes. */

import { button, choice, el, slider } from "../dom";
import { isMap, maps, type Brush, type Tool } from "../brush";
import { brushStrokes } from "../recipe-text";
import type { Studio } from "../studio";

export const tools: { tool: Tool; label: string; key: string; help: string }[] = [
  { tool: "orbit", label: "Turn the view", key: "1", help: "Drag to turn, scroll or pinch to come nearer, drag with the right button to move." },
  { tool: "brush", label: "Paint a species", key: "2", help: "Moves a concentration towards the value under the brush, while the coat grows on." },
  { tool: "eraser", label: "Erase to the rest", key: "3", help: "Sets all species to what they were before anything grew." },
  { tool: "mask", label: "Paint a mask", key: "4", help: "Nothing grows where it is painted. Strokes become part of the recipe; the coat begins anew." },
  { tool: "size", label: "Paint the size", key: "5", help: "Makes the pattern wider or finer where it is painted. Strokes become part of the recipe." },
  { tool: "direction", label: "Comb directions", key: "6", help: "Diffusion follows the strokes, and between them the smoothest way from one to the next. Strokes become part of the recipe; the coat begins anew." },
];

function speciesPart(studio: Studio, brush: Brush): HTMLElement {
  const select = el("select", { id: "paint-species" });
  const place = el("div", {});
  let built = "";
  const value = (): void => {
    const range = studio.progress?.range.find((r) => r.species === brush.species);
    const low = Math.min(range?.low ?? 0, studio.rest.get(brush.species) ?? 0);
    const high = Math.max(range?.high ?? 1, studio.rest.get(brush.species) ?? 0);
    const room = Math.max(high - low, 0.1 * Math.max(Math.abs(low), Math.abs(high)), 0.05);
    const track = { low: low >= 0 ? 0 : low - room, high: high + room };
    brush.value = high + 0.25 * room;
    const control = slider({ label: "Value", ...track, value: brush.value, digits: 3, onInput: (v) => (brush.value = v) });
    place.replaceChildren(control.node);
  };
  select.addEventListener("change", () => {
    brush.species = select.value;
    value();
  });
  const follow = (): void => {
    const names = studio.stage?.species ?? [];
    const key = `${names.join()} ${brush.tool}`;
    if (key === built) return;
    built = key;
    select.replaceChildren(...names.map((name) => el("option", { value: name }, name)));
    select.value = brush.species;
    value();
  };
  studio.on(["tool", "begun"], follow);
  return el("div", {}, el("div", { class: "field" }, el("label", { for: "paint-species" }, "Species"), select), place);
}

function maskPart(studio: Studio, brush: Brush): HTMLElement {
  const kind = choice("Mask", [{ value: "1", text: "Add" }, { value: "0", text: "Take away" }], "1", (v) => (brush.mapValue.mask = Number(v)));
  return el("div", {}, kind.node, clearButton(studio, brush, "mask"));
}

function sizePart(studio: Studio, brush: Brush): HTMLElement {
  const control = slider({
    label: "Size times",
    low: 0.4,
    high: 3,
    value: 2,
    curve: { place: (v) => Math.log(v / 0.4) / Math.log(7.5), value: (p) => 0.4 * 7.5 ** p },
    onInput: (v) => (brush.mapValue.size = v - 1),
  });
  return el("div", {}, control.node, clearButton(studio, brush, "size"));
}

function clearButton(studio: Studio, brush: Brush, tool: "mask" | "size"): HTMLElement {
  const clear = button(`Clear the ${tool === "mask" ? "mask" : "map"}`, { class: "small" });
  clear.addEventListener("click", () => brush.clearMap(tool));
  const count = el("span", { class: "quiet-text" });
  studio.on("recipe", () => {
    const strokes = brushStrokes(studio.recipe, maps[tool].attribute, 1).length;
    count.textContent = strokes ? `${strokes} stroke${strokes > 1 ? "s" : ""}` : "nothing painted yet";
    clear.disabled = strokes === 0;
  });
  return el("div", { class: "inline spread" }, count, clear);
}

function directionPart(studio: Studio, brush: Brush): HTMLElement {
  const why = el("p", { class: "quiet-text" });
  const clear = button("Clear the strokes", { class: "small" });
  clear.addEventListener("click", () => brush.clearDirections());
  const count = el("span", { class: "quiet-text" });
  const row = el("div", { class: "inline spread" }, count, clear);
  studio.on(["recipe", "begun"], () => {
    const models = [...new Set((studio.begun?.stages ?? []).map((stage) => stage.model))].join(" and ");
    const [any, strokes] = [brush.combed.length > 0, brush.directions.length];
    why.textContent = any ? "" : `There is nothing to comb here: ${models} spreads the same in all directions. Coats such as zebra, weave or parquet have directions.`;
    why.hidden = any;
    row.hidden = !any;
    count.textContent = strokes ? `${strokes} stroke${strokes > 1 ? "s" : ""}` : "nothing combed yet";
    clear.disabled = strokes === 0;
  });
  return el("div", {}, why, row);
}

function commonPart(studio: Studio, brush: Brush): HTMLElement {
  const place = el("div", {});
  let diagonal = 0;
  const follow = (): void => {
    if (!studio.info) return;
    if (diagonal !== studio.info.diagonal) {
      diagonal = studio.info.diagonal;
      const [low, high] = [0.004 * diagonal, 0.3 * diagonal];
      const control = slider({
        label: "Radius",
        low,
        high,
        value: brush.radius,
        digits: 3,
        curve: { place: (v) => Math.log(v / low) / Math.log(high / low), value: (p) => low * (high / low) ** p },
        onInput: (v) => brush.setRadius(v),
      });
      place.replaceChildren(control.node);
      studio.on("tool", () => control.set(brush.radius));
    }
  };
  studio.on("shape", follow);
  const hardness = slider({ label: "Hardness", low: 0, high: 1, value: brush.hardness, digits: 2, onInput: (v) => (brush.hardness = v) });
  const planes = el("div", { class: "inline" });
  ["x", "y", "z"].forEach((axis, i) => {
    const one = el("button", { type: "button", class: "small axis", "aria-pressed": "false", "aria-label": `Mirror along ${axis}` }, axis);
    one.addEventListener("click", () => {
      brush.symmetry[i] = !brush.symmetry[i];
      one.setAttribute("aria-pressed", String(brush.symmetry[i]));
    });
    planes.append(one);
  });
  const size = el("div", {}, place, hardness.node);
  studio.on("tool", () => (size.hidden = brush.tool === "direction"));
  return el("div", {}, size, el("div", { class: "inline spread" }, el("span", { class: "label" }, "Mirror along"), planes));
}

export function paintPanel(studio: Studio, brush: Brush): HTMLElement {
  const title = el("h2", {});
  const help = el("p", { class: "quiet-text" });
  const parts: Partial<Record<Tool, HTMLElement>> = {
    brush: speciesPart(studio, brush),
    mask: maskPart(studio, brush),
    size: sizePart(studio, brush),
    direction: directionPart(studio, brush),
  };
  const common = commonPart(studio, brush);
  const pick = el("div", { class: "rows" });
  for (const { tool, label, key } of tools.slice(1)) {
    const row = button(label, { icon: tool, class: "row" });
    row.append(el("kbd", {}, key));
    row.addEventListener("click", () => brush.choose(tool));
    pick.append(row);
  }
  const show = (): void => {
    const current = tools.find((entry) => entry.tool === brush.tool)!;
    const off = brush.tool === "orbit";
    title.textContent = off ? "Choose a brush" : current.label;
    help.textContent = off ? "Paint concentrations while the coat grows, or masks and maps that become part of the recipe." : current.help;
    pick.hidden = !off;
    common.hidden = off;
    for (const [tool, part] of Object.entries(parts)) part.hidden = tool !== brush.tool;
    if (isMap(brush.tool)) help.append(` Formulas read it as attribute(${maps[brush.tool].attribute}).`);
  };
  studio.on("tool", show);
  show();
  return el("div", { class: "panel" }, el("div", { class: "scroll padded" }, title, help, pick, ...Object.values(parts), common));
}
