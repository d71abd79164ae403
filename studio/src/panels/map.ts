/** A map of two parameters to choose them in: what linear theory says of each pair, and pictures of what really grows. */

import { button, el } from "../dom";
import { shortNumber } from "../plot";
import type { MapTile, ModelParameter, ParameterMap } from "../protocol";
import * as toml from "../recipe-text";
import type { Studio } from "../studio";
import { trackOf } from "./adjust";

interface Axis {
  parameter: string;
  low: number;
  high: number;
}

interface Drawn {
  regimes: string[];
  regime: Uint8Array;
  growth: Float32Array;
  wavelength: Float32Array;
}

const cells = { x: 24, y: 20 };
const tiles = { x: 6, y: 5 };
const colors: [number, number, number][] = [[74, 79, 90], [214, 150, 72], [86, 140, 186], [128, 176, 110], [190, 104, 140], [150, 132, 204], [196, 188, 92], [90, 170, 160]];
/** A cell of which nothing is known yet; 255 is what lies outside of the ranges of the parameters. */
const unknown = 254;
const outside: [number, number, number] = [30, 31, 34];

/** The range of an axis around a value: half as much and half more, within what the model allows. */
export function axisAround(parameter: ModelParameter, value: number): Axis {
  const track = trackOf({ ...parameter, value });
  if (value === 0) return { parameter: parameter.name, low: track.low, high: track.high };
  const [a, b] = [0.5 * value, 1.5 * value].sort((p, q) => p - q) as [number, number];
  return { parameter: parameter.name, low: Math.max(a, parameter.low ?? -Infinity), high: Math.min(b, parameter.high ?? Infinity) };
}

/** The two parameters that a map begins with: of the reaction rather than of diffusion and noise. */
export function firstPair(parameters: ModelParameter[]): string[] {
  const dull = (p: ModelParameter): number => Number(/diffus|deviation|noise|initial|random|uneven|0:/i.test(p.meaning));
  return [...parameters].sort((p, q) => dull(p) - dull(q)).slice(0, 2).map((p) => p.name);
}

/** The value in the middle of a cell. */
const middle = (axis: Axis, i: number, count: number): number => axis.low + ((i + 0.5) / count) * (axis.high - axis.low);

class MapView {
  readonly node = el("section", { "aria-label": "Parameter map" });
  private readonly canvas = el("canvas", { class: "map", tabindex: 0, role: "application", "aria-label": "Parameter map. A click or the arrow keys choose both parameters." });
  private readonly here = el("p", { class: "quiet-text", role: "status" });
  private readonly legend = el("ul", { class: "findings" });
  private readonly selects: [HTMLSelectElement, HTMLSelectElement];
  private readonly fill = el("input", { type: "checkbox" });
  private axes: Axis[] = [];
  private model = "";
  private asked = "";
  private drawn: Drawn | null = null;
  private pictures = new Map<number, ImageBitmap | null>();
  private filling = false;

  constructor(private readonly studio: Studio) {
    this.selects = ["across", "upwards"].map((way) => el("select", { "aria-label": `Parameter ${way}` })) as [HTMLSelectElement, HTMLSelectElement];
    this.selects.forEach((select, i) => select.addEventListener("change", () => this.setAxis(i, select.value)));
    const around = button("Around here", { class: "small" });
    around.addEventListener("click", () => this.axes.forEach((axis, i) => this.setAxis(i, axis.parameter)));
    this.fill.addEventListener("change", () => void this.fillIn());
    const pictures = el("label", { class: "toggle" }, this.fill, el("span", {}, "Show what grows, while the coat rests or is paused"));
    const choose = el("div", { class: "inline map-axes" }, this.selects[0], el("span", {}, "→"), this.selects[1], el("span", {}, "↑"), around);
    this.node.append(el("h2", {}, "Parameter map"), choose, this.canvas, this.here, this.legend, pictures);
    this.canvas.addEventListener("pointerdown", (event) => this.onPointer(event));
    this.canvas.addEventListener("keydown", (event) => this.onKey(event));
  }

