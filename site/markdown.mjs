// The guides and the rest of docs, README, CONTRIBUTING and CHANGELOG, as pages; with the sources that they name.
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join, posix } from "node:path";
import MarkdownIt from "markdown-it";
import { code, escape, link } from "./page.mjs";

const guides = ["recipe", "model", "scan", "blender", "engine", "print", "paper"].map((name) => `docs/guides/${name}.md`);
const docs = (...names) => names.map((name) => `docs/${name}.md`);
const groups = [
  ["Guides", ["README.md", ...guides]],
  ["Patterns", docs("recipes", "models", "measure", "figures", "questions")],
  ["Shapes", docs("grids", "regions", "cells", "volumes", "solid", "unwrap")],
  ["Results", docs("formats", "pictures", "scenes", "frames", "textures", "gltf", "blender", "lines", "print")],
  ["Runs", docs("checkpoints", "provenance", "untrusted")],
  ["Programs", docs("python", "python-match")],
  ["Studio", docs("studio", "studio-protocol", "site")],
  ["Inside", [...docs("method", "performance", "architecture", "dependencies"), "CONTRIBUTING.md", "CHANGELOG.md"]],
];

/** What pages of another kind stand for. */
const elsewhere = { "docs/gallery.md": "gallery.html", "include/pelage": "headers/index.html" };

function pageOf(file) {
  if (elsewhere[file]) return elsewhere[file];
  const page = file.replace(/\.md$/, ".html");
  return page.startsWith("docs/") ? page : `docs/${page.toLowerCase()}`;
}

/** Anchors of headings, as the hosts of repositories make them. */
export const slug = (text) => text.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").trim().replace(/\s/g, "-");

/** Width and height of a picture, so that a page does not jump while it loads. */
export function sizeOf(path) {
  const bytes = readFileSync(path);
  const size = (width, height) => `width="${width}" height="${height}"`;
  if (bytes.toString("latin1", 1, 4) === "PNG") return size(bytes.readUInt32BE(16), bytes.readUInt32BE(20));
  if (bytes.toString("latin1", 12, 16) === "VP8 ") return size(bytes.readUInt16LE(26), bytes.readUInt16LE(28));
  const [, width, height] = /<svg[^>]*viewBox="0 0 (\d+) (\d+)"/.exec(bytes.toString("utf8"));
  return size(width, height);
}

