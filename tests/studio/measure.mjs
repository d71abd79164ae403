// Figures of the page, printed and not judged, on a machine that does nothing else; how busy it was stands beside them:
// PELAGE=... PAGE=... [ENGINE=wasm] node tests/studio/measure.mjs [opening] [frames] [memory]
import { loadavg } from "node:os";
import { deflateRawSync } from "node:zlib";
import * as h from "./harness.mjs";

const engine = await h.startEngine();
const browser = await h.startBrowser();
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const load = () => `load ${loadavg()[0].toFixed(1)}`;
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const wanted = process.argv.slice(2);
const asked = (what) => wanted.length === 0 || wanted.includes(what);

/** Milliseconds from the beginning of a visit with nothing saved until things are there. */
async function opening() {
  const { tab, close } = await h.openTab(browser, "about:blank");
  await tab.evaluateOnNewDocument(() => {
    const seen = (window.seen = {});
    const look = () => {
      const steps = Number(document.querySelectorAll(".readings dd")[2]?.textContent.replace(/,/g, ""));
      if (document.querySelector(".stage")) seen.page ??= performance.now();
      if (document.querySelector(".card")) seen.lists ??= performance.now();
      if (steps === 0) seen.coat ??= performance.now();
      if (steps >= 1) seen.moving ??= performance.now();
      if (steps >= 10) seen.tenSteps ??= performance.now();
    };
    setInterval(look, 10);
  });
  await tab.goto(engine.link);
  await tab.waitForFunction("window.seen?.tenSteps", { timeout: 120000 });
  const seen = await tab.evaluate("window.seen");
  console.log(Object.entries(seen).map(([what, at]) => `${what} ${Math.round(at)} ms`).join(", "), load());
  await close();
}

/** Notes how long each request to the engine takes, with the way there and back. */
function watchRequests() {
  window.requests = [];
  const plainFetch = window.fetch;
  window.fetch = async (...all) => {
    const from = performance.now();
    const reply = await plainFetch(...all);
    window.requests.push(performance.now() - from);
    return reply;
  };
  const plainPost = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (...all) {
    const from = performance.now();
    this.addEventListener("message", () => window.requests.push(performance.now() - from), { once: true });
    plainPost.apply(this, all);
  };
}

const recipe = (size) => `name = "measured"\n[stage]\nmodel = "gray-scott"\nsize = ${size}\nuntil = 1000000\n`;
const linkOf = (text) => `${engine.link}&s=${deflateRawSync(JSON.stringify({ v: 1, recipe: text, shape: "builtin:sphere" })).toString("base64url")}`;

async function over(tab, seconds) {
  const read = async () => ({ at: performance.now(), steps: await h.steps(tab), ...(await tab.evaluate(() => window.studioFigures())) });
  const before = await read();
  await tab.evaluate(() => (window.requests.length = 0));
  await wait(1000 * seconds);
  const after = await read();
  const time = (after.at - before.at) / 1000;
  const requests = await tab.evaluate(() => window.requests);
  return { pictures: (after.pictures - before.pictures) / time, steps: (after.steps - before.steps) / time, request: median(requests), requests: requests.length / time };
}

/** Pictures and steps a second while it grows; and how often the picture alone is drawn, of a coat that only turns. */
async function frames(size, speed) {
  const { tab, close } = await h.openTab(browser, "about:blank", { width: 1200, height: 800 });
  await tab.evaluateOnNewDocument(watchRequests);
  await tab.goto(linkOf(recipe(size)));
  await h.waitForSteps(tab, 5);
  await tab.$eval("#speed", (input, value) => { input.value = value; input.dispatchEvent(new Event("input")); }, speed);
  await wait(1500);
  const grown = await over(tab, 6);
  await h.press(tab, "Pause");
  await tab.keyboard.press("t");
  await wait(700);
  const turned = await over(tab, 4);
  await h.openPanel(tab, "shape");
  const nodes = /([\d,]+) nodes/.exec(await h.text(tab, "#panel-shape"))[1];
  const n = (x) => x.toFixed(1);
  console.log(`${h.wasm ? "wasm" : "native"} | ${nodes} nodes | speed ${speed} | ${n(grown.pictures)} pictures/s | ${n(grown.steps)} steps/s | ${n(grown.steps / grown.requests)} steps a slice | slice ${n(grown.request)} ms, ${n(grown.requests)}/s | only turning ${n(turned.pictures)} pictures/s | ${load()}`);
  await close();
}

/** What the page holds, of its own and on the side of the GPU, after so many new starts and meshes. */
async function memory() {
  const { tab, close } = await h.openTab(browser, linkOf(recipe(0.2)));
  const client = await tab.createCDPSession();
  const tell = async (what) => {
    await wait(500);
    await client.send("HeapProfiler.collectGarbage");
    const { JSHeapUsedSize } = await tab.metrics();
    const buffers = (await client.send("Runtime.getHeapUsage")).backingStorageSize ?? 0;
    const { geometries, textures, programs } = await tab.evaluate(() => window.studioFigures());
    console.log(`${what}: heap ${(JSHeapUsedSize / 1e6).toFixed(1)} MB, buffers ${(buffers / 1e6).toFixed(1)} MB, ${geometries} geometries, ${textures} textures, ${programs} programs`, load());
  };
  const idle = () => tab.waitForFunction(() => document.querySelector(".busy").hidden && document.querySelectorAll(".readings dd")[2].textContent !== "0", { polling: 50 });
  await h.waitForSteps(tab, 5);
  await tab.focus(".stage > canvas");
  await tell("at first");
  for (let i = 1; i <= 100; ++i) {
    await tab.keyboard.press("r");
    await wait(60);
    await idle();
    if ([10, 50, 100].includes(i)) await tell(`${i} new starts`);
  }
  await h.openPanel(tab, "shape");
  for (let i = 1; i <= 20; ++i) {
    const shape = i % 2 ? "torus" : "sphere";
    await tab.click(`[data-shape="builtin:${shape}"]`);
    await tab.waitForFunction((name) => document.querySelector(".what").textContent.includes(`on ${name}`), {}, shape);
    await wait(200);
    await idle();
    if (i % 10 === 0) await tell(`${i} meshes`);
  }
  await close();
}

if (asked("opening")) for (let i = 0; i < 3; ++i) await opening();
if (asked("frames")) for (const size of [0.1, 0.05]) for (const speed of [2, 3]) await frames(size, speed);
if (asked("memory")) await memory();
await browser.close();
engine.stop();
