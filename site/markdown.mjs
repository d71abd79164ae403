// The guides and the rest of docs, and README, CONTRIBUTING and CHANGELOG, as pages; with the sources that they name.
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join, posix } from "node:path";
import MarkdownIt from "markdown-it";
import { code, escape, link } from "./page.mjs";

const groups = [
  ["Guides", ["README", "docs/guides/recipe", "docs/guides/model", "docs/guides/scan", "docs/guides/blender", "docs/guides/engine", "docs/guides/print", "docs/guides/paper"]],
  ["Patterns", ["docs/recipes", "docs/models", "docs/measure", "docs/figures", "docs/questions"]],
  ["Shapes", ["docs/grids", "docs/regions", "docs/cells", "docs/volumes", "docs/solid", "docs/unwrap"]],
  ["Results", ["docs/formats", "docs/pictures", "docs/scenes", "docs/frames", "docs/textures", "docs/gltf", "docs/blender", "docs/lines", "docs/print"]],
  ["Runs", ["docs/checkpoints", "docs/provenance", "docs/untrusted"]],
  ["Studio", ["docs/studio", "docs/studio-protocol"]],
  ["Inside", ["docs/method", "docs/performance", "docs/architecture", "docs/dependencies", "CONTRIBUTING", "CHANGELOG"]],
];

/** Files that pages of another kind stand for. */
const elsewhere = { "docs/gallery.md": "gallery.html", "include/pelage": "headers/index.html" };

const pageOf = (file) => elsewhere[file] ?? (file.startsWith("docs/") ? file.replace(/\.md$/, ".html") : `docs/${file.replace(/\.md$/, ".html").toLowerCase()}`);

export function slug(text) {
  return text.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").trim().replace(/\s/g, "-");
}

