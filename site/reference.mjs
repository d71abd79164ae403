// What the program says of itself, page by page: commands, models, recipes; and the headers of the library.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { card, liveModel, liveRecipe } from "./gallery.mjs";
import { code, escape, link, table } from "./page.mjs";

const capital = (name) => name[0].toUpperCase() + name.slice(1);
const start = (title) => (title ? `<h2 id="${title.toLowerCase().replace(/[^a-z]+/g, "-")}">${escape(title)}</h2>` : "");

/** Lines of a help text under one heading: entries of a name and a meaning, commands, or prose. */
function section(title, lines) {
  if (title === "Examples" || title === "Usage") return start(title) + code(lines.map((line) => line.trim()).join("\n"));
  if (!lines[0].startsWith("  ")) return start(title) + lines.join("\n").trim().split("\n\n").map((text) => `<p>${escape(text)}</p>`).join("");
  const entries = [];
  for (const line of lines) {
    const [, name, meaning = ""] = /^ {2}(\S.*?)(?: {2,}(.*))?$/.exec(line) ?? [];
    if (name) entries.push([name, meaning]);
    else entries.at(-1)[1] = `${entries.at(-1)[1]} ${line.trim()}`.trim();
  }
  return `${start(title)}<dl class="options">${entries.map(([name, meaning]) => `<dt><code>${escape(name)}</code></dt><dd>${escape(meaning)}</dd>`).join("\n")}</dl>`;
}

export function helpBody(text) {
  const sections = [["", []]];
  for (const line of text.trimEnd().split("\n")) {
    const head = /^([A-Z][A-Za-z ,-]*):(?: (.*))?$/.exec(line);
    if (head) sections.push([head[1], head[2] ? [head[2]] : []]);
    else sections.at(-1)[1].push(line);
  }
  return sections.map(([title, lines]) => [title, lines.join("\n").trimEnd().split("\n")]).filter(([, lines]) => lines[0] || lines.length > 1).map(([title, lines]) => section(title, lines)).join("\n");
}

export class Reference {
  /** `program`: the path of pelage. */
  constructor(root, site, program) {
    this.root = root;
    this.site = site;
    this.run = (...words) => execFileSync(program, words, { encoding: "utf8", maxBuffer: 1 << 26 });
    const listed = /\nCommands:\n([^]*?)\n\n/.exec(this.run("--help"))[1];
    this.commands = [...listed.matchAll(/^ {2}(\S+) +(.*)$/gm)].map(([, name, summary]) => ({ name, summary }));
    this.models = JSON.parse(this.run("models", "--json"));
    this.recipes = JSON.parse(this.run("recipes", "--json"));
    for (const recipe of this.recipes) recipe.text = this.run("recipes", recipe.name);
    this.headers = readdirSync(join(root, "include/pelage")).filter((name) => name.endsWith(".h")).map((name) => ({ name, ...this.header(name) }));
  }

  baseModels() {
    return this.models.filter(({ name }) => !name.includes(":"));
  }

  /** The parts of the reference, and the pages of the one that `path` belongs to. */
  side(path) {
    const all = { commands: this.commands, recipes: this.recipes, models: this.baseModels(), headers: this.headers };
    const here = path.split("/")[0];
    const own = (all[here] ?? []).map(({ name }) => [name, `${here}/${name}.html`]);
    const overview = ["Reference", [["Overview", "reference.html"], ...Object.keys(all).map((name) => [capital(name), `${name}/index.html`])]];
    return own.length ? [overview, [capital(here), own]] : [overview];
  }

  page(path, name, description, body) {
    this.site.page(path, { title: name, description, body, part: "reference.html", side: this.side(path) });
  }

  pages() {
    this.overview();
    this.page("commands/index.html", "Commands", "All commands of pelage", `<h1>Commands</h1>${this.commandLinks(helpBody(this.run("--help")))}`);
    for (const { name, summary } of this.commands) {
      this.page(`commands/${name}.html`, `pelage ${name}`, summary, `<h1>pelage ${name}</h1>${helpBody(this.run("help", name))}`);
    }
    for (const model of this.baseModels()) this.model(model);
    for (const recipe of this.recipes) this.recipe(recipe);
    this.index("recipes", "Coats that come with the program, with all their stages and colours.", ["docs/recipes.html", "How to write one"], this.recipes.map(({ name, summary }) => [name, summary]));
    this.index("models", "Reaction systems that come with the program.", ["docs/models.html", "What the files promise, and how to write one"], this.baseModels().map(({ name, title, summary }) => [name, `${title}. ${summary}`]));
    this.headerIndex();
    for (const { name, title, body } of this.headers) this.page(`headers/${name}.html`, `pelage/${name}`, title, `<h1>pelage/${name}</h1>${body}`);
  }

  commandLinks(html) {
    return this.commands.reduce((text, { name }) => text.replace(`<dt><code>${name}</code>`, `<dt><a href="${name}.html"><code>${name}</code></a>`), html);
  }

  overview() {
    const entries = [
      ["Commands", "commands/index.html", "Every command and option, as the program itself explains them."],
      ["Recipes", "recipes/index.html", "The text of every coat that comes along."],
      ["The grammar of recipes", "docs/recipes.html", "Stages, masks, maps, layers, materials."],
      ["Models", "models/index.html", "The equations, parameters and linear theory of every reaction system that comes along."],
      ["The language of models", "docs/models.html", "What a file promises, what formulas may say, and how models are tested."],
      ["Headers", "headers/index.html", "The headers of the library, with their comments."],
      ["Formats", "docs/formats.html", "What is read and written, and what each format can hold."],
      ["The studio's messages", "docs/studio-protocol.html", "What the page and its engines say to each other."],
      ["The method", "docs/method.html", "What is solved, how, and how well."],
    ];
    const items = entries.map(([title, to, text]) => `<li><a href="${to}">${title}</a><p>${text}</p></li>`).join("\n");
    this.page("reference.html", "Reference", "Commands, recipes, models and headers of Pelage", `<h1>Reference</h1><ul class="entries">${items}</ul>`);
  }