  private get visible(): boolean {
    return this.node.offsetParent !== null;
  }

  private get stage(): number {
    return this.studio.progress?.stage ?? 0;
  }

  /** The parameters that are numbers; formulas of the place cannot be moved. */
  private get parameters(): ModelParameter[] {
    const { recipe, stage } = this.studio;
    return (stage?.parameters ?? []).filter((p) => {
      const raw = toml.parameterValue(recipe, this.stage, p.name);
      return p.value !== null && (raw === null || toml.numberValue(raw) !== null);
    });
  }

  private valueOf(name: string): number {
    const raw = toml.parameterValue(this.studio.recipe, this.stage, name);
    return toml.numberValue(raw) ?? this.studio.stage?.parameters.find((p) => p.name === name)?.value ?? 0;
  }

  private setAxis(i: number, name: string): void {
    const parameter = this.parameters.find((p) => p.name === name);
    if (!parameter) return;
    this.axes[i] = axisAround(parameter, this.valueOf(name));
    void this.follow();
  }

  /** Takes another model, another recipe or other values; asks for the map where it is another one. */
  async follow(): Promise<void> {
    if (!this.visible || !this.studio.begun) return;
    const { parameters } = this;
    const names = parameters.map((p) => p.name);
    const model = `${this.studio.shape.id} ${this.stage} ${this.studio.stage?.model} ${names.join()}`;
    if (model !== this.model) {
      this.model = model;
      this.axes = firstPair(parameters).map((name) => axisAround(parameters.find((p) => p.name === name)!, this.valueOf(name)));
    }
    this.node.hidden = names.length < 2;
    if (names.length < 2) return;
    this.selects.forEach((select, i) => {
      const free = names.filter((name) => name !== this.axes[1 - i]!.parameter);
      const there = [...select.options].map((option) => option.value);
      if (free.join() !== there.join()) select.replaceChildren(...free.map((name) => el("option", { value: name }, name)));
      select.value = this.axes[i]!.parameter;
    });
    const rest = this.axes.reduce((text, axis) => toml.removeParameter(text, this.stage, axis.parameter), this.studio.recipe);
    const key = JSON.stringify([rest, this.stage, this.axes]);
    this.draw();
    if (key !== this.asked) await this.ask(key);
    void this.fillIn();
  }

  /** Asks row by row, from the chosen pair outward, so that the coat grows on between them. */
  private async ask(key: string): Promise<void> {
    this.asked = key;
    const { studio, stage } = this;
    const [x, y] = this.axes as [Axis, Axis];
    const count = cells.x * cells.y;
    const drawn: Drawn = { regimes: [], regime: new Uint8Array(count).fill(unknown), growth: new Float32Array(count), wavelength: new Float32Array(count).fill(NaN) };
    this.drawn = drawn;
    this.pictures.clear();
    this.legend.replaceChildren();
    const own = (this.valueOf(y.parameter) - y.low) / (y.high - y.low);
    const rows = Array.from({ length: cells.y }, (_, j) => j).sort((a, b) => Math.abs((a + 0.5) / cells.y - own) - Math.abs((b + 0.5) / cells.y - own));
    const columns = { parameter: x.parameter, low: middle(x, 0, cells.x), high: middle(x, cells.x - 1, cells.x), count: cells.x };
    try {
      for (const j of rows) {
        const row = { parameter: y.parameter, low: middle(y, j, cells.y) };
        const reply = await studio.engine.ask<ParameterMap>("parameter_map", { recipe: studio.recipe, stage, x: columns, y: row });
        if (key !== this.asked || !this.visible) break;
        drawn.regimes = reply.regimes;
        drawn.regime.set(reply.blocks["regime"] as Uint8Array, j * cells.x);
        drawn.growth.set(reply.blocks["growth"] as Float32Array, j * cells.x);
        drawn.wavelength.set(reply.blocks["wavelength"] as Float32Array, j * cells.x);
        this.draw();
      }
      if (key === this.asked && !this.visible) this.asked = "";
    } catch (error) {
      if (key === this.asked) this.legend.replaceChildren(el("li", {}, error instanceof Error ? error.message : String(error)));
    }
  }

