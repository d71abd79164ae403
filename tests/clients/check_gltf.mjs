// node check_gltf.mjs FILE.glb: the Khronos validator; fails on errors and warnings.
import fs from 'node:fs';
import { createRequire } from 'node:module';

const validator = createRequire(process.env.NODE_MODULES + '/')('gltf-validator');
const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])));
const { numErrors, numWarnings, numInfos, messages } = report.issues;
for (const m of messages) console.log(m.code, m.message, m.pointer);
if (numErrors || numWarnings) process.exit(1);
console.log(`ok ${report.info.totalVertexCount} vertices ${report.info.totalTriangleCount} triangles, ` +
  `0 errors 0 warnings ${numInfos} infos`);
