/** Sliders: sizes and parameters of the stages, seed and quality. They edit the text of the recipe. */

import { button, choice, el, slider, type Slider } from "../dom";
import type { ModelParameter, Stage } from "../protocol";
import * as toml from "../recipe-text";
import type { Studio } from "../studio";

type Quality = "draft" | "normal" | "fine";

/** A track on which a value that is given sits well inside, however wide the range: place^power. */
export function curveFor(low: number, high: number, value: number): { place: (v: number) => number; value: (p: number) => number } {
  const at = Math.min(0.98, Math.max(1e-6, (value - low) / (high - low)));
  const power = value > low && value < high ? Math.min(8, Math.max(1, Math.log(at) / Math.log(0.45))) : value <= low ? 2 : 1;
  return {
    place: (v) => Math.max(0, (v - low) / (high - low)) ** (1 / power),
    value: (p) => low + (high - low) * p ** power,
  };
}

/** The ends of the track of a parameter whose range may be open. */
export function trackOf(parameter: ModelParameter): { low: number; high: number } {
  const value = parameter.value ?? 0;
  const reach = Math.max(1, 4 * Math.abs(value));
  const low = parameter.low ?? (parameter.high !== null ? Math.min(value, parameter.high) - reach : value < 0 ? value - reach : Math.min(0, value));
  const high = parameter.high ?? Math.max(value, low) + reach;
  return { low, high: high > low ? high : low + 1 };
}

/** The text of a size so many times as large, in the unit that it was written in. */
export function scaledLength(raw: string | null, ratio: number, fraction: number): string {
  const text = toml.stringValue(raw);
  const match = text === null ? null : /^\s*([0-9.eE+-]+)\s*([a-z]*)\s*$/.exec(text);
  if (match && Number(match[1]) > 0) return toml.quoted(`${toml.numberText(Number(match[1]) * ratio)}${match[2]}`);
  const number = toml.numberValue(raw);
  return toml.numberText(number === null ? fraction : number * ratio);
}

interface StageControls {
  size: Slider | null;
  parameters: Map<string, Slider>;
}

class Adjust {
  readonly node = el("div", { class: "panel" });
  private readonly stages = el("div", {});
  private controls: StageControls[] = [];
  private signature = "";
  private together = true;

  constructor(private readonly studio: Studio) {
    this.node.append(el("div", { class: "scroll padded" }, this.general(), this.stages));
    studio.on("begun", () => this.follow());
    studio.on("stage", () => this.markStage());
  }

  private general(): HTMLElement {
    const studio = this.studio;
    const seed = el("input", { type: "text", inputmode: "numeric", class: "number", id: "seed", spellcheck: "false" });
    const setSeed = (value: number): void => {
      let text = studio.recipe;
      for (let stage = 0; stage < toml.stageCount(text); ++stage) text = toml.setStageKey(text, stage, "seed", String(value));
      studio.edit(text, { label: "seed", change: "restart" });
    };
    seed.addEventListener("change", () => {
      const value = Number(seed.value);
      if (Number.isInteger(value) && value >= 0) setSeed(value);
      else studio.say("A seed is a whole number, 0 or more.", true);
    });
    const another = button("Another", { label: "Another seed", class: "small" });
    another.addEventListener("click", () => setSeed(1 + Math.floor(Math.random() * 9999)));
    const qualities = (["draft", "normal", "fine"] as Quality[]).map((value) => ({ value, text: value[0]!.toUpperCase() + value.slice(1) }));
    const quality = choice<Quality>("Quality", qualities, "normal", (value) =>
      studio.edit(toml.setTopKey(studio.recipe, "quality", toml.quoted(value)), { label: "quality", change: "restart" }),
    );
    studio.on("recipe", () => {
      if (document.activeElement !== seed) seed.value = toml.stageValue(studio.recipe, 0, "seed") ?? "1";
      const chosen = toml.stringValue(toml.topValue(studio.recipe, "quality"));
      quality.set(chosen === "draft" || chosen === "fine" ? chosen : "normal");
    });
    return el(
      "div",
      { class: "pair" },
      el("div", {}, el("span", { class: "label" }, "Quality"), quality.node),
      el("div", {}, el("label", { for: "seed", class: "label" }, "Seed"), el("div", { class: "inline" }, seed, another)),
    );
  }

  private follow(): void {
    const stages = this.studio.begun?.stages ?? [];
    const signature = JSON.stringify([this.studio.shape.id, stages.map((s) => [s.name, s.model, s.parameters.map((p) => p.name)])]);
    if (signature !== this.signature) this.build(stages);
    this.signature = signature;
    stages.forEach((stage, index) => this.show(stage, index));
    this.markStage();
  }

