/** Colours and surface of the coat, which the recipe holds; background and light, which belong to the view. */

import { button, choice, el, slider, toggle } from "../dom";
import type { Ramp } from "../protocol";
import * as toml from "../recipe-text";
import { backgrounds } from "../scene";
import type { Studio } from "../studio";

const layersOf = (text: string): toml.Section[] => toml.sections(text).filter((section) => section.name === "look.layers");

function gradient(ramp: Ramp): string {
  return `linear-gradient(90deg, ${ramp.colors.map((c) => `rgb(${c.map(Number).join(",")})`).join(",")})`;
}

function rampsPart(studio: Studio): HTMLElement {
  const list = el("div", { class: "ramps", role: "group", "aria-label": "Colour ramps" });
  const mark = (): void => {
    const chosen = toml.stringValue(toml.lookValue(studio.recipe, "ramp"));
    for (const node of list.children) node.setAttribute("aria-pressed", String(node.getAttribute("data-ramp") === chosen));
  };
  studio.on("ready", () => {
    for (const ramp of studio.catalog?.ramps ?? []) {
      const bar = el("span", { class: "ramp-bar" });
      bar.style.background = gradient(ramp);
      const node = el("button", { type: "button", class: "ramp", "data-ramp": ramp.name }, bar, el("span", {}, ramp.name));
      node.addEventListener("click", () => {
        const text = withoutLayers(studio.recipe);
        studio.edit(toml.setLookKey(text, "ramp", toml.quoted(ramp.name)), { label: `ramp ${ramp.name}` });
      });
      list.append(node);
    }
    mark();
  });
  studio.on("recipe", mark);
  return list;
}

/** The text without the layers of its look, which would hide a ramp. */
function withoutLayers(text: string): string {
  for (const layer of layersOf(text).reverse()) text = text.slice(0, layer.start) + text.slice(layer.end);
  return text;
}

function layerRow(studio: Studio, index: number): HTMLElement {
  const section = (): toml.Section | undefined => layersOf(studio.recipe)[index];
  const edit = (key: string, value: string): void => {
    const layer = section();
    if (layer) studio.edit(toml.setKey(studio.recipe, layer, key, value), { label: `layer ${index + 1}`, merge: `layer ${index} ${key}` });
  };
  const colorText = toml.stringValue(toml.rawValue(studio.recipe, section(), "color"));
  const color = el("input", { type: "color", "aria-label": `Colour of layer ${index + 1}` });
  color.value = /^#[0-9a-f]{6}$/i.test(colorText ?? "") ? colorText! : "#888888";
  color.disabled = colorText === null;
  color.addEventListener("input", () => edit("color", toml.quoted(color.value)));
  const raw = toml.rawValue(studio.recipe, section(), "opacity");
  const opacity = el("input", { type: "text", class: "formula-field", "aria-label": `Opacity of layer ${index + 1}, a formula`, placeholder: "everywhere", spellcheck: "false" });
  opacity.value = toml.stringValue(raw) ?? raw ?? "";
  opacity.addEventListener("change", () => {
    const text = opacity.value.trim();
    if (text) edit("opacity", toml.numberValue(text) !== null && Number.isFinite(Number(text)) ? text : toml.quoted(text));
  });
  return el("div", { class: "layer" }, color, opacity);
}

function layersPart(studio: Studio): HTMLElement {
  const rows = el("div", { class: "layers" });
  const remove = button("Show a ramp instead", { class: "small" });
  remove.addEventListener("click", () => studio.edit(withoutLayers(studio.recipe), { label: "remove layers" }));
  const part = el("div", {}, el("h2", {}, "Layers"), el("p", { class: "quiet-text" }, "The first one lies lowest. The opacity is a formula from 0 to 1."), rows, remove);
  let signature = "";
  studio.on("recipe", () => {
    const layers = layersOf(studio.recipe);
    part.hidden = layers.length === 0;
    const now = layers.map((layer) => studio.recipe.slice(layer.start, layer.end)).join("");
    if (now === signature || rows.contains(document.activeElement)) return;
    signature = now;
    rows.replaceChildren(...layers.map((_, index) => layerRow(studio, index)));
  });
  return part;
}

function speciesPart(studio: Studio): HTMLElement {
  const select = el("select", { id: "look-species" });
  const invert = toggle("Exchange the ends of the colours", false, (on) => {
    const text = on ? toml.setLookKey(studio.recipe, "invert", "true") : toml.removeLookKey(studio.recipe, "invert");
    studio.edit(text, { label: "invert" });
  });
  select.addEventListener("change", () => studio.edit(toml.setLookKey(studio.recipe, "species", toml.quoted(select.value)), { label: "species shown" }));
  const follow = (): void => {
    const species = studio.begun?.stages[studio.begun.stages.length - 1]?.species ?? [];
    select.replaceChildren(...species.map((name) => el("option", { value: name }, name)));
    select.value = toml.stringValue(toml.lookValue(studio.recipe, "species")) ?? species[species.length - 1] ?? "";
    invert.set(toml.lookValue(studio.recipe, "invert") === "true");
  };
  studio.on(["recipe", "begun"], follow);
  return el("div", {}, el("div", { class: "field" }, el("label", { for: "look-species" }, "Species shown"), select), invert.node);
}

function surfacePart(studio: Studio): HTMLElement {
  const usual: Record<string, number> = { roughness: 0.8, metalness: 0 };
  const controls = Object.entries(usual).map(([key, value]) => {
    const label = key[0]!.toUpperCase() + key.slice(1);
    const control = slider({
      label,
      low: 0,
      high: 1,
      value,
      digits: 2,
      onInput: (v) => studio.edit(toml.setLookKey(studio.recipe, key, toml.numberText(v)), { label: key, merge: key }),
      onReset: () => studio.edit(toml.removeLookKey(studio.recipe, key), { label: key }),
    });
    return { key, control };
  });
  studio.on("recipe", () => {
    const values = controls.map(({ key, control }) => {
      const raw = toml.lookValue(studio.recipe, key);
      const number = toml.numberValue(raw);
      control.setNote(raw !== null && number === null ? "a formula" : "");
      control.set(number ?? usual[key]!);
      return number ?? (raw !== null && key === "roughness" ? 0.5 : usual[key]!);
    });
    studio.scene.setSurface(values[0]!, values[1]!);
  });
  return el("div", {}, ...controls.map(({ control }) => control.node));
}

function viewPart(studio: Studio): HTMLElement {
  const names = Object.keys(backgrounds).map((value) => ({ value, text: value[0]!.toUpperCase() + value.slice(1) }));
  const background = choice("Background", names, studio.background, (value) => studio.setView({ background: value }));
  const light = slider({ label: "Light", low: 0.2, high: 2, value: studio.light, digits: 2, onInput: (v) => studio.setView({ light: v }) });
  studio.on("ready", () => {
    background.set(studio.background);
    light.set(studio.light);
  });
  return el("div", {}, el("span", { class: "label" }, "Background"), background.node, light.node);
}

export function lookPanel(studio: Studio): HTMLElement {
  return el(
    "div",
    { class: "panel" },
    el(
      "div",
      { class: "scroll padded" },
      layersPart(studio),
      el("h2", {}, "Ramp"),
      rampsPart(studio),
      speciesPart(studio),
      el("h2", {}, "Surface"),
      surfacePart(studio),
      el("h2", {}, "View"),
      viewPart(studio),
    ),
  );
}
