// The parts of the page that need no browser: links, edits of recipes, messages, tracks of sliders.
import assert from "node:assert/strict";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { deflateRawSync } from "node:zlib";

const root = fileURLToPath(new URL("../..", import.meta.url));
const { build } = createRequire(join(root, "studio/package.json"))("esbuild");
const folder = mkdtempSync(join(tmpdir(), "studio-unit-"));
after(() => rmSync(folder, { recursive: true, force: true }));

async function load(name) {
  const outfile = join(folder, `${name.replace("/", "-")}.mjs`);
  await build({ entryPoints: [join(root, "studio/src", `${name}.ts`)], outfile, bundle: true, format: "esm", logLevel: "error" });
  return import(pathToFileURL(outfile));
}

const link = await load("link");
const toml = await load("recipe-text");
const engine = await load("engine");
const adjust = await load("panels/adjust");
const map = await load("panels/map");
const recipes = readdirSync(join(root, "recipes")).map((name) => [name, readFileSync(join(root, "recipes", name), "utf8")]);
const pack = (text) => deflateRawSync(Buffer.from(text)).toString("base64url");

test("links: every shipped recipe survives", async () => {
  const view = { eye: [0.5, 0.25, 1.5], target: [0, 0.125, 0] };
  for (const [, recipe] of recipes) {
    const shared = { recipe, shape: "builtin:sphere?n=642", view };
    assert.deepEqual(await link.decodeLink(await link.encodeLink(shared)), shared);
  }
});

test("links: one with paint survives, and one too long is refused where it is made", async () => {
  let recipe = recipes[0][1];
  const points = Array.from({ length: 200 }, (_, i) => [Math.sin(i), Math.cos(i), i / 200]);
  for (let i = 0; i < 5; ++i) recipe = toml.addStroke(recipe, "bald", { radius: 0.1, value: 1, hardness: 0.5, points });
  const shared = { recipe, shape: "builtin:animal", view: null };
  assert.deepEqual(await link.decodeLink(await link.encodeLink(shared)), shared);
  const noise = Array.from({ length: 200000 }, () => Math.random().toString(36)).join("");
  await assert.rejects(link.encodeLink({ ...shared, recipe: noise }), link.LinkError);
});

test("links: hostile ones are refused in words", async () => {
  const good = { v: 1, recipe: "x", shape: "builtin:animal" };
  const bad = {
    "10 MB": "A".repeat(10 << 20),
    "a bomb of 100 MB": pack("0".repeat(100 << 20)),
    script: "<script>alert(1)</script>",
    "other bytes": "AAAA____",
    "cut off": pack(JSON.stringify(good)).slice(0, -4),
    "deep nesting": pack("[".repeat(400000)),
    "deep and closed": pack("[".repeat(400000) + "]".repeat(400000)),
    "no object": pack("7"),
    "no recipe": pack(JSON.stringify({ ...good, recipe: 7 })),
    "another version": pack(JSON.stringify({ ...good, v: 2 })),
    "a file as shape": pack(JSON.stringify({ ...good, shape: "/etc/passwd" })),
    "a path as shape": pack(JSON.stringify({ ...good, shape: "builtin:../../x" })),
    "not UTF-8": deflateRawSync(Buffer.from([0x22, 0xff, 0x22])).toString("base64url"),
    nothing: "",
  };
  for (const [what, code] of Object.entries(bad)) {
    await assert.rejects(link.decodeLink(code), (error) => error instanceof link.LinkError && error.message.length > 20, what);
  }
  const odd = await link.decodeLink(pack(JSON.stringify({ ...good, view: { eye: [1, "2", 3], target: [1e300, 0, 0] }, more: 1 })));
  assert.deepEqual(odd, { recipe: "x", shape: "builtin:animal", view: null });
});

test("recipe text: parameters in braces, in a table, in none; comments stay", () => {
  const braces = '[stage]\nmodel = "turing"\nparameters = { s = 0.05, Da = 0.1 } # as printed\n\n[look]\nramp = "mono"\n';
  assert.equal(toml.setParameter(braces, 0, "s", "0.1"), braces.replace("s = 0.05", "s = 0.1"));
  assert.equal(toml.setParameter(braces, 0, "Db", "1"), braces.replace("Da = 0.1 }", "Da = 0.1, Db = 1 }"));
  assert.equal(toml.removeParameter(braces, 0, "Da"), braces.replace(", Da = 0.1", ""));
  assert.equal(toml.removeParameter(braces, 0, "s"), braces.replace("s = 0.05, ", ""));
  const table = '[[stage]]\nmodel = "a"\n[[stage]]\nmodel = "b" # second\n[stage.parameters]\nx = 1 # one\n';
  assert.equal(toml.setParameter(table, 1, "x", "2"), table.replace("x = 1", "x = 2"));
  assert.equal(toml.setParameter(table, 1, "y", "3"), `${table}y = 3\n`);
  assert.equal(toml.setParameter(table, 0, "x", "2"), table.replace('"a"\n', '"a"\nparameters = { x = 2 }\n'));
  assert.equal(toml.removeParameter(table, 1, "x"), table.replace("x = 1 # one\n", ""));
});