export class Docs {
  /** `root`: the project; `site`: where pages go. */
  constructor(root, site) {
    this.root = root;
    this.site = site;
    this.sources = new Set(["LICENSE"]);
    this.pictures = new Set();
    this.files = this.listed();
    this.titles = new Map(this.files.map((file) => [file, /^# (.*)$/m.exec(this.read(file))[1]]));
    this.titles.set("README.md", "Overview");
    this.markdown = this.renderer();
  }

  read(file) {
    return readFileSync(join(this.root, file), "utf8");
  }

  /** All of them: those that no group names come last. */
  listed() {
    const named = groups.flatMap(([, names]) => names.map((name) => `${name}.md`));
    const found = ["docs", "docs/guides"].flatMap((folder) => readdirSync(join(this.root, folder)).map((name) => `${folder}/${name}`));
    const others = found.filter((file) => file.endsWith(".md") && !named.includes(file) && !elsewhere[file]);
    this.groups = others.length ? [...groups, ["More", others.map((file) => file.replace(/\.md$/, ""))]] : groups;
    return [...named, ...others];
  }

  side() {
    return this.groups.map(([title, names]) => [title, names.map((name) => [this.titles.get(`${name}.md`), pageOf(`${name}.md`)])]);
  }

  /** Where a link of a text leads: a page of the site, the page of a source, or out into the world. */
  resolve(file, href) {
    if (/^[a-z]+:/.test(href) || href.startsWith("#")) return href;
    const [path, anchor] = href.split("#");
    const target = posix.normalize(posix.join(posix.dirname(file), path)).replace(/\/$/, "");
    if (!existsSync(join(this.root, target))) throw new Error(`${file}: the link ${href} leads nowhere`);
    const page = target.endsWith(".md") || elsewhere[target] ? pageOf(target) : this.sourcePage(target);
    return link(pageOf(file), anchor ? `${page}#${anchor}` : page);
  }

  sourcePage(target) {
    this.sources.add(target);
    return `source/${target}.html`;
  }

  picture(file, src) {
    const target = posix.normalize(posix.join(posix.dirname(file), src));
    this.pictures.add(target);
    return link(pageOf(file), target);
  }

  renderer() {
    const markdown = new MarkdownIt();
    const { rules } = markdown.renderer;
    const plain = (tokens, i, options, env, self) => self.renderToken(tokens, i, options);
    rules.link_open = (tokens, i, options, env, self) => {
      tokens[i].attrSet("href", this.resolve(env.file, tokens[i].attrGet("href")));
      return plain(tokens, i, options, env, self);
    };
    rules.image = (tokens, i, options, env) => {
      const src = tokens[i].attrGet("src");
      return `<img src="${escape(this.picture(env.file, src))}" alt="${escape(tokens[i].content)}" ${sizeOf(join(this.root, dirname(env.file), src))} loading="lazy">`;
    };
    rules.heading_open = (tokens, i, options, env, self) => {
      const text = tokens[i + 1].children.map((child) => child.content).join("");
      const again = env.slugs[slug(text)] ?? 0;
      env.slugs[slug(text)] = again + 1;
      tokens[i].attrSet("id", again ? `${slug(text)}-${again}` : slug(text));
      return plain(tokens, i, options, env, self);
    };
    rules.code_block = rules.fence = (tokens, i) => code(tokens[i].content);
    rules.table_open = () => '<div class="table" tabindex="0"><table>';
    rules.table_close = () => "</table></div>";
    return markdown;
  }

  html(file) {
    // Heads without words are no heads.
    return this.markdown.render(this.read(file), { file, slugs: {} }).replace(/<thead>\s*<tr>\s*(<th><\/th>\s*)+<\/tr>\s*<\/thead>/g, "");
  }

  pages() {
    for (const file of this.files) {
      const first = /^# .*\n+(.*)/m.exec(this.read(file))[1].replace(/[[\]`*]|\(.*?\)/g, "");
      this.site.page(pageOf(file), { title: this.titles.get(file), description: first, body: this.html(file), part: "guides.html", side: this.side() });
    }
    for (const target of this.sources) this.source(target);
    for (const target of this.pictures) {
      mkdirSync(dirname(join(this.site.folder, target)), { recursive: true });
      copyFileSync(join(this.root, target), join(this.site.folder, target));
    }
  }

  /** A source of the project, or a folder of them one after the other. */
  source(target) {
    const folder = statSync(join(this.root, target)).isDirectory();
    const files = folder ? readdirSync(join(this.root, target)).map((name) => `${target}/${name}`) : [target];
    const texts = files.map((file) => (folder ? `<h2 id="${slug(file)}">${escape(file)}</h2>` : "") + code(this.read(file)));
    this.site.page(`source/${target}.html`, { title: target, body: `<h1>${escape(target)}</h1>${texts.join("\n")}`, part: "reference.html", side: this.side() });
  }

  /** The page of the guides: what each is about. */
  guides() {
    const entry = (name) => {
      const file = `${name}.md`;
      const lines = this.read(file).split("\n\n")[1].replace(/\n/g, " ");
      return `<li><a href="${link("guides.html", pageOf(file))}">${escape(this.titles.get(file))}</a><p>${this.markdown.renderInline(lines, { file: "docs/guides/x.md" })}</p></li>`;
    };
    const guides = this.groups[0][1].filter((name) => name.startsWith("docs/guides/"));
    const body = `<h1>Guides</h1><p class="lead">To be followed alone, in minutes each. Every command in them is run by the tests.</p>
<ul class="entries">${guides.map(entry).join("\n")}</ul>`;
    this.site.page("guides.html", { title: "Guides", description: "Guides to Pelage, to be followed alone", body, side: this.side() });
  }
}

/** Width and height of a picture, so that a page does not jump while it loads. */
export function sizeOf(path) {
  const bytes = readFileSync(path);
  if (bytes.toString("latin1", 1, 4) === "PNG") return `width="${bytes.readUInt32BE(16)}" height="${bytes.readUInt32BE(20)}"`;
  if (bytes.toString("latin1", 12, 16) === "VP8 ") return `width="${bytes.readUInt16LE(26) & 0x3fff}" height="${bytes.readUInt16LE(28) & 0x3fff}"`;
  const box = /<svg[^>]*viewBox="0 0 (\d+) (\d+)"/.exec(bytes.toString("utf8"));
  return box ? `width="${box[1]}" height="${box[2]}"` : "";
}
