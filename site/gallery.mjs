// Pages of pictures: all recipes and models, each live on a click, the figures of the papers, and the front page.
import { cpSync, existsSync } from "node:fs";
import { join } from "node:path";
import { deflateRawSync } from "node:zlib";
import { sizeOf } from "./markdown.mjs";
import { code, escape, link } from "./page.mjs";

/** The studio with a coat in it: its links are described in docs/studio.md. */
export function liveRecipe(recipe) {
  const shared = JSON.stringify({ v: 1, recipe, shape: "builtin:animal", view: null });
  return `studio/index.html#s=${deflateRawSync(shared, { level: 9 }).toString("base64url")}`;
}
export const liveModel = (name) => liveRecipe(`name = "${name}"\n\n[stage]\nmodel = "${name}"\nsize = 0.05\n`);

/** The pictures carry their names below them; only what is above is shown (style.css). */
export function card(path, { kind, name, live, caption = "", more = "" }) {
  const src = link(path, `studio/gallery/${kind}/${name.replace(":", "-")}-animal.png`);
  return `<li class="card"><a href="${link(path, live)}">
<img src="${src}" alt="${escape(name)} on the animal" width="224" height="224" loading="lazy">
<span class="name">${escape(name).replace(":", ":<wbr>")}</span><span class="live">Grow it</span></a>
${caption && `<p>${escape(caption)}</p>`}${more}</li>`;
}

export function galleryPage(site, { recipes, models }) {
  const path = "gallery.html";
  const recipeCards = recipes.map(({ name, summary, text }) => {
    const more = `<a href="recipes/${name}.html">The recipe</a>`;
    return card(path, { kind: "recipes", name, live: liveRecipe(text), caption: summary, more });
  });
  const modelCards = models.map(({ name, title }) => {
    const more = `<a href="models/${name.split(":")[0]}.html">The model</a>`;
    return card(path, { kind: "models", name, live: liveModel(name), caption: title, more });
  });
  const body = `<h1>Gallery</h1>
<p class="lead">Every recipe and every model, grown on the same animal. A click on a picture grows that coat in the studio,
where you can change it.</p>${site.notice}
<h2 id="recipes">Recipes</h2><p>Coats with all their stages and colours. <a href="docs/recipes.html">How to write one</a>.</p>
<ul class="cards">${recipeCards.join("\n")}</ul>
<h2 id="models">Models</h2><p>Reaction systems and their variants, as their own look shows them.
<a href="docs/models.html">What grows where</a>.</p>
<ul class="cards small">${modelCards.join("\n")}</ul>`;
  const description = "Every recipe and every model of Pelage, live on a click";
  site.page(path, { title: "Gallery", description, body, kind: "wide" });
}

/** The page of the recipe or the model that a command names, if it does. */
function subject(command) {
  const [, option, name] = /--(recipe|model) ([a-z0-9-]+)/.exec(command) ?? [];
  return option ? `<a href="${option}s/${name}.html">${name}</a>` : "";
}

function panel(root, { caption, picture, commands }) {
  const kept = `figures/${picture.replace(/png$/, "webp")}`;
  const image = existsSync(join(root, "site", kept))
    ? `<img src="${kept}" alt="${escape(caption)}" ${sizeOf(join(root, "site", kept))} loading="lazy">`
    : '<p class="none">No picture of this is kept; the command makes it.</p>';
  const lines = commands.map((one) => `pelage ${one}`).join("\n");
  return `<figure>${image}<figcaption>${escape(caption)} ${subject(lines)}</figcaption>${code(lines)}</figure>`;
}

function figureSection(root, { figure, shows, verdict, said, panels }) {
  return `<section class="figure" id="${figure}">
<h3>${figure} <span class="verdict ${verdict.replace(" ", "-")}">${verdict}</span></h3>
<p><strong>The paper:</strong> ${escape(shows)}</p><p><strong>Here:</strong> ${escape(said)}</p>
<div class="panels">${panels.map((one) => panel(root, one)).join("\n")}</div></section>`;
}