  private build(stages: Stage[]): void {
    this.controls = stages.map(() => ({ size: null, parameters: new Map() }));
    const parts = stages.map((stage, index) => this.stagePart(stage, index, stages.length));
    if (stages.length > 1) parts.unshift(this.togetherToggle());
    this.stages.replaceChildren(...parts);
  }

  private togetherToggle(): HTMLElement {
    const box = el("input", { type: "checkbox", id: "together" });
    box.checked = this.together;
    box.addEventListener("change", () => (this.together = box.checked));
    return el("label", { class: "toggle" }, box, el("span", {}, "Sizes of the stages keep their proportions"));
  }

  private stagePart(stage: Stage, index: number, count: number): HTMLElement {
    const controls = this.controls[index]!;
    const body = el("div", { class: "stage-body" });
    const diagonal = this.studio.info?.diagonal ?? 1;
    if (stage.size !== null) {
      controls.size = this.sizeSlider(stage, index, diagonal);
      body.append(controls.size.node);
    }
    for (const parameter of stage.parameters) {
      const control = this.parameterSlider(parameter, index);
      controls.parameters.set(parameter.name, control);
      body.append(control.node);
    }
    const title = el("summary", {}, el("span", { class: "stage-name" }, count > 1 ? stage.name : "Parameters"), el("small", {}, stage.model));
    const part = el("details", { class: "stage", "data-stage": index }, title, body);
    part.open = count <= 2 || index === 0;
    return part;
  }

  private sizeSlider(stage: Stage, index: number, diagonal: number): Slider {
    const low = 0.006 * diagonal;
    const high = 0.3 * diagonal;
    return slider({
      label: "Size",
      help: "Spacing of the pattern in units of the shape",
      low,
      high,
      value: stage.size ?? low,
      curve: { place: (v) => Math.log(v / low) / Math.log(high / low), value: (p) => low * (high / low) ** p },
      onInput: (value) => this.setSize(index, value),
    });
  }

  private setSize(index: number, value: number): void {
    const { studio } = this;
    const grown = studio.begun?.stages ?? [];
    const before = grown[index]?.size;
    if (!before || !(value > 0)) return;
    const ratio = value / before;
    let text = studio.recipe;
    grown.forEach((stage, i) => {
      if (stage.size === null || (i !== index && !this.together)) return;
      const key = toml.stageValue(studio.grown, i, "unit") === null ? "size" : "unit";
      const raw = toml.stageValue(studio.grown, i, key);
      text = toml.setStageKey(text, i, key, scaledLength(raw, ratio, (stage.size * ratio) / (studio.info?.diagonal ?? 1)));
    });
    studio.edit(text, { label: "size", change: "restart", merge: `size ${index}` });
  }

  private parameterSlider(parameter: ModelParameter, index: number): Slider {
    const { studio } = this;
    const value = parameter.value ?? 0;
    const { low, high } = trackOf(parameter);
    return slider({
      label: parameter.name,
      help: parameter.meaning,
      low,
      high,
      value,
      curve: curveFor(low, high, value),
      onInput: (chosen) => {
        const text = toml.setParameter(studio.recipe, index, parameter.name, toml.numberText(chosen));
        studio.edit(text, { label: parameter.name, change: "keep", merge: `${index}.${parameter.name}` });
      },
      onReset: () => {
        const text = toml.removeParameter(studio.recipe, index, parameter.name);
        studio.edit(text, { label: `${parameter.name} as the model has it`, change: "keep" });
      },
    });
  }

  private show(stage: Stage, index: number): void {
    const controls = this.controls[index]!;
    if (controls.size && stage.size !== null) controls.size.set(stage.size);
    for (const parameter of stage.parameters) {
      const control = controls.parameters.get(parameter.name);
      const raw = toml.parameterValue(this.studio.recipe, index, parameter.name);
      const formula = raw !== null && toml.numberValue(raw) === null;
      control?.node.classList.toggle("own", raw !== null);
      control?.setNote(formula ? "a formula" : "");
      control?.node.classList.toggle("formula", formula);
      const value = toml.numberValue(raw) ?? parameter.value;
      if (value !== null && !formula) control?.set(value);
    }
  }

  private markStage(): void {
    const current = this.studio.progress?.stage ?? 0;
    for (const part of this.stages.querySelectorAll(".stage")) part.classList.toggle("current", Number(part.getAttribute("data-stage")) === current);
  }
}

export function adjustPanel(studio: Studio): HTMLElement {
  return new Adjust(studio).node;
}
