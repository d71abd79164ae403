/** The shape: built-in ones, files, and what the engine found about them. */

import { button, el, icon } from "../dom";
import { lengthText } from "../ruler";
import type { Studio } from "../studio";

const counted = (n: number): string => n.toLocaleString("en-US");

function facts(studio: Studio): HTMLElement {
  const info = studio.info;
  const list = el("dl", { class: "facts" });
  if (!info) return list;
  const add = (name: string, value: string): void => list.append(el("dt", {}, name), el("dd", {}, value));
  const edges = info.high.map((high, i) => lengthText(high - info.low[i]!, info.metres_per_unit)).join(" × ");
  add("Name", studio.shape.name);
  add("Vertices", counted(info.vertices));
  add("Triangles", counted(info.triangles));
  add("Size", edges);
  add("Diagonal", lengthText(info.diagonal, info.metres_per_unit));
  if (studio.begun) add("Grown on", `${counted(studio.begun.nodes)} nodes, ${lengthText(studio.begun.node_spacing ?? 0, info.metres_per_unit)} apart`);
  if (info.attributes.length) add("Attributes", info.attributes.join(", "));
  return list;
}

function findings(studio: Studio): HTMLElement {
  const all = studio.info?.findings ?? [];
  const list = el("ul", { class: "findings" });
  if (!all.length && studio.info) list.append(el("li", { class: "fine" }, icon("good"), "Nothing to repair."));
  for (const { message, repaired } of all) {
    list.append(el("li", { class: repaired ? "fine" : "bad" }, icon(repaired ? "good" : "warning"), repaired ? `${message} (repaired)` : message));
  }
  return list;
}

function openButton(studio: Studio): HTMLElement {
  const input = el("input", { type: "file", class: "hidden-input", tabindex: -1, "aria-label": "File of a shape or a recipe" });
  const open = button("Open a mesh or a recipe", { icon: "open", class: "wide" });
  open.addEventListener("click", () => input.click());
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (file) studio.chooseFile(file).catch((error: unknown) => studio.fail(error, file.name));
    input.value = "";
  });
  studio.on("ready", () => (input.accept = [...(studio.catalog?.reads ?? []), ".toml"].join(",")));
  return el("div", {}, open, input);
}

function builtinList(studio: Studio): HTMLElement {
  const list = el("div", { class: "rows", role: "group", "aria-label": "Built-in shapes" });
  const mark = (): void => {
    for (const row of list.children) row.setAttribute("aria-pressed", String(row.getAttribute("data-shape") === studio.shape.id));
  };
  studio.on("ready", () => {
    for (const { name } of studio.catalog?.shapes ?? []) {
      const row = el("button", { type: "button", class: "row", "data-shape": name }, icon("shape"), el("span", {}, name.replace("builtin:", "")));
      row.addEventListener("click", () => void studio.chooseShape(studio.builtin(name)));
      list.append(row);
    }
    mark();
  });
  studio.on("shape", mark);
  return list;
}

export function shapePanel(studio: Studio): HTMLElement {
  const place = el("div", {});
  const show = (): void => place.replaceChildren(facts(studio), findings(studio));
  studio.on(["shape", "begun"], show);
  const reads = el("p", { class: "quiet-text" });
  studio.on("ready", () => {
    const where = studio.hello?.engine === "wasm" ? "It stays in this page; nothing is sent anywhere." : "It stays on this machine.";
    reads.textContent = `Or drop a file anywhere: ${studio.catalog?.reads.join(" ") ?? ""}. ${where}`;
  });
  return el(
    "div",
    { class: "panel" },
    el("div", { class: "scroll padded" }, openButton(studio), reads, el("h2", {}, "Built-in shapes"), builtinList(studio), el("h2", {}, "This shape"), place),
  );
}
