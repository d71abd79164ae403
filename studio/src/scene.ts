/** The surface as it is seen: three.js, the camera and its keys, the light, the brush's ring, and what lies under a pixel. */

import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";
import type { View } from "./link";
import type { ShapeInfo, Vec3 } from "./protocol";

export interface Hit {
  point: Vec3;
  normal: Vec3;
}

/** Backgrounds: the colour in the middle and at the rim. */
export const backgrounds: Record<string, [string, string]> = {
  studio: ["#55565a", "#232427"],
  night: ["#1d1e22", "#0b0c0e"],
  paper: ["#fbfaf7", "#dcd9d2"],
  none: ["transparent", "transparent"],
};

const maxRings = 8;
const skyStrength = 2.6;
const roomStrength = 0.42;
export const reducedMotion = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

interface Uniforms {
  [name: string]: three.IUniform;
  bare: { value: number };
  rings: { value: three.Vector3[] };
  ringCount: { value: number };
  ringRadius: { value: number };
  tint: { value: three.Color };
}

/** The coat's bytes are sRGB; light is computed in linear numbers. The ring and what is masked are drawn by the surface itself. */
function dressMaterial(material: three.MeshStandardMaterial, uniforms: Uniforms): void {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace(
        "#include <common>",
        `#include <common>
        attribute vec4 coat; attribute float painted;
        varying vec4 vCoat; varying float vPainted; varying vec3 vPlace;
        vec3 linearLight(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }`,
      )
      .replace(
        "#include <begin_vertex>",
        `#include <begin_vertex>
        vCoat = vec4(linearLight(coat.rgb), coat.a); vPainted = painted; vPlace = position;`,
      );
    shader.fragmentShader = shader.fragmentShader
      .replace(
        "#include <common>",
        `#include <common>
        varying vec4 vCoat; varying float vPainted; varying vec3 vPlace;
        uniform float bare; uniform vec3 rings[${maxRings}]; uniform int ringCount; uniform float ringRadius; uniform vec3 tint;`,
      )
      .replace(
        "#include <color_fragment>",
        `diffuseColor *= mix(vCoat, vec4(0.52, 0.50, 0.47, 1.0), bare);
        diffuseColor.rgb = mix(diffuseColor.rgb, tint, 0.7 * vPainted);
        if (diffuseColor.a < 0.02) discard;`,
      )
      .replace(
        "#include <dithering_fragment>",
        `#include <dithering_fragment>
        for (int i = 0; i < ${maxRings}; ++i) {
          if (i >= ringCount) break;
          float away = distance(vPlace, rings[i]);
          float pixels = abs(away - ringRadius) / max(fwidth(away), 1e-9);
          float strength = i == 0 ? 1.0 : 0.55;
          gl_FragColor.rgb = mix(gl_FragColor.rgb, vec3(0.05), strength * 0.6 * (1.0 - smoothstep(1.6, 2.8, pixels)));
          gl_FragColor.rgb = mix(gl_FragColor.rgb, vec3(1.0), strength * (1.0 - smoothstep(0.7, 1.5, pixels)));
        }`,
      );
  };
}

