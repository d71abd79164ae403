// What the program says of itself, page by page: commands, models, recipes; and the headers of the library.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { card, liveModel, liveRecipe } from "./gallery.mjs";
import { code, escape, link, table } from "./page.mjs";

const capital = (name) => name[0].toUpperCase() + name.slice(1);
const heading = (title) => `<h2 id="${title.toLowerCase().replace(/[^a-z]+/g, "-")}">${escape(title)}</h2>`;

/** Paragraphs, and what is set in from the left as code. */
function prose(text) {
  const paragraphs = text.split(/\n{2,}/).filter((one) => one.trim());
  return paragraphs.map((one) => (/^ {2}/.test(one) ? code(one.replace(/^ {2}/gm, "")) : `<p>${escape(one.trim())}</p>`)).join("");
}

/** Lines of names, each with its meaning two blanks or more to the right and on the lines below. */
function options(lines) {
  const entries = [];
  for (const line of lines) {
    const [, name, meaning = ""] = /^ {2}(\S.*?)(?: {2,}(.*))?$/.exec(line) ?? [];
    if (name) entries.push([name, meaning]);
    else entries.at(-1)[1] = `${entries.at(-1)[1]} ${line.trim()}`.trim();
  }
  const items = entries.map(([name, meaning]) => `<dt><code>${escape(name)}</code></dt><dd>${escape(meaning)}</dd>`);
  return `<dl class="options">${items.join("\n")}</dl>`;
}

function section(title, text) {
  if (title === "Examples" || title === "Usage") return heading(title) + code(text.replace(/^ +/gm, ""));
  const body = text.startsWith("  ") ? options(text.split("\n")) : prose(text);
  return title ? heading(title) + body : body;
}

/** What `pelage help COMMAND` prints: prose, and sections that begin with a line such as "Options:". */
export function helpBody(text) {
  const sections = [["", ""]];
  for (const line of text.trimEnd().split("\n")) {
    const [, title, rest = ""] = /^([A-Z][A-Za-z ,-]*):(?: (.*))?$/.exec(line) ?? [];
    if (title) sections.push([title, rest && `${rest}\n`]);
    else sections.at(-1)[1] += `${line}\n`;
  }
  return sections.filter(([, lines]) => lines.trim()).map(([title, lines]) => section(title, lines.trimEnd())).join("\n");
}

