/** Painting on the surface: concentrations while they grow, masks and maps into the recipe's text. */

import type { Vec3 } from "./protocol";
import { addDirections, addStroke, brushStrokes, directionStrokes, removeBrush, removeDirections, unuseInStages, useInStages } from "./recipe-text";
import type { Stroke, Use } from "./recipe-text";
import type { Studio } from "./studio";

export type Tool = "orbit" | "brush" | "eraser" | "mask" | "size" | "direction";

/** The painted attributes, and how the stages use them. */
export const maps: Record<"mask" | "size", { attribute: string; use: Use; tint: string; label: string }> = {
  mask: {
    attribute: "bald",
    use: { key: "mask", alone: "attribute(bald) > 0.5", before: "(", after: ") or (attribute(bald) > 0.5)" },
    tint: "#3f8fd0",
    label: "mask stroke",
  },
  size: {
    attribute: "wider",
    use: { key: "size-map", alone: "1 + attribute(wider)", before: "(", after: ")*(1 + attribute(wider))" },
    tint: "#c0529a",
    label: "size stroke",
  },
};

export function isMap(tool: Tool): tool is "mask" | "size" {
  return tool === "mask" || tool === "size";
}

const difference = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const distance = (a: Vec3, b: Vec3): number => Math.sqrt(dot(difference(a, b), difference(a, b)));

/** How strongly a stroke acts at a distance: 1 within the hard part, falling smoothly to 0 at the radius. */
export function strength(away: number, radius: number, hardness: number): number {
  if (away >= radius) return 0;
  const t = Math.max(0, (away / radius - hardness) / Math.max(1e-6, 1 - hardness));
  return 1 - t * t * (3 - 2 * t);
}

export class Brush {
  tool: Tool = "orbit";
  species = "";
  value = 1;
  radius = 0;
  hardness = 0.5;
  mapValue: Record<"mask" | "size", number> = { mask: 1, size: 1 };
  symmetry = [false, false, false];

  private pointer: number | null = null;
  private points: Vec3[] = [];
  private sent = 0;
  private sending = false;
  private preview: Float32Array | null = null;
  private last: { x: number; y: number } | null = null;

  constructor(private readonly studio: Studio) {
    const { canvas } = studio.scene;
    const host = canvas.parentElement!;
    host.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
    host.addEventListener("pointermove", (event) => this.move(event), { capture: true });
    host.addEventListener("pointerup", (event) => this.up(event), { capture: true });
    host.addEventListener("pointercancel", (event) => this.up(event), { capture: true });
    host.addEventListener("pointerleave", () => this.hover(null));
    studio.on("shape", () => this.onShape());
    studio.on(["begun", "fine"], () => this.show());
    studio.on("recipe", () => this.pointer === null && this.show());
    studio.on("stage", () => this.onStage());
  }

  choose(tool: Tool): void {
    this.tool = tool;
    this.studio.scene.canvas.style.cursor = tool === "orbit" ? "" : "crosshair";
    if (tool === "orbit" || tool === "direction") this.studio.scene.setRings([], 0);
    this.show();
    this.studio.emit("tool");
  }

  setRadius(radius: number): void {
    const diagonal = this.studio.info?.diagonal ?? 1;
    this.radius = Math.min(0.5 * diagonal, Math.max(0.002 * diagonal, radius));
    this.hover(this.last);
    this.studio.emit("tool");
  }

  private onShape(): void {
    this.radius = 0.04 * (this.studio.info?.diagonal ?? 1);
    this.studio.emit("tool");
  }

  /** Another stage has other species: paint its last one, to a value that its field reaches. */
  private onStage(): void {
    const species = this.studio.stage?.species ?? [];
    if (!species.includes(this.species)) this.species = species[species.length - 1] ?? "";
    this.studio.emit("tool");
  }

  /** The point and its mirror images about the middle of the box. */
  private mirrored(point: Vec3): Vec3[] {
    const info = this.studio.info;
    let all: Vec3[] = [point];
    if (!info) return all;
    this.symmetry.forEach((on, axis) => {
      if (!on) return;
      const twice = info.low[axis]! + info.high[axis]!;
      all = [...all, ...all.map((p) => p.map((v, i) => (i === axis ? twice - v : v)) as Vec3)];
    });
    return all;
  }

