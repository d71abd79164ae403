// The same requests to the native engine, over HTTP, and to the one of WebAssembly, through the page's worker script: the
// same replies, numbers to 1e-10 and bytes to the bit. Usage: node engines.mjs PELAGE FOLDER_OF_WASM
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { request } from "node:http";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [program, folder] = process.argv.slice(2);
const sizes = { u8: 1, u32: 4, f32: 4, f64: 8 };
const arrays = { u8: Uint8Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };

function encode(header, bytes) {
  if (bytes) header = { ...header, blocks: [{ name: "bytes", type: "u8", count: bytes.length }] };
  const text = new TextEncoder().encode(JSON.stringify(header));
  const begin = Math.ceil((4 + text.length) / 8) * 8;
  const message = new Uint8Array(begin + (bytes?.length ?? 0));
  new DataView(message.buffer).setUint32(0, text.length, true);
  message.set(text, 4);
  if (bytes) message.set(bytes, begin);
  return message.buffer;
}

function decode(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const blocks = {};
  let at = 4 + length;
  for (const { name, type, count } of header.blocks ?? []) {
    at = Math.ceil(at / 8) * 8;
    blocks[name] = new arrays[type](buffer.slice(at, at + count * sizes[type]));
    at += count * sizes[type];
  }
  return { header, blocks };
}

