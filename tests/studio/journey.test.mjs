// The studio as a person uses it, with real clicks and keys in a browser, on the real engine.
// PELAGE=build/release/bin/pelage PAGE=out/studio node --test tests/studio/journey.test.mjs
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import * as h from "./harness.mjs";

const ready = h.program && h.page;
const run = (name, body) => test(name, { skip: ready ? false : "PELAGE and PAGE name the program and the page" }, body);
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
let engine;
let browser;

before(async () => {
  if (!ready) return;
  engine = await h.startEngine();
  browser = await h.startBrowser();
});
after(async () => {
  await browser?.close();
  engine?.stop();
});

const recipeText = (tab) => tab.$eval(".code", (area) => area.value);
const pixels = async (tab) => {
  const picture = await tab.screenshot({ clip: { x: 420, y: 200, width: 560, height: 480 } });
  return createHash("sha256").update(picture).digest("hex");
};
const saved = (tab) => tab.evaluate(() => JSON.parse(localStorage.getItem("pelage-studio")));
const idle = (tab) => tab.waitForFunction(() => document.querySelector(".busy").hidden, { polling: 100 });

async function typeRecipe(tab, text) {
  await h.openPanel(tab, "recipe");
  await tab.click(".code");
  await h.pressKeys(tab, "a", "Control");
  await tab.keyboard.sendCharacter(text);
}

const quick = 'name = "quick"\nquality = "draft"\n\n[stage]\nmodel = "turing"\nsize = 0.12\n';

async function quickCoat(tab) {
  await h.waitForSteps(tab, 1);
  await typeRecipe(tab, quick);
  await h.pressKeys(tab, "Enter", "Control");
  await tab.waitForFunction(() => document.querySelector(".what").textContent.includes("quick"));
  await wait(300);
  await idle(tab);
  await h.waitForSteps(tab, 3);
}

run("open, choose leopard, play, paint a mask, change the size, export, reload, undo", async () => {
  const { tab, faults, downloads, close } = await h.openTab(browser, engine.link);
  await h.waitForSteps(tab, 1);
  await h.shot(tab, "01-open");
  await tab.type('input[type="search"]', "giraffe");
  await tab.click('.card[title^="Patches that grow"]');
  await tab.waitForFunction(() => document.querySelector(".what strong").textContent === "giraffe");
  await tab.click('input[type="search"]', { clickCount: 3 });
  await tab.keyboard.type("leopard");
  await h.shot(tab, "02-search");
  await tab.click('.card[title^="Rosettes"]');
  await tab.waitForFunction(() => document.querySelector(".what strong").textContent === "leopard");
  await wait(300);
  await idle(tab);
  await h.waitForSteps(tab, 20);
  await h.shot(tab, "03-leopard");

  await h.press(tab, "Pause");
  await wait(400);
  const paused = await h.steps(tab);
  await wait(500);
  assert.equal(await h.steps(tab), paused);
  await h.press(tab, "One step");
  await h.waitForSteps(tab, paused + 1);
  assert.equal(await h.steps(tab), paused + 1);
  await tab.focus(".stage > canvas");
  await tab.keyboard.press("Space");
  await h.waitForSteps(tab, paused + 3);

  await h.press(tab, "Paint a mask");
  await h.stroke(tab, [[0.4, 0.52], [0.5, 0.54], [0.58, 0.56]]);
  await h.shot(tab, "04-mask");
  let text = await recipeText(tab);
  assert.match(text, /\[\[brush\]\]\nname = "bald"/);
  assert.match(text, /mask = "\(large\.b < 4\) or \(attribute\(bald\) > 0\.5\)"/);
  await wait(400);
  await idle(tab);
  await h.waitForSteps(tab, 15);
  await h.shot(tab, "05-masked");

  await h.openPanel(tab, "adjust");
  const size = (await tab.$$(".stage-body .slider"))[0];
  const before = Number(await size.$eval(".number", (n) => n.value));
  await (await size.$('input[type="range"]')).focus();
  for (let i = 0; i < 5; ++i) await tab.keyboard.press("PageUp");
  await wait(500);
  await idle(tab);
  await h.waitForSteps(tab, 10);
  assert.ok(Number(await size.$eval(".number", (n) => n.value)) > 1.2 * before);
  text = await recipeText(tab);
  const sizes = [...text.matchAll(/^size = ([\d.]+)/gm)].map((m) => Number(m[1]));
  assert.ok(sizes[0] > 0.085 * 1.2 && Math.abs(sizes[0] / sizes[1] - 0.085 / 0.032) < 0.01, String(sizes));
  await h.shot(tab, "06-size");

  await h.openPanel(tab, "export");
  await tab.click('.choice [data-value="1024"]');
  await tab.click('[data-format=".glb"]');
  const file = await h.waitForFile(downloads, ".glb", 10000);
  assert.equal(readFileSync(file).subarray(0, 4).toString(), "glTF");
  assert.match(execFileSync(h.program, ["check", file], { encoding: "utf8" }), /vertices/);
  await h.shot(tab, "07-export");

  await wait(500);
  await tab.reload();
  await h.waitForSteps(tab, 1);
  assert.equal(await recipeText(tab), text);
  await h.shot(tab, "08-reload");

  await tab.click('input[type="search"]');
  await tab.keyboard.type("zebra");
  await tab.click(".card:not([hidden])");
  await tab.waitForFunction(() => document.querySelector(".what strong").textContent.includes("zebra"));
  await tab.focus(".stage > canvas");
  await h.pressKeys(tab, "z", "Control");
  await tab.waitForFunction((t) => document.querySelector(".code").value === t, {}, text);
  await h.pressKeys(tab, "z", "Control", "Shift");
  await tab.waitForFunction(() => document.querySelector(".what strong").textContent.includes("zebra"));
  await h.shot(tab, "09-undone-and-redone");
  assert.deepEqual(faults, []);
  await close();
});

