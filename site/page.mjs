// What all pages have in common: the frame around their text, and links between them.
import { mkdirSync, writeFileSync } from "node:fs";
import { dirname, join, posix } from "node:path";

const parts = [
  ["Studio", "studio/index.html"],
  ["Gallery", "gallery.html"],
  ["Figures", "figures.html"],
  ["Guides", "guides.html"],
  ["Reference", "reference.html"],
];

export const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);

/** Comments stand back in code of any kind here: `# ...` and `// ...` after a blank. */
export const code = (text) =>
  `<pre tabindex="0"><code>${escape(text.replace(/\n+$/, "")).replace(/(^|\s)((?:#|\/\/\/?(?:&lt;)?) .*)$/gm, '$1<span class="comment">$2</span>')}</code></pre>`;

/** Wide tables scroll by themselves; keys reach them. */
export const table = (head, rows) =>
  `<div class="table" tabindex="0"><table><thead><tr>${head.map((cell) => `<th scope="col">${cell}</th>`).join("")}</tr></thead>` +
  `<tbody>${rows.map((row) => `<tr>${row.map((cell) => `<td>${cell}</td>`).join("")}</tr>`).join("\n")}</tbody></table></div>`;

/** From one page to another file of the site, relative, so that the site works in any folder of any server. */
export function link(from, to) {
  const [file, anchor] = to.split("#");
  const path = file === from && anchor ? "" : posix.relative(posix.dirname(from), file);
  return anchor ? `${path}#${anchor}` : path;
}

const anchor = (from, [text, to], current = from) => `<a href="${link(from, to)}"${current === to ? ' aria-current="page"' : ""}>${escape(text)}</a>`;
const list = (from, links) => `<ul>${links.map((one) => `<li>${anchor(from, one)}</li>`).join("")}</ul>`;

function sideOf(path, groups) {
  const inner = groups.map(([title, links]) => `<h2>${escape(title)}</h2>${list(path, links)}`).join("\n");
  return `<nav class="side" id="pages" aria-label="Pages">${inner}</nav>`;
}

/** The headings of the second level, beside long texts. */
function headingsOf(path, body) {
  const found = [...body.matchAll(/<h2 id="([^"]+)">(.*?)<\/h2>/g)].map(([, id, html]) => `<li><a href="#${id}">${html.replace(/<\/?a[^>]*>/g, "")}</a></li>`);
  return found.length < 3 ? "" : `<nav class="toc" aria-label="On this page"><p>On this page</p><ul>${found.join("")}</ul></nav>`;
}

const mainWithSide = (path, body, side) =>
  `<div class="frame">${sideOf(path, side)}<main id="content"><p class="to-pages"><a href="#pages">All pages</a></p>${body}</main>${headingsOf(path, body)}</div>`;

export class Site {
  /** `engine`: whether the studio of this site has one. */
  constructor(folder, engine) {
    this.folder = folder;
    this.notice = engine ? "" : '<p class="notice">This copy of the site was made without the engine for browsers: the studio in it does not grow anything. <a href="docs/site.html">How to make one that does</a>.</p>';
  }

  write(path, bytes) {
    const target = join(this.folder, path);
    mkdirSync(dirname(target), { recursive: true });
    writeFileSync(target, bytes);
  }

  /** `part`: where the page belongs to; `side`: groups of links beside the text; `kind`: the class of the page. */
  page(path, { title, description = "", body, part = path, side = null, kind = "text" }) {
    const top = parts.map((one) => anchor(path, one, part)).join("");
    const html = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="description" content="${escape(description || title)}">
<title>${escape(title)}${path === "index.html" ? "" : " · Pelage"}</title>
<link rel="icon" type="image/svg+xml" href="${link(path, "mark.svg")}">
<link rel="stylesheet" href="${link(path, "style.css")}">
</head>
<body class="${kind}">
<a class="skip" href="#content">To the text</a>
<header class="top"><a class="brand" href="${link(path, "index.html")}"><img src="${link(path, "mark.svg")}" alt="" width="28" height="28">Pelage</a><nav aria-label="Parts">${top}</nav></header>
${side ? mainWithSide(path, body, side) : `<main id="content">${body}</main>`}
<footer><p>Pelage grows coats on surfaces. ${anchor(path, ["MIT licence", "source/LICENSE.html"])}. These pages ask for nothing from anywhere else.</p></footer>
</body>
</html>
`;
    this.write(path, html);
  }
}