export function figuresPage(root, site, { figures }) {
  const papers = [...new Set(figures.map(({ paper }) => paper))];
  const sections = papers.map((paper, i) => {
    const own = figures.filter((one) => one.paper === paper).map((one) => figureSection(root, one));
    return `<h2 id="paper-${i + 1}">${escape(paper)}</h2>${own.join("\n")}`;
  });
  const body = `<h1>The papers, figure by figure</h1>
<p class="lead">Every figure of the papers that this program follows, with the commands that make it again.
<code>pelage figures -o figures</code> makes all of them in some minutes.</p>
<p><span class="verdict made">made</span> with the paper's parameters;
<span class="verdict made-otherwise">made otherwise</span> what the figure is about, by other means or on another shape;
<span class="verdict misprint">misprint</span> what is printed cannot make the figure; what can is beside it.
<a href="docs/figures.html">What came out, in numbers</a>.</p>
${sections.join("\n")}`;
  cpSync(join(root, "site/figures"), join(site.folder, "figures"), { recursive: true });
  const description = "Figures of papers on reaction-diffusion textures, made again";
  site.page("figures.html", { title: "The papers, figure by figure", description, body, kind: "wide" });
}

const shownFirst = ["leopard", "zebra", "reticulated-giraffe", "embers", "crocodile", "sea-glass", "lionfish", "agate"];

export function frontPage(root, site, { recipes, models }) {
  const size = (name) => sizeOf(join(root, "site", name));
  for (const name of ["front-light.webp", "front-dark.webp", "studio.webp"]) cpSync(join(root, "site", name), join(site.folder, name));
  const shown = shownFirst.map((wanted) => recipes.find(({ name }) => name === wanted));
  const cards = shown.map(({ name, text }) => card("index.html", { kind: "recipes", name, live: liveRecipe(text) }));
  const install = `sh tools/demo.sh
build/release/bin/pelage grow cow.obj --recipe leopard --size 0.05 -o cow.glb --picture cow.png
build/release/bin/pelage studio`;
  const body = `<section class="hero"><h1>Coats that grow on surfaces</h1>
<p class="lead">Pelage takes a triangle mesh and grows spots, stripes and mazes on it by reaction and diffusion, as Turing
thought animals do. Nothing is unwrapped, painted or projected: the pattern knows neither seams nor texture coordinates.</p>
<p class="actions"><a class="primary" href="studio/index.html">Open the studio</a><a href="gallery.html">See the gallery</a></p>
${site.notice}
<picture><source srcset="front-dark.webp" media="(prefers-color-scheme: dark)">
<img src="front-light.webp" ${size("front-light.webp")} alt="Three cubs with the coats of a gilded zebra, a leopard and a giraffe;
beside them balls, a glowing ring and a knot with patterns of their own"></picture></section>
<section><h2 id="coats">Pick a coat, watch it grow</h2>
<ul class="cards">${cards.join("\n")}</ul>
<p><a href="gallery.html">All ${recipes.length} recipes and ${models.length} models</a></p></section>
<section class="beside"><div><h2 id="studio">The studio</h2>
<p>A page in the browser: choose a shape and a coat, drop in a mesh of yours, turn the sliders, paint while it grows, and take
the result away as GLB, PNG, STL or a link. It runs on your machine; nothing is sent anywhere.</p>
<p><a href="docs/studio.html">How it works</a></p></div>
<a href="studio/index.html"><img src="studio.webp" ${size("studio.webp")} loading="lazy"
alt="The studio: a leopard's coat growing, coats to the left, parameters to the right"></a></section>
<section class="facts">
<div><h3>True sizes</h3><p>The spacing of a pattern is a length, such as 4 mm. A coarse and a fine mesh of the same animal get
the same spots.</p></div>
<div><h3>The same again</h3><p>The same input gives the same file, bit for bit, on one thread or many. Files say what made
them.</p></div>
<div><h3>Text all the way</h3><p>Models and recipes are small text files of formulas.
<a href="docs/guides/model.html">Write a model</a> in ten minutes.</p></div>
<div><h3>For what comes after</h3><p>Meshes with colours, baked textures, films, lines to cut, solids to print:
<a href="docs/formats.html">formats</a>.</p></div></section>
<section><h2 id="install">Install</h2><p>On Debian 12, in a checkout of the repository. The first command installs what is
missing, builds the program and grows a coat.</p>
${code(install)}
<p>Then: <a href="docs/readme.html">the overview</a>, <a href="guides.html">guides</a>,
<a href="commands/index.html">all commands</a>, <a href="headers/index.html">the C++ library</a>,
<a href="figures.html">the papers' figures made again</a>.</p></section>`;
  const description = "Grows reaction-diffusion coats directly on surfaces";
  site.page("index.html", { title: "Pelage: coats that grow on surfaces", description, body, kind: "front" });
}