run("paint on a paused coat, and undo and redo follow", async () => {
  const { tab, faults, close } = await h.openTab(browser, engine.link);
  await quickCoat(tab);
  if ((await tab.$eval(".play", (n) => n.getAttribute("aria-label"))) === "Play") await tab.click(".play");
  await h.press(tab, "Pause");
  await wait(600);
  await h.press(tab, "Paint a species");
  await tab.mouse.move(5, 5);
  await wait(300);
  const before = await pixels(tab);
  await h.stroke(tab, [[0.42, 0.5], [0.55, 0.54]]);
  await wait(800);
  await h.shot(tab, "10-painted");
  await tab.mouse.move(5, 5);
  await wait(300);
  const painted = await pixels(tab);
  assert.notEqual(painted, before);
  await h.pressKeys(tab, "z", "Control");
  await wait(1500);
  const undone = await pixels(tab);
  await h.pressKeys(tab, "z", "Control", "Shift");
  await wait(1500);
  const redone = await pixels(tab);
  assert.notEqual(undone, painted);
  assert.notEqual(redone, undone);
  assert.match(await h.text(tab, ".message"), /brush stroke/);
  await h.press(tab, "Erase to the rest");
  await tab.click('[aria-label="Mirror along z"]');
  await h.stroke(tab, [[0.42, 0.5], [0.55, 0.54]]);
  await wait(800);
  await h.shot(tab, "11-erased");
  assert.deepEqual(faults, []);
  await close();
});

run("a parameter moves while it grows; text with a fault is marked at its line", async () => {
  const { tab, faults, close } = await h.openTab(browser, engine.link);
  await quickCoat(tab);
  const grown = await h.waitForSteps(tab, 10);
  await h.openPanel(tab, "adjust");
  const slider = (await tab.$$(".stage-body .slider"))[3];
  assert.equal(await slider.$eval("label", (n) => n.textContent), "s");
  await (await slider.$('input[type="range"]')).focus();
  await tab.keyboard.press("ArrowRight");
  await wait(700);
  assert.match(await recipeText(tab), /parameters = \{ s = 0\.05\d* \}/);
  await h.waitForSteps(tab, grown);

  await typeRecipe(tab, quick.replace("size", "sise"));
  await tab.waitForFunction(() => document.querySelector(".fault").textContent.includes("Line 6"));
  assert.equal(await tab.$eval(".fault-line", (n) => n.hidden), false);
  await h.shot(tab, "12-fault");
  await tab.reload();
  await h.waitForSteps(tab, 1);
  assert.match(await recipeText(tab), /sise/, "what is being typed survives a reload");
  assert.deepEqual(faults, []);
  await close();
});

