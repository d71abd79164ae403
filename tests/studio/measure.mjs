// Figures of the page, printed and not judged: PELAGE=... PAGE=... [ENGINE=wasm] node tests/studio/measure.mjs [opening]
// On a machine that does nothing else; how busy it was stands beside them.
import { loadavg } from "node:os";
import * as h from "./harness.mjs";

const engine = await h.startEngine();
const browser = await h.startBrowser();
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const load = () => `load ${loadavg()[0].toFixed(1)}`;

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

for (let i = 0; i < 3; ++i) await opening();
await wait(0);
await browser.close();
engine.stop();
