/** The recipe as text, or a model that it holds: line numbers, colours, and faults at their place while one types. */

import { button, download, el } from "../dom";
import { EngineError } from "../engine";
import { addModel, changeBetween, ownModels, type OwnModel } from "../recipe-text";
import type { Studio } from "../studio";

const longestColoured = 40000;
const tokens = /(#[^\n]*)|("""[\s\S]*?"""|'''[\s\S]*?'''|"(?:\\.|[^"\\\n])*"|'[^'\n]*')|(^[ \t]*\[\[?[^\]\n]*\]\]?)|(^[ \t]*[A-Za-z0-9_.-]+(?=[ \t]*=))/gm;
const kinds = ["comment", "string", "table", "key"];

/** The text in pieces with classes, as nodes. */
function coloured(text: string): Node[] {
  if (text.length > longestColoured) return [document.createTextNode(text)];
  const nodes: Node[] = [];
  let at = 0;
  for (const match of text.matchAll(tokens)) {
    const kind = kinds[match.slice(1).findIndex((group) => group !== undefined)] ?? "";
    if (match.index > at) nodes.push(document.createTextNode(text.slice(at, match.index)));
    nodes.push(el("span", { class: `t-${kind}` }, match[0]));
    at = match.index + match[0].length;
  }
  nodes.push(document.createTextNode(`${text.slice(at)}\n`));
  return nodes;
}

class Editor {
  readonly node: HTMLElement;
  private readonly area = el("textarea", { class: "code", "aria-label": "Text of the recipe or model", spellcheck: "false", autocapitalize: "off", autocomplete: "off", wrap: "off", "aria-describedby": "recipe-fault" });
  private readonly paper = el("pre", { class: "code-paper", "aria-hidden": "true" });
  private readonly gutter = el("pre", { class: "gutter", "aria-hidden": "true" });
  private readonly mark = el("div", { class: "fault-line", hidden: true });
  private readonly fault = el("p", { class: "fault", id: "recipe-fault", role: "status" });
  private readonly growButton = button("Grow this text", { class: "primary small" });
  private timer = 0;
  private asked = 0;
  private typed = false;
  /** The model whose text is shown; null: all of the recipe. */
  private model: string | null = null;
  private readonly parts = el("select", { "aria-label": "Text shown" });
  private readonly copyButton = button("Edit a copy of its model", { class: "small" });

  constructor(private readonly studio: Studio) {
    const sheet = el("div", { class: "sheet" }, this.mark, this.paper, this.area);
    const frame = el("div", { class: "editor" }, this.gutter, sheet);
    const save = button("Save as file", { icon: "download", class: "small" });
    save.addEventListener("click", () => download(`${studio.fileName}.toml`, this.whole, "text/plain"));
    this.growButton.title = "Ctrl+Enter";
    this.growButton.addEventListener("click", () => this.grow());
    this.parts.addEventListener("change", () => this.choose(this.parts.value || null));
    this.copyButton.addEventListener("click", () => this.copyModel().catch((error: unknown) => studio.fail(error)));
    const head = el("div", { class: "editor-head" }, this.parts, this.copyButton);
    this.node = el("div", { class: "panel recipe" }, head, frame, el("div", { class: "editor-foot" }, this.fault, el("div", { class: "inline" }, this.growButton, save)));
    this.area.addEventListener("input", () => this.onInput());
    this.area.addEventListener("scroll", () => this.follow());
    this.area.addEventListener("keydown", (event) => this.onKey(event));
    studio.on("recipe", () => this.show());
    studio.on("fault", () => this.showFault(studio.fault));
    studio.on(["begun", "stage"], () => this.buttons());
  }

  private get whole(): string {
    return this.studio.draft ?? this.studio.recipe;
  }

  /** Where the text that is shown stands in the recipe. */
  private get place(): { start: number; end: number } {
    return ownModels(this.whole).find((one) => one.name === this.model) ?? { start: 0, end: this.whole.length };
  }

  private choose(model: string | null): void {
    this.model = model;
    this.show();
    this.area.scrollTop = 0;
    this.area.focus();
  }

  /** The model that grows, as the recipe's own, to be changed. */
  private async copyModel(): Promise<void> {
    const { studio } = this;
    const stage = studio.progress?.stage ?? 0;
    const model = studio.begun?.stages[stage]?.model;
    if (!model) return;
    const base = model.split(":")[0]!;
    const own = ownModels(this.whole).find((one) => one.name === base);
    if (own) return this.choose(own.name);
    const { text } = await studio.engine.ask<{ text: string }>("model_text", { name: base });
    const added = addModel(this.whole, stage, model, text);
    this.model = added.name;
    studio.edit(added.text, { label: `copy of ${base}`, change: "keep" });
    this.choose(added.name);
  }

  private showParts(models: OwnModel[]): void {
    if (!models.some((one) => one.name === this.model)) this.model = null;
    const wanted = ["", ...models.map((one) => one.name)];
    if (JSON.stringify(wanted) !== JSON.stringify([...this.parts.options].map((option) => option.value))) {
      this.parts.replaceChildren(...wanted.map((value) => el("option", { value }, value ? `Model ${value}` : "Recipe")));
    }
    this.parts.value = this.model ?? "";
  }

  private onKey(event: KeyboardEvent): void {
    const command = event.ctrlKey || event.metaKey;
    if (command && event.key === "Enter") {
      event.preventDefault();
      this.grow();
    }
    // The field undoes its own typing; where nothing was typed, the page undoes its last step.
    if (command && event.key.toLowerCase() === "z" && this.typed) event.stopPropagation();
  }

  private show(): void {
    this.showParts(ownModels(this.whole));
    const { start, end } = this.place;
    const text = this.whole.slice(start, end);
    if (text !== this.area.value) {
      this.area.value = text;
      this.typed = false;
    }
    this.paint();
    this.buttons();
  }

  private onInput(): void {
    this.typed = true;
    const { start, end } = this.place;
    const text = this.whole.slice(0, start) + this.area.value + this.whole.slice(end);
    this.studio.draft = text === this.studio.recipe ? null : text;
    this.studio.keep();
    this.paint();
    this.buttons();
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.check(), 250);
  }

  /** Asks whether the text is understood; new colours and parameters are taken at once. */
  private async check(): Promise<void> {
    const text = this.whole;
    const asked = ++this.asked;
    try {
      await this.studio.check(text);
    } catch (error) {
      if (asked === this.asked) this.showFault(error instanceof EngineError ? error : null, String(error));
      return;
    }
    if (asked !== this.asked || text !== this.whole) return;
    this.showFault(null);
    const change = changeBetween(this.studio.recipe, text);
    if (change !== "restart" && text !== this.studio.recipe) this.studio.edit(text, { label: "typing", change, merge: "typing" });
  }

  private grow(): void {
    const text = this.whole;
    if (text === this.studio.recipe) this.studio.restart();
    else this.studio.edit(text, { label: "text", change: "restart" });
  }

  private buttons(): void {
    const waiting = this.studio.draft !== null && this.studio.draft !== this.studio.recipe;
    this.growButton.classList.toggle("waiting", waiting);
    this.growButton.querySelector("span")!.textContent = waiting ? "Grow this text" : "Grow anew";
    const model = this.studio.stage?.model.split(":")[0] ?? "";
    const own = ownModels(this.whole).some((one) => one.name === model);
    this.copyButton.querySelector("span")!.textContent = own ? `Edit ${model}` : `Edit a copy of ${model}`;
    this.copyButton.hidden = !model || this.model === model;
  }

  private paint(): void {
    const text = this.area.value;
    this.paper.replaceChildren(...coloured(text));
    const lines = text.split("\n").length;
    if (this.gutter.childElementCount !== 0 || this.gutter.textContent?.split("\n").length !== lines) {
      this.gutter.textContent = Array.from({ length: lines }, (_, i) => String(i + 1)).join("\n");
    }
    this.follow();
  }

  private follow(): void {
    this.paper.style.transform = `translate(${-this.area.scrollLeft}px, ${-this.area.scrollTop}px)`;
    this.gutter.style.transform = `translateY(${-this.area.scrollTop}px)`;
    this.mark.style.transform = `translateY(${-this.area.scrollTop}px)`;
  }

  private showFault(fault: EngineError | null, otherwise = ""): void {
    const above = this.whole.slice(0, this.place.start).split("\n").length - 1;
    const line = fault?.line === null || fault?.line === undefined ? null : fault.line - above;
    const here = line !== null && line >= 1 && line <= this.area.value.split("\n").length;
    const number = here ? line : `${fault?.line} of the recipe`;
    const place = line === null ? "" : `Line ${number}${fault?.column ? `, column ${fault.column}` : ""}: `;
    this.fault.textContent = fault ? place + fault.message : otherwise;
    this.area.setAttribute("aria-invalid", String(fault !== null));
    this.mark.hidden = !here;
    if (here) this.mark.style.top = `calc(var(--code-pad) + ${line - 1} * var(--code-line))`;
  }
}

export function recipePanel(studio: Studio): HTMLElement {
  return new Editor(studio).node;
}
