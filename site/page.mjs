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
const noEngine =
  '<p class="notice">This copy of the site was made without the engine for browsers: the studio in it does not grow' +
  ' anything. <a href="docs/site.html">How to make one that does</a>.</p>';

const entities = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
export const escape = (text) => String(text).replace(/[&<>"]/g, (c) => entities[c]);

/** Comments stand back in code of any kind: `# ...` and `// ...` after a blank. */
export function code(text) {
  const comments = /(^|\s)((?:#|\/\/\/?(?:&lt;)?) .*)$/gm;
  const html = escape(text.replace(/\n+$/, "")).replace(comments, '$1<span class="comment">$2</span>');
  return `<pre tabindex="0"><code>${html}</code></pre>`;
}

/** Cells are HTML. Wide tables scroll by themselves; keys reach them. */
export function table(head, rows) {
  const line = (cells, tag) => `<tr>${cells.map((cell) => `<${tag}>${cell}</${tag.split(" ")[0]}>`).join("")}</tr>`;
  const body = rows.map((cells) => line(cells, "td")).join("\n");
  return `<div class="table" tabindex="0"><table><thead>${line(head, 'th scope="col"')}</thead><tbody>${body}</tbody></table></div>`;
}

/** From one page to another file of the site, relative, so that the site works in any folder of any server. */
export function link(from, to) {
  const [file, anchor] = to.split("#");
  const path = file === from && anchor ? "" : posix.relative(posix.dirname(from), file);
  return anchor ? `${path}#${anchor}` : path;
}

function anchor(from, [text, to], current = from) {
  return `<a href="${link(from, to)}"${current === to ? ' aria-current="page"' : ""}>${escape(text)}</a>`;
}

function sideOf(path, groups) {
  const list = (links) => `<ul>${links.map((one) => `<li>${anchor(path, one)}</li>`).join("")}</ul>`;
  const inner = groups.map(([title, links]) => `<h2>${escape(title)}</h2>${list(links)}`).join("\n");
  return `<nav class="side" id="pages" aria-label="Pages">${inner}</nav>`;
}

/** The headings of the second level, beside long texts. */
function headingsOf(body) {
  const found = [...body.matchAll(/<h2 id="([^"]+)">(.*?)<\/h2>/g)];
  const entries = found.map(([, id, html]) => `<li><a href="#${id}">${html.replace(/<\/?a[^>]*>/g, "")}</a></li>`);
  if (entries.length < 3) return "";
  return `<nav class="toc" aria-label="On this page"><p>On this page</p><ul>${entries.join("")}</ul></nav>`;
}

function mainWithSide(path, body, side) {
  const toPages = '<p class="to-pages"><a href="#pages">All pages</a></p>';
  return `<div class="frame">${sideOf(path, side)}<main id="content">${toPages}${body}</main>${headingsOf(body)}</div>`;
}

export class Site {
  /** `engine`: whether the studio of this site has one. */
  constructor(folder, engine) {
    this.folder = folder;
    this.notice = engine ? "" : noEngine;
  }

  write(path, bytes) {
    const target = join(this.folder, path);
    mkdirSync(dirname(target), { recursive: true });
    writeFileSync(target, bytes);
  }

  /** `part`: where the page belongs to; `side`: groups of links beside the text; `kind`: the class of the page. */
  page(path, { title, description, body, part = path, side = null, kind = "text" }) {
    const to = (file) => link(path, file);
    const html = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="description" content="${escape(description)}">
<title>${escape(title)}${path === "index.html" ? "" : " · Pelage"}</title>
<link rel="icon" type="image/svg+xml" href="${to("mark.svg")}">
<link rel="stylesheet" href="${to("style.css")}">
</head>
<body class="${kind}">
<a class="skip" href="#content">To the text</a>
<header class="top">
<a class="brand" href="${to("index.html")}"><img src="${to("mark.svg")}" alt="" width="28" height="28">Pelage</a>
<nav aria-label="Parts">${parts.map((one) => anchor(path, one, part)).join("")}</nav>
</header>
${side ? mainWithSide(path, body, side) : `<main id="content">${body}</main>`}
<footer><p>Pelage grows coats on surfaces. <a href="${to("source/LICENSE.html")}">MIT licence</a>.
These pages ask for nothing from anywhere else.</p></footer>
</body>
</html>
`;
    this.write(path, html);
  }
}
