/** Lays the page out and joins its parts. */

import { Brush, type Tool } from "./brush";
import { button, el, icon } from "./dom";
import { Engine, tokenOfAddress } from "./engine";
import { decodeLink, LinkError, type Shared } from "./link";
import { adjustPanel } from "./panels/adjust";
import { coatsPanel } from "./panels/coats";
import { lookPanel } from "./panels/look";
import { outPanel, shareAddress } from "./panels/out";
import { paintPanel, tools } from "./panels/paint";
import { readoutPanel } from "./panels/readout";
import { recipePanel } from "./panels/recipe";
import { shapePanel } from "./panels/shape";
import { transport } from "./panels/transport";
import { ruler } from "./ruler";
import { Scene } from "./scene";
import { open, Studio } from "./studio";
import { dock, type Dock } from "./tabs";

const embedded = new URLSearchParams(location.search).has("embed");

/** The coat that the address holds, if it does; a link that is refused is told in words. */
async function sharedOfAddress(): Promise<{ shared: Shared | null; refused: string }> {
  const code = new URLSearchParams(location.hash.slice(1)).get("s");
  if (!code) return { shared: null, refused: "" };
  const token = tokenOfAddress();
  if (!embedded) history.replaceState(null, "", `${location.pathname}${location.search}${token ? `#token=${token}` : ""}`);
  try {
    return { shared: await decodeLink(code), refused: "" };
  } catch (error) {
    if (error instanceof LinkError) return { shared: null, refused: error.message };
    throw error;
  }
}

function statusLine(studio: Studio): HTMLElement {
  const text = el("span", {});
  const close = button("", { icon: "close", label: "Dismiss", class: "quiet tiny" });
  const node = el("div", { class: "message", role: "status", "aria-live": "polite", hidden: true }, icon("warning"), text, close);
  close.addEventListener("click", () => studio.say(""));
  let timer = 0;
  studio.on("message", () => {
    clearTimeout(timer);
    text.textContent = studio.message.text;
    node.hidden = !studio.message.text;
    node.classList.toggle("bad", studio.message.bad);
    if (!studio.message.bad) timer = window.setTimeout(() => studio.say(""), 6000);
  });
  return node;
}

function busySign(studio: Studio): HTMLElement {
  const text = el("span", {});
  const stop = button("Stop", { class: "small" });
  stop.addEventListener("click", () => studio.engine.stop());
  const node = el("div", { class: "busy", hidden: true }, el("span", { class: "spinner", "aria-hidden": "true" }), text, stop);
  let timer = 0;
  studio.on("busy", () => {
    clearTimeout(timer);
    text.textContent = studio.busy;
    stop.hidden = studio.hello?.engine !== "native";
    if (!studio.busy) node.hidden = true;
    else timer = window.setTimeout(() => (node.hidden = false), 250);
  });
  return node;
}

function palette(studio: Studio, brush: Brush, docks: Dock[]): HTMLElement {
  const node = el("div", { class: "palette", role: "toolbar", "aria-label": "Tools", "aria-orientation": "vertical" });
  for (const { tool, label, key } of tools) {
    const one = button("", { icon: tool, label, keys: key });
    one.dataset["tool"] = tool;
    one.addEventListener("click", () => choose(tool));
    node.append(one);
  }
  const choose = (tool: Tool): void => {
    brush.choose(tool);
    if (tool !== "orbit") docks.forEach((one) => one.show("paint"));
  };
  const mark = (): void => {
    for (const one of node.children) one.setAttribute("aria-pressed", String(one.getAttribute("data-tool") === brush.tool));
  };
  studio.on("tool", mark);
  mark();
  return node;
}

interface Actions {
  bare: () => void;
  turntable: () => void;
}

function viewButtons(studio: Studio): { node: HTMLElement; actions: Actions } {
  const bareButton = button("", { icon: "compare", label: "Bare shape", keys: "B" });
  const turnButton = button("", { icon: "turntable", label: "Turntable", keys: "T" });
  const frameButton = button("", { icon: "frame", label: "See all of it", keys: "F" });
  const actions: Actions = {
    bare: () => {
      studio.setView({ bare: !studio.bare });
      bareButton.setAttribute("aria-pressed", String(studio.bare));
    },
    turntable: () => {
      studio.scene.turntable = !studio.scene.turntable;
      turnButton.setAttribute("aria-pressed", String(studio.scene.turntable));
    },
  };
  bareButton.setAttribute("aria-pressed", "false");
  turnButton.setAttribute("aria-pressed", "false");
  bareButton.addEventListener("click", actions.bare);
  turnButton.addEventListener("click", actions.turntable);
  frameButton.addEventListener("click", () => studio.scene.frame());
  return { node: el("div", { class: "view-buttons", role: "toolbar", "aria-label": "View" }, bareButton, turnButton, frameButton), actions };
}

function topBar(studio: Studio, docks: Dock[]): HTMLElement {
  const title = el("div", { class: "what" });
  const undo = button("", { icon: "undo", label: "Undo", keys: "Ctrl+Z" });
  const redo = button("", { icon: "redo", label: "Redo", keys: "Ctrl+Shift+Z" });
  undo.addEventListener("click", () => studio.undo());
  redo.addEventListener("click", () => studio.redo());
  const out = button("Export", { icon: "download", class: "primary" });
  out.addEventListener("click", () => docks.forEach((one) => one.show("export")));
  const engine = el("span", { class: "engine" });
  const history = (): void => {
    undo.disabled = studio.undoLabel === null;
    redo.disabled = studio.redoLabel === null;
    undo.title = studio.undoLabel ? `Undo: ${studio.undoLabel} (Ctrl+Z)` : "Nothing to undo";
    redo.title = studio.redoLabel ? `Redo: ${studio.redoLabel} (Ctrl+Shift+Z)` : "Nothing to redo";
  };
  const name = (): void => {
    title.replaceChildren(el("strong", {}, studio.coatName), el("span", {}, `on ${studio.shape.name}`));
    document.title = `${studio.coatName} · Pelage Studio`;
  };
  studio.on("history", history);
  studio.on(["recipe", "shape"], name);
  studio.on("ready", () => {
    const { hello } = studio;
    engine.textContent = hello?.engine === "wasm" ? "in this browser" : `on this machine, ${hello?.threads ?? 1} thread${hello?.threads === 1 ? "" : "s"}`;
    engine.title = `Engine: ${hello?.engine ?? ""} ${hello?.version ?? ""}`;
  });
  history();
  const brand = el("h1", { class: "brand" }, mark(), el("span", {}, "Pelage", el("small", {}, "Studio")));
  return el("header", { class: "top" }, brand, title, engine, el("div", { class: "buttons" }, undo, redo), out);
}

/** The mark of the studio: a rosette. */
function mark(): SVGSVGElement {
  const svg = icon(
    "M12 3c2.2 0 3.6.8 4.5 1.9l-2.3 2C13.6 6.3 12.9 6 12 6c-1.6 0-2.7.7-3.5 1.9L6 6.2C7.3 4.2 9.3 3 12 3zM18.7 7.2C20 8.8 20.6 10.5 20.3 12.6l-3-.3c.1-1.2-.2-2.2-.9-3.2zM16.5 14.6l2.8 1.3C18 18.8 15.6 20.6 12.6 20.9l-.3-3c2-.2 3.3-1.3 4.2-3.3zM9.7 17.3 8.3 20C5.5 18.7 3.8 16.3 3.6 13l3-.2c.2 2.2 1.2 3.7 3.1 4.5zM3.9 10.7c.1-.9.4-1.7.8-2.5l2.7 1.4c-.3.5-.4 1-.5 1.5zM12 9.5a2.5 2.5 0 1 1 0 5 2.5 2.5 0 0 1 0-5z",
  );
  svg.setAttribute("class", "mark");
  return svg;
}

function dropZone(studio: Studio): HTMLElement {
  const node = el("div", { class: "drop", hidden: true, "aria-hidden": "true" }, el("div", {}, icon("open"), "Drop a mesh or a recipe"));
  addEventListener("dragover", (event) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    node.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (!event.relatedTarget) node.hidden = true;
  });
  addEventListener("drop", (event) => {
    event.preventDefault();
    node.hidden = true;
    const file = event.dataTransfer?.files[0];
    if (file) studio.chooseFile(file).catch((error: unknown) => studio.fail(error, file.name));
  });
  return node;
}

