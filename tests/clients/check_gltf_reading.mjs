// node check_gltf_reading.mjs PELAGE FILE.glb: the program finds the shape where three.js shows it.
import fs from 'node:fs';
import { execFileSync } from 'node:child_process';
import { pathToFileURL } from 'node:url';

globalThis.self = globalThis;  // what the loader expects of a browser
globalThis.ProgressEvent = class {};
const root = pathToFileURL(process.env.NODE_MODULES + '/three/');
const THREE = await import(new URL('build/three.module.js', root));
const { GLTFLoader } = await import(new URL('examples/jsm/loaders/GLTFLoader.js', root));

const [pelage, file] = process.argv.slice(2);
const bytes = new Uint8Array(fs.readFileSync(file)).buffer;
const { scene } = await new Promise((done, failed) => new GLTFLoader().parse(bytes, '', done, failed));
scene.updateMatrixWorld(true);
const box = new THREE.Box3(), point = new THREE.Vector3(), matrix = new THREE.Matrix4();
let points = 0;
scene.traverse(mesh => {
  if (!mesh.isMesh) return;
  if (mesh.isSkinnedMesh) mesh.skeleton.update();
  for (let copy = 0; copy < (mesh.isInstancedMesh ? mesh.count : 1); ++copy) {
    for (let i = 0; i < mesh.geometry.attributes.position.count; ++i, ++points) {
      mesh.getVertexPosition(i, point);
      if (mesh.isInstancedMesh) {
        mesh.getMatrixAt(copy, matrix);
        point.applyMatrix4(matrix);
      }
      box.expandByPoint(point.applyMatrix4(mesh.matrixWorld));
    }
  }
});
const ours = JSON.parse(execFileSync(pelage, ['check', file, '--json']));
const theirs = [...box.min.toArray(), ...box.max.toArray()];
const away = Math.max(...[...ours.low, ...ours.high].map((x, i) => Math.abs(x - theirs[i]))) / ours.diagonal;
if (ours.vertices !== points || !(away < 1e-6)) throw Error(`${ours.vertices} of ${points} vertices, box off by ${away}`);
console.log(`ok ${points} vertices, boxes agree to ${away.toExponential(0)} of the diagonal`);