test("recipe text: what looks like a key in strings, comments and arrays is none", () => {
  const text = 'summary = """\nsize = 3\n[stage]\n"""\n# size = 4\n[stage]\nmodel = "turing" # size = 5\ndirections = { strokes = [\n  [[0, 0, 0], [1, 0, 0]], # size = 6\n] }\nsize = 0.1\n';
  assert.equal(toml.stageValue(text, 0, "size"), "0.1");
  assert.equal(toml.setStageKey(text, 0, "size", "0.2"), text.replace("size = 0.1\n", "size = 0.2\n"));
  assert.equal(toml.stageCount(text), 1);
});

test("recipe text: the look, the top, and what a change needs", () => {
  for (const [name, text] of recipes) {
    const ramp = toml.setLookKey(text, "ramp", '"mono"');
    assert.equal(toml.lookValue(ramp, "ramp"), '"mono"', name);
    assert.equal(toml.changeBetween(text, ramp), toml.lookValue(text, "ramp") === '"mono"' ? "none" : "look", name);
    assert.equal(toml.changeBetween(text, toml.setParameter(text, 0, "unheard_of", "1")), "keep", name);
    assert.equal(toml.changeBetween(text, toml.setStageKey(text, 0, "seed", "77")), "restart", name);
    assert.equal(toml.changeBetween(text, toml.setTopKey(text, "quality", '"fine"')), "restart", name);
    assert.equal(toml.changeBetween(text, `${text}# a word\n`), "none", name);
    const back = toml.removeParameter(toml.setParameter(text, 0, "unheard_of", "1"), 0, "unheard_of");
    assert.equal(back, text, name);
  }
});

test("recipe text: strokes go to the brush of their name, and what was painted is read again", () => {
  const stroke = (x) => ({ radius: 0.1, value: 1, hardness: 0.5, points: [[x, 0, 0], [x, 1, 0]] });
  let text = recipes[0][1];
  for (const [name, x] of [["bald", 1], ["wider", 2], ["bald", 3]]) text = toml.addStroke(text, name, stroke(x));
  assert.deepEqual(toml.brushStrokes(text, "bald", 1), [stroke(1), stroke(3)]);
  assert.deepEqual(toml.brushStrokes(text, "wider", 1), [stroke(2)]);
  assert.deepEqual(toml.brushStrokes(toml.removeBrush(text, "bald"), "wider", 1), [stroke(2)]);
  assert.deepEqual(toml.brushStrokes(toml.removeBrush(text, "bald"), "bald", 1), []);
});

test("recipe text: the use of a map is put in and taken out", () => {
  const use = { key: "mask", alone: "attribute(bald) > 0.5", before: "(", after: ") or (attribute(bald) > 0.5)" };
  for (const [name, text] of recipes) {
    const used = toml.useInStages(text, use);
    assert.equal(toml.useInStages(used, use), used, name);
    assert.equal(toml.unuseInStages(used, use), text, name);
    for (let stage = 0; stage < toml.stageCount(text); ++stage) assert.match(toml.stageValue(used, stage, "mask"), /attribute\(bald\)/);
  }
});

test("recipe text: strokes of directions join what is there, and go again", () => {
  const strokes = [[[0, 0, 0], [1, 0, 0.5]], [[0, 1, 0], [0, 2, 0], [0, 3, 0]]];
  const stage = '[stage]\nmodel = "witkin-kass-2"\n';
  for (const directions of ["", "directions = { axis = [0, 1, 0] } # up\n", "[stage.directions]\naxis = [0, 1, 0]\n"]) {
    const text = stage + directions;
    const once = toml.addDirections(text, 0, strokes.slice(0, 1));
    const twice = toml.addDirections(once, 0, strokes.slice(1));
    assert.deepEqual(toml.directionStrokes(twice, 0), strokes);
    assert.equal(twice.includes("axis"), text.includes("axis"));
    assert.equal(toml.removeDirections(twice, 0), text);
    assert.equal(toml.changeBetween(once, twice), "restart");
  }
});

