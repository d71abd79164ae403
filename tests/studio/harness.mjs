// Starts an engine with the page, and a browser on it. PELAGE: the program; PAGE: folder of the built page; ENGINE=wasm: the
// engine is the one in the page's folder, which a plain server of files serves, below a path; CHROMIUM: the browser; SHOTS:
// folder for pictures of the steps, if wanted.
import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { createInterface } from "node:readline";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const require = createRequire(fileURLToPath(new URL("../../studio/package.json", import.meta.url)));
const puppeteer = require("puppeteer-core");
export const axeSource = require("axe-core").source;

export const program = process.env.PELAGE;
export const page = process.env.PAGE;
export const wasm = process.env.ENGINE === "wasm";
const browserPath = process.env.CHROMIUM ?? "/usr/bin/chromium";

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".png": "image/png" };

/** Serves the page's folder as any server of files would, and gives a link to which `&s=` of a coat may be appended. */
async function serveFiles() {
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url, "http://here").pathname.replace(/\/$/, "/index.html"));
    try {
      const bytes = readFileSync(join(page, path.replace("/some/folder/", "/")));
      response.writeHead(200, { "Content-Type": types[extname(path)] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { link: `http://127.0.0.1:${server.address().port}/some/folder/#`, stop: () => server.close() };
}

/** Starts the engine that is wanted and gives the link of the page with it. */
export const startEngine = () => (wasm ? serveFiles() : startProgram());

/** Starts `pelage studio`, which prints its link. */
async function startProgram() {
  const child = spawn(program, ["studio", "--no-open", "--page", page], { stdio: ["ignore", "pipe", "inherit"] });
  const link = await new Promise((resolve, reject) => {
    child.on("exit", (code) => reject(new Error(`the program ended with ${code} before it printed its link`)));
    createInterface({ input: child.stdout }).on("line", (line) => {
      const match = /http:\/\/\S+#token=\w+/.exec(line);
      if (match) resolve(match[0]);
    });
  });
  return { link, stop: () => child.kill() };
}

/** `flags`: further ones of the browser. */
export async function startBrowser(...flags) {
  const browser = await puppeteer.launch({
    executablePath: browserPath,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking", ...flags],
  });
  return browser;
}

/** A tab of its own, with what goes wrong in it gathered in `faults`, and a folder for what it downloads. */
export async function openTab(browser, link, { width = 1440, height = 900, touch = false, context = null } = {}) {
  const place = context ?? (await browser.createBrowserContext());
  const tab = await place.newPage();
  const faults = [];
  tab.on("pageerror", (error) => faults.push(String(error)));
  tab.on("console", (message) => {
    if (message.type() === "error") faults.push(message.text());
  });
  const downloads = mkdtempSync(join(tmpdir(), "studio-"));
  const client = await tab.createCDPSession();
  await client.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: downloads, browserContextId: place.id });
  await tab.setViewport({ width, height, isMobile: touch, hasTouch: touch });
  await tab.goto(link);
  const close = async () => {
    rmSync(downloads, { recursive: true, force: true });
    await tab.close();
  };
  return { tab, faults, downloads, context: place, close };
}

export const text = (tab, selector) => tab.$eval(selector, (node) => node.textContent);

/** Waits for a growth that has taken at least so many steps; gives how many. */
export async function waitForSteps(tab, least, timeout = 120000) {
  const read = "Number(document.querySelectorAll('.readings dd')[2]?.textContent.replace(/,/g, ''))";
  await tab.waitForFunction(`${read} >= ${least}`, { timeout, polling: 100 });
  return tab.evaluate(read);
}

export const steps = (tab) => tab.evaluate("Number(document.querySelectorAll('.readings dd')[2]?.textContent.replace(/,/g, ''))");

export async function pressKeys(tab, key, ...modifiers) {
  for (const one of modifiers) await tab.keyboard.down(one);
  await tab.keyboard.press(key);
  for (const one of modifiers.reverse()) await tab.keyboard.up(one);
}

/** Presses the button that a reader would call by this name. */
export async function press(tab, name) {
  const find = (wanted) => [...document.querySelectorAll("button")].find((b) => (b.getAttribute("aria-label") ?? b.querySelector("span")?.textContent) === wanted && b.offsetParent);
  const found = await tab.waitForFunction(find, { timeout: 10000 }, name);
  await found.click();
}

export async function openPanel(tab, id) {
  await tab.click(`#tab-${id}`);
}

/** A stroke of the mouse over the canvas; places are fractions of it. */
export async function stroke(tab, places) {
  const box = await (await tab.$(".stage > canvas")).boundingBox();
  const at = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
  await tab.mouse.move(...at(places[0]));
  await tab.mouse.down();
  for (const place of places.slice(1)) await tab.mouse.move(...at(place), { steps: 6 });
  await tab.mouse.up();
}

/** Waits for a file of at least so many bytes in the folder of downloads; gives its path. */
export async function waitForFile(folder, ending, least = 1, timeout = 90000) {
  for (const end = Date.now() + timeout; Date.now() < end; await new Promise((r) => setTimeout(r, 200))) {
    const name = readdirSync(folder).find((one) => one.endsWith(ending));
    if (name && statSync(join(folder, name)).size >= least) return join(folder, name);
  }
  throw new Error(`no file ${ending} came`);
}

export async function shot(tab, name) {
  if (!process.env.SHOTS) return;
  mkdirSync(process.env.SHOTS, { recursive: true });
  await tab.screenshot({ path: join(process.env.SHOTS, `${name}.png`) });
}
