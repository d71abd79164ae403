/**
 * The one place that knows what is being grown: recipe, shape, the coat as it stands, what was before. Panels read it,
 * call its methods and listen to its topics; they know nothing of each other.
 */

import { EngineError, type Answer, type Engine } from "./engine";
import { History, type Snapshot } from "./history";
import type { Shared, View } from "./link";
import type { Analysis, Begun, Catalog, Hello, Progress, ShapeInfo, Stage } from "./protocol";
import * as toml from "./recipe-text";
import type { Change } from "./recipe-text";
import { reducedMotion, type Scene } from "./scene";
import { keepFile, keptFile, load, save, type KeptFile, type Saved } from "./store";

export type Topic = "ready" | "recipe" | "shape" | "begun" | "frame" | "stage" | "playing" | "busy" | "history" | "fine" | "message" | "fault" | "tool";

export interface ShapeChoice {
  /** `builtin:NAME`, or `file:NUMBER` for a file of the user. */
  id: string;
  name: string;
  bytes: Uint8Array | null;
}

export interface EditOptions {
  label: string;
  change?: Change;
  /** Edits of the same key in a row are one step of undo. */
  merge?: string;
}

export interface Series {
  /** Steps of the stages before this one. */
  earlier: number;
  time: number[];
  change: (number | null)[];
  ranges: Map<string, { low: (number | null)[]; high: (number | null)[] }>;
}

/** Milliseconds of growth between two pictures; the slowest goes by single steps. */
export const speeds = [0, 5, 12, 25, 50, 100, 200];
const rank: Record<Change, number> = { none: 0, look: 1, keep: 2, restart: 3 };
const longestSeries = 600;

const newSeries = (): Series => ({ earlier: 0, time: [], change: [], ranges: new Map() });
const asError = (error: unknown): Error => (error instanceof Error ? error : new Error(String(error)));

function askShape(engine: Engine, { id, name, bytes }: ShapeChoice): Promise<ShapeInfo> {
  return engine.ask<ShapeInfo>("shape", { name: bytes ? name : id }, bytes ? { bytes } : {});
}

/** What the page begins with, and the shape of it, which the engine makes while the page is laid out. */
export interface Opening {
  shared: Shared | null;
  saved: Partial<Saved>;
  /** Of a built-in shape, if the user's own file is not there. */
  shape: string;
  file: Promise<KeptFile | null>;
  info: Promise<ShapeInfo>;
}

export function open(engine: Engine, shared: Shared | null): Opening {
  const saved = load();
  const wanted = (shared ?? saved).shape ?? "";
  const shape = wanted.startsWith("builtin:") ? wanted : "builtin:animal";
  const file = wanted.startsWith("file:") ? keptFile() : Promise.resolve(null);
  const info = file.then((kept) => askShape(engine, { id: shape, name: kept?.name ?? shape, bytes: kept?.bytes ?? null }));
  info.catch(() => undefined); // told where it is waited for
  return { shared, saved, shape, file, info };
}

export class Studio {
  hello: Hello | null = null;
  catalog: Catalog | null = null;
  recipe = "";
  /** The recipe by which the coat on the screen was begun. */
  grown = "";
  draft: string | null = null;
  shape: ShapeChoice = { id: "builtin:animal", name: "animal", bytes: null };
  info: ShapeInfo | null = null;
  begun: Begun | null = null;
  progress: Progress | null = null;
  series = newSeries();
  /** What each species is where nothing has grown: the median of its field at the start. */
  rest = new Map<string, number>();
  playing = false;
  speed = 3;
  busy = "";
  message = { text: "", bad: false };
  fault: EngineError | null = null;
  bare = false;
  background = "studio";
  light = 1;
  stepsPerSecond = 0;

  private readonly listeners = new Map<Topic, (() => void)[]>();
  private readonly history = new History();
  private readonly files = new Map<string, ShapeChoice>();
  private fileCount = 0;
  private wantPlay = !reducedMotion();
  private grace = 0;
  private looping = false;
  private pending: Change = "none";
  private applying = false;
  private saveTimer = 0;
  private refineTimer = 0;

  constructor(
    readonly engine: Engine,
    readonly scene: Scene,
  ) {}

