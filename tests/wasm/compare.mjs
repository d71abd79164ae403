// The same runs natively and as WebAssembly (cmake/wasm/cases.cpp): which lines are the same to the bit, and how far the others are
// apart. Usage: node compare.mjs NATIVE_PROGRAM FOLDER_OF_WASM [TOLERANCE]; exit code 77 where there is no such build.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [program, folder, given] = process.argv.slice(2);
const tolerance = Number(given ?? 1e-10);
const script = resolve(folder, "wasm-cases.js");
for (const file of [program, script])
  if (!existsSync(file)) {
    console.log(`no ${file}: nothing was compared`);
    process.exit(77);
  }

const native = spawnSync(program, { encoding: "utf8", maxBuffer: 1 << 30 });
if (native.status !== 0) throw new Error(`${program}: ${native.stderr}`);
const expected = native.stdout.trimEnd().split("\n");
const lines = [];
const run = createRequire(import.meta.url)(script);
await run({
  wasmBinary: readFileSync(join(folder, "wasm-cases.wasm")),
  print: (line) => lines.push(line),
});

/** The largest difference of two lists of numbers, relative to the range of the first. */
function distance(a, b) {
  let low = Infinity, high = -Infinity, worst = 0;
  for (let i = 0; i < a.length; ++i) {
    low = Math.min(low, a[i]);
    high = Math.max(high, a[i]);
    worst = Math.max(worst, Math.abs(a[i] - b[i]));
  }
  return worst / Math.max(high - low, Number.MIN_VALUE);
}

let failures = 0, equal = 0;
if (lines.length !== expected.length) {
  console.log(`FAILED: ${lines.length} lines as WebAssembly, ${expected.length} natively`);
  ++failures;
}
for (let i = 0; i < Math.min(lines.length, expected.length); ++i) {
  if (lines[i] === expected[i]) {
    ++equal;
    continue;
  }
  const [kind, name, count, ...a] = expected[i].split(" ");
  const b = lines[i].split(" ").slice(3);
  const apart = kind === "values" && a.length === b.length ? distance(a.map(Number), b.map(Number)) : Infinity;
  const fails = kind === "values" && !(apart <= tolerance) || kind === "count";
  failures += fails ? 1 : 0;
  const what = kind === "values" ? `values differ by ${apart.toExponential(1)} of their range` : "other bytes";
  console.log(`${fails ? "FAILED: " : ""}${name}: ${what}`);
}
console.log(`${equal} of ${expected.length} lines are the same to the bit, ${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