  private explain({ regimes, regime }: Drawn): void {
    const there = regimes.map((text, i) => ({ text, i })).filter(({ i }) => regime.includes(i));
    if (this.legend.childElementCount === there.length) return;
    const swatch = (i: number): HTMLElement => el("span", { class: "swatch", style: `background: rgb(${colors[i % colors.length]!.join()})` });
    this.legend.replaceChildren(...there.map(({ text, i }) => el("li", {}, swatch(i), text)));
  }

  private draw(): void {
    const { canvas, drawn } = this;
    const [x, y] = this.axes;
    const scale = Math.min(2, devicePixelRatio || 1);
    [canvas.width, canvas.height] = [Math.round(canvas.clientWidth * scale), Math.round(canvas.clientHeight * scale)];
    const context = canvas.getContext("2d");
    if (!context || !x || !y || !canvas.width) return;
    if (drawn) {
      this.drawCells(context, drawn);
      this.explain(drawn);
    }
    this.pictures.forEach((picture, i) => picture && this.drawPicture(context, picture, i));
    const at = [((this.valueOf(x.parameter) - x.low) / (x.high - x.low)) * canvas.width, (1 - (this.valueOf(y.parameter) - y.low) / (y.high - y.low)) * canvas.height] as const;
    for (const [width, color] of [[4, "#0009"], [2, "#fff"]] as const) {
      context.lineWidth = width * scale;
      context.strokeStyle = color;
      context.beginPath();
      context.arc(at[0], at[1], 6 * scale, 0, 2 * Math.PI);
      context.stroke();
    }
    this.tell();
  }

  private drawCells(context: CanvasRenderingContext2D, { regime, growth }: Drawn): void {
    const image = new ImageData(cells.x, cells.y);
    const fastest = growth.reduce((most, g) => Math.max(most, g || 0), 0);
    for (let i = 0; i < regime.length; ++i) {
      const from = (cells.y - 1 - Math.floor(i / cells.x)) * cells.x + (i % cells.x);
      const color = regime[i]! >= unknown ? outside : colors[regime[i]! % colors.length]!;
      const light = fastest > 0 ? 0.6 + 0.4 * Math.sqrt(Math.max(0, growth[i]! || 0) / fastest) : 0.8;
      image.data.set([...color.map((c) => c * light), 255], 4 * from);
    }
    const small = new OffscreenCanvas(cells.x, cells.y);
    small.getContext("2d")?.putImageData(image, 0, 0);
    context.imageSmoothingEnabled = false;
    context.drawImage(small, 0, 0, this.canvas.width, this.canvas.height);
  }

  private drawPicture(context: CanvasRenderingContext2D, picture: ImageBitmap, i: number): void {
    const [width, height] = [this.canvas.width / tiles.x, this.canvas.height / tiles.y];
    const side = 0.86 * Math.min(width, height);
    const [x, y] = [i % tiles.x, tiles.y - 1 - Math.floor(i / tiles.x)];
    context.imageSmoothingEnabled = true;
    context.drawImage(picture, (x + 0.5) * width - side / 2, (y + 0.5) * height - side / 2, side, side);
  }

  /** What the map says of the pair that is chosen. */
  private tell(): void {
    const [x, y] = this.axes;
    if (!x || !y) return;
    const [a, b] = [this.valueOf(x.parameter), this.valueOf(y.parameter)];
    const cell = (axis: Axis, value: number, count: number): number => Math.floor(((value - axis.low) / (axis.high - axis.low)) * count);
    const [i, j] = [cell(x, a, cells.x), cell(y, b, cells.y)];
    const within = this.drawn && i >= 0 && i < cells.x && j >= 0 && j < cells.y;
    const k = j * cells.x + i;
    const regime = within ? this.drawn!.regimes[this.drawn!.regime[k]!] : undefined;
    const wavelength = within ? this.drawn!.wavelength[k]! : NaN;
    const words = regime ? `: ${regime}${Number.isFinite(wavelength) ? `, wavelength ${shortNumber(wavelength)}` : ""}` : "";
    this.here.textContent = `${x.parameter} = ${shortNumber(a)}, ${y.parameter} = ${shortNumber(b)}${words}`;
  }