/** The native engine, which prints its link. */
async function nativeEngine() {
  const page = mkdtempSync(join(tmpdir(), "pelage-engines-"));
  writeFileSync(join(page, "index.html"), "<!doctype html>");
  const child = spawn(program, ["studio", "--no-open", "--page", page], { stdio: ["ignore", "pipe", "inherit"] });
  const [, origin, token] = await new Promise((done, fail) => {
    let text = "";
    child.stdout.on("data", (data) => {
      text += data;
      const link = text.match(/(http:\/\/[^/\s]+)\/#token=(\w+)/);
      if (link) done(link);
    });
    child.on("exit", (code) => fail(new Error(`pelage studio ended with ${code}`)));
  });
  return {
    // A connection for each: one that is kept may be closed just as it is used again.
    ask: (body) => new Promise((done, fail) => {
      const options = { method: "POST", agent: false, headers: { "X-Pelage-Token": token } };
      const sent = request(`${origin}/api`, options, async (reply) => {
        const parts = [];
        for await (const part of reply) parts.push(part);
        done(new Uint8Array(Buffer.concat(parts)).buffer);
      });
      sent.on("error", fail);
      sent.end(new Uint8Array(body));
    }),
    end: () => {
      child.removeAllListeners("exit");
      child.kill();
      rmSync(page, { recursive: true });
    },
  };
}

/** The worker script as a browser would run it. */
function workerEngine() {
  const require = createRequire(import.meta.url);
  const replies = [];
  const self = { postMessage: (reply) => replies.shift()(reply) };
  let create;
  const importScripts = (name) => {
    create = require(resolve(folder, name));
  };
  const wasmBinary = readFileSync(join(folder, "pelage-engine.wasm"));
  const source = readFileSync(join(folder, "engine-worker.js"), "utf8");
  new Function("self", "importScripts", "createPelageEngine", source)(self, importScripts, () => create({ wasmBinary }));
  return {
    ask: (data) => new Promise((done) => {
      replies.push(done);
      self.onmessage({ data });
    }),
  };
}

let failures = 0, checks = 0;
function fail(what) {
  if (++failures <= 20) console.log(`FAILED: ${what}`);
}

const may_differ = new Set(["engine", "threads"]);

/** Numbers to 1e-10 of their size, the rest exactly. */
function same(a, b, path) {
  ++checks;
  if (typeof a === "number" && typeof b === "number") {
    if (Math.abs(a - b) > 1e-10 * Math.max(1, Math.abs(a))) fail(`${path}: ${a} natively, ${b} as WebAssembly`);
  } else if (a && b && typeof a === "object" && typeof b === "object") {
    for (const key of new Set([...Object.keys(a), ...Object.keys(b)]))
      if (!may_differ.has(key)) same(a[key], b[key], `${path}.${key}`);
  } else if (a !== b) {
    fail(`${path}: ${JSON.stringify(a)} natively, ${JSON.stringify(b)} as WebAssembly`);
  }
}

function sameBlocks(a, b, path) {
  same(Object.keys(a), Object.keys(b), path);
  for (const name of Object.keys(a)) {
    ++checks;
    const x = a[name], y = b[name];
    let differ = 0;
    for (let i = 0; i < x.length; ++i) differ += x[i] === y?.[i] ? 0 : 1;
    if (differ > 0 || x.length !== y.length) fail(`${path}.${name}: ${differ} of ${x.length} numbers differ`);
  }
}

const native = await nativeEngine(), wasm = workerEngine();

/** Replies of both; `bytes` may be different for the two. */
async function askBoth(header, bytes, others = bytes) {
  return (await Promise.all([native.ask(encode(header, bytes)), wasm.ask(encode(header, others))])).map(decode);
}

async function ask(header, bytes, others = bytes) {
  const [a, b] = await askBoth(header, bytes, others);
  same(a.header, b.header, header.do);
  sameBlocks(a.blocks, b.blocks, header.do);
  return b;
}

const recipe = '[[stage]]\nname = "large"\nmodel = "turing"\nsize = 0.2\nsteps = 60\n[[stage]]\nname = "rings"\n' +
  'model = "turing"\nsize = 0.15\nmask = "large.b < 4"\npin = { a = 4, b = 3.7 }\nsteps = 40\n';
const obj = new TextEncoder().encode("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
const advance = { do: "advance", milliseconds: 10000, steps: 30 };

const { header } = await ask({ do: "hello" });
if (header.engine !== "wasm") fail(`hello: the engine is ${header.engine}`);
await ask({ do: "catalog" });
await ask({ do: "recipe_text", name: "leopard" });
await ask({ do: "nothing" });
await ask({ do: "check", recipe: "[[stage]]\nmodel = \"turng\"\n" });
await ask({ do: "shape", name: "none.obj" }, new Uint8Array([1, 2, 3]));
await ask({ do: "shape", name: "tetrahedron.obj" }, obj);
await ask({ do: "shape", name: "builtin:sphere?n=642" });
await ask({ do: "begin", recipe });
for (let i = 0; i < 4; ++i) await ask(advance);
await ask({ do: "field", species: "b" });
const { state } = (await ask({ do: "keep_state" })).header;
await ask({ do: "paint", species: "b", value: 9, radius: 0.3, hardness: 0.5, points: [[0, 1, 0], [1, 0, 0]] });
await ask({ do: "restore_state", state });
await ask({ do: "sample", point: [0, 1, 0] });
await ask({ do: "analyse", recipe, stage: 0 });
for (const format of [".glb", ".ply", ".obj", ".stl"]) {
  // The native engine writes into files what made them, so that they are compared as shapes (the bytes: compare.mjs).
  const [a, b] = await askBoth({ do: "export", format, name: "coat" });
  same(a.header.losses, b.header.losses, `export ${format}`);
  await ask({ do: "shape", name: `back${format}` }, a.blocks.bytes, b.blocks.bytes);
  await ask({ do: "shape", name: "builtin:sphere?n=642" });
  await ask({ do: "begin", recipe });
}
const x = { parameter: "s", low: 0.02, high: 0.08, count: 5 }, y = { parameter: "Db", low: 0.02, high: 0.1, count: 4 };
await ask({ do: "parameter_map", recipe, stage: 0, x, y });
await ask({ do: "map_tile", recipe, stage: 0, x, y, texels: 32 });
native.end();
console.log(`${checks} comparisons of the two engines, ${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