run("a mesh of the user: opened, kept over a reload; a file that is none is told in words", async () => {
  const { tab, faults, close } = await h.openTab(browser, engine.link);
  await quickCoat(tab);
  const folder = mkdtempSync(join(tmpdir(), "studio-mesh-"));
  const cone = join(folder, "tetrahedron.obj");
  writeFileSync(cone, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  await h.openPanel(tab, "shape");
  const input = await tab.$('input[type="file"]');
  await input.uploadFile(cone);
  await tab.waitForFunction(() => document.querySelector(".what").textContent.includes("tetrahedron.obj"));
  await wait(300);
  await idle(tab);
  await h.waitForSteps(tab, 2);
  await h.shot(tab, "13-own-mesh");
  await wait(500);
  await tab.reload();
  await h.waitForSteps(tab, 1);
  assert.match(await h.text(tab, ".what"), /tetrahedron\.obj/);
  const broken = join(folder, "broken.obj");
  writeFileSync(broken, "v 0 0\nf 1 2 9\n");
  await (await tab.$('input[type="file"]')).uploadFile(broken);
  await tab.waitForFunction(() => document.querySelector(".message").textContent.includes("broken.obj"));
  await h.shot(tab, "14-broken-mesh");
  assert.match(await h.text(tab, ".what"), /tetrahedron\.obj/, "the shape before stays");
  assert.deepEqual(faults, []);
  await close();
});

run("a link carries coat, shape and view; a hostile one is refused and nothing runs", async () => {
  const { tab, faults, close, context } = await h.openTab(browser, engine.link);
  await quickCoat(tab);
  await h.openPanel(tab, "export");
  await h.press(tab, "Copy a link");
  await tab.waitForSelector(".link-field:not([hidden])");
  const address = await tab.$eval(".link-field", (n) => n.value);
  assert.ok(!address.includes("token"), "the token stays here");
  const code = address.split("#s=")[1];
  await close();
  const other = await h.openTab(browser, `${engine.link}&s=${code}`);
  await h.waitForSteps(other.tab, 1);
  assert.equal(await recipeText(other.tab), quick);
  assert.ok(!(await other.tab.url()).includes("s="), "the link is taken out of the address");
  assert.deepEqual([...faults, ...other.faults], []);
  await other.close();
  const bad = await h.openTab(browser, `${engine.link}&s=${encodeURIComponent('"><img src=x onerror=alert(1)>')}`);
  await bad.tab.waitForFunction(() => document.querySelector(".message").textContent.includes("characters that no link"));
  await h.waitForSteps(bad.tab, 1);
  await h.shot(bad.tab, "15-hostile-link");
  await bad.close();
  const [server, hash] = engine.link.split("#");
  const small = await h.openTab(browser, `${server}?embed#${hash}&s=${code}`, { width: 640, height: 480 });
  await small.tab.waitForSelector(".embed-bar");
  await wait(4000);
  await h.shot(small.tab, "16-embedded");
  assert.deepEqual(small.faults, []);
  await small.close();
  await context.close();
});

run("what the page exports as text is what the command line grows", async () => {
  const { tab, downloads, close } = await h.openTab(browser, engine.link);
  await quickCoat(tab);
  await h.openPanel(tab, "export");
  await h.press(tab, "Save the recipe");
  const file = await h.waitForFile(downloads, ".toml");
  assert.equal(readFileSync(file, "utf8"), quick);
  const out = join(downloads, "cli.ply");
  execFileSync(h.program, ["grow", "builtin:animal", "--recipe", file, "-o", out], { stdio: "pipe" });
  await close();
});

run("small screen, touch", async () => {
  const { tab, faults, close } = await h.openTab(browser, engine.link, { width: 390, height: 844, touch: true });
  await h.waitForSteps(tab, 1);
  await wait(3000);
  await h.shot(tab, "20-phone");
  for (const id of ["shape", "adjust", "paint", "look", "recipe", "readout", "export"]) {
    await tab.tap(`#tab-${id}`);
    await wait(300);
    assert.ok(await tab.$eval(`#panel-${id}`, (n) => n.getBoundingClientRect().height > 200), id);
    await h.shot(tab, `21-phone-${id}`);
  }
  const wide = await tab.evaluate(() => document.documentElement.scrollWidth);
  assert.equal(wide, 390);
  assert.deepEqual(faults, []);
  await close();
});

run("accessibility: nothing serious, on every panel and both sizes", async () => {
  for (const size of [{ width: 1440, height: 900 }, { width: 390, height: 844, touch: true }]) {
    const { tab, close } = await h.openTab(browser, engine.link, size);
    await h.waitForSteps(tab, 1);
    await tab.evaluate(h.axeSource);
    for (const id of ["coats", "shape", "adjust", "paint", "look", "recipe", "readout", "export"]) {
      await h.openPanel(tab, id);
      await wait(400);
      const found = await tab.evaluate(async () => (await window.axe.run()).violations.map(({ id, impact, nodes }) => ({ id, impact, nodes: nodes.slice(0, 4).map((n) => n.html.slice(0, 160)) })));
      const serious = found.filter((one) => one.impact === "serious" || one.impact === "critical");
      assert.deepEqual(serious, [], `${id} at ${size.width}`);
    }
    await close();
  }
});
