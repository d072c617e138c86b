// A server's world by three.js: terrain and pieces with materials of this page's own, and shadows. A click carves; dragging
// turns the camera, the wheel moves it. The server of the page is the server of the world.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { connect } from 'scree-client';

const SKY = 0xa9c4dc, RADIUS_M = 64, MESHING_MS = 6, LOADING_MS = 30;
const canvas = document.querySelector('#view'), state = document.querySelector('#state');
Object.assign(document.body.style, { margin: '0', overflow: 'hidden', font: '14px sans-serif' });
Object.assign(state.style, { position: 'fixed', left: '12px', top: '10px' });

const client = await connect(location.origin, { name: 'three.js', smooth: true, radius: RADIUS_M, program: 'three-example' })
  .catch((error) => {
    state.value = error.message;
    throw error;
  });
await client.loaded();
const mesher = client.mesher({ radius: RADIUS_M / 2 });

// ---- the scene

const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
renderer.shadowMap.enabled = true;
renderer.toneMapping = THREE.ACESFilmicToneMapping;
const scene = new THREE.Scene();
scene.background = new THREE.Color(SKY);
scene.fog = new THREE.Fog(SKY, RADIUS_M / 2, RADIUS_M);
scene.add(new THREE.HemisphereLight(SKY, 0x6b5a48, 0.9));

const sun = new THREE.DirectionalLight(0xfff0d8, 3.2);
sun.castShadow = true;
sun.shadow.mapSize.set(2048, 2048);
sun.shadow.normalBias = 0.08;
Object.assign(sun.shadow.camera, { left: -30, right: 30, top: 30, bottom: -30, far: 160 });
scene.add(sun, sun.target);

const rock = new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.95 });
const rubble = new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.7, color: 0xffd9b0 });

const camera = new THREE.PerspectiveCamera(60, 1, 0.1, 2 * RADIUS_M);
const controls = new OrbitControls(camera, canvas);
// From where visitors begin, along the way that is free the farthest.
const { eye } = client.status();
const ways = Array.from({ length: 16 }, (_, i) => [Math.cos(i * Math.PI / 8), -0.25, Math.sin(i * Math.PI / 8)]);
const free = (way) => client.cast(eye, way, { most: RADIUS_M })?.distance ?? RADIUS_M;
const ahead = ways.reduce((best, way) => (free(way) > free(best) ? way : best));
camera.position.fromArray(eye);
controls.target.fromArray(eye.map((x, i) => x + Math.min(free(ahead), 16) * ahead[i]));

// ---- from meshes to objects

let colours = [];
function read_palette() {
  colours = [];
  for (let row; (row = client.material(colours.length));) colours.push(row.colour);
}

/** A vertex has its material's colour, darker in crevices. */
function geometry_of(mesh) {
  const tints = new Float32Array(mesh.positions.length);
  mesh.materials.forEach((material, vertex) => {
    const light = 0.35 + 0.65 * mesh.shades[vertex] / 255;
    for (let i = 0; i < 3; ++i) tints[3 * vertex + i] = light * colours[material][i];
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(mesh.positions, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(mesh.normals, 3));
  geometry.setAttribute('color', new THREE.BufferAttribute(tints, 3));
  geometry.setIndex(new THREE.BufferAttribute(mesh.indices, 1));
  return geometry;
}

const terrain = new Map(), pieces = new Map(); // objects by node, and by id
let bodies = null; // poses of the last frame, whose arrays the next one takes

function remove(objects, key) {
  const object = objects.get(key);
  if (!object) return;
  scene.remove(object);
  object.geometry.dispose();
  objects.delete(key);
}

function show(mesh) {
  const is_piece = mesh.kind === 'piece', objects = is_piece ? pieces : terrain;
  const key = is_piece ? mesh.id : `${mesh.level}: ${mesh.node}`;
  remove(objects, key);
  if (mesh.gone) return;
  const object = new THREE.Mesh(geometry_of(mesh), is_piece ? rubble : rock);
  object.castShadow = object.receiveShadow = true;
  if (!is_piece) object.position.fromArray(mesh.origin);
  objects.set(key, object);
  scene.add(object);
}

function move_pieces() {
  bodies = client.bodies(client.drawTick(), bodies);
  const { count, ids, positions, rotations } = bodies;
  for (let i = 0; i < count; ++i) {
    const object = pieces.get(ids[i]);
    object?.position.fromArray(positions, 3 * i);
    object?.quaternion.fromArray(rotations, 4 * i);
  }
}

// ---- what happens

async function hear() {
  for await (const event of client.events()) {
    if (event.kind === 'palette') read_palette();
    if (event.kind !== 'joined') continue;
    for (const objects of [terrain, pieces]) for (const key of [...objects.keys()]) remove(objects, key);
    read_palette();
  }
}

let pressed = null;
canvas.addEventListener('pointerdown', ({ clientX, clientY }) => { pressed = [clientX, clientY]; });
canvas.addEventListener('pointerup', async ({ clientX, clientY }) => {
  if (!pressed || Math.hypot(clientX - pressed[0], clientY - pressed[1]) > 4) return;
  const at = new THREE.Vector3(2 * clientX / innerWidth - 1, 1 - 2 * clientY / innerHeight, 0.5).unproject(camera);
  const hit = client.cast(camera.position, at.sub(camera.position));
  if (!hit) return;
  try {
    await client.carve({ centre: hit.place, radius: 1.6, seeds: 16, randomSeed: Math.floor(2 ** 32 * Math.random()) });
  } catch (error) {
    state.value = error.message;
  }
});

function resize() {
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', resize);

function frame() {
  controls.update();
  sun.target.position.copy(controls.target);
  sun.position.copy(controls.target).add(new THREE.Vector3(50, 32, -24));
  mesher.update(camera.position, mesher.complete ? MESHING_MS : LOADING_MS).forEach(show);
  move_pieces();
  renderer.render(scene, camera);
  state.value = `${mesher.complete ? 'all is shown' : 'meshing'}: ${terrain.size} blocks of terrain, ${pieces.size} pieces`;
}

read_palette();
resize();
hear();
renderer.setAnimationLoop(frame);