  on(topic: Topic | Topic[], listener: () => void): void {
    for (const one of Array.isArray(topic) ? topic : [topic]) {
      this.listeners.set(one, [...(this.listeners.get(one) ?? []), listener]);
    }
  }

  emit(topic: Topic): void {
    for (const listener of this.listeners.get(topic) ?? []) listener();
  }

  say(text: string, bad = false): void {
    this.message = { text, bad };
    this.emit("message");
  }

  /** Says what went wrong; a fault with a place in the recipe is also shown there. */
  fail(error: unknown, what = ""): void {
    const known = asError(error);
    if (known instanceof EngineError && known.fault === "cancelled") return this.say("Stopped.");
    this.fault = known instanceof EngineError && known.line !== null ? known : null;
    const place = this.fault?.line ? ` (line ${this.fault.line})` : "";
    this.say(`${what ? `${what}: ` : ""}${known.message}${place}`, true);
    this.emit("fault");
  }

  private setBusy(text: string): void {
    this.busy = text;
    this.emit("busy");
  }

  // ---- Beginning ----

  /**
   * Begins with what a link holds, what was saved, or the leopard as a draft. The order is that of a quick opening: the
   * shape was asked for before the page was laid out, and the lists are shown while the engine lays the mesh.
   */
  async start(opening: Opening): Promise<void> {
    const { shared, saved } = opening;
    this.background = saved.background ?? this.background;
    this.light = saved.light ?? this.light;
    this.speed = Math.min(speeds.length - 1, Math.max(0, Math.round(saved.speed ?? this.speed)));
    this.scene.setBackground(this.background);
    this.scene.setLight(this.light);
    this.setBusy("Starting the engine");
    try {
      this.draft = shared ? null : (saved.draft ?? null);
      this.recipe = (shared ?? saved).recipe ?? toml.setTopKey(await this.recipeText("leopard"), "quality", '"draft"');
      this.emit("recipe");
      await this.firstShape(opening);
      const asked = [this.engine.ask<Hello>("hello"), this.engine.ask<Catalog>("catalog")] as const;
      this.request("restart");
      [this.hello, this.catalog] = await Promise.all(asked);
      this.emit("ready");
    } catch (error) {
      this.setBusy("");
      this.fail(error, "The studio could not start");
    }
  }

  /** The shape that was asked for; where it cannot be had any more, the animal. */
  private async firstShape(opening: Opening): Promise<void> {
    const view = (opening.shared ?? opening.saved).view ?? null;
    const file = await opening.file;
    const choice = file ? this.registerFile(file.name, file.bytes) : this.builtin(opening.shape);
    await this.loadShape(choice, view, opening.info).catch(async (error: unknown) => {
      await this.loadShape(this.builtin("builtin:animal"), null);
      this.fail(error, choice.name);
    });
  }

  /** Opens what a link holds, as a step that can be undone. */
  async open(shared: Shared): Promise<void> {
    try {
      if (shared.shape !== this.shape.id) await this.chooseShape(this.builtin(shared.shape));
      this.edit(shared.recipe, { label: "open a link", change: "restart" });
      if (shared.view) this.scene.setView(shared.view);
    } catch (error) {
      this.fail(error);
    }
  }

  async recipeText(name: string): Promise<string> {
    return (await this.engine.ask<{ text: string }>("recipe_text", { name })).text;
  }

  builtin(id: string): ShapeChoice {
    return { id, name: id.replace(/^builtin:/, ""), bytes: null };
  }

  // ---- Shapes ----

  private registerFile(name: string, bytes: Uint8Array): ShapeChoice {
    const choice = { id: `file:${++this.fileCount}`, name, bytes };
    this.files.set(choice.id, choice);
    for (const old of this.files.keys()) {
      if (this.files.size <= 6) break;
      this.files.delete(old);
    }
    return choice;
  }

