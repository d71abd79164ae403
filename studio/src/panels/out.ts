/** What leaves the page: meshes, pictures, clips, the recipe, links. */

import { button, choice, download, el, setIcon } from "../dom";
import { encodeLink } from "../link";
import type { Exported } from "../protocol";
import type { Studio } from "../studio";

const meanings: Record<string, string> = {
  ".glb": "Blender, game engines, the web",
  ".ply": "colours and fields",
  ".obj": "nearly every program",
  ".stl": "shape only, for printers",
  ".vtp": "ParaView, with all fields",
  ".3mf": "printers, with colours",
  ".off": "plain triangles",
};

function note(): { node: HTMLElement; say: (text: string, bad?: boolean) => void } {
  const node = el("p", { class: "quiet-text", role: "status" });
  return {
    node,
    say: (text, bad = false) => {
      node.textContent = text;
      node.classList.toggle("bad", bad);
    },
  };
}

/** Has the engine make the file and offers it. */
export async function exportMesh(studio: Studio, format: string, bake: number): Promise<string> {
  const reply = await studio.engine.ask<Exported>("export", { format, bake, name: studio.fileName });
  const bytes = reply.blocks["bytes"] as Uint8Array;
  download(`${studio.fileName}${format}`, bytes);
  const size = bytes.length > 1e6 ? `${(bytes.length / 1e6).toFixed(1)} MB` : `${Math.ceil(bytes.length / 1e3)} kB`;
  const losses = reply.losses?.length ? ` Not in it: ${reply.losses.join("; ")}.` : "";
  return `${studio.fileName}${format}, ${size}.${losses}`;
}

function meshPart(studio: Studio): HTMLElement {
  let bake = "2048";
  const sizes = [{ value: "0", text: "Vertices" }, ...["1024", "2048", "4096"].map((value) => ({ value, text: value }))];
  const colours = choice("Colours of GLB", sizes, bake, (value) => (bake = value));
  const told = note();
  const rows = el("div", { class: "rows" });
  const run = (format: string, row: HTMLButtonElement): void => {
    row.disabled = true;
    told.say("Making the file in full quality …");
    exportMesh(studio, format, format === ".glb" ? Number(bake) : 0)
      .then((text) => told.say(text))
      .catch((error: unknown) => told.say(error instanceof Error ? error.message : String(error), true))
      .finally(() => (row.disabled = !studio.begun));
  };
  studio.on("ready", () => {
    const formats = studio.catalog?.writes ?? [];
    const sorted = [".glb", ...formats.filter((f) => f !== ".glb")].filter((f) => formats.includes(f));
    for (const format of sorted) {
      const row = button(format.slice(1).toUpperCase(), { icon: "download", class: "row" });
      row.dataset["format"] = format;
      row.append(el("small", {}, meanings[format] ?? ""));
      row.addEventListener("click", () => run(format, row));
      rows.append(row);
    }
  });
  return el("div", {}, el("h2", {}, "Mesh"), el("span", { class: "label" }, "Colours of GLB: at vertices, or a texture of so many pixels"), colours.node, rows, told.node);
}

function picturePart(studio: Studio): HTMLElement {
  const told = note();
  const png = button("Picture", { icon: "camera", class: "row" });
  png.append(el("small", {}, "PNG, twice as large"));
  png.addEventListener("click", () => {
    studio.scene
      .picture(2)
      .then((blob) => download(`${studio.fileName}.png`, blob))
      .catch((error: unknown) => told.say(String(error), true));
  });
  const clip = button("Record a clip", { icon: "record", class: "row" });
  clip.append(el("small", {}, "WebM of the view"));
  let running: { stop: () => Promise<Blob> } | null = null;
  clip.addEventListener("click", () => {
    if (running) {
      void running.stop().then((blob) => download(`${studio.fileName}.webm`, blob));
      running = null;
    } else {
      running = studio.scene.record();
      if (!running) told.say("This browser cannot record clips.", true);
    }
    clip.classList.toggle("recording", running !== null);
    setIcon(clip, running ? "pause" : "record");
    clip.querySelector("span")!.textContent = running ? "Stop and save the clip" : "Record a clip";
  });
  return el("div", {}, el("h2", {}, "Picture and clip"), el("div", { class: "rows" }, png, clip), told.node);
}

/** The address of this page with the coat in its fragment; without the token of the native program. */
export async function shareAddress(studio: Studio, embed: boolean): Promise<string> {
  const code = await encodeLink({ recipe: studio.recipe, shape: studio.shape.id, view: studio.scene.view() });
  return `${location.origin === "null" ? "" : location.origin}${location.pathname}${embed ? "?embed" : ""}#s=${code}`;
}

function sharePart(studio: Studio): HTMLElement {
  const told = note();
  const field = el("input", { type: "text", readonly: true, "aria-label": "Link", class: "link-field", hidden: true });
  const copy = async (embed: boolean): Promise<void> => {
    try {
      if (studio.shape.bytes) throw new Error("A link holds the recipe and a built-in shape; it cannot hold your mesh. Save the recipe as a file instead.");
      const address = await shareAddress(studio, embed);
      field.value = embed ? `<iframe src="${address}" width="640" height="480" title="Pelage"></iframe>` : address;
      field.hidden = false;
      field.select();
      const copied = await navigator.clipboard.writeText(field.value).then(() => true, () => false);
      const local = studio.hello?.engine === "native" && !embed ? " It opens on this machine; what begins with #s= works behind the address of any studio." : "";
      told.say(`${copied ? "Copied." : "Copy it from the field."} ${field.value.length} characters; nothing was sent anywhere.${local}`);
    } catch (error) {
      told.say(error instanceof Error ? error.message : String(error), true);
    }
  };
  const link = button("Copy a link", { icon: "share", class: "row" });
  link.append(el("small", {}, "recipe, shape and view"));
  link.addEventListener("click", () => void copy(false));
  const embed = button("Copy a small player", { icon: "frame", class: "row" });
  embed.append(el("small", {}, "for a web page"));
  embed.addEventListener("click", () => void copy(true));
  const recipe = button("Save the recipe", { icon: "download", class: "row" });
  recipe.append(el("small", {}, "for the command line"));
  recipe.addEventListener("click", () => download(`${studio.fileName}.toml`, studio.recipe, "text/plain"));
  return el("div", {}, el("h2", {}, "Recipe and link"), el("div", { class: "rows" }, recipe, link, embed), field, told.node);
}

export function outPanel(studio: Studio): HTMLElement {
  return el("div", { class: "panel" }, el("div", { class: "scroll padded" }, meshPart(studio), picturePart(studio), sharePart(studio)));
}
