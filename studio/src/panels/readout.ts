/** What happens, in numbers: plots of change and of the ranges of the species, and what linear theory says. */

import { button, el } from "../dom";
import { plot, shortNumber } from "../plot";
import type { Analysis } from "../protocol";
import type { Studio } from "../studio";
import { parameterMap } from "./map";

export const speciesColors = ["#e0a660", "#7fb2d9", "#9cc98a", "#d98ab0", "#c3b7e6", "#d8d27a"];

function figure(title: string, label: string): { node: HTMLElement; canvas: HTMLCanvasElement; note: HTMLElement } {
  const canvas = el("canvas", { class: "plot", role: "img", "aria-label": label });
  const note = el("span", { class: "legend" });
  return { node: el("figure", {}, el("figcaption", {}, el("span", {}, title), note), canvas), canvas, note };
}

class Readout {
  readonly node = el("div", { class: "panel" });
  private readonly change = figure("Change per unit of time", "Plot of the change over the steps");
  private readonly ranges = el("div", {});
  private readonly rangeFigures = new Map<string, ReturnType<typeof figure>>();
  private readonly theory = el("div", {});
  private readonly dispersion = figure("Growth rate by wavelength", "Plot of the dispersion relation");
  private readonly words = el("div", {});
  private analysed = "";
  private drawn = 0;

  constructor(private readonly studio: Studio) {
    const again = button("Ask again", { class: "small" });
    again.addEventListener("click", () => void this.analyse(true));
    this.theory.append(el("div", { class: "inline spread" }, el("h2", {}, "Linear theory"), again), this.dispersion.node, this.words);
    const map = parameterMap(studio);
    this.node.append(el("div", { class: "scroll padded" }, el("h2", {}, "Growth"), this.change.node, this.ranges, this.theory, map.node));
    studio.on("frame", () => this.draw(false));
    studio.on(["begun", "stage"], () => void this.analyse(false));
    new ResizeObserver(() => {
      this.draw(true);
      void this.analyse(false);
      map.follow();
    }).observe(this.node);
  }

  private get visible(): boolean {
    return this.node.offsetParent !== null;
  }

  private draw(now: boolean): void {
    if (!this.visible || (!now && performance.now() - this.drawn < 150)) return;
    this.drawn = performance.now();
    const { series } = this.studio;
    const last = series.change[series.change.length - 1];
    this.change.note.textContent = shortNumber(last);
    plot(this.change.canvas, { lines: [{ x: series.time, y: series.change, color: speciesColors[1]! }], logY: true, xLabel: "steps" });
    const names = this.studio.stage?.species ?? [];
    if (names.join() !== [...this.rangeFigures.keys()].join()) this.makeRanges(names);
    names.forEach((name, i) => {
      const range = series.ranges.get(name);
      const one = this.rangeFigures.get(name);
      if (!range || !one) return;
      const color = speciesColors[i % speciesColors.length]!;
      one.note.textContent = `${shortNumber(range.low[range.low.length - 1])} to ${shortNumber(range.high[range.high.length - 1])}`;
      plot(one.canvas, { lines: [{ x: series.time, y: range.low, color }, { x: series.time, y: range.high, color }], xLabel: "steps" });
    });
  }

  private makeRanges(names: string[]): void {
    this.rangeFigures.clear();
    for (const name of names) this.rangeFigures.set(name, figure(`Range of ${name}`, `Plot of the smallest and largest ${name}`));
    this.ranges.replaceChildren(...[...this.rangeFigures.values()].map((one) => one.node));
  }

  private async analyse(again: boolean): Promise<void> {
    const { studio } = this;
    const stage = studio.progress?.stage ?? 0;
    const key = `${stage} ${studio.grown}`;
    if (!this.visible || !studio.begun || (key === this.analysed && !again)) return;
    this.analysed = key;
    try {
      this.showAnalysis(await studio.analyse(stage));
    } catch (error) {
      this.dispersion.node.hidden = true;
      this.words.replaceChildren(el("p", { class: "quiet-text" }, error instanceof Error ? error.message : String(error)));
    }
  }

  private showAnalysis(analysis: Analysis): void {
    const { wavelengths, growth_rates } = analysis;
    const known = wavelengths.some((w) => w !== null);
    this.dispersion.node.hidden = !known;
    const facts = el("dl", { class: "facts" });
    const add = (name: string, value: string): void => facts.append(el("dt", {}, name), el("dd", {}, value));
    add("Grows fastest", analysis.wavelength === null ? "nothing" : `wavelength ${shortNumber(analysis.wavelength)}`);
    add("Finished spacing", shortNumber(analysis.spacing));
    const conditions = el("ul", { class: "findings" });
    for (const { text, holds } of analysis.conditions) conditions.append(el("li", { class: holds ? "holds" : "fails" }, text));
    const thresholds = [analysis.thresholds ?? []].flat().map((text) => el("li", {}, text));
    const lengths = el("p", { class: "quiet-text" }, "Lengths and times are the model's own.");
    this.words.replaceChildren(el("p", { class: "verdict" }, analysis.verdict), facts, conditions, el("ul", { class: "findings" }, ...thresholds), lengths);
    if (known) {
      plot(this.dispersion.canvas, { lines: [{ x: wavelengths, y: growth_rates, color: speciesColors[0]! }], zeroLine: true, clipBelow: true, markX: analysis.wavelength, xLabel: "wavelength" });
    }
  }
}

export function readoutPanel(studio: Studio): HTMLElement {
  return new Readout(studio).node;
}