  async chooseFile(file: File): Promise<void> {
    const known = this.catalog?.reads ?? [];
    const extension = /\.[^.]*$/.exec(file.name.toLowerCase())?.[0] ?? "";
    if (extension === ".toml") return this.openRecipe(file);
    if (known.length && !known.includes(extension)) {
      return this.say(`${file.name}: the studio reads ${known.join(", ")} and recipes (.toml), not this kind of file.`, true);
    }
    if (file.size > 1e9) return this.say(`${file.name} is larger than 1 GB, which is more than a page can hold.`, true);
    const choice = this.registerFile(file.name, new Uint8Array(await file.arrayBuffer()));
    await this.chooseShape(choice);
    if (!(await keepFile({ name: choice.name, bytes: choice.bytes! }))) {
      this.say(`${file.name} is in use. It is too large to be kept for the next visit.`);
    }
  }

  private async openRecipe(file: File): Promise<void> {
    if (file.size > 1 << 20) return this.say(`${file.name} is larger than 1 MB; that is no recipe.`, true);
    this.edit(await file.text(), { label: `open ${file.name}` });
  }

  async chooseShape(choice: ShapeChoice): Promise<void> {
    const before = this.snapshot("shape");
    try {
      await this.loadShape(choice, null);
    } catch (error) {
      return this.fail(error, choice.name);
    }
    this.history.record(() => before);
    this.emit("history");
    this.request("restart");
  }

  private async loadShape(choice: ShapeChoice, view: View | null, asked?: Promise<ShapeInfo>): Promise<void> {
    this.setBusy(`Reading ${choice.name}`);
    try {
      this.info = await (asked ?? askShape(this.engine, choice));
    } finally {
      this.setBusy("");
    }
    this.shape = choice;
    this.begun = null;
    this.scene.setShape(this.info, view !== null);
    if (view) this.scene.setView(view);
    this.emit("shape");
    this.keep();
  }

  // ---- The recipe ----

  /** Takes another text of the recipe and does what the change needs. */
  edit(text: string, options: EditOptions): void {
    const change = options.change ?? toml.changeBetween(this.recipe, text);
    if (text === this.recipe) return;
    this.history.record(() => this.snapshot(options.label), options.merge ?? null);
    this.recipe = text;
    this.draft = null;
    this.emit("recipe");
    this.emit("history");
    this.keep();
    this.request(this.begun ? change : "restart");
  }

  /** Grows the same recipe from its start. */
  restart(): void {
    this.history.record(() => this.snapshot("start anew"));
    this.emit("history");
    this.wantPlay = true;
    this.request("restart");
  }

  /** Notes what is to be done; if something is being done, the latest wish is done behind it. */
  private request(change: Change): void {
    if (rank[change] > rank[this.pending]) this.pending = change;
    if (!this.applying) void this.apply();
  }

  private async apply(): Promise<void> {
    this.applying = true;
    while (this.pending !== "none") {
      const change = this.pending;
      this.pending = "none";
      try {
        await this.grow(change);
      } catch (error) {
        this.fail(error);
      }
    }
    this.applying = false;
    this.go();
  }

  private async grow(change: Change): Promise<void> {
    const recipe = this.recipe;
    if (change === "look") {
      const reply = await this.engine.ask("look", { recipe });
      this.scene.setColors(reply.blocks["colors"] as Uint8Array);
      this.scene.setTransparent(reply.blocks["colors"] as Uint8Array);
      this.refineSoon();
      return this.settled();
    }
    this.setBusy(change === "keep" ? "" : "Laying the mesh");
    try {
      const reply = await this.engine.ask<Begun>("begin", { recipe, keep: change === "keep" && this.begun !== null });
      this.grace = change === "keep" ? 30 : 0;
      this.accept(reply, recipe, change === "restart");
    } finally {
      this.setBusy("");
    }
  }

  private settled(): void {
    this.fault = null;
    this.emit("fault");
    if (this.message.bad) this.say("");
  }

  /** Takes a coat from its beginning: its mesh, its stages, its state. */
  private accept(reply: Answer<Begun>, recipe: string, fresh: boolean): void {
    const { positions, normals, triangles, colors } = reply.blocks;
    this.scene.setMesh(positions as Float32Array, normals as Float32Array, triangles as Uint32Array, colors as Uint8Array);
    this.begun = reply;
    this.grown = recipe;
    if (fresh) {
      this.series = newSeries();
      this.progress = null;
    }
    this.settled();
    if (reply.warnings.length) this.say(reply.warnings.join(" "));
    this.follow(reply);
    this.emit("begun");
    if (!fresh) this.emit("stage");
  }

