/** A few helpers to make elements. Texts become text nodes: nothing that comes from elsewhere is ever read as HTML. */

type Child = Node | string | null | false;
type Attributes = Record<string, string | number | boolean | null>;

function assign(node: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === false) continue;
    node.setAttribute(name, value === true ? "" : String(value));
  }
}

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  assign(node, attributes);
  for (const child of children) if (child) node.append(child);
  return node;
}

/** Shapes of the icons; parts that may overlap stand between bars. */
const paths: Record<string, string> = {
  play: "M7 5v14l11-7z",
  pause: "M7 5h4v14H7zM14 5h4v14h-4z",
  step: "M5 5v14l9-7zM16 5h3v14h-3z",
  reset: "M12 5V2L7 6.5 12 11V8a5 5 0 1 1-5 5H4.5a7.5 7.5 0 1 0 7.5-8z",
  undo: "M9 6V2L3 8l6 6v-4h5a4 4 0 0 1 0 8H8v2h6a6 6 0 0 0 0-14z",
  redo: "M15 6V2l6 6-6 6v-4h-5a4 4 0 0 0 0 8h6v2h-6a6 6 0 0 1 0-14z",
  orbit: "M12 3a9 9 0 1 1 0 18 9 9 0 0 1 0-18zm0 1.7a7.3 7.3 0 1 0 0 14.6 7.3 7.3 0 0 0 0-14.6z|M4 11.2h16v1.6H4z|M12 3.6c2.7 0 4.6 3.7 4.6 8.4s-1.9 8.4-4.6 8.4-4.6-3.7-4.6-8.4 1.9-8.4 4.6-8.4zm0 1.6c-1.6 0-3 3-3 6.8s1.4 6.8 3 6.8 3-3 3-6.8-1.4-6.8-3-6.8z",
  brush: "M20.7 3.3a1 1 0 0 0-1.4 0L9.5 13.1l1.9 1.9 9.8-9.8a1.3 1.3 0 0 0-.5-1.9zM8 14a3 3 0 0 0-3 3c0 1.5-1 2.3-2 2.6 1 .9 2.4 1.4 4 1.4a4 4 0 0 0 4-4z",
  eraser: "M15.5 3.5 3.9 15.1a2 2 0 0 0 0 2.8L7 21h6l8.1-8.1a2 2 0 0 0 0-2.8zM8 19l-2.7-2.5 4.2-4.2 4.7 4.7L12.2 19z",
  mask: "M12 3 4 6v6c0 4.5 3.4 7.8 8 9 4.6-1.2 8-4.5 8-9V6zm0 2.2v13.7c-3.6-1.2-6-3.7-6-6.9V7.4z",
  size: "M3 8h18v8H3zm2 2v4h2v-2h2v2h2v-3h2v3h2v-2h2v2h2v-4z",
  direction: "M4 19c2.5-8 6-11.5 13-13l-1.2-2L21 4.6l-2.2 4.8-1-1.8C11.5 9 8.3 12 6 19.6z|M10 20c1.5-4.5 3.8-7 8.5-8.6l.6 1.9c-4 1.4-5.9 3.4-7.2 7.3z",
  shape: "M12 2 3 7v10l9 5 9-5V7zm0 2.3L18 7.6l-6 3.3-6-3.3zM5 9.3l6 3.3v6.6l-6-3.4zm8 9.9v-6.6l6-3.3v6.5z",
  turntable: "M12 6c5 0 9 1.8 9 4.5 0 2-2.3 3.5-5.6 4.1l-.4-2c2.5-.4 4-1.3 4-2.1C19 9.2 16 8 12 8s-7 1.2-7 2.5c0 .9 1.7 1.8 4 2.2V10l4.5 3.8L9 17.5v-2.7c-3.5-.6-6-2.2-6-4.3C3 7.8 7 6 12 6z",
  compare: "M11 3h2v18h-2zM9 6H4v12h5zm6 0h5v12h-5v-2h3V8h-3z",
  share: "M17 3a3 3 0 1 1-2.4 4.8L9.3 10.7a3 3 0 0 1 0 2.6l5.3 2.9a3 3 0 1 1-1 1.7l-5.3-2.9a3 3 0 1 1 0-6l5.3-2.9A3 3 0 0 1 17 3z",
  download: "M11 3h2v9l3.5-3.5L18 10l-6 6-6-6 1.5-1.5L11 12zM4 18h16v2H4z",
  search: "M10 3a7 7 0 0 1 5.6 11.2l5 5-1.4 1.4-5-5A7 7 0 1 1 10 3zm0 2a5 5 0 1 0 0 10 5 5 0 0 0 0-10z",
  open: "M3 5h7l2 2h9v12H3zm2 4v8h14V9z",
  frame: "M4 4h6v2H6v4H4zm10 0h6v6h-2V6h-4zM4 14h2v4h4v2H4zm14 0h2v6h-6v-2h4z",
  record: "M12 5a7 7 0 1 1 0 14 7 7 0 0 1 0-14z",
  camera: "M9 5l-1.5 2H4v12h16V7h-3.5L15 5zm3 4a4 4 0 1 1 0 8 4 4 0 0 1 0-8zm0 2a2 2 0 1 0 0 4 2 2 0 0 0 0-4z",
  close: "M6.4 5 12 10.6 17.6 5 19 6.4 13.4 12 19 17.6 17.6 19 12 13.4 6.4 19 5 17.6 10.6 12 5 6.4z",
  good: "M12 3a9 9 0 1 1 0 18 9 9 0 0 1 0-18zm4.2 5.5L10.5 14l-2.7-2.6-1.4 1.4 4.1 4 7.1-6.9z",
  warning: "M12 3 2 20h20zm-1 6h2v5h-2zm0 6.5h2v2h-2z",
};