const pickVertex = `varying vec3 place; varying vec3 up;
void main() { place = position; up = normal; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;
const pickFragment = `uniform bool normals; varying vec3 place; varying vec3 up;
void main() { gl_FragColor = vec4(normals ? normalize(up) : place, 1.0); }`;

export class Scene {
  readonly canvas: HTMLCanvasElement;
  onView: () => void = () => undefined;
  private readonly renderer: three.WebGLRenderer;
  private readonly scene = new three.Scene();
  private readonly camera = new three.PerspectiveCamera(30, 1, 0.01, 100);
  private controls: OrbitControls;
  private readonly material = new three.MeshStandardMaterial({ roughness: 0.75, metalness: 0, side: three.DoubleSide });
  private readonly uniforms: Uniforms;
  private mesh: three.Mesh<three.BufferGeometry, three.MeshStandardMaterial>;
  /** What a room sheds on a matt surface, as `room` has it: its irradiance by spherical harmonics, kept to two colours. */
  private readonly sky = new three.HemisphereLight(0xffffff, new three.Color(0.24, 0.24, 0.24), skyStrength);
  private readonly key = new three.DirectionalLight(0xfff4e6, 1.25);
  private readonly rim = new three.DirectionalLight(0xdde8ff, 0.6);
  private readonly ground: three.Mesh;
  private readonly pickScene = new three.Scene();
  private readonly pickMesh: three.Mesh;
  private readonly pickMaterial: three.ShaderMaterial;
  private readonly pickTarget: three.WebGLRenderTarget;
  /** The mesh on which it grows, where a finer one is shown. */
  private coarse: three.BufferGeometry | null = null;
  private room: three.Texture | null = null;
  private middle = new three.Vector3();
  private diagonal = 1;
  private up: "y" | "z" = "y";
  private dirty = true;
  private continuous = false;
  private background = "studio";

  constructor(private readonly host: HTMLElement) {
    this.renderer = new three.WebGLRenderer({ antialias: true, alpha: true, powerPreference: "high-performance" });
    this.renderer.toneMapping = three.NeutralToneMapping;
    this.renderer.setClearColor(0, 0);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.autoUpdate = false;
    this.canvas = this.renderer.domElement;
    this.uniforms = {
      bare: { value: 0 },
      rings: { value: Array.from({ length: maxRings }, () => new three.Vector3()) },
      ringCount: { value: 0 },
      ringRadius: { value: 0 },
      tint: { value: new three.Color(0.1, 0.55, 0.9) },
    };
    dressMaterial(this.material, this.uniforms);
    this.mesh = new three.Mesh(new three.BufferGeometry(), this.material);
    this.ground = new three.Mesh(new three.CircleGeometry(1, 64), new three.ShadowMaterial({ opacity: 0.28 }));
    this.pickMaterial = new three.ShaderMaterial({
      vertexShader: pickVertex,
      fragmentShader: pickFragment,
      uniforms: { normals: { value: false } },
      side: three.DoubleSide,
      toneMapped: false,
    });
    this.pickMesh = new three.Mesh(this.mesh.geometry, this.pickMaterial);
    this.pickTarget = new three.WebGLRenderTarget(1, 1, {
      type: three.FloatType,
      minFilter: three.NearestFilter,
      magFilter: three.NearestFilter,
    });
    this.furnish();
    this.controls = this.makeControls();
    this.canvas.tabIndex = 0;
    this.canvas.addEventListener("keydown", (event) => this.onKey(event));
    host.prepend(this.canvas);
    new ResizeObserver(() => this.resize()).observe(host);
    this.resize();
    const tick = (): void => {
      requestAnimationFrame(tick);
      this.draw();
    };
    tick();
  }

  private furnish(): void {
    this.key.castShadow = true;
    this.key.shadow.mapSize.set(1024, 1024);
    this.key.shadow.radius = 5;
    this.mesh.castShadow = this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = this.pickMesh.frustumCulled = false;
    this.ground.receiveShadow = true;
    this.scene.add(this.mesh, this.ground, this.sky, this.key, this.key.target, this.rim, this.rim.target);
    this.pickScene.add(this.pickMesh);
  }

  private makeControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.enableDamping = !reducedMotion();
    controls.dampingFactor = 0.12;
    controls.autoRotateSpeed = 4;
    controls.addEventListener("change", () => this.touch());
    return controls;
  }

  /** Asks for a new picture with the next frame of the display. */
  touch(): void {
    this.dirty = true;
  }

  private draw(): void {
    this.controls.update();
    if (!this.dirty && !this.continuous) return;
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
    this.onView();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
    this.touch();
  }

  /** A new shape: the camera, the light and the ground are set for its box. */
  setShape(info: ShapeInfo, keepView: boolean): void {
    const low = new three.Vector3(...info.low);
    const high = new three.Vector3(...info.high);
    this.middle.addVectors(low, high).multiplyScalar(0.5);
    this.diagonal = info.diagonal || 1;
    if (this.up !== info.up) {
      this.up = info.up;
      this.camera.up.set(0, this.up === "y" ? 1 : 0, this.up === "z" ? 1 : 0);
      this.controls.dispose();
      this.controls = this.makeControls();
    }
    const d = this.diagonal;
    this.controls.minDistance = 0.05 * d;
    this.controls.maxDistance = 12 * d;
    this.camera.near = 0.02 * d;
    this.camera.far = 30 * d;
    this.placeLights(d);
    this.ground.position.copy(this.middle);
    this.ground.position[this.up] = low[this.up] - 0.002 * d;
    this.ground.rotation.x = this.up === "y" ? -Math.PI / 2 : 0;
    this.ground.scale.setScalar(3 * d);
    if (!keepView) this.frame();
    this.camera.updateProjectionMatrix();
    this.touch();
  }

  private placeLights(d: number): void {
    const at = (x: number, up: number, toward: number): three.Vector3 =>
      (this.up === "y" ? new three.Vector3(x, up, toward) : new three.Vector3(x, -toward, up)).multiplyScalar(d).add(this.middle);
    this.key.position.copy(at(0.9, 1.9, 1.2));
    this.rim.position.copy(at(-1.4, 0.9, -1.3));
    this.sky.position.copy(at(0, 0.72, 0.69).sub(this.middle));
    this.scene.environmentRotation.x = this.up === "y" ? 0 : Math.PI / 2;
    this.key.target.position.copy(this.middle);
    this.rim.target.position.copy(this.middle);
    const shadow = this.key.shadow.camera;
    [shadow.left, shadow.right, shadow.top, shadow.bottom] = [-0.8 * d, 0.8 * d, 0.8 * d, -0.8 * d];
    shadow.near = 0.2 * d;
    shadow.far = 6 * d;
    shadow.updateProjectionMatrix();
    this.key.shadow.normalBias = 0.004 * d;
    this.key.shadow.bias = -0.0008;
  }

  /** Looks at all of the shape, from the side and a little from above. */
  frame(): void {
    const portrait = Math.max(1, 1.05 / this.camera.aspect);
    const distance = 1.85 * portrait;
    const direction = this.up === "y" ? new three.Vector3(0.5, 0.34, 1) : new three.Vector3(0.5, -1, 0.34);
    direction.normalize().multiplyScalar(distance);
    this.setView({ eye: [direction.x, direction.y, direction.z], target: [0, 0, 0] });
  }

  view(): View {
    const eye = this.camera.position.clone().sub(this.controls.target).divideScalar(this.diagonal);
    const target = this.controls.target.clone().sub(this.middle).divideScalar(this.diagonal);
    return { eye: [eye.x, eye.y, eye.z], target: [target.x, target.y, target.z] };
  }

  setView(view: View): void {
    this.controls.target.set(...view.target).multiplyScalar(this.diagonal).add(this.middle);
    this.camera.position.set(...view.eye).multiplyScalar(this.diagonal).add(this.controls.target);
    this.controls.update();
    this.touch();
  }

  /** A new mesh to grow on; all arrays are taken as they are. */
  setMesh(positions: Float32Array, normals: Float32Array, triangles: Uint32Array, colors: Uint8Array): void {
    this.coarse?.dispose();
    this.coarse = null;
    this.mesh.geometry.dispose();
    this.show(this.geometryOf(positions, normals, triangles, colors));
    this.setTransparent(colors);
  }

  /** A finer mesh of a coat that stands still; it goes with the next colours of the one that it grows on. */
  setFine(positions: Float32Array, normals: Float32Array, triangles: Uint32Array, colors: Uint8Array): void {
    if (this.coarse) this.mesh.geometry.dispose();
    else this.coarse = this.mesh.geometry;
    this.show(this.geometryOf(positions, normals, triangles, colors));
  }

  private toCoarse(): void {
    if (!this.coarse) return;
    this.mesh.geometry.dispose();
    this.show(this.coarse);
    this.coarse = null;
  }

  private show(geometry: three.BufferGeometry): void {
    this.mesh.geometry = this.pickMesh.geometry = geometry;
    this.renderer.shadowMap.needsUpdate = true;
    this.touch();
  }

  private geometryOf(positions: Float32Array, normals: Float32Array, triangles: Uint32Array, colors: Uint8Array): three.BufferGeometry {
    const geometry = new three.BufferGeometry();
    const dynamic = (attribute: three.BufferAttribute): three.BufferAttribute => attribute.setUsage(three.DynamicDrawUsage);
    geometry.setAttribute("position", dynamic(new three.BufferAttribute(positions, 3)));
    geometry.setAttribute("normal", dynamic(new three.BufferAttribute(normals, 3)));
    geometry.setAttribute("coat", dynamic(new three.BufferAttribute(colors, 4, true)));
    geometry.setAttribute("painted", dynamic(new three.BufferAttribute(new Uint8Array(positions.length / 3), 1, true)));
    geometry.setIndex(new three.BufferAttribute(triangles, 1));
    return geometry;
  }

  get positions(): Float32Array {
    const attribute = this.mesh.geometry.getAttribute("position") as three.BufferAttribute | undefined;
    return (attribute?.array ?? new Float32Array()) as Float32Array;
  }

  private update(name: string, values: ArrayLike<number>): void {
    const attribute = this.mesh.geometry.getAttribute(name) as three.BufferAttribute | undefined;
    if (!attribute || attribute.array.length !== values.length) return;
    (attribute.array as Uint8Array).set(values);
    attribute.needsUpdate = true;
    this.touch();
  }

  setColors(colors: Uint8Array): void {
    this.toCoarse();
    this.update("coat", colors);
  }

  /** Whether some of the coat is see-through decides how it is drawn; it is asked when the look changes. */
  setTransparent(colors: Uint8Array): void {
    let seeThrough = false;
    for (let i = 3; i < colors.length && !seeThrough; i += 4) seeThrough = colors[i]! < 250;
    if (this.material.transparent === seeThrough) return;
    this.material.transparent = seeThrough;
    this.material.needsUpdate = true;
  }

  movePositions(positions: Float32Array, normals: Float32Array): void {
    this.toCoarse();
    this.update("position", positions);
    this.update("normal", normals);
    this.renderer.shadowMap.needsUpdate = true;
  }

  /** How strongly each node is marked as painted by a mask or map, from 0 to 255; null: nothing is marked. */
  setPainted(values: Uint8Array | null, tint: string): void {
    this.uniforms.tint.value.set(tint);
    this.update("painted", values ?? new Uint8Array(this.positions.length / 3));
  }

  setBare(bare: boolean): void {
    this.uniforms.bare.value = bare ? 1 : 0;
    this.touch();
  }

  /** The rings of the brush on the surface, the first one under the pointer. */
  setRings(centres: Vec3[], radius: number): void {
    this.uniforms.ringCount.value = Math.min(maxRings, centres.length);
    centres.slice(0, maxRings).forEach((centre, i) => this.uniforms.rings.value[i]!.set(...centre));
    this.uniforms.ringRadius.value = radius;
    this.touch();
  }

  setSurface(roughness: number, metalness: number): void {
    this.material.roughness = Math.min(1, Math.max(0.02, roughness));
    this.material.metalness = Math.min(1, Math.max(0, metalness));
    this.reflectRoom(roughness < 0.6 || metalness > 0.05);
    this.touch();
  }

  /** Only what shines needs a room to mirror, whose blurred images take seconds to make where a processor draws. */
  private reflectRoom(on: boolean): void {
    if (on && !this.room) {
      const pmrem = new three.PMREMGenerator(this.renderer);
      this.room = pmrem.fromScene(new RoomEnvironment(), 0.04).texture;
      pmrem.dispose();
    }
    this.scene.environment = on ? this.room : null;
    this.sky.visible = !on;
  }

  setLight(strength: number): void {
    this.scene.environmentIntensity = roomStrength * strength;
    this.sky.intensity = skyStrength * strength;
    this.key.intensity = 1.25 * strength;
    this.rim.intensity = 0.6 * strength;
    this.touch();
  }

  setBackground(name: string): void {
    this.background = name in backgrounds ? name : "studio";
    const [inner, outer] = backgrounds[this.background]!;
    this.host.style.setProperty("--inner", inner);
    this.host.style.setProperty("--outer", outer);
    this.host.dataset["background"] = this.background;
    this.ground.visible = this.background !== "none";
    this.touch();
  }

  set turntable(on: boolean) {
    this.controls.autoRotate = on;
  }

  get turntable(): boolean {
    return this.controls.autoRotate;
  }

  /** Whether the mouse turns the camera; a brush stroke switches it off for its time. */
  set orbiting(on: boolean) {
    this.controls.enabled = on;
  }

  /** World units that a pixel of the page spans at the depth of the orbit's target. */
  get unitsPerPixel(): number {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / (this.canvas.clientHeight || 1);
  }

  /** What lies under a place of the page: one pixel is drawn with positions and normals in place of colours. */
  pick(clientX: number, clientY: number): Hit | null {
    const box = this.canvas.getBoundingClientRect();
    const x = clientX - box.left;
    const y = clientY - box.top;
    if (x < 0 || y < 0 || x >= box.width || y >= box.height) return null;
    this.camera.setViewOffset(box.width, box.height, x, y, 1, 1);
    const place = this.drawPick(false);
    const normal = place[3]! > 0 ? this.drawPick(true) : place;
    this.camera.clearViewOffset();
    if (!(place[3]! > 0)) return null;
    return { point: [place[0]!, place[1]!, place[2]!], normal: [normal[0]!, normal[1]!, normal[2]!] };
  }

  private drawPick(normals: boolean): Float32Array {
    const pixel = new Float32Array(4);
    this.pickMaterial.uniforms["normals"]!.value = normals;
    this.renderer.setRenderTarget(this.pickTarget);
    this.renderer.clear();
    this.renderer.render(this.pickScene, this.camera);
    this.renderer.readRenderTargetPixels(this.pickTarget, 0, 0, 1, 1, pixel);
    this.renderer.setRenderTarget(null);
    return pixel;
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turn = 0.12;
    const moves: Record<string, () => void> = {
      ArrowLeft: () => this.turn(-turn, 0),
      ArrowRight: () => this.turn(turn, 0),
      ArrowUp: () => this.turn(0, -turn),
      ArrowDown: () => this.turn(0, turn),
      "+": () => this.zoom(0.88),
      "=": () => this.zoom(0.88),
      "-": () => this.zoom(1 / 0.88),
    };
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    move();
  }

  turn(around: number, over: number): void {
    const upright = new three.Quaternion().setFromUnitVectors(this.camera.up, new three.Vector3(0, 1, 0));
    const offset = this.camera.position.clone().sub(this.controls.target).applyQuaternion(upright);
    const sphere = new three.Spherical().setFromVector3(offset);
    sphere.theta += around;
    sphere.phi = Math.min(Math.PI - 0.05, Math.max(0.05, sphere.phi + over));
    offset.setFromSpherical(sphere).applyQuaternion(upright.invert());
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.touch();
  }

  zoom(factor: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.setLength(Math.min(this.controls.maxDistance, Math.max(this.controls.minDistance, offset.length() * factor)));
    this.camera.position.copy(this.controls.target).add(offset);
    this.touch();
  }

  /** The picture as it is seen, without the brush's ring, so many times larger than on the page. */
  async picture(scale: number): Promise<Blob> {
    const { clientWidth: width, clientHeight: height } = this.host;
    const rings = this.uniforms.ringCount.value;
    this.uniforms.ringCount.value = 0;
    this.renderer.setPixelRatio(scale);
    this.renderer.setSize(width, height);
    this.renderer.render(this.scene, this.camera);
    const copy = document.createElement("canvas");
    copy.width = width * scale;
    copy.height = height * scale;
    const context = copy.getContext("2d");
    if (!context) throw new Error("The browser cannot make the picture.");
    this.paintBackground(context, copy.width, copy.height);
    context.drawImage(this.canvas, 0, 0, copy.width, copy.height);
    this.uniforms.ringCount.value = rings;
    this.resize();
    return new Promise((resolve, reject) =>
      copy.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("The browser cannot make the picture."))), "image/png"),
    );
  }

  private paintBackground(context: CanvasRenderingContext2D, width: number, height: number): void {
    if (this.background === "none") return;
    const [inner, outer] = backgrounds[this.background]!;
    const gradient = context.createRadialGradient(0.5 * width, 0.45 * height, 0, 0.5 * width, 0.45 * height, 0.75 * Math.max(width, height));
    gradient.addColorStop(0, inner);
    gradient.addColorStop(1, outer);
    context.fillStyle = gradient;
    context.fillRect(0, 0, width, height);
  }

  /** A film of the canvas until `stop` is called; null where the browser cannot. */
  record(): { stop: () => Promise<Blob> } | null {
    const type = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((t) => window.MediaRecorder?.isTypeSupported(t));
    if (!type || !this.canvas.captureStream) return null;
    const chunks: Blob[] = [];
    const recorder = new MediaRecorder(this.canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 8e6 });
    const inside = this.scene.background;
    if (this.background !== "none") this.scene.background = new three.Color(backgrounds[this.background]![1]);
    this.continuous = true;
    recorder.ondataavailable = (event) => chunks.push(event.data);
    recorder.start(500);
    const stop = (): Promise<Blob> =>
      new Promise((resolve) => {
        recorder.onstop = () => {
          this.continuous = false;
          this.scene.background = inside;
          this.touch();
          resolve(new Blob(chunks, { type: "video/webm" }));
        };
        recorder.stop();
      });
    return { stop };
  }
}
