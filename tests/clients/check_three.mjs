// node check_three.mjs FILE: three.js in headless Chromium (software WebGL) loads and draws the file.
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { spawn } from 'node:child_process';

const three = path.join(process.env.NODE_MODULES, 'three');
const file = path.resolve(process.argv[2]), kind = path.extname(file).slice(1);

// Runs in the browser; posts "ok ..." or the error.
async function inspect(kind) {
  const THREE = await import('three');
  const name = { glb: 'GLTFLoader', ply: 'PLYLoader', obj: 'OBJLoader', vtp: 'VTKLoader' }[kind];
  const loader = new (await import(`three/addons/loaders/${name}.js`))[name]();
  if (loader.setMeshoptDecoder)
    loader.setMeshoptDecoder((await import('three/addons/libs/meshopt_decoder.module.js')).MeshoptDecoder);
  const loaded = await loader.loadAsync('/file');
  const material = new THREE.MeshStandardMaterial({ vertexColors: kind !== 'vtp' });
  const object = loaded.scene || (loaded.isBufferGeometry ? new THREE.Mesh(loaded, material) : loaded);
  const meshes = [];
  let image = false;
  object.traverse(o => o.isMesh && meshes.push(o.geometry) && (image ||= Boolean(o.material.map)));
  if (meshes.length !== 1) throw Error(`one mesh expected, ${meshes.length} arrived`);
  const { position, normal, color } = meshes[0].attributes;
  if (![...position.array].every(Number.isFinite)) throw Error('positions are not finite');
  if (!normal || normal.count !== position.count) throw Error('no normals');
  if (kind !== 'vtp' && !image && (!color || new Set(color.array).size < 8)) throw Error('no colours');  // its loader ignores RGB
  const renderer = new THREE.WebGLRenderer({ canvas: document.createElement('canvas') });
  const scene = new THREE.Scene().add(object, new THREE.HemisphereLight(0xffffff, 0x888888, 3));
  const sphere = new THREE.Box3().setFromObject(object).getBoundingSphere(new THREE.Sphere());
  const camera = new THREE.PerspectiveCamera(40, 1, sphere.radius / 100, sphere.radius * 100);
  camera.position.copy(sphere.center).addScalar(2 * sphere.radius);
  camera.lookAt(sphere.center);
  renderer.render(scene, camera);
  const corners = (meshes[0].index || position).count;
  if (renderer.info.render.triangles !== corners / 3) throw Error(`${renderer.info.render.triangles} triangles drawn`);
  return `ok ${position.count} vertices ${corners / 3} triangles drawn, ${Object.keys(meshes[0].attributes).join(' ')}`;
}

const page = `<!doctype html><script type=importmap>
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}</script>
<script type=module>
const post = text => fetch('/result', { method: 'POST', body: text });
(${inspect})('${kind}').then(post, e => post('error ' + (e && e.stack || e)));
</script>`;

let finish;
const result = new Promise(resolve => { finish = resolve; });
const server = http.createServer((request, response) => {
  if (request.method === 'POST') {
    let text = '';
    request.on('data', part => { text += part; });
    request.on('end', () => { response.end(); finish(text); });
  } else if (request.url === '/') {
    response.setHeader('content-type', 'text/html').end(page);
  } else {
    const wanted = request.url === '/file' ? file : path.join(three, request.url.replace(/^\/three/, ''));
    if (!fs.existsSync(wanted)) return response.writeHead(404).end();
    if (wanted.endsWith('.js')) response.setHeader('content-type', 'text/javascript');
    fs.createReadStream(wanted).pipe(response);
  }
});
await new Promise(resolve => { server.listen(0, '127.0.0.1', resolve); });
const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'three-'));
const browser = spawn('chromium', [
  '--headless', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync', '--disable-dev-shm-usage',
  '--user-data-dir=' + profile, '--remote-debugging-port=0', `http://127.0.0.1:${server.address().port}/`],
{ stdio: 'ignore', detached: true });
browser.on('error', e => finish('error ' + e));
const limit = setTimeout(() => finish('error: no answer from the browser within 120 s'), 120000);
const text = await result;
clearTimeout(limit);
console.log(text);
if (browser.pid) process.kill(-browser.pid, 'SIGKILL');
await new Promise(resolve => { setTimeout(resolve, 300); });
fs.rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
process.exit(text.startsWith('ok ') ? 0 : 1);