  private choose(a: number, b: number): void {
    const [x, y] = this.axes;
    if (!x || !y) return;
    const within = (axis: Axis, value: number): string => String(Number(Math.min(axis.high, Math.max(axis.low, value)).toPrecision(3)));
    let text = toml.setParameter(this.studio.recipe, this.stage, x.parameter, within(x, a));
    text = toml.setParameter(text, this.stage, y.parameter, within(y, b));
    this.studio.edit(text, { label: `${x.parameter} and ${y.parameter}`, change: "keep", merge: "map" });
    this.draw();
  }

  private onPointer(event: PointerEvent): void {
    const [x, y] = this.axes;
    if (!x || !y || event.button !== 0) return;
    const box = this.canvas.getBoundingClientRect();
    const [across, up] = [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    this.choose(x.low + across * (x.high - x.low), y.low + up * (y.high - y.low));
  }

  private onKey(event: KeyboardEvent): void {
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const step = steps[event.key];
    const [x, y] = this.axes;
    if (!step || !x || !y) return;
    event.preventDefault();
    const moved = (axis: Axis, by: number, count: number): number => this.valueOf(axis.parameter) + (by * (axis.high - axis.low)) / count;
    this.choose(moved(x, step[0], cells.x), moved(y, step[1], cells.y));
  }

  /** Asks for one picture after the other, those near the chosen pair first, while the coat needs no engine. */
  private async fillIn(): Promise<void> {
    if (this.filling) return;
    this.filling = true;
    while (this.fill.checked && this.visible && this.drawn && !this.studio.playing && !this.studio.busy) {
      const next = this.nextTile();
      if (next === null) break;
      await this.tile(next);
      this.draw();
    }
    this.filling = false;
  }

  private placeOf(tile: number): [number, number] {
    return [middle(this.axes[0]!, tile % tiles.x, tiles.x), middle(this.axes[1]!, Math.floor(tile / tiles.x), tiles.y)];
  }

  private nextTile(): number | null {
    const away = (tile: number): number => {
      const place = this.placeOf(tile);
      return this.axes.reduce((sum, axis, i) => sum + ((place[i]! - this.valueOf(axis.parameter)) / (axis.high - axis.low)) ** 2, 0);
    };
    const left = Array.from({ length: tiles.x * tiles.y }, (_, i) => i).filter((i) => !this.pictures.has(i));
    return left.sort((a, b) => away(a) - away(b))[0] ?? null;
  }

  private async tile(i: number): Promise<void> {
    const key = this.asked;
    const [a, b] = this.placeOf(i);
    const [x, y] = [{ parameter: this.axes[0]!.parameter, low: a }, { parameter: this.axes[1]!.parameter, low: b }];
    let picture: ImageBitmap | null = null;
    try {
      const texels = 64;
      const reply = await this.studio.engine.ask<MapTile>("map_tile", { recipe: this.studio.recipe, stage: this.stage, x, y, texels });
      const pixels = reply.blocks["pixels"] as Uint8Array | undefined;
      if (pixels) picture = await createImageBitmap(new ImageData(new Uint8ClampedArray(pixels), texels));
    } catch {
      // Nothing grows there, or it was stopped; the place stays as the theory has it.
    }
    if (key === this.asked) this.pictures.set(i, picture);
  }
}

export function parameterMap(studio: Studio): { node: HTMLElement; follow: () => void } {
  const view = new MapView(studio);
  const follow = (): void => void view.follow();
  studio.on(["recipe", "begun", "stage", "playing"], follow);
  return { node: view.node, follow };
}