function writing(target: EventTarget | null): boolean {
  if (target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement) return true;
  return target instanceof HTMLInputElement && !["range", "checkbox", "color"].includes(target.type);
}

function keys(studio: Studio, brush: Brush, actions: Actions, toolbar: HTMLElement): void {
  const plain: Record<string, () => void> = {
    ".": () => void studio.stepOnce(),
    r: () => studio.restart(),
    b: actions.bare,
    t: actions.turntable,
    f: () => studio.scene.frame(),
    "[": () => brush.setRadius(brush.radius / 1.2),
    "]": () => brush.setRadius(brush.radius * 1.2),
  };
  tools.forEach(({ key }, i) => (plain[key] = () => (toolbar.children[i] as HTMLElement).click()));
  addEventListener("keydown", (event) => {
    const command = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    if (command && (key === "z" || key === "y")) {
      event.preventDefault();
      if (key === "y" || event.shiftKey) studio.redo();
      else studio.undo();
      return;
    }
    if (command || event.altKey || writing(event.target)) return;
    const onButton = event.target instanceof Element && event.target.closest("button, summary, input");
    if (key === " " && !onButton) {
      event.preventDefault();
      studio.togglePlay();
    } else if (plain[key]) {
      event.preventDefault();
      plain[key]!();
    }
  });
}

