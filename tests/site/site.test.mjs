// The built site (SITE) in a browser that reaches nothing but one folder of one file server: every page, in both of its
// colours, wide and narrow. CHROMIUM: the browser; SHOTS: folder for pictures of the kinds of pages, if wanted;
// SITE_PAGES=all: axe-core on every page, also on all those that one template fills.
import assert from "node:assert/strict";
import { createReadStream, existsSync, readdirSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { after, before, test } from "node:test";
import { axeSource, shot, startBrowser, waitForSteps } from "../studio/harness.mjs";

const folder = process.env.SITE;
const prefix = "/in/a/folder/";
const types = {
  ".html": "text/html; charset=utf-8",
  ".css": "text/css",
  ".js": "text/javascript",
  ".svg": "image/svg+xml",
  ".png": "image/png",
  ".webp": "image/webp",
  ".wasm": "application/wasm",
};
const pages = readdirSync(folder, { recursive: true }).filter((name) => name.endsWith(".html") && !name.startsWith("studio/"));
const kinds = [
  ...["index.html", "gallery.html", "figures.html", "guides.html", "docs/models.html", "commands/grow.html"],
  ...["models/gray-scott.html", "recipes/leopard.html", "headers/grow.h.html", "source/examples/outside.html"],
];

/** Of pages that one template fills every sixteenth is enough for axe-core, which takes most of the time. */
const generated = pages.filter((name) => /^(commands|models|recipes|headers|source)\//.test(name)).sort();
const skipped = new Set(process.env.SITE_PAGES === "all" ? [] : generated.filter((name, i) => i % 16 && !kinds.includes(name)));

let server, base, browser;

before(async () => {
  server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://x").pathname);
    const file = path.startsWith(prefix) && join(folder, path.slice(prefix.length).replace(/^$|\/$/, "$&index.html"));
    if (!file || !existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": types[extname(file)] ?? "application/octet-stream" });
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  base = `http://127.0.0.1:${server.address().port}${prefix}`;
  // No name leads anywhere; requests by number are seen below.
  browser = await startBrowser("--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1");
});

after(async () => {
  await browser?.close();
  server?.close();
});

/** A tab that notes what it should not have done. */
async function openTab() {
  const tab = await browser.newPage();
  const faults = [];
  tab.on("request", (request) => {
    if (!request.url().startsWith(base) && !/^(data|blob):/.test(request.url())) faults.push(`asked for ${request.url()}`);
  });
  tab.on("response", (response) => response.status() >= 400 && faults.push(`${response.status()} ${response.url()}`));
  tab.on("pageerror", (error) => faults.push(String(error)));
  tab.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  return { tab, faults };
}

async function dress(tab, width, scheme) {
  await tab.setViewport({ width, height: width > 600 ? 900 : 844 });
  await tab.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
}

/** Pictures that are not there, also those that would load only when they come into view. */
const missingPictures = () =>
  Promise.all([...document.images].map((image) => {
    image.loading = "eager";
    return image.decode().then(() => "", () => image.src);
  })).then((sources) => sources.filter(Boolean));

const seriousFindings = (tab) =>
  tab.evaluate(async (source) => {
    if (!window.axe) new Function(source)();
    const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
    const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
    return serious.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)}`);
  }, axeSource);

test("every page: pictures, accessibility, no faults, nothing from elsewhere", async () => {
  const { tab, faults } = await openTab();
  await dress(tab, 1440, "light");
  for (const page of pages) {
    await tab.goto(base + page);
    assert.deepEqual(await tab.evaluate(missingPictures), [], page);
    if (!skipped.has(page)) assert.deepEqual(await seriousFindings(tab), [], page);
    assert.deepEqual(faults, [], page);
  }
  await tab.close();
});

test("each kind of page: dark, and narrow without scrolling sideways", async () => {
  const { tab, faults } = await openTab();
  for (const page of kinds) {
    await tab.goto(base + page);
    for (const [width, scheme] of [[1440, "light"], [1440, "dark"], [390, "light"], [390, "dark"]]) {
      await dress(tab, width, scheme);
      if (scheme === "dark" && width === 390) assert.deepEqual(await seriousFindings(tab), [], `${page} ${width} ${scheme}`);
      assert.ok(await tab.evaluate("document.scrollingElement.scrollWidth <= innerWidth"), `${page} is wider than ${width}`);
      await shot(tab, `${page.replaceAll("/", "-")}-${width}-${scheme}`);
    }
  }
  assert.deepEqual(faults, []);
  await tab.close();
});

test("a click in the gallery opens the studio with that coat", async () => {
  const { tab, faults } = await openTab();
  await dress(tab, 1440, "light");
  await tab.goto(`${base}gallery.html`);
  await Promise.all([tab.waitForNavigation(), tab.click('img[alt^="zebra on"]')]);
  if (existsSync(join(folder, "studio/pelage-engine.wasm"))) {
    await waitForSteps(tab, 1);
    assert.match(await tab.title(), /^zebra /);
    assert.deepEqual(faults, []);
  } else {
    await tab.waitForFunction("document.querySelector('.message')?.textContent.includes('engine could not be started')");
    assert.deepEqual(faults.filter((fault) => !fault.includes("404")), []);
  }
  await shot(tab, "studio-from-gallery");
  await tab.close();
});