test("recipe text: a copy of a model is the recipe's own, and its equations change while it grows", () => {
  const model = 'name = "turing"\n[species.u]\nrate = "u - \\"v\\""\n';
  let text = recipes.find(([name]) => name === "leopard.toml")[1];
  const own = (name) => toml.ownModels(text).find((one) => one.name === name);
  for (const [stage, asked, name, used] of [[0, "turing", "my-turing", "my-turing"], [1, "turing:spots", "my-turing-2", "my-turing-2:spots"], [1, "my-turing-2:spots", "my-turing-3", "my-turing-3:spots"]]) {
    const added = toml.addModel(text, stage, asked, model);
    assert.equal(added.name, name);
    text = added.text;
    assert.equal(toml.stringValue(toml.stageValue(text, stage, "model")), used);
    assert.equal(text.slice(own(name).start, own(name).end), model);
  }
  assert.equal(toml.stageCount(text), 2, "tables within the text of a model are none of the recipe");
  const { start } = own("my-turing-2");
  assert.equal(toml.changeBetween(text, `${text.slice(0, start)}# a word\n${text.slice(start)}`), "keep");
});

test("parameter map: axes lie around what there is, within the ranges; it begins with the reaction", () => {
  const parameter = (name, value, low, high, meaning = "") => ({ name, value, low, high, meaning });
  assert.deepEqual(map.axisAround(parameter("F", 0.04, 0, 1), 0.04), { parameter: "F", low: 0.02, high: 0.06 });
  assert.deepEqual(map.axisAround(parameter("p", -2, -2.5, 0), -2), { parameter: "p", low: -2.5, high: -1 });
  const zero = map.axisAround(parameter("z", 0, null, 1), 0);
  assert.ok(zero.low < zero.high && zero.high <= 1);
  const all = [parameter("Da", 1, 0, null, "diffusion of a"), parameter("F", 1, 0, 1, "feed"), parameter("k", 1, 0, 1, "kill")];
  assert.deepEqual(map.firstPair(all), ["F", "k"]);
});

test("messages: all kinds of blocks come back, at multiples of eight", () => {
  const blocks = {
    bytes: new Uint8Array([1, 2, 3]),
    numbers: new Float64Array([0.1, -1e300]),
    odd: new Float32Array([0.5, 2, -3]),
    index: new Uint32Array([4294967295]),
    none: new Float32Array(),
  };
  const message = engine.decode(engine.encode({ do: "shape", name: "Kätzchen" }, blocks));
  assert.equal(message.header.name, "Kätzchen");
  for (const [name, block] of Object.entries(blocks)) assert.deepEqual(message.blocks[name], block);
  assert.equal(engine.encode({ do: "hello" }).byteLength % 8, 0);
});

test("messages: what is too short or not understood is refused", () => {
  const whole = engine.encode({ do: "x" }, { bytes: new Uint8Array(64) });
  for (let length = 0; length < whole.byteLength; length += 7) assert.throws(() => engine.decode(whole.slice(0, length)));
  assert.throws(() => engine.decode(engine.encode({ blocks: [{ name: "a", type: "f16", count: 1 }] })));
  assert.throws(() => engine.decode(engine.encode({ blocks: [{ name: "a", type: "u8", count: -1 }] })));
  assert.throws(() => engine.decode(engine.encode({ blocks: [{ name: "a", type: "f64", count: 1e12 }] })));
  assert.throws(() => engine.decode(engine.encode({ blocks: 7 })));
});

test("sliders: places and values are each other's inverse, open ranges have ends", () => {
  for (const [low, high, value] of [[0, 10, 0.125], [0, 1, 0.9], [-2, 3, -2], [0, 6, 0.1], [5, 6, 6]]) {
    const curve = adjust.curveFor(low, high, value);
    for (const place of [0, 0.2, 0.5, 1]) assert.ok(Math.abs(curve.place(curve.value(place)) - place) < 1e-9);
    assert.ok(curve.place(low) === 0 && Math.abs(curve.place(high) - 1) < 1e-12);
  }
  const track = (value, low, high) => adjust.trackOf({ name: "p", value, low, high, meaning: "" });
  for (const one of [track(3, null, null), track(-3, null, null), track(0, null, 0), track(0.5, 0, null), track(-9, null, -2), track(null, null, null)]) {
    assert.ok(one.low < one.high);
  }
  assert.deepEqual(track(0.5, 0, 1), { low: 0, high: 1 });
});

test("sliders: sizes stay in the unit in which they were written", () => {
  assert.equal(adjust.scaledLength("0.05", 2, 9), "0.1");
  assert.equal(adjust.scaledLength('"4mm"', 1.5, 9), '"6mm"');
  assert.equal(adjust.scaledLength('"24px"', 0.5, 9), '"12px"');
  assert.equal(adjust.scaledLength(null, 2, 0.04), "0.04");
});