function embedPlayer(studio: Studio, stage: HTMLElement): HTMLElement {
  const play = button("", { icon: "pause", label: "Pause" });
  play.addEventListener("click", () => studio.togglePlay());
  studio.on("playing", () => {
    play.querySelector("svg")?.replaceWith(icon(studio.playing ? "pause" : "play"));
    play.setAttribute("aria-label", studio.playing ? "Pause" : "Play");
  });
  const again = button("", { icon: "reset", label: "Begin anew" });
  again.addEventListener("click", () => studio.restart());
  const open = el("a", { class: "open-studio", target: "_blank", rel: "noopener", href: "./" }, "Open in the studio");
  studio.on(["recipe", "shape", "begun"], () => {
    shareAddress(studio, false)
      .then((address) => (open.href = address))
      .catch(() => undefined);
  });
  stage.append(el("div", { class: "embed-bar" }, play, again, open));
  return stage;
}

async function main(): Promise<void> {
  const { shared, refused } = await sharedOfAddress();
  const engine = Engine.ofPage();
  const opening = open(engine, shared);
  const stage = el("main", { class: "stage", id: "stage" });
  const scene = new Scene(stage);
  scene.canvas.setAttribute("aria-label", "The coat on its shape. Arrow keys turn it, plus and minus come nearer and go away.");
  scene.canvas.setAttribute("role", "application");
  const studio = new Studio(engine, scene);
  stage.append(busySign(studio), statusLine(studio));
  if (embedded) {
    document.body.classList.add("embedded");
    document.body.append(embedPlayer(studio, stage));
  } else {
    furnish(studio, stage);
  }
  await studio.start(opening);
  if (refused) studio.say(refused, true);
  addEventListener("pagehide", () => !embedded && studio.keepNow());
  addEventListener("hashchange", () => void sharedOfAddress().then(({ shared: next, refused: why }) => (next ? studio.open(next) : why && studio.say(why, true))));
}

function furnish(studio: Studio, stage: HTMLElement): void {
  const brush = new Brush(studio);
  const left = dock("left", "Choose", [
    { id: "coats", label: "Coats", panel: coatsPanel(studio) },
    { id: "shape", label: "Shape", panel: shapePanel(studio) },
  ]);
  const right = dock("right", "Work", [
    { id: "adjust", label: "Adjust", panel: adjustPanel(studio) },
    { id: "paint", label: "Paint", panel: paintPanel(studio, brush) },
    { id: "look", label: "Look", panel: lookPanel(studio) },
    { id: "recipe", label: "Recipe", panel: recipePanel(studio) },
    { id: "readout", label: "Readout", panel: readoutPanel(studio) },
    { id: "export", label: "Export", panel: outPanel(studio) },
  ]);
  const docks = [left, right];
  const toolbar = palette(studio, brush, docks);
  const view = viewButtons(studio);
  stage.append(toolbar, view.node, ruler(studio));
  document.body.append(topBar(studio, docks), left.node, stage, transport(studio), right.node, dropZone(studio));
  keys(studio, brush, view.actions, toolbar);
  studio.scene.canvas.addEventListener("pointerup", () => studio.keep());
  studio.scene.canvas.addEventListener("wheel", () => studio.keep(), { passive: true });
}

void main();