  index(folder, lead, [to, text], entries) {
    const path = `${folder}/index.html`;
    const rows = entries.map(([name, meaning]) => [`<a href="${name}.html"><code>${name}</code></a>`, escape(meaning)]);
    this.page(path, capital(folder), lead, `<h1>${capital(folder)}</h1><p class="lead">${lead}</p>
<p><a href="${link(path, to)}">${text}</a>; <a href="${link(path, "gallery.html")}#${folder}">all as pictures</a>.</p>${table(["name", "what it is"], rows)}`);
  }

  /** The parts of what `pelage models NAME` prints, by their headings. */
  printed(name) {
    const parts = this.run("models", name).split(/\n\n(?=[A-Z])/);
    return Object.fromEntries(parts.map((part) => [part.split(/[\n(]/)[0].trim(), part.slice(part.indexOf("\n") + 1).replace(/^ {2}/gm, "")]));
  }

  model(model) {
    const path = `models/${model.name}.html`;
    const printed = this.printed(model.name);
    const family = this.models.filter(({ name }) => name === model.name || name.startsWith(`${model.name}:`));
    const cards = family.map(({ name, title }) => card(path, { kind: "models", name, live: liveModel(name), caption: title }));
    const range = ({ min, max }) => (min === null && max === null ? "" : `${min ?? "…"} to ${max ?? "…"}`);
    const rows = model.parameters.map((p) => [`<code>${escape(p.name)}</code>`, p.value, range(p), escape(p.unit), escape(p.help)]);
    const body = `<h1>${escape(model.title)}</h1>
<p class="lead">${escape(model.summary)}</p>
<p>After ${escape(model.cite)}.</p>${code(`pelage grow cow.obj --model ${model.name} -o cow.glb`)}
<p>A click grows a variant in the studio:</p>
<ul class="cards small">${cards.join("\n")}</ul>
<h2 id="equations">Equations</h2>${code(printed.Equations)}
<h2 id="parameters">Parameters</h2>${table(["name", "value", "range", "unit", "meaning"], rows)}
<h2 id="analysis">What linear theory says</h2><p>Lengths and times are in the model's own units.</p>${code(printed.Analysis)}
<p>What these say, and how they are tested: <a href="${link(path, "docs/models.html")}">models</a>.</p>`;
    this.page(path, model.title, model.summary, body);
  }

  recipe({ name, summary, text }) {
    const path = `recipes/${name}.html`;
    const body = `<h1>${escape(name)}</h1>
<p class="lead">${escape(summary)}</p>
<ul class="cards one">${card(path, { kind: "recipes", name, live: liveRecipe(text), caption: "" })}</ul>
<p class="actions"><a class="primary" href="${link(path, liveRecipe(text))}">Grow it in the studio</a></p>
<h2 id="command">On a mesh of yours</h2>${code(`pelage grow cow.obj --recipe ${name} -o cow.glb --picture cow.png`)}
<h2 id="text">The recipe</h2><p>What the words mean: <a href="${link(path, "docs/recipes.html")}">recipes</a>. To change it, keep it as a file and grow that: <code>pelage recipes ${name} &gt; mine.toml</code></p>${code(text)}`;
    this.page(path, name, summary, body);
  }

  /** A header as text and declarations in turn: comments are prose, the rest is code. */
  header(name) {
    const text = readFileSync(join(this.root, "include/pelage", name), "utf8").replace(/^(#pragma|#include|namespace pelage|}  \/\/ namespace).*\n/gm, "");
    const [head, ...blocks] = this.split(text);
    const title = head.text.split("\n\n")[0].replace(/\n/g, " ");
    return { title, body: [head, ...blocks].map(({ kind, text }) => (kind === "prose" ? prose(text) : code(text))).join("\n") };
  }

  split(text) {
    const blocks = [];
    for (const line of text.split("\n")) {
      const comment = /^\s*\/\/\/? ?(.*)$/.exec(line);
      const kind = comment ? "prose" : "code";
      if (blocks.at(-1)?.kind !== kind) blocks.push({ kind, text: "" });
      blocks.at(-1).text += `${comment ? comment[1] : line}\n`;
    }
    return blocks.map(({ kind, text: all }) => ({ kind, text: kind === "code" ? all.replace(/^\n+|\s+$/g, "") : all })).filter(({ text: all }) => all);
  }

  headerIndex() {
    const rows = this.headers.map(({ name, title }) => [`<a href="${name}.html"><code>pelage/${name}</code></a>`, prose(title)]);
    this.page("headers/index.html", "Headers", "The headers of the library", `<h1>Headers</h1>
<p class="lead">The library needs C++20 and the standard library's headers only. Each part begins with a function that does all at once, and has an object for those who want to look in between.</p>
<p>How to link it, and examples: <a href="../docs/readme.html#from-c">overview</a>.</p>${table(["header", "what it is for"], rows)}`);
  }
}

/** Paragraphs, and what is set in from the left as code. */
function prose(text) {
  const paragraphs = text.split(/\n{2,}/).filter((one) => one.trim());
  return paragraphs.map((one) => (/^ {2}/.test(one) ? code(one.replace(/^ {2}/gm, "")) : `<p>${escape(one.trim())}</p>`)).join("");
}