/** The icon of this name, or one of a shape that is given. */
export function icon(name: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  assign(svg, { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true", focusable: "false" });
  for (const d of (paths[name] ?? name).split("|")) {
    const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
    assign(path, { d, "fill-rule": "evenodd" });
    svg.append(path);
  }
  return svg;
}

/** A button of an icon, of a text, or of both; what an icon means is its label. */
export function button(text: string, options: { icon?: string; label?: string; class?: string; keys?: string } = {}): HTMLButtonElement {
  const node = el("button", { type: "button", class: options.class ?? null });
  if (options.icon) node.append(icon(options.icon));
  if (text) node.append(el("span", {}, text));
  if (options.label) {
    node.setAttribute("aria-label", options.label);
    node.title = options.keys ? `${options.label} (${options.keys})` : options.label;
  }
  if (options.keys && options.keys.length === 1) node.setAttribute("aria-keyshortcuts", options.keys);
  return node;
}

export function setIcon(node: Element, name: string): void {
  node.querySelector("svg")?.replaceWith(icon(name));
}

let ids = 0;
export const freshId = (what: string): string => `${what}-${++ids}`;

export interface SliderOptions {
  label: string;
  help?: string;
  low: number;
  high: number;
  value: number;
  /** Place of a value along the track, and back; both from 0 to 1. Straight where left out. */
  curve?: { place: (value: number) => number; value: (place: number) => number };
  digits?: number;
  unit?: string;
  onInput: (value: number) => void;
  onReset?: () => void;
}

export interface Slider {
  node: HTMLElement;
  set(value: number): void;
  setNote(text: string): void;
}

const shown = (value: number, digits: number): string => String(Number(value.toPrecision(digits)));

/** A labelled track with a field beside it for the exact number. */
export function slider(options: SliderOptions): Slider {
  const { low, high } = options;
  const place = options.curve?.place ?? ((v: number) => (v - low) / (high - low || 1));
  const value = options.curve?.value ?? ((p: number) => low + p * (high - low));
  const digits = options.digits ?? 4;
  const id = freshId("slider");
  const track = el("input", { type: "range", id, min: 0, max: 1000, step: 1 });
  const field = el("input", { type: "text", inputmode: "decimal", class: "number", "aria-label": `${options.label}, exact`, spellcheck: "false" });
  const note = el("span", { class: "slider-note" });
  const label = el("label", { for: id, title: options.help ?? null }, options.label);
  const set = (v: number): void => {
    track.value = String(Math.round(1000 * Math.min(1, Math.max(0, place(v)))));
    track.style.setProperty("--fill", `${Number(track.value) / 10}%`);
    track.setAttribute("aria-valuetext", `${shown(v, digits)} ${options.unit ?? ""}`.trim());
    if (document.activeElement !== field) field.value = shown(v, digits);
  };
  track.addEventListener("input", () => {
    const chosen = Number(shown(value(Number(track.value) / 1000), 3));
    set(chosen);
    options.onInput(chosen);
  });
  field.addEventListener("change", () => {
    const chosen = Number(field.value.replace(",", "."));
    if (!Number.isFinite(chosen) || field.value.trim() === "") return set(options.value);
    field.blur();
    set(chosen);
    options.onInput(chosen);
  });
  const head = el("div", { class: "slider-head" }, label, note, field, options.unit ? el("span", { class: "unit" }, options.unit) : null);
  const node = el("div", { class: "slider" }, head, track);
  if (options.help) {
    const help = el("p", { class: "slider-help", id: `${id}-help` }, options.help);
    track.setAttribute("aria-describedby", help.id);
    node.append(help);
  }
  if (options.onReset) {
    const reset = button("", { icon: "reset", label: `${options.label}: back to the model's own value`, class: "quiet tiny" });
    reset.addEventListener("click", options.onReset);
    field.before(reset);
  }
  set(options.value);
  return { node, set, setNote: (text) => (note.textContent = text) };
}

/** A row of buttons of which one is chosen. */
export function choice<T extends string>(
  label: string,
  items: { value: T; text: string }[],
  chosen: T,
  onChoose: (value: T) => void,
): { node: HTMLElement; set(value: T): void } {
  const node = el("div", { class: "choice", role: "radiogroup", "aria-label": label });
  const set = (value: T): void => {
    for (const child of node.children) {
      const on = child.getAttribute("data-value") === value;
      child.setAttribute("aria-checked", String(on));
      child.setAttribute("tabindex", on ? "0" : "-1");
    }
  };
  for (const item of items) {
    const one = el("button", { type: "button", role: "radio", "data-value": item.value }, item.text);
    one.addEventListener("click", () => {
      set(item.value);
      onChoose(item.value);
    });
    node.append(one);
  }
  node.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const all = [...node.children] as HTMLElement[];
    const index = all.findIndex((child) => child.getAttribute("aria-checked") === "true");
    const next = all[(index + step + all.length) % all.length]!;
    next.click();
    next.focus();
  });
  set(chosen);
  return { node, set };
}

export function toggle(label: string, value: boolean, onChange: (value: boolean) => void): { node: HTMLElement; set(value: boolean): void } {
  const box = el("input", { type: "checkbox", id: freshId("toggle") });
  box.checked = value;
  box.addEventListener("change", () => onChange(box.checked));
  return { node: el("label", { class: "toggle" }, box, el("span", {}, label)), set: (v) => (box.checked = v) };
}

/** Offers bytes as a file to keep. */
export function download(name: string, bytes: Uint8Array | Blob | string, type = "application/octet-stream"): void {
  const blob = bytes instanceof Blob ? bytes : new Blob([bytes as BlobPart], { type });
  const url = URL.createObjectURL(blob);
  const link = el("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