export class Docs {
  /** `root`: the project; `site`: where pages go. */
  constructor(root, site) {
    this.root = root;
    this.site = site;
    this.sources = new Set(["LICENSE"]);
    this.pictures = new Set();
    this.groups = this.allGroups();
    this.files = this.groups.flatMap(([, files]) => files);
    this.titles = new Map(this.files.map((file) => [file, file === "README.md" ? "Overview" : /^# (.*)$/m.exec(this.read(file))[1]]));
    this.side = this.groups.map(([title, files]) => [title, files.map((file) => [this.titles.get(file), pageOf(file)])]);
    this.markdown = this.renderer();
  }

  read(file) {
    return readFileSync(join(this.root, file), "utf8");
  }

  /** Texts that no group names come last. */
  allGroups() {
    const named = groups.flatMap(([, files]) => files);
    const found = ["docs", "docs/guides"].flatMap((folder) => readdirSync(join(this.root, folder)).map((name) => `${folder}/${name}`));
    const others = found.filter((file) => file.endsWith(".md") && !named.includes(file) && !elsewhere[file]);
    return others.length ? [...groups, ["More", others]] : groups;
  }

  /** Where a link of a text leads: a page of the site, the page of a source, or out into the world. */
  resolve(file, href) {
    if (/^[a-z]+:/.test(href) || href.startsWith("#")) return href;
    const [path, anchor] = href.split("#");
    const target = posix.normalize(posix.join(posix.dirname(file), path)).replace(/\/$/, "");
    if (!existsSync(join(this.root, target))) return href;  // which the check of the site names
    const page = target.endsWith(".md") || elsewhere[target] ? pageOf(target) : this.sourcePage(target);
    return link(pageOf(file), anchor ? `${page}#${anchor}` : page);
  }

  sourcePage(target) {
    this.sources.add(target);
    return `source/${target}.html`;
  }

  image(file, token) {
    const target = posix.normalize(posix.join(posix.dirname(file), token.attrGet("src")));
    const there = existsSync(join(this.root, target));
    if (there) this.pictures.add(target);
    const size = there ? sizeOf(join(this.root, target)) : "";
    return `<img src="${link(pageOf(file), target)}" alt="${escape(token.content)}" ${size} loading="lazy">`;
  }

  renderer() {
    const markdown = new MarkdownIt();
    const { rules } = markdown.renderer;
    rules.link_open = (tokens, i, options, env, self) => {
      tokens[i].attrSet("href", this.resolve(env.file, tokens[i].attrGet("href")));
      return self.renderToken(tokens, i, options);
    };
    rules.heading_open = (tokens, i, options, env, self) => {
      const name = slug(tokens[i + 1].children.map(({ content }) => content).join(""));
      const before = env.names.filter((one) => one === name).length;
      env.names.push(name);
      tokens[i].attrSet("id", before ? `${name}-${before}` : name);
      return self.renderToken(tokens, i, options);
    };
    rules.image = (tokens, i, options, env) => this.image(env.file, tokens[i]);
    rules.code_block = rules.fence = (tokens, i) => code(tokens[i].content);
    rules.table_open = () => '<div class="table" tabindex="0"><table>';
    rules.table_close = () => "</table></div>";
    return markdown;
  }

  /** Heads of tables without words are no heads. */
  html(file) {
    const wordless = /<thead>\s*<tr>\s*(<th><\/th>\s*)+<\/tr>\s*<\/thead>/g;
    return this.markdown.render(this.read(file), { file, names: [] }).replace(wordless, "");
  }

  pages() {
    for (const file of this.files) {
      const first = /^# .*\n+(.*)/m.exec(this.read(file))[1].replace(/[[\]`*]|\(.*?\)/g, "");
      const title = this.titles.get(file);
      this.site.page(pageOf(file), { title, description: first, body: this.html(file), part: "guides.html", side: this.side });
    }
    for (const target of this.sources) this.source(target);
    for (const target of this.pictures) {
      mkdirSync(dirname(join(this.site.folder, target)), { recursive: true });
      copyFileSync(join(this.root, target), join(this.site.folder, target));
    }
  }

  /** A source of the project, or those of a folder one after the other. */
  source(target) {
    const folder = statSync(join(this.root, target)).isDirectory();
    const files = folder ? readdirSync(join(this.root, target)).map((name) => `${target}/${name}`) : [target];
    const texts = files.map((file) => (folder ? `<h2 id="${slug(file)}">${escape(file)}</h2>` : "") + code(this.read(file)));
    const body = `<h1>${escape(target)}</h1>${texts.join("\n")}`;
    const about = { title: target, description: `Source: ${target}`, part: "reference.html" };
    this.site.page(`source/${target}.html`, { ...about, body, side: this.side });
  }

  /** The page of the guides: what each is about, in its own first words. */
  guides() {
    const entry = (file) => {
      const words = this.read(file).split("\n\n")[1].replace(/\[(.*?)\]\(.*?\)/g, "$1");
      const first = this.markdown.renderInline(words);
      return `<li><a href="${pageOf(file)}">${escape(this.titles.get(file))}</a><p>${first}</p></li>`;
    };
    const body = `<h1>Guides</h1><p class="lead">To be followed alone, in minutes each. Every command in them is run by the tests.</p>
<ul class="entries">${guides.map(entry).join("\n")}</ul>`;
    this.site.page("guides.html", { title: "Guides", description: "Guides to Pelage, to be followed alone", body, side: this.side });
  }
}
