// The studio as a person uses it, with real clicks and keys in a browser, on the real engine.
// PELAGE=build/release/bin/pelage PAGE=out/studio [ENGINE=wasm] node --test tests/studio/journey.test.mjs
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

async function growText(tab, text, name) {
  await typeRecipe(tab, text);
  await h.pressKeys(tab, "Enter", "Control");
  await tab.waitForFunction((wanted) => document.querySelector(".what").textContent.includes(wanted), {}, name);
  await wait(300);
  await idle(tab);
  await h.waitForSteps(tab, 3);
}

async function quickCoat(tab) {
  await h.waitForSteps(tab, 1);
  await growText(tab, quick, "quick");
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

run("directions are combed where diffusion follows them, as lines, undone and redone", async () => {
  const { tab, faults, close } = await h.openTab(browser, engine.link);
  await quickCoat(tab);
  await h.press(tab, "Comb directions");
  assert.match(await h.text(tab, "#panel-paint"), /turing spreads the same in all directions/);
  const coat = quick.replace('"turing"', '"witkin-kass-stripes"').replace("quick", "combed");
  await growText(tab, coat, "combed");
  await h.openPanel(tab, "paint");
  await h.stroke(tab, [[0.4, 0.5], [0.5, 0.54], [0.6, 0.5]]);
  await tab.waitForFunction(() => document.querySelector("#panel-paint").textContent.includes("1 stroke"));
  const text = await recipeText(tab);
  assert.match(text, /^directions = \{ strokes = \[\[\[[-\d., [\]]*\]\]\] \}$/m);
  await wait(400);
  await idle(tab);
  await h.waitForSteps(tab, 3);
  await wait(1500);
  await h.shot(tab, "22-combed");
  await tab.focus(".stage > canvas");
  await h.pressKeys(tab, "z", "Control");
  await tab.waitForFunction((t) => document.querySelector(".code").value === t, {}, coat);
  await h.pressKeys(tab, "z", "Control", "Shift");
  await tab.waitForFunction((t) => document.querySelector(".code").value === t, {}, text);
  assert.deepEqual(faults, []);
  await close();
});

run("a copy of a model is edited in the recipe, its faults marked at their line; equations change while it grows", async () => {
  const { tab, faults, close } = await h.openTab(browser, engine.link);
  await quickCoat(tab);
  await h.openPanel(tab, "recipe");
  await h.press(tab, "Edit a copy of turing");
  await tab.waitForFunction(() => document.querySelector(".editor-head select").value === "my-turing");
  const model = await recipeText(tab);
  assert.match(model, /^(#.*\n)*name = "turing"/);
  await idle(tab);
  const line = model.split("\n").findIndex((one) => one.startsWith("rate")) + 1;
  await typeRecipe(tab, model.replace(/^rate = "/m, 'rate = "nothing*'));
  await tab.waitForFunction((n) => document.querySelector(".fault").textContent.startsWith(`Line ${n},`), {}, line);
  await h.shot(tab, "23-own-model");
  await typeRecipe(tab, model.replace(/^rate = "/m, 'rate = "0*t + '));
  await tab.waitForFunction(() => document.querySelector(".fault").textContent === "");
  await tab.select(".editor-head select", "");
  await tab.waitForFunction(() => document.querySelector(".code").value.includes("0*t + "));
  const text = await recipeText(tab);
  assert.match(text, /model = "my-turing"/);
  await wait(600);
  await tab.reload();
  await h.waitForSteps(tab, 1);
  assert.equal(await recipeText(tab), text);
  assert.deepEqual(faults, []);
  await close();
});

run("the parameter map is clicked into and walked by keys; the coat goes on growing; the view is undone", async () => {
  const { tab, faults, close } = await h.openTab(browser, engine.link);
  await h.waitForSteps(tab, 1);
  await growText(tab, quick.replace('"turing"', '"schnakenberg"').replace("quick", "mapped"), "mapped");
  await h.openPanel(tab, "readout");
  await tab.waitForFunction(() => [...document.querySelectorAll("#panel-readout .swatch")].length > 0, { timeout: 60000 });
  const map = await tab.$(".map");
  await map.evaluate((node) => node.scrollIntoView());
  const box = await map.boundingBox();
  const grown = await h.steps(tab);
  await tab.mouse.click(box.x + 0.25 * box.width, box.y + 0.5 * box.height);
  const parameters = async () => /parameters = \{ (\w+) = ([\d.]+), (\w+) = ([\d.]+) \}/.exec(await recipeText(tab));
  const clicked = await parameters();
  await tab.keyboard.press("ArrowRight");
  const moved = await parameters();
  assert.ok(Number(moved[2]) > Number(clicked[2]) && moved[4] === clicked[4], `${clicked} ${moved}`);
  await wait(1000);
  await h.waitForSteps(tab, grown);
  await h.shot(tab, "24-map");
  await tab.focus(".stage > canvas");
  const before = (await saved(tab)).view;
  await tab.keyboard.press("ArrowLeft");
  await wait(500);
  assert.notDeepEqual((await saved(tab)).view, before);
  await h.pressKeys(tab, "z", "Control");
  await wait(500);
  const apart = (await saved(tab)).view.eye.map((v, i) => Math.abs(v - before.eye[i]));
  assert.ok(Math.max(...apart) < 1e-6, String(apart));
  assert.deepEqual(await parameters(), moved);
  assert.deepEqual(faults, []);
  await close();
});

run("twenty new starts and four meshes leave nothing behind", async () => {
  const { tab, faults, close } = await h.openTab(browser, engine.link);
  await h.waitForSteps(tab, 1);
  await growText(tab, `${quick.replace("quick", "endless")}until = 1000000\n`, "endless");
  const held = async () => {
    await wait(300);
    await idle(tab);
    await h.waitForSteps(tab, 1);
    const { geometries, textures, programs } = await tab.evaluate(() => window.studioFigures());
    return { geometries, textures, programs };
  };
  const anew = async () => {
    await tab.keyboard.press("r");
    await wait(100);
    await idle(tab);
  };
  await tab.focus(".stage > canvas");
  for (let i = 0; i < 3; ++i) await anew();  // what was shown before them has gone by then
  const before = await held();
  /** What one start or mesh left behind would be there twenty times, or four; a finer picture is one geometry more. */
  const nothingLeft = async (what) => {
    const now = await held();
    for (const kind of Object.keys(before)) assert.ok(now[kind] <= before[kind] + 1, `${what}: ${now[kind]} ${kind}, ${before[kind]} before`);
  };
  for (let i = 0; i < 20; ++i) await anew();
  await nothingLeft("after new starts");
  await h.openPanel(tab, "shape");
  for (const shape of ["sphere", "torus", "sphere", "animal"]) {
    await tab.click(`[data-shape="builtin:${shape}"]`);
    await tab.waitForFunction((name) => document.querySelector(".what").textContent.includes(`on ${name}`), {}, shape);
    await held();
  }
  await nothingLeft("after other meshes");
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

/** A PLY without its comments, which say who made it. */
function withoutComments(file) {
  const text = readFileSync(file, "latin1");
  const end = text.indexOf("end_header");
  return text.slice(0, end).replace(/^comment.*\n/gm, "") + text.slice(end);
}

// The engine for browsers has another animal (docs/architecture.md).
run("what the page exports as text grows the same coat on the command line, to the bit", async (t) => {
  if (h.wasm) return t.skip("the bits are those of the program's engine");
  const { tab, faults, downloads, close } = await h.openTab(browser, engine.link);
  await h.waitForSteps(tab, 1);
  await typeRecipe(tab, `${quick}steps = 25\n`);
  await h.pressKeys(tab, "Enter", "Control");
  await tab.waitForFunction(() => document.querySelector(".status-word").textContent === "steps reached", { timeout: 60000 });
  assert.equal(await h.steps(tab), 25);
  await h.openPanel(tab, "export");
  await h.press(tab, "Save the recipe");
  const file = await h.waitForFile(downloads, ".toml");
  assert.equal(readFileSync(file, "utf8"), `${quick}steps = 25\n`);
  await tab.click('[data-format=".ply"]');
  const coat = withoutComments(await h.waitForFile(downloads, ".ply", 100000));
  const own = join(downloads, "program.ply");
  execFileSync(h.program, ["grow", "builtin:animal", "--recipe", file, "-o", own], { stdio: "pipe" });
  assert.ok(coat === withoutComments(own));
  assert.deepEqual(faults, []);
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