  private learnRest(stage: number): void {
    for (const species of this.begun?.stages[stage]?.species ?? []) {
      const asked = this.engine.ask("field", { species });
      asked.then((reply) => this.rest.set(species, median(reply.blocks["values"] as Float32Array))).catch(() => undefined);
    }
  }

  get stage(): Stage | null {
    return this.begun?.stages[this.progress?.stage ?? 0] ?? null;
  }

  check(recipe: string): Promise<unknown> {
    return this.engine.ask("check", { recipe });
  }

  analyse(stage: number): Promise<Analysis> {
    return this.engine.ask<Analysis>("analyse", { recipe: this.recipe, stage });
  }

  // ---- Time ----

  play(): void {
    if (!this.begun) return;
    if (this.progress && !this.progress.running) this.grace = Infinity;
    this.wantPlay = true;
    this.go();
  }

  pause(): void {
    this.wantPlay = false;
    this.playing = false;
    this.emit("playing");
  }

  togglePlay(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Paint wakes a coat that has come to rest, unless the user has paused it. */
  wake(): void {
    this.grace = Math.max(this.grace, 60);
    this.go();
  }

  private go(): void {
    if (!this.wantPlay || !this.begun) return;
    if (this.progress && !this.progress.running && this.grace === 0) return;
    this.playing = true;
    this.emit("playing");
    if (!this.looping) void this.loop();
  }

  async stepOnce(): Promise<void> {
    if (!this.begun) return;
    this.pause();
    await this.advance({ steps: 1, milliseconds: 2000 }).catch((error: unknown) => this.fail(error));
  }

  private async loop(): Promise<void> {
    this.looping = true;
    while (this.playing) {
      try {
        await this.advance(this.speed === 0 ? { steps: 1, milliseconds: 1000 } : { milliseconds: speeds[this.speed]! });
      } catch (error) {
        this.playing = false;
        if (this.begun) this.fail(error, "The growth stopped");
      }
      if (this.speed === 0 || document.hidden) await new Promise((resolve) => setTimeout(resolve, 60));
      if (!this.applying && this.progress && !this.progress.running && --this.grace < 0) this.rested();
    }
    this.looping = false;
    this.emit("playing");
  }

  private rested(): void {
    this.grace = 0;
    this.playing = false;
    if (this.progress?.status === "failed") this.say(this.progress.message, true);
    else void this.refine();
    this.emit("playing");
  }

  private refineSoon(): void {
    clearTimeout(this.refineTimer);
    if (this.playing || !this.progress || this.progress.running) return;
    this.refineTimer = window.setTimeout(() => void this.refine(), 400);
  }

  /** A coat that stands still is shown as finely as files get it. */
  private async refine(): Promise<void> {
    const coat = this.begun;
    try {
      const { positions, normals, triangles, colors } = (await this.engine.ask("fine")).blocks;
      if (coat !== this.begun || this.playing || this.applying) return;
      this.scene.setFine(positions as Float32Array, normals as Float32Array, triangles as Uint32Array, colors as Uint8Array);
      this.emit("fine");
    } catch {
      // What is there is fine enough.
    }
  }

  private async advance(request: Record<string, number>): Promise<void> {
    const coat = this.begun;
    const before = { steps: this.progress?.steps ?? 0, at: performance.now() };
    const reply = await this.engine.ask<Progress>("advance", request);
    if (this.begun !== coat) return;
    const { colors, positions, normals } = reply.blocks;
    if (positions && normals) this.scene.movePositions(positions as Float32Array, normals as Float32Array);
    if (colors) this.scene.setColors(colors as Uint8Array);
    const speed = (1000 * (reply.steps - before.steps)) / Math.max(1, performance.now() - before.at);
    if (speed > 0) this.stepsPerSecond = this.stepsPerSecond ? 0.9 * this.stepsPerSecond + 0.1 * speed : speed;
    this.follow(reply);
  }

  private follow(reply: Progress): void {
    const moved = this.progress?.stage !== reply.stage;
    if (moved && this.progress) this.series.earlier += this.progress.steps;
    this.progress = reply;
    this.note(reply);
    if (moved) {
      this.learnRest(reply.stage);
      this.emit("stage");
    }
    this.emit("frame");
  }

  private note(reply: Progress): void {
    const { series } = this;
    const index = series.time.push(series.earlier + reply.steps) - 1;
    series.change.push(reply.change);
    for (const { species, low, high } of reply.range) {
      const range = series.ranges.get(species) ?? { low: [], high: [] };
      range.low[index] = low;
      range.high[index] = high;
      series.ranges.set(species, range);
    }
    if (index < longestSeries) return;
    const every = (_: unknown, i: number): boolean => i % 2 === 0;
    series.time = series.time.filter(every);
    series.change = series.change.filter(every);
    for (const range of series.ranges.values()) {
      range.low = Array.from(range.low).filter(every);
      range.high = Array.from(range.high).filter(every);
    }
  }

  // ---- Undo and redo ----

  private snapshot(label: string): Snapshot {
    const asked = this.begun ? this.engine.ask<{ state: number }>("keep_state") : null;
    const state = asked ? asked.then((reply) => reply.state).catch(() => null) : Promise.resolve(null);
    return { label, recipe: this.recipe, shape: this.shape.id, state };
  }

  /** Notes the coat as it stands before something is painted on it. */
  recordPaint(label: string): void {
    this.history.record(() => this.snapshot(label));
    this.emit("history");
  }

  get undoLabel(): string | null {
    return this.history.undoLabel;
  }

  get redoLabel(): string | null {
    return this.history.redoLabel;
  }

  undo(): void {
    const wanted = this.history.undo((label) => this.snapshot(label));
    if (wanted) void this.restore(wanted, "Undone");
  }

  redo(): void {
    const wanted = this.history.redo((label) => this.snapshot(label));
    if (wanted) void this.restore(wanted, "Done again");
  }

  private async restore(wanted: Snapshot, word: string): Promise<void> {
    this.recipe = wanted.recipe;
    this.draft = null;
    this.emit("recipe");
    this.emit("history");
    try {
      if (wanted.shape !== this.shape.id) await this.loadShape(this.files.get(wanted.shape) ?? this.builtin(wanted.shape), null);
      if (!(await this.restoreState(await wanted.state))) await this.grow("restart");
      this.say(`${word}: ${wanted.label}.`);
      this.go();
    } catch (error) {
      this.fail(error);
    }
    this.keep();
  }

  /** Has the engine take back a state that it keeps; false where it no longer does. */
  private async restoreState(state: number | null): Promise<boolean> {
    if (state === null) return false;
    try {
      const reply = await this.engine.ask<Begun>("restore_state", { state });
      this.accept(reply, reply.recipe ?? this.recipe, true);
      const change = reply.recipe === undefined ? "look" : toml.changeBetween(reply.recipe, this.recipe);
      if (change !== "none") await this.grow(change);
      return true;
    } catch {
      return false;
    }
  }

  // ---- What a reload keeps ----

  /** Saves what a reload must not lose, a moment later. */
  keep(): void {
    clearTimeout(this.saveTimer);
    this.saveTimer = window.setTimeout(() => this.keepNow(), 300);
  }

  keepNow(): void {
    if (!this.recipe) return;
    const { recipe, draft, background, light, speed } = this;
    save({ recipe, draft, shape: this.shape.id, view: this.info ? this.scene.view() : null, background, light, speed });
  }

  setView(change: { background?: string; light?: number; speed?: number; bare?: boolean }): void {
    Object.assign(this, change);
    this.scene.setBackground(this.background);
    this.scene.setLight(this.light);
    this.scene.setBare(this.bare);
    this.keep();
  }

  /** Name of the coat as its text has it, and one that files can have. */
  get coatName(): string {
    return toml.stringValue(toml.topValue(this.recipe, "name")) ?? "coat";
  }

  get fileName(): string {
    const name = `${this.coatName}-${this.shape.name.replace(/\.[^.]*$/, "").replace(/\?.*/, "")}`;
    return name.replace(/[^A-Za-z0-9_-]+/g, "-").slice(0, 60) || "coat";
  }
}

export function median(values: Float32Array): number {
  const sorted = Float32Array.from(values).sort();
  return sorted[sorted.length >> 1] ?? 0;
}