  private hover(at: { x: number; y: number } | null): void {
    this.last = at;
    if (this.tool === "orbit" || this.tool === "direction") return;
    const hit = at && this.studio.begun ? this.studio.scene.pick(at.x, at.y) : null;
    this.studio.scene.setRings(hit ? this.mirrored(hit.point) : [], this.radius);
  }

  private down(event: PointerEvent): void {
    if (this.tool === "orbit" || event.button !== 0 || this.pointer !== null || !this.studio.begun) return;
    if (this.tool === "direction" && !this.combed.length) return;
    if (event.target !== this.studio.scene.canvas) return;
    const hit = this.studio.scene.pick(event.clientX, event.clientY);
    if (!hit) return;
    this.studio.scene.orbiting = false;
    this.pointer = event.pointerId;
    this.studio.scene.canvas.setPointerCapture(event.pointerId);
    this.points = [];
    this.sent = 0;
    if (this.tool === "brush" || this.tool === "eraser") this.studio.recordPaint(this.tool === "eraser" ? "eraser stroke" : "brush stroke");
    this.add(this.placeOf(hit.point));
  }

  /** What becomes part of the recipe is painted on the shape as it was, and what grows on the one that is there. */
  private placeOf(point: Vec3): Vec3 {
    return isMap(this.tool) || this.tool === "direction" ? this.studio.scene.atStart(point) : point;
  }

  private move(event: PointerEvent): void {
    if (this.pointer === null) {
      if (event.buttons === 0) this.hover({ x: event.clientX, y: event.clientY });
      return;
    }
    if (event.pointerId !== this.pointer) return;
    this.last = { x: event.clientX, y: event.clientY };
    const hit = this.studio.scene.pick(event.clientX, event.clientY);
    if (this.tool !== "direction") this.studio.scene.setRings(hit ? this.mirrored(hit.point) : [], this.radius);
    if (hit) this.add(this.placeOf(hit.point));
  }

  private up(event: PointerEvent): void {
    if (event.pointerId !== this.pointer) return;
    this.pointer = null;
    this.studio.scene.orbiting = true;
    if (isMap(this.tool)) this.finishMap(this.tool);
    if (this.tool === "direction") this.finishDirection();
    if (event.pointerType === "touch") this.studio.scene.setRings([], 0);
  }

  private add(point: Vec3): void {
    const last = this.points[this.points.length - 1];
    const apart = this.tool === "direction" ? 0.015 * (this.studio.info?.diagonal ?? 1) : 0.25 * this.radius;
    if (last && distance(last, point) < apart) return;
    this.points.push(point);
    if (isMap(this.tool)) this.previewSegment(this.tool, last ?? point, point);
    else if (this.tool === "direction") this.showDirections();
    else void this.send();
  }

  /** Sends what has been added to the stroke since the last request; while one is on its way, the next ones gather. */
  private async send(): Promise<void> {
    if (this.sending) return;
    this.sending = true;
    try {
      while (this.sent < this.points.length) {
        const from = Math.max(0, this.sent - 1);
        const part = this.points.slice(from);
        this.sent = this.points.length;
        await this.paint(part);
      }
      this.studio.wake();
    } catch (error) {
      this.studio.fail(error, "The paint did not take");
    }
    this.sending = false;
  }

  private async paint(points: Vec3[]): Promise<void> {
    const images = points.map((point) => this.mirrored(point));
    const { radius, hardness } = this;
    for (const [species, value] of this.targets()) {
      for (let i = 0; i < images[0]!.length; ++i) {
        const line = images.map((all) => all[i]!);
        const reply = await this.studio.engine.ask("paint", { species, value, radius, hardness, points: line });
        if (reply.blocks["colors"]) this.studio.scene.setColors(reply.blocks["colors"] as Uint8Array);
      }
    }
  }

  private targets(): [string, number][] {
    if (this.tool === "brush") return [[this.species, this.value]];
    return (this.studio.stage?.species ?? []).map((species) => [species, this.studio.rest.get(species) ?? 0]);
  }

  /** The numbers of the stages whose diffusion follows directions. */
  get combed(): number[] {
    return (this.studio.begun?.stages ?? []).flatMap((stage, i) => (stage.anisotropic ? [i] : []));
  }

