// Stands in for scree.js: a client without a world, for what the page's panels do. Its state is what the test says
// (globalThis.fake), and it notes what the page tells it. Loaded by the page under test, in the browser.
const catalogue = {
  methods: [
    { name: 'mesh', summary: 'cached surface nets of blocks of terrain, rebuilt where they change', missing: null },
    { name: 'dual', summary: 'the same by dual contouring: sharp edges of the rock stay sharp', missing: null },
    { name: 'cubes', summary: 'the same by marching cubes', missing: null },
    { name: 'raymarch', summary: 'rays through an atlas of bricks; edits do not slow it down', missing: null },
    { name: 'grid', summary: 'marching cubes by a geometry shader, from a grid of points about the camera', missing: 'this OpenGL has no geometry shaders' },
  ],
  qualities: ['low', 'medium', 'high'], tools: ['sphere', 'box', 'tunnel', 'crater'], uses: ['dig', 'place', 'carve', 'fill', 'paint'],
  patterns: ['radial', 'even', 'random', 'slabs', 'columns'],
  limits: { view_radius_m: [8, 128], tool_radius_m: [0.5, 4], blast_speed_m_s: [0, 40], seeds: [0, 256], field_of_view_degrees: [20, 110],
    look_speed: [0.1, 10], replay_speed: [0.1, 16], line_bytes: 200, name_bytes: 32 },
  events: [],
  controls: [
    { action: 'dig', key: '1', button: '', does: 'dig: rock goes into your store', of_replay: false },
    { action: 'next_use', key: 'F', button: 'pad B', does: 'the next of these five', of_replay: false },
    { action: 'next_method', key: 'M', button: 'pad Y', does: 'draw by the next method', of_replay: false },
    { action: 'walk', key: 'Q', button: '', does: 'walk, or fly', of_replay: false },
    { action: 'replay_play', key: 'J', button: '', does: 'replay: play, or hold', of_replay: true },
    { action: 'picture', key: 'F12', button: '', does: 'take a picture (a PNG in this folder)', of_replay: false },
    { action: 'menu', key: 'Esc', button: '', does: 'free the mouse; then the menu, which ends', of_replay: false },
  ],
};

const status = {
  clients: 3, pieces: 128, pieces_made: 512, pieces_merged: 384, tick_median_ms: 2.31, tick_worst_ms: 9.87, field_hash: '0123456789abcdef',
  repairs: 0, chunks_waiting: 0, saving: '', ledger: { terrain: -31.2, pieces: 12.1, dust: 0.42, poured: 0, moved: 44.1 }, refusals: {},
};

export const state = {
  connection: { phase: 'connected', text: 'fake', replay: false, role: 'player', session: 1 },
  notice: '', hint: '', mark: { number: 0, refused: '' }, aim: { beyond: false, material: '', m3: 6.2 },
  carried: [{ name: 'rock', m3: 8.1 }, { name: 'brick', m3: 4.3 }], store_m3: 1000, camera: '30,9,19,63,-7', walks: false, eye: '', tick: 67611, tick_rate_hz: 60, pace: 1, lost_ticks: 0, pieces_near: 96, props_near: 0,
  predictions: 0, joined: true, loaded: true, complete: true,
  traffic: { received_bytes: 1250000, sent_bytes: 8123, received_bytes_per_s: 10240, waiting_bytes: 0 },
  mirror: { frames: 900, pieces_made: 512, pieces_merged: 384, checks: 120, mismatches: 0, repairs: 0, held_chunks: 444, edited_bricks: 812 },
  frame: { ms: 16.7, median_ms: 16.7, worst_ms: 31.2, update_ms: 3.1, draw_ms: 8.4, apply_worst_ms: 4.1, work_worst_ms: 3.2 },
  draw: { method: 'mesh', draws: 210, triangles: 812345, pieces: 96, kept: 420, waiting: 0, driver: 'a driver of a fake, with a long name', gl_errors: 0, first_gl_error: '' },
  preparing: null, latency_ms: 21.4, status,
  materials: [{ name: 'rock', colour: '#938e8b' }, { name: 'brick', colour: '#99543f' }, { name: 'glass', colour: '#bdd5d2' }],
  tool: { kind: 'crater', use: 'dig', material: '', radius_m: 2, blast_speed_m_s: 6, pattern: 'radial', seeds: 0, seeds_now: 34 },
  view: { method: 'mesh', quality: 'medium', quality_auto: true, view_radius_m: 48, particles: true, details: true, shake: true, predict: true, overlay: false,
    field_of_view_degrees: 60, look_speed: 1 },
  persons: { list: [{ session: 1, name: 'Ann', role: 'player' }], more: 0, chat: true },
  lines: [], playback: null,
};

