// Builds the site: node build.mjs FOLDER PROGRAM. The studio is in FOLDER/studio already (tools/site.sh).
import { copyFileSync, existsSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { faults, sizeLines } from "./check.mjs";
import { figuresPage, frontPage, galleryPage } from "./gallery.mjs";
import { Docs } from "./markdown.mjs";
import { Site } from "./page.mjs";
import { Reference } from "./reference.mjs";

const root = join(dirname(fileURLToPath(import.meta.url)), "..");
const [folder, program] = process.argv.slice(2);

const engine = existsSync(join(folder, "studio/pelage-engine.wasm"));
const site = new Site(folder, engine);
const docs = new Docs(root, site);
const reference = new Reference(root, site, program);
for (const name of ["style.css", "mark.svg"]) copyFileSync(join(root, "site", name), join(folder, name));
frontPage(root, site, reference);
galleryPage(site, reference);
figuresPage(root, site, reference);
docs.guides();
docs.pages();
reference.pages();

const found = faults(folder);
for (const line of found) console.error(`site: ${line}`);
if (found.length) {
  console.error(`site: ${found.length} faults`);
  process.exit(1);
}
console.log(sizeLines(folder).join("\n"));
if (!engine) {
  console.log("The site has NO engine for browsers: its studio only says so. sh tools/wasm.sh makes one; then make the site again.");
}