  /** The stroke in hand with its mirror images, as lines. */
  private get lines(): Vec3[][] {
    const images = this.points.map((point) => this.mirrored(point));
    return (images[0] ?? []).map((_, i) => images.map((all) => all[i]!));
  }

  private finishDirection(): void {
    const { lines, studio } = this;
    this.points = [];
    if (!lines[0] || lines[0].length < 2) return this.showDirections();
    const text = this.combed.reduce((all, stage) => addDirections(all, stage, lines), studio.recipe);
    studio.edit(text, { label: "direction stroke", change: "restart" });
  }

  clearDirections(): void {
    const text = this.combed.reduce(removeDirections, this.studio.recipe);
    this.studio.edit(text, { label: "clear the directions", change: "restart" });
  }

  /** The strokes of all stages, each once. */
  get directions(): Vec3[][] {
    const all = this.combed.flatMap((stage) => directionStrokes(this.studio.recipe, stage));
    return [...new Map(all.map((stroke) => [JSON.stringify(stroke), stroke])).values()];
  }

  private showDirections(): void {
    const shown = this.tool === "direction" ? [...this.directions, ...this.lines] : [];
    this.studio.scene.setLines(shown, 0.0035 * (this.studio.info?.diagonal ?? 1));
  }

  private finishMap(tool: "mask" | "size"): void {
    const { attribute, use, label } = maps[tool];
    let text = this.studio.recipe;
    for (const points of this.lines) {
      text = addStroke(text, attribute, { radius: this.radius, value: this.mapValue[tool], hardness: this.hardness, points });
    }
    this.studio.edit(useInStages(text, use), { label, change: "restart" });
  }

  clearMap(tool: "mask" | "size"): void {
    const { attribute, use } = maps[tool];
    this.studio.edit(removeBrush(unuseInStages(this.studio.recipe, use), attribute), { label: `clear the ${tool} map`, change: "restart" });
  }

  /** Marks on the surface what the tool in hand has painted into the recipe. */
  private show(): void {
    const tool = this.tool;
    this.showDirections();
    if (!isMap(tool)) {
      this.preview = null;
      return this.studio.scene.setPainted(null, "#000");
    }
    this.preview = new Float32Array(this.studio.scene.positions.length / 3);
    for (const stroke of brushStrokes(this.studio.recipe, maps[tool].attribute, this.studio.info?.diagonal ?? 1)) this.lay(stroke);
    this.showPreview(tool);
  }

  private previewSegment(tool: "mask" | "size", a: Vec3, b: Vec3): void {
    const from = this.mirrored(a);
    this.mirrored(b).forEach((point, i) => {
      this.lay({ radius: this.radius, value: this.mapValue[tool], hardness: this.hardness, points: [from[i]!, point] });
    });
    this.showPreview(tool);
  }

  private lay(stroke: Stroke): void {
    const places = this.studio.scene.startPositions;
    const values = this.preview;
    if (!values || values.length !== places.length / 3) return;
    const { points, radius, hardness, value } = stroke;
    for (let i = 0; i < values.length; ++i) {
      const place: Vec3 = [places[3 * i]!, places[3 * i + 1]!, places[3 * i + 2]!];
      let away = Infinity;
      for (let k = 0; k < points.length; ++k) away = Math.min(away, toSegment(place, points[Math.max(0, k - 1)]!, points[k]!));
      const w = strength(away, radius, hardness);
      if (w > 0) values[i] = values[i]! + w * (value - values[i]!);
    }
  }

  private showPreview(tool: "mask" | "size"): void {
    const bytes = Uint8Array.from(this.preview ?? [], (v) => Math.min(255, Math.abs(v) * 255));
    // Afterwards the pattern shows through.
    this.studio.scene.setPainted(bytes, maps[tool].tint, this.pointer === null ? 0.35 : 0.7);
  }
}

export function toSegment(p: Vec3, a: Vec3, b: Vec3): number {
  const along = difference(b, a);
  const from = difference(p, a);
  const length = dot(along, along);
  const t = length > 0 ? Math.min(1, Math.max(0, dot(from, along) / length)) : 0;
  return distance(p, [a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]]);
}
