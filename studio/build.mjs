// Bundles the page: node build.mjs --outdir=DIR. What it writes works from any folder of any file server.
import { cpSync, copyFileSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const given = process.argv.find((argument) => argument.startsWith("--outdir="));
const outdir = resolve(given ? given.slice("--outdir=".length) : join(here, "../out/studio"));

await build({
  entryPoints: { studio: join(here, "src/main.ts") },
  outdir,
  bundle: true,
  minify: !process.argv.includes("--plain"),
  format: "esm",
  target: ["chrome111", "firefox115", "safari16.4"],
  legalComments: "none",
  banner: { js: "/* Pelage Studio, MIT licence. Contains three.js, copyright three.js authors, MIT licence. */" },
  logLevel: "warning",
});
mkdirSync(outdir, { recursive: true });
copyFileSync(join(here, "src/index.html"), join(outdir, "index.html"));
copyFileSync(join(here, "src/style.css"), join(outdir, "studio.css"));
for (const kind of ["recipes", "models"]) {
  const source = join(here, "../docs/gallery", kind);
  const target = join(outdir, "gallery", kind);
  rmSync(target, { recursive: true, force: true });
  mkdirSync(target, { recursive: true });
  for (const name of readdirSync(source)) {
    if (/\.(png|jpg|webp)$/.test(name)) cpSync(join(source, name), join(target, name));
  }
}
