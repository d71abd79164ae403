// What must hold of a finished site: every link, anchor and picture is there, nothing is asked for from elsewhere, and
// every page can be reached. And how large it is.
import { existsSync, readFileSync, readdirSync, statSync } from "node:fs";
import { join, posix } from "node:path";
import { gzipSync } from "node:zlib";

const filesOf = (folder) => readdirSync(folder, { recursive: true }).map((name) => name.replaceAll("\\", "/")).filter((name) => statSync(join(folder, name)).isFile());

const unescape = (text) => text.replace(/&quot;/g, '"').replace(/&lt;/g, "<").replace(/&gt;/g, ">").replace(/&amp;/g, "&");

/** Faults of one reference; notes the page that it leads to. */
function faultOf(folder, page, { tag, value, ids, reached }) {
  if (/^data:/.test(value)) return "";
  if (/^[a-z]+:/i.test(value)) return tag === "a" ? "" : "is loaded from elsewhere";
  if (value.startsWith("/") || value === "") return "is not relative";
  const [path, anchor] = value.split("#");
  const target = path ? posix.normalize(posix.join(posix.dirname(page), path)) : page;
  if (target.startsWith("..")) return "leads out of the site";
  if (!existsSync(join(folder, target)) || !statSync(join(folder, target)).isFile()) return "leads nowhere";
  reached.add(target);
  if (!anchor || target.startsWith("studio/")) return "";
  return ids.get(target)?.has(anchor) ? "" : "names a place that the page does not have";
}

/** All that is wrong, one line each. */
export function faults(folder) {
  const pages = filesOf(folder).filter((name) => name.endsWith(".html"));
  const html = new Map(pages.map((page) => [page, readFileSync(join(folder, page), "utf8")]));
  const ids = new Map(pages.map((page) => [page, new Set([...html.get(page).matchAll(/\sid="([^"]+)"/g)].map(([, id]) => id))]));
  const reached = new Set(["index.html"]);
  const found = [];
  for (const page of pages) {
    for (const [, tag, value] of html.get(page).matchAll(/<([a-z]+)\b[^>]*?\s(?:href|src|srcset)="([^"]*)"/g)) {
      const fault = faultOf(folder, page, { tag, value: unescape(value), ids, reached });
      if (fault) found.push(`${page}: ${value.slice(0, 100)} ${fault}`);
    }
    for (const [image] of html.get(page).matchAll(/<img\b[^>]*>/g)) if (!/\salt="/.test(image)) found.push(`${page}: ${image} has no words in its place`);
  }
  return [...found, ...pages.filter((page) => !reached.has(page)).map((page) => `${page}: no page leads there`)];
}

const kB = (bytes) => `${(bytes / 1000).toFixed(bytes < 1e5 ? 1 : 0)} kB`;

function sizes(folder, files) {
  const bytes = files.filter((name) => existsSync(join(folder, name))).map((name) => readFileSync(join(folder, name)));
  const sum = (list) => list.reduce((total, one) => total + one.length, 0);
  return { raw: sum(bytes), gzipped: sum(bytes.map((one) => gzipSync(one, { level: 9 }))) };
}

/** What a first visit loads; pictures further down are loaded when they come into view. */
export const firstLoads = {
  "front page": ["index.html", "style.css", "mark.svg", "front-light.webp"],
  gallery: ["gallery.html", "style.css", "mark.svg"],
  "studio, before the first mesh": ["index.html", "studio.css", "studio.js", "engine-worker.js", "pelage-engine.js", "pelage-engine.wasm"].map((name) => `studio/${name}`),
};

export function sizeLines(folder) {
  const all = filesOf(folder);
  const lines = Object.entries({ ...firstLoads, everything: all }).map(([what, files]) => [what, sizes(folder, files)]);
  return [...lines.map(([what, { raw, gzipped }]) => `${what.padEnd(30)} ${kB(raw).padStart(9)}, gzipped ${kB(gzipped)}`), `${all.length} files, ${all.filter((name) => name.endsWith(".html")).length} pages`];
}
