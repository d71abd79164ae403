// What must hold of a finished site: every link, anchor and picture is there, nothing is asked for from elsewhere, and
// every page can be reached. And how large it is.
import { existsSync, readFileSync, readdirSync, statSync } from "node:fs";
import { join, posix } from "node:path";
import { gzipSync } from "node:zlib";

const isFile = (path) => existsSync(path) && statSync(path).isFile();
const filesOf = (folder) => readdirSync(folder, { recursive: true }).filter((name) => isFile(join(folder, name)));
const plain = (html) => html.replace(/&quot;/g, '"').replace(/&lt;/g, "<").replace(/&gt;/g, ">").replace(/&amp;/g, "&");

class Check {
  constructor(folder) {
    this.folder = folder;
    this.html = new Map();
    this.ids = new Map();
    this.reached = new Set(["index.html"]);
    for (const page of filesOf(folder).filter((name) => name.endsWith(".html"))) {
      const html = readFileSync(join(folder, page), "utf8");
      this.html.set(page, html);
      this.ids.set(page, new Set([...html.matchAll(/\sid="([^"]+)"/g)].map(([, id]) => id)));
    }
  }

  /** What is wrong with a reference of a page, if anything is; notes where it leads. */
  fault(page, tag, value) {
    if (/^data:/.test(value)) return "";
    if (/^[a-z]+:/i.test(value)) return tag === "a" ? "" : "is loaded from elsewhere";
    if (value.startsWith("/") || value === "") return "is not relative";
    const [path, anchor] = value.split("#");
    const target = path ? posix.normalize(posix.join(posix.dirname(page), path)) : page;
    if (target.startsWith("..")) return "leads out of the site";
    if (!isFile(join(this.folder, target))) return "leads nowhere";
    this.reached.add(target);
    // What stands behind the # of a studio's link is a coat.
    if (!anchor || target.startsWith("studio/") || this.ids.get(target)?.has(anchor)) return "";
    return "names a place that the page does not have";
  }

  faultsOf(page) {
    const found = [];
    for (const [, tag, value] of this.html.get(page).matchAll(/<([a-z]+)\b[^>]*?\s(?:href|src|srcset)="([^"]*)"/g)) {
      const fault = this.fault(page, tag, plain(value));
      if (fault) found.push(`${page}: ${value.slice(0, 100)} ${fault}`);
    }
    const silent = [...this.html.get(page).matchAll(/<img\b[^>]*>/g)].filter(([image]) => !/\salt="/.test(image));
    return [...found, ...silent.map(([image]) => `${page}: ${image} has no words in its place`)];
  }

  faults() {
    const pages = [...this.html.keys()];
    const found = pages.flatMap((page) => this.faultsOf(page));
    return [...found, ...pages.filter((page) => !this.reached.has(page)).map((page) => `${page}: no page leads there`)];
  }
}

/** All that is wrong, one line each. */
export const faults = (folder) => new Check(folder).faults();

const studio = ["index.html", "studio.css", "studio.js", "engine-worker.js", "pelage-engine.js", "pelage-engine.wasm"];
/** What a first visit loads; pictures further down are loaded when they come into view. */
const firstLoads = {
  "front page": ["index.html", "style.css", "mark.svg", "front-light.webp"],
  gallery: ["gallery.html", "style.css", "mark.svg"],
  "studio, before the first mesh": studio.map((name) => `studio/${name}`),
};

function sizeLine(folder, what, files) {
  const bytes = files.filter((name) => isFile(join(folder, name))).map((name) => readFileSync(join(folder, name)));
  const kB = (list) => `${(list.reduce((sum, { length }) => sum + length, 0) / 1000).toFixed(0)} kB`;
  return `${what.padEnd(30)} ${kB(bytes).padStart(9)}, gzipped ${kB(bytes.map((one) => gzipSync(one, { level: 9 })))}`;
}

export function sizeLines(folder) {
  const all = filesOf(folder);
  const lines = Object.entries({ ...firstLoads, everything: all }).map(([what, files]) => sizeLine(folder, what, files));
  return [...lines, `${all.length} files, ${all.filter((name) => name.endsWith(".html")).length} pages`];
}
