// node check_gltf_reading.mjs PELAGE FILE.glb: the program finds the shape where three.js shows it, vertex by vertex.
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { execFileSync } from 'node:child_process';
import { pathToFileURL } from 'node:url';

globalThis.self = globalThis;  // what the loader expects of a browser
globalThis.ProgressEvent = class {};
const root = pathToFileURL(process.env.NODE_MODULES + '/three/');
const THREE = await import(new URL('build/three.module.js', root));
const { GLTFLoader } = await import(new URL('examples/jsm/loaders/GLTFLoader.js', root));
const { PLYLoader } = await import(new URL('examples/jsm/loaders/PLYLoader.js', root));
const [pelage, file] = process.argv.slice(2);
const whole = name => new Uint8Array(fs.readFileSync(name)).buffer;

// Of every triangle the three corners in the world.
async function shown() {
  const { scene } = await new Promise((done, failed) => new GLTFLoader().parse(whole(file), '', done, failed));
  scene.updateMatrixWorld(true);
  const corners = [], matrix = new THREE.Matrix4();
  scene.traverse(mesh => {
    if (!mesh.isMesh) return;
    if (mesh.isSkinnedMesh) mesh.skeleton.update();
    const { index, attributes } = mesh.geometry;
    for (let copy = 0; copy < (mesh.isInstancedMesh ? mesh.count : 1); ++copy)
      for (let i = 0; i < (index || attributes.position).count; ++i) {
        const point = mesh.getVertexPosition(index ? index.getX(i) : i, new THREE.Vector3());
        if (mesh.isInstancedMesh) {
          mesh.getMatrixAt(copy, matrix);
          point.applyMatrix4(matrix);
        }
        corners.push(point.applyMatrix4(mesh.matrixWorld));
      }
  });
  return corners;
}

// The same after the program has read the file and written it again.
function read() {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'reading-')), copy = path.join(folder, 'copy.ply');
  try {
    execFileSync(pelage, ['fair', file, '--steps', '0', '-q', '-o', copy], { stdio: 'pipe' });
    const { index, attributes } = new PLYLoader().parse(whole(copy));
    return [...index.array].map(i => new THREE.Vector3().fromBufferAttribute(attributes.position, i));
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
}

// The largest distance from a point to the nearest of the others.
const away = (points, others) => Math.max(...points.map(p => Math.min(...others.map(q => p.distanceTo(q)))));

const theirs = await shown(), ours = read();
const { low, high, diagonal } = JSON.parse(execFileSync(pelage, ['check', file, '--json']));
const box = new THREE.Box3().setFromPoints(theirs);
const boxes = Math.max(...[...low, ...high].map((x, i) => Math.abs(x - [...box.min, ...box.max][i]))) / diagonal;
const points = Math.max(away(theirs, ours), away(ours, theirs)) / diagonal;
if (ours.length !== theirs.length) throw Error(`${ours.length / 3} triangles instead of ${theirs.length / 3}`);
if (!(boxes < 1e-6 && points < 1e-6)) throw Error(`box off by ${boxes}, vertices by ${points} of the diagonal`);
console.log(`ok ${ours.length / 3} triangles, vertices within ${points.toExponential(0)} of the diagonal`);
