// The check of the finished site (SITE) finds what is wrong with a page, by name, and nothing in the site as it is.
import assert from "node:assert/strict";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { faults, sizeLines } from "../../site/check.mjs";
import { liveModel } from "../../site/gallery.mjs";
import { slug } from "../../site/markdown.mjs";
import { helpBody } from "../../site/reference.mjs";

const site = process.env.SITE;
const page = (body) => `<!doctype html><html lang="en"><head><title>x</title></head><body>${body}</body></html>`;

/** What is found in a site of a front page and one other. */
function found(body, other = page("<h1 id='there'>other</h1>".replaceAll("'", '"'))) {
  const folder = mkdtempSync(join(tmpdir(), "site-"));
  mkdirSync(join(folder, "docs"));
  writeFileSync(join(folder, "index.html"), page(body));
  writeFileSync(join(folder, "docs/other.html"), other);
  const result = faults(folder);
  rmSync(folder, { recursive: true });
  return result;
}

test("the site as it is has no faults", () => assert.deepEqual(faults(site), []));

test("the studio asks for 3 MB at most before the first mesh", () => {
  const line = sizeLines(site).find((one) => one.startsWith("studio"));
  assert.ok(Number(/gzipped (\d+) kB/.exec(line)[1]) <= 3000, line);
});

test("a link that is broken in a page of the site is named", () => {
  const copy = mkdtempSync(join(tmpdir(), "site-"));
  cpSync(site, copy, { recursive: true });
  const path = join(copy, "docs/recipes.html");
  writeFileSync(path, readFileSync(path, "utf8").replace('href="models.html"', 'href="modles.html"'));
  const [only, ...rest] = faults(copy);
  assert.equal(only, "docs/recipes.html: modles.html leads nowhere");
  assert.deepEqual(rest, []);
  rmSync(copy, { recursive: true });
});

const good = '<a href="docs/other.html#there">x</a>';
const nowhere = "docs/other.html#nowhere";
const script = "https://example.org/x.js";
for (const [what, body, expected] of [
  ["all right", `${good}<a href="https://example.org">x</a><img src="data:," alt="">`, []],
  ["a missing page", `${good}<a href="docs/none.html">x</a>`, ["index.html: docs/none.html leads nowhere"]],
  ["a folder", `${good}<a href="docs">x</a>`, ["index.html: docs leads nowhere"]],
  ["a missing anchor", `${good}<a href="${nowhere}">x</a>`, [`index.html: ${nowhere} names a place that the page does not have`]],
  ["an absolute path", `${good}<a href="/docs/other.html">x</a>`, ["index.html: /docs/other.html is not relative"]],
  ["a way out", `${good}<a href="../x.html">x</a>`, ["index.html: ../x.html leads out of the site"]],
  ["a missing picture", `${good}<img src="x.png" alt="">`, ["index.html: x.png leads nowhere"]],
  ["a picture without words", `${good}<img src="data:,">`, ['index.html: <img src="data:,"> has no words in its place']],
  ["a script from elsewhere", `${good}<script src="${script}"></script>`, [`index.html: ${script} is loaded from elsewhere`]],
  ["a page by itself", "", ["docs/other.html: no page leads there"]],
]) {
  test(`the check: ${what}`, () => assert.deepEqual(found(body), expected));
}

test("anchors are those of the hosts of repositories", () => {
  assert.equal(slug("A blow-up, and its cure"), "a-blow-up-and-its-cure");
  assert.equal(slug("`--fair` & co."), "--fair--co");
});

test("a help text becomes lists, its examples stay lines", () => {
  const printed = `Do it

Usage: pelage do [OPTIONS]

Options:
  -o,--output FILE ...        File for it; may be
                              given twice
  --long-name SOMETHING LONG IN IT
                              Takes <much>

Examples:
  pelage do it
`;
  const html = helpBody(printed);
  assert.match(html, /<p>Do it<\/p>/);
  assert.match(html, /<dt><code>-o,--output FILE ...<\/code><\/dt><dd>File for it; may be given twice<\/dd>/);
  assert.match(html, /<dt><code>--long-name SOMETHING LONG IN IT<\/code><\/dt><dd>Takes &lt;much&gt;<\/dd>/);
  assert.match(html, /<code>pelage do it<\/code>/);
});

test("links of the gallery are what the studio reads, and models in it what it grows itself", async () => {
  const { build } = createRequire(new URL("../../studio/package.json", import.meta.url))("esbuild");
  const contents = 'export { decodeLink } from "./link"; export { recipeOfModel } from "./panels/coats";';
  const resolveDir = fileURLToPath(new URL("../../studio/src", import.meta.url));
  const { outputFiles } = await build({ stdin: { contents, resolveDir, loader: "ts" }, bundle: true, write: false, format: "esm" });
  const studio = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
  const coat = await studio.decodeLink(liveModel("gray-scott:spots").split("#s=")[1]);
  assert.deepEqual(coat, { recipe: studio.recipeOfModel("gray-scott:spots"), shape: "builtin:animal", view: null });
});