export const replay = {
  ...state,
  connection: { ...state.connection, replay: true },
  playback: { moment: 1500, first: 0, last: 3840, speed: 1, playing: true, grows: false, refusal: '', marks: 1 },
};

const marks = { first: 0, ticks_per_column: 4, read_to: 3840, marks: [] };
['carve', 'dent', 'break', 'fall', 'merge', 'join', 'leave', 'slow'].forEach((kind, row) => {
  for (let column = 7 * row; column < 960; column += 5 + 13 * row) marks.marks.push({ kind, column, count: 1 + column % (row + 2) });
});

const fake = { state, replay, calls: [], wish: 1, names: [], signs: '', heard: [], asked: [], frame: () => 1, begin: 0 };
globalThis.fake = fake;
const start = new URLSearchParams(location.search).get('fake');
if (start) Object.assign(fake, JSON.parse(start));
if (fake.replays) fake.state = replay;

const texts = {
  state: () => JSON.stringify(fake.state), catalogue: () => JSON.stringify(catalogue), names: () => JSON.stringify(fake.names), signs: () => fake.signs,
  marks: () => JSON.stringify(marks), camera: () => fake.state.camera, error: () => 'no reason at all', asked: () => JSON.stringify(fake.asked.splice(0)),
};

const KEYS = ['KeyW', 'KeyA', 'KeyS', 'KeyD', 'Space', 'Enter', 'F1'];
const ACTIONS = { KeyH: 'help', KeyP: 'panel', KeyL: 'persons', KeyI: 'figures', F3: 'all_figures', Enter: 'talk', F1: 'hide' };

export default async function createScree({ canvas }) {
  const pen = canvas.getContext('2d');
  const call = (name, values) => {
    fake.calls.push([name, ...values]);
    if (texts[name]) return texts[name]();
    if (name === 'key' && values[1] && ACTIONS[values[0]]) fake.asked.push(ACTIONS[values[0]]);
    if (name === 'key') return Number(KEYS.includes(values[0]) || values[0] in ACTIONS);
    if (name === 'begin') return fake.begin;
    if (name === 'socket_wish') return 0;
    if (name === 'frame') {
      const sky = pen.createLinearGradient(0, 0, 0, canvas.height);
      [[0, '#4f7fb5'], [0.45, '#c3d2da'], [0.46, '#cf9a62'], [0.7, '#b87947'], [1, '#8b9a5b']].forEach(([at, colour]) => sky.addColorStop(at, colour));
      pen.fillStyle = sky;
      pen.fillRect(0, 0, canvas.width, canvas.height);
      return fake.frame();
    }
    return ['outgoing', 'incoming', 'sounds'].includes(name) ? 0 : 1;
  };
  const ccall = (name, _result, _types, values) => call(name.replace('scree_', ''), values);
  return new Proxy({ ccall, HEAPU8: new Uint8Array(16) }, {
    get: (module, name) => {
      if (name === 'then') return undefined;
      return typeof name === 'string' && name.startsWith('_scree_') ? (...values) => call(name.slice(7), values) : module[name];
    },
  });
}