/** A header as blocks of comments, which are prose, and of code. */
function blocksOf(text) {
  const blocks = [];
  for (const line of text.split("\n")) {
    const comment = /^\s*\/\/\/? ?(.*)$/.exec(line);
    if (blocks.at(-1)?.comment !== !!comment) blocks.push({ comment: !!comment, text: "" });
    blocks.at(-1).text += `${comment ? comment[1] : line}\n`;
  }
  return blocks.filter((one) => one.text.trim());
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
    this.baseModels = this.models.filter(({ name }) => !name.includes(":"));
    this.recipes = JSON.parse(this.run("recipes", "--json"));
    for (const recipe of this.recipes) recipe.text = this.run("recipes", recipe.name);
    this.figures = JSON.parse(this.run("figures", "--json")).figures;
    const headers = readdirSync(join(root, "include/pelage")).filter((name) => name.endsWith(".h"));
    this.headers = headers.map((name) => this.header(name));
  }

  /** The parts of the reference, and the pages of the one that `path` belongs to. */
  side(path) {
    const all = { commands: this.commands, recipes: this.recipes, models: this.baseModels, headers: this.headers };
    const here = path.split("/")[0];
    const own = (all[here] ?? []).map(({ name }) => [name, `${here}/${name}.html`]);
    const indices = Object.keys(all).map((name) => [capital(name), `${name}/index.html`]);
    const overview = ["Reference", [["Overview", "reference.html"], ...indices]];
    return own.length ? [overview, [capital(here), own]] : [overview];
  }

  page(path, title, description, body) {
    this.site.page(path, { title, description, body, part: "reference.html", side: this.side(path) });
  }

  pages() {
    this.overview();
    this.commandIndex();
    for (const { name, summary } of this.commands) {
      this.page(`commands/${name}.html`, `pelage ${name}`, summary, `<h1>pelage ${name}</h1>${helpBody(this.run("help", name))}`);
    }
    const recipes = this.recipes.map(({ name, summary }) => [name, summary]);
    this.index("recipes", "Coats with all their stages and colours.", ["docs/recipes.html", "How to write one"], recipes);
    for (const recipe of this.recipes) this.recipe(recipe);
    const models = this.baseModels.map(({ name, title, summary }) => [name, `${title}. ${summary}`]);
    this.index("models", "Reaction systems.", ["docs/models.html", "What they promise, and how to write one"], models);
    for (const model of this.baseModels) this.model(model);
    this.headerIndex();
    for (const { name, about, body } of this.headers) {
      this.page(`headers/${name}.html`, `pelage/${name}`, about, `<h1>pelage/${name}</h1>${body}`);
    }
  }

  overview() {
    const entries = [
      ["Commands", "commands/index.html", "Every command and option, as the program itself explains them."],
      ["Recipes", "recipes/index.html", "The text of every coat that comes along."],
      ["The grammar of recipes", "docs/recipes.html", "Stages, masks, maps, layers, materials."],
      ["Models", "models/index.html", "Equations, parameters and linear theory of every reaction system that comes along."],
      ["The language of models", "docs/models.html", "What a file promises, what formulas may say, and how models are tested."],
      ["Headers", "headers/index.html", "The C++ library, with the comments of its headers."],
      ["Formats", "docs/formats.html", "What is read and written, and what each format can hold."],
      ["The studio's messages", "docs/studio-protocol.html", "What the page and its engines say to each other."],
      ["The method", "docs/method.html", "What is solved, how, and how well."],
    ];
    const items = entries.map(([title, to, text]) => `<li><a href="${to}">${title}</a><p>${text}</p></li>`);
    const body = `<h1>Reference</h1><ul class="entries">${items.join("\n")}</ul>`;
    this.page("reference.html", "Reference", "Commands, recipes, models and headers of Pelage", body);
  }

  commandIndex() {
    const linked = (html, { name }) => html.replace(`<dt><code>${name}</code>`, `<dt><a href="${name}.html"><code>${name}</code></a>`);
    const body = `<h1>Commands</h1>${this.commands.reduce(linked, helpBody(this.run("--help")))}`;
    this.page("commands/index.html", "Commands", "All commands of pelage", body);
  }

  index(folder, lead, [to, text], entries) {
    const path = `${folder}/index.html`;
    const rows = entries.map(([name, meaning]) => [`<a href="${name}.html"><code>${name}</code></a>`, escape(meaning)]);
    const body = `<h1>${capital(folder)}</h1><p class="lead">${lead}</p>
<p><a href="${link(path, to)}">${text}</a>; <a href="${link(path, `gallery.html#${folder}`)}">all as pictures</a>.</p>
${table(["name", "what it is"], rows)}`;
    this.page(path, capital(folder), lead, body);
  }

  recipe({ name, summary, text }) {
    const path = `recipes/${name}.html`;
    const live = liveRecipe(text);
    const body = `<h1>${escape(name)}</h1><p class="lead">${escape(summary)}</p>
<ul class="cards one">${card(path, { kind: "recipes", name, live })}</ul>
<p class="actions"><a class="primary" href="${link(path, live)}">Grow it in the studio</a></p>
<h2 id="command">On a mesh of yours</h2>${code(`pelage grow cow.obj --recipe ${name} -o cow.glb --picture cow.png`)}
<h2 id="text">The recipe</h2><p>What the words mean: <a href="${link(path, "docs/recipes.html")}">recipes</a>.
To change it, keep it as a file and grow that: <code>pelage recipes ${name} &gt; mine.toml</code></p>${code(text)}`;
    this.page(path, name, summary, body);
  }

  /** The parts of what `pelage models NAME` prints, by their headings. */
  printed(name) {
    const parts = this.run("models", name).split(/\n\n(?=[A-Z])/);
    const text = (part) => part.slice(part.indexOf("\n") + 1).replace(/^ {2}/gm, "");
    return Object.fromEntries(parts.map((part) => [part.split(/[\n(]/)[0].trim(), text(part)]));
  }

  model({ name: base, title, summary, cite, parameters }) {
    const path = `models/${base}.html`;
    const printed = this.printed(base);
    const family = this.models.filter(({ name }) => name.split(":")[0] === base);
    const cards = family.map((one) => card(path, { kind: "models", name: one.name, live: liveModel(one.name), caption: one.title }));
    const range = ({ min, max }) => (min === null && max === null ? "" : `${min ?? "…"} to ${max ?? "…"}`);
    const rows = parameters.map((p) => [`<code>${escape(p.name)}</code>`, p.value, range(p), escape(p.unit), escape(p.help)]);
    const body = `<h1>${escape(title)}</h1><p class="lead">${escape(summary)}</p><p>After ${escape(cite)}.</p>
${code(`pelage grow cow.obj --model ${base} -o cow.glb`)}
<p>A click grows a variant in the studio:</p><ul class="cards small">${cards.join("\n")}</ul>
${heading("Equations")}${code(printed.Equations)}
${heading("Parameters")}${table(["name", "value", "range", "unit", "meaning"], rows)}
${heading("What linear theory says")}<p>Lengths and times are in the model's own units.</p>${code(printed.Analysis)}
<p>What these say, and how they are tested: <a href="${link(path, "docs/models.html")}">models</a>.</p>`;
    this.page(path, title, summary, body);
  }

  header(name) {
    const frame = /^(#pragma|#include|namespace pelage|}  \/\/ namespace).*\n/gm;
    const blocks = blocksOf(readFileSync(join(this.root, "include/pelage", name), "utf8").replace(frame, ""));
    const html = ({ comment, text }) => (comment ? prose(text) : code(text.replace(/^\n+/, "")));
    return { name, about: blocks[0].text.split("\n\n")[0].replace(/\n/g, " "), body: blocks.map(html).join("\n") };
  }

  headerIndex() {
    const rows = this.headers.map(({ name, about }) => [`<a href="${name}.html"><code>pelage/${name}</code></a>`, escape(about)]);
    const body = `<h1>Headers</h1><p class="lead">The library's headers need C++20 and the standard library only. Each part begins
with a function that does all at once, and has an object for those who want to look in between.</p>
<p>How to link it, and examples: <a href="../docs/readme.html#from-c">overview</a>.</p>${table(["header", "what it is for"], rows)}`;
    this.page("headers/index.html", "Headers", "The headers of the C++ library", body);
  }
}
