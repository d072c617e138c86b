// The page's modules that need no browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { path_of, round_above } from './admin/charts.js';
import { scale_of } from './admin/map_view.js';
import { light_of } from './admin/paint.js';
import { ROCK, SIDE, Tile, Tiles, UNKNOWN, VOID, level_for, spacing_of, tile_m } from './admin/tiles.js';
import { AddressBar, at_port, format, parse } from './page/address.js';
import { Backoff } from './page/backoff.js';
import { all, brief } from './page/figures.js';
import { Game } from './page/game.js';
import { STICK, TAP, Thumbs, tilt } from './page/gestures.js';
import { terrain_part } from './page/gate.js';
import { read_glb, read_model } from './page/glb.js';
import { is_taken, kind_of } from './page/keyboard.js';
import { buffer_size, layout_of } from './page/layout.js';
import { events_near, part_of, rows_of, span_of, tick_at } from './page/marks.js';
import { pad_state } from './page/pad.js';
import { picture_name } from './page/picture.js';
import { Socket, ask_why, session_url, told_url, why_closed } from './page/socket.js';
import { is_read_on_the_way, is_withheld, insist, token_to_send } from './page/secrets.js';
import { read_signs } from './page/signs.js';
import { points } from './page/spark.js';
import { rows } from './page/help.js';
import { aim_text, bar_parts, carried_text, materials_for } from './page/tools.js';
import { budget_text, heads, latency_bars, lists, session_row, stage_bars } from './page/status_figures.js';
import { bytes, span, time, whole } from './page/words.js';

test('an address says the view and says it back', () => {
  const state = { camera: '30,9,19,63.5,-7', method: 'raymarch', quality: 'low', view: '64' };
  assert.deepEqual(parse(format(state)), state);
  assert.equal(format(state), '#camera=30,9,19,63.5,-7&method=raymarch&quality=low&view=64');
  assert.deepEqual(parse(format({ past: '4178', now: '4177' })), { past: '4178', now: '4177' });
  assert.deepEqual(parse('#past=//evil&now=0'), {});
  assert.equal(at_port(new URL('http://localhost:4177/x/'), '4178', '#now=4177'), 'http://localhost:4178/x/#now=4177');
});

test('an address takes nothing that is not well formed', () => {
  for (const fragment of ['#camera=1,2,3', '#camera=1,2,3,4,5,6', '#camera=1,2,3,4,x', '#camera=1e9,2,3,4,5', '#camera=NaN,2,3,4,5', '#method=<b>', '#quality=LOW',
    '#view=-3', '#view=99999', `#name=${'x'.repeat(33)}`, `#name=${'ä'.repeat(17)}`, '#name=a%0ab', '#%', '#'])
    assert.deepEqual(parse(fragment), {}, fragment);
});

test('a token in the address that is none is told of', () => {
  for (const fragment of ['#token=a%20b', `#token=${'x'.repeat(513)}`]) assert.deepEqual(parse(fragment), { unfit: 'token' }, fragment);
  assert.equal(parse(`#token=${'x'.repeat(512)}`).token.length, 512);
});

test('a link never has the token or the name', () => {
  assert.equal(format(parse('#token=secret&name=Ann&method=mesh')), '#method=mesh');
});

test('a token leaves the page by TLS, to the own machine, or when the person insists', () => {
  const at = (address) => new URL(address);
  for (const safe of ['https://play.example.org/', 'http://localhost:4177/', 'http://hill.localhost/', 'http://127.0.0.1:4177/', 'http://127.1.2.3/', 'http://[::1]:4177/'])
    assert.equal(is_read_on_the_way(at(safe)), false, safe);
  for (const read of ['http://192.168.0.7:4177/', 'http://play.example.org/', 'http://localhost.example.org/', 'http://127.0.0.1.example.org/', 'http://[2001:db8::1]/',
    'http://notlocalhost/'])
    assert.equal(is_read_on_the_way(at(read)), true, read);
  const kept = new Map();
  globalThis.sessionStorage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value) };
  const far = at('http://192.168.0.7:4177/');
  assert.equal(is_withheld(far), false, 'there is none');
  sessionStorage.setItem('scree', 'a-secret');
  assert.equal(is_withheld(far), true);
  assert.equal(token_to_send(far), '');
  assert.equal(token_to_send(at('https://192.168.0.7:4177/')), 'a-secret');
  assert.equal(token_to_send(at('http://localhost:4177/')), 'a-secret');
  insist();
  assert.equal(token_to_send(far), 'a-secret');
  delete globalThis.sessionStorage;
});

test('a link leaves the quality that a page chooses to the page that opens it', () => {
  assert.equal(format({ quality: 'auto', view: '64.4' }), '#view=64');
});

test('the address is written after a rest, once', () => {
  const written = [];
  const bar = new AddressBar('', (fragment) => written.push(fragment), 500);
  for (let now = 0; now < 1000; now += 100) bar.note(`#camera=${now},0,0,0,0`, now);
  assert.deepEqual(written, []);
  for (let now = 1000; now < 3000; now += 100) bar.note('#camera=7,0,0,0,0', now);
  assert.deepEqual(written, ['#camera=7,0,0,0,0']);
});

test('waits double up to a minute, and begin anew after success', () => {
  const backoff = new Backoff();
  assert.deepEqual(Array.from({ length: 8 }, () => backoff.failed()), [1000, 2000, 4000, 8000, 16000, 32000, 60000, 60000]);
  backoff.well();
  assert.equal(backoff.failed(), 1000);
});

test('the left thumb moves and the right one looks, at once', () => {
  const thumbs = new Thumbs();
  assert.equal(thumbs.down(1, 50, 300, 360, 0), true);
  assert.equal(thumbs.down(2, 300, 300, 360, 10), false);
  thumbs.move(1, 50, 300 - STICK.full);
  thumbs.move(2, 310, 295);
  thumbs.move(2, 320, 290);
  const stick = thumbs.stick();
  assert.ok(Math.abs(stick.forward - 1) < 1e-9 && Math.abs(stick.right) < 1e-9 && !stick.fast);
  assert.deepEqual(thumbs.take_look(), { right: 20, down: -10 });
  assert.deepEqual(thumbs.take_look(), { right: 0, down: 0 });
  thumbs.up(1, 1000);
  assert.equal(thumbs.stick(), null);
});

test('a second finger on the left looks, and the first goes on moving', () => {
  const thumbs = new Thumbs();
  thumbs.down(1, 50, 300, 360, 0);
  assert.equal(thumbs.down(2, 60, 200, 360, 0), false);
  thumbs.move(2, 70, 200);
  assert.equal(thumbs.take_look().right, 10);
  assert.equal(thumbs.stick().x, 50);
});

test('a short touch that stays is a tap, a long or a moved one is none', () => {
  const thumbs = new Thumbs();
  const touch = (to, ms) => {
    thumbs.down(1, 300, 300, 360, 0);
    thumbs.move(1, 300 + to, 300);
    thumbs.move(1, 300, 300);
    return thumbs.up(1, ms);
  };
  assert.equal(touch(TAP.pixels, TAP.ms), true);
  assert.equal(touch(TAP.pixels + 1, TAP.ms), false);
  assert.equal(touch(0, TAP.ms + 1), false);
  assert.equal(thumbs.up(9, 0), false);
});

test('a stick has a middle that is still, a full speed, and beyond that it runs', () => {
  assert.deepEqual(tilt(STICK.dead, 0), { right: 0, forward: 0, fast: false });
  assert.equal(tilt(STICK.full * 2, 0).right, 1);
  assert.equal(tilt(0, STICK.fast).fast, true);
  const both = tilt(30, 30);
  assert.ok(Math.hypot(both.right, both.forward) <= 1);
});

test('keys go to what has the focus first', () => {
  assert.equal(is_taken('KeyW', 'text'), true);
  assert.equal(is_taken('KeyW', 'button'), false);
  assert.equal(is_taken('Space', 'button'), true);
  assert.equal(is_taken('ArrowLeft', 'slider'), true);
  assert.equal(is_taken('ArrowLeft', null), false);
  assert.equal(is_taken('KeyW', 'choice'), true);
  assert.equal(kind_of({ tagName: 'INPUT', type: 'range' }), 'slider');
  assert.equal(kind_of({ tagName: 'INPUT', type: 'password' }), 'text');
  assert.equal(kind_of({ tagName: 'CANVAS', getAttribute: () => null }), null);
});

test('panels lie by the room that there is', () => {
  assert.equal(layout_of(1920, 1080), 'wide');
  assert.equal(layout_of(360, 640), 'tall');
  assert.equal(layout_of(640, 360), 'low');
  assert.equal(layout_of(800, 1280), 'tall');
  assert.equal(layout_of(1280, 400), 'low');
});

test('what is drawn has as many pixels as the screen, up to a bound', () => {
  assert.deepEqual(buffer_size(360, 640, 3), { width: 1080, height: 1920, ratio: 3 });
  const large = buffer_size(2560, 1440, 3);
  assert.ok(large.width * large.height <= 3840 * 2160 * 1.001 && Math.abs(large.width / large.height - 16 / 9) < 0.01);
  assert.deepEqual(buffer_size(0, 0, 1), { width: 1, height: 1, ratio: 1 });
});

const playback = { first: 100, last: 1100 };
const marks = { first: 100, ticks_per_column: 10, marks: [{ kind: 'carve', column: 0, count: 2 }, { kind: 'fall', column: 50, count: 1 }, { kind: 'carve', column: 51, count: 3 }] };

test('places on a timeline and ticks are each other', () => {
  for (const tick of [100, 350, 1100]) assert.equal(tick_at(part_of(tick, playback), playback), tick);
  assert.equal(part_of(0, playback), 0);
  assert.equal(tick_at(2, playback), 1100);
  assert.deepEqual(span_of(50, marks, playback), [0.5, 0.51]);
});

test('a timeline tells what is near', () => {
  assert.equal(events_near(0.51, 0.005, marks, playback), '1 fall, 3 carve');
  assert.equal(events_near(0.524, 0.005, marks, playback), '3 carve');
  assert.equal(events_near(0.496, 0.005, marks, playback), '1 fall');
  assert.equal(events_near(0.3, 0.005, marks, playback), '');
  assert.deepEqual([...rows_of(marks)], [['carve', 3], ['fall', 1]]);
});

test("a gamepad's state is the client's eight numbers", () => {
  const buttons = Array.from({ length: 17 }, (_, i) => ({ pressed: i === 0 || i === 16, value: i === 7 ? 0.75 : 0 }));
  assert.deepEqual(pad_state({ axes: [0.5, -1, 0, 0.25], buttons }), [0.5, -1, 0, 0.25, 0, 0.75, 1 | 1 << 16]);
  assert.deepEqual(pad_state({ axes: [], buttons: [] }), [0, 0, 0, 0, 0, 0, 0]);
});

class FakeSocket {
  static all = [];
  constructor(url) { Object.assign(this, { url, readyState: 0, sent: [], closed: false }); FakeSocket.all.push(this); }
  send(data) { this.sent.push(data); }
  close() { this.closed = true; }
}

function client_of(wishes) {
  const told = [];
  return { told, socket_wish: () => wishes.shift() ?? '', socket_opened: () => told.push('opened'), socket_closed: (why) => told.push(`closed ${why}`),
    receive: (data) => { told.push(data.length); return data.length < 5; }, take_outgoing: () => 'hello' };
}

test('a socket opens when the client wishes, and passes bytes on', () => {
  const client = client_of(['open']);
  const socket = new Socket(client, 'ws://here/session', (url) => new FakeSocket(url));
  socket.step();
  const made = FakeSocket.all.at(-1);
  assert.deepEqual(made.sent, []);
  made.readyState = 1;
  made.onopen({});
  made.onmessage({ data: new ArrayBuffer(3) });
  assert.deepEqual(client.told, ['opened', 3]);
  assert.deepEqual(made.sent, ['hello']);
});

test('of a socket that was replaced nothing is passed on', () => {
  const client = client_of(['open', 'open', 'close']);
  const socket = new Socket(client, 'ws://here/session', (url) => new FakeSocket(url));
  socket.step();
  const first = FakeSocket.all.at(-1);
  socket.step();
  assert.equal(first.closed, true);
  first.onmessage({ data: new ArrayBuffer(3) });
  first.onclose({ code: 1006, reason: '' });
  assert.deepEqual(client.told, []);
  socket.step();
  assert.equal(FakeSocket.all.at(-1).closed, true);
});

test('a message that is too long, or is text, ends the connection', () => {
  for (const data of [new ArrayBuffer(9), 'text']) {
    const client = client_of(['open']);
    const socket = new Socket(client, 'ws://here/session', (url) => new FakeSocket(url));
    socket.step();
    FakeSocket.all.at(-1).onmessage({ data });
    assert.equal(FakeSocket.all.at(-1).closed, true);
    assert.match(client.told.at(-1), /^closed /);
  }
});

const turn = () => new Promise((done) => { setImmediate(done); });

test('a socket that cannot be opened says what the server saw of it', async () => {
  const client = client_of(['open']);
  const asked = [];
  const why = async (session, name) => { asked.push(name); return { words: 'a line is missing' }; };
  const socket = new Socket(client, 'ws://here/session', (url) => new FakeSocket(url), why);
  socket.step();
  const made = FakeSocket.all.at(-1);
  made.onclose({ code: 1006, reason: '' });
  await turn();
  assert.match(made.url, /^ws:\/\/here\/session\?attempt=[0-9a-f]{32}$/);
  assert.deepEqual(asked, [made.url.slice(-32)]);
  assert.deepEqual(client.told, ['closed a line is missing']);
});

test('a page that is given a pass tries again with it, once', async () => {
  const client = client_of(['open']);
  const why = async () => ({ words: 'of another site', pass: 'f00d' });
  const socket = new Socket(client, 'ws://here/session', (url) => new FakeSocket(url), why);
  socket.step();
  FakeSocket.all.at(-1).onclose({ code: 1006, reason: '' });
  await turn();
  assert.match(FakeSocket.all.at(-1).url, /&pass=f00d$/);
  assert.deepEqual(client.told, []);
  FakeSocket.all.at(-1).onclose({ code: 1006, reason: '' });
  await turn();
  assert.deepEqual(client.told, ['closed of another site']);
});

test('a socket that the client gave up meanwhile tells nothing', async () => {
  const client = client_of(['open', 'close']);
  const socket = new Socket(client, 'ws://here/session', (url) => new FakeSocket(url), async () => ({ words: 'late' }));
  socket.step();
  FakeSocket.all.at(-1).onclose({ code: 1006, reason: '' });
  socket.step();
  await turn();
  assert.deepEqual(client.told, []);
});

test('the server is asked beside the session, and its answer put in words', async () => {
  const answer = (ok, status, json, text = '') => async (url) => {
    assert.equal(url, 'https://a.example/scree/session.json?attempt=01');
    return { ok, status, json: async () => json, text: async () => text };
  };
  const ask = (reply) => ask_why('wss://a.example/scree/session', '01', reply);
  assert.deepEqual(await ask(answer(true, 200, { seen: true, words: 'no line', pass: '7' })), { words: 'no line', pass: '7' });
  assert.match((await ask(answer(true, 200, { seen: false }))).words, /passes the page on, and "session" beside it not/);
  assert.match((await ask(answer(false, 429, null, 'too many'))).words, /429: too many/);
  assert.deepEqual(await ask(async () => { throw new TypeError('no network'); }), {});
});

test('a page joins its own server', () => {
  assert.equal(session_url({ protocol: 'https:', host: 'a.example', pathname: '/games/scree/' }), 'wss://a.example/games/scree/session');
  assert.equal(told_url('ws://a.example:81/scree/session'), 'http://a.example:81/scree/session.json');
  assert.equal(session_url({ protocol: 'https:', host: 'a.example' }), 'wss://a.example/session');
  assert.equal(session_url({ protocol: 'http:', host: '127.0.0.1:4177' }), 'ws://127.0.0.1:4177/session');
  assert.equal(why_closed(1006, ''), '');
  assert.equal(why_closed(1008, 'no'), 'no');
});

test('a tool says what a click does, and what one carries', () => {
  const aim = { beyond: false, material: '', m3: 6.24 };
  assert.equal(aim_text({ use: 'dig' }, aim), 'takes 6.2 m³');
  assert.equal(aim_text({ use: 'place' }, { ...aim, material: 'rock' }), 'puts 6.2 m³ of rock');
  assert.equal(aim_text({ use: 'place' }, { ...aim, m3: null }), 'nothing to place');
  assert.equal(aim_text({ use: 'dig' }, { ...aim, beyond: true }), 'too far away');
  assert.equal(aim_text({ use: 'dig' }, null), 'nothing to aim at');
  const carried = [{ name: 'rock', m3: 8.14 }, { name: 'soil', m3: 4 }];
  assert.deepEqual(carried_text([], 1000), { full: false, text: 'You carry nothing' });
  assert.deepEqual(carried_text(carried, 1000), { full: false, text: 'You carry 12.1 m³ of 1000 m³: rock 8.1 m³, soil 4.0 m³' });
  assert.equal(carried_text(carried, 12.5).full, true);
  assert.match(carried_text(carried, 12.5).text, /full: 2 places rock, U gives all to the world/);
  assert.deepEqual(bar_parts(carried, 40), [['rock', 20.35], ['soil', 10]]);
  assert.deepEqual(bar_parts([{ name: 'rock', m3: 1 }], 1000), [['rock', 0.8]], 'a little is seen');
});

test('the keys of a replay have no tool among them, and those of a world no timeline', () => {
  const controls = [{ action: 'dig', key: '1', button: '', does: 'dig', of_replay: false, of_world: true }, { action: 'replay_play', key: 'J', button: '', does: 'hold', of_replay: true },
    { action: 'menu', key: 'Esc', button: '', does: 'menu', of_replay: false }];
  const keys = (replay) => rows(controls, replay).map(([key]) => key);
  assert.ok(keys(false).includes('1') && keys(false).includes('left click') && !keys(false).includes('J'));
  assert.ok(!keys(true).includes('1') && !keys(true).includes('left click') && keys(true).includes('J'));
  assert.ok(!keys(false).includes('Esc'), 'a page does not end');
});

test('how much of the terrain is there is between none and all', () => {
  assert.equal(terrain_part({ draw: { kept: 0, waiting: 0 }, preparing: null, complete: false }), 0);
  assert.equal(terrain_part({ draw: { kept: 30, waiting: 10 }, preparing: null, complete: false }), 0.75);
  assert.equal(terrain_part({ draw: { kept: 1, waiting: 9 }, preparing: { share: 0.5 }, complete: false }), 0.5);
  assert.equal(terrain_part({ draw: { kept: 1, waiting: 9 }, preparing: null, complete: true }), 1);
});

test('numbers read as people write them', () => {
  assert.equal(bytes(999), '999 B');
  assert.equal(bytes(1234), '1.2 kB');
  assert.equal(bytes(999600), '1.0 MB');
  assert.equal(time(3 * 60 * 60 + 30, 60), '3:00');
  assert.equal(time(60 * 3600 * 2, 60), '2:00:00');
  assert.equal(whole(1234567), '1\u00a0234\u00a0567');
  assert.equal(span(90061), '1 d 1 h');
  assert.equal(span(2 * 3600 + 3 * 60 + 59), '2 h 3 min');
  assert.equal(picture_name(new Date('2026-01-02T03:04:05Z')), 'scree-2026-01-02T03-04-05.png');
});

test('a curve ends at its right, and its highest value is at the top', () => {
  assert.equal(points([0, 2], 100, 10, 3), '50.0,9.0 100.0,1.0');
  assert.equal(points([], 100, 10), '');
});

/** The module as a page at that path has it, which reads its path once. */
async function kept_at(pathname, storage) {
  const before = Object.getOwnPropertyDescriptors(globalThis);
  const set = (name, value) => Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
  set('location', { pathname });
  set('sessionStorage', storage);
  set('localStorage', storage);
  const module = await import(`./page/kept.js?${pathname}`);
  if (before.location) Object.defineProperty(globalThis, 'location', before.location);
  else delete globalThis.location;
  return module;
}

function storage_of_nothing() {
  const kept = new Map();
  return { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value) };
}

test('a token is kept for one server of several behind a proxy', async () => {
  const storage = storage_of_nothing();
  const one = await kept_at('/one/', storage), page_of_one = await kept_at('/one/status.html', storage);
  const other = await kept_at('/two/', storage);
  one.token.keep('secret');
  assert.equal(page_of_one.token.load(), 'secret');
  assert.equal(other.token.load(), '');
});

test('choices of tool and view come back, and what is no choice is left out', async () => {
  const { choices_of, keep, restore } = await kept_at('/', storage_of_nothing());
  const tool = { kind: 'ball', use: 'carve', radius_m: 2, of_the_day: 1 }, view = { particles: false, look_speed: 1.5 };
  keep(choices_of({ tool, view }));
  keep({ tool: { ...choices_of({ tool, view }).tool, seeds: { many: true } } });
  const told = [];
  restore({ set: (wish, value) => told.push([wish, value]) });
  assert.deepEqual(told,
    [['tool', 'ball'], ['use', 'carve'], ['radius', 2], ['particles', false], ['look_speed', 1.5]]);
});

const status = {
  tick_rate_hz: 60, replay: false, version: '1',
  now: { tick: 600, clients: 2, pieces: 3, tick_median_ms: 20, tick_worst_ms: 30, stages_ms: { commands: 1, step: 8 }, work: { budget_us: 0, islands_put_off: 4 }, saving: 'failed', saved_tick: 1 },
  report: { ticks: 600, late_ticks: 5, seconds: 10, pieces_made: 9, pieces_merged: 6, resident_mb: 100, sessions: { joined: 4 }, ledger: { terrain: 1, pieces: 2, dust: 3, poured: 4, moved: 5, error: 1 },
    refusals: { total: 3, by_reason: { rate: 1, shape: 2 } }, bytes_sent: 5000 },
};

test('the status page marks what is wrong', () => {
  const bad = heads(status).filter((head) => head.bad).map((head) => head.name);
  assert.deepEqual(bad, ['Tick, median', 'Ledger error']);
  const { ledger, memory, refusals, work, wire } = lists(status);
  assert.deepEqual(ledger.at(-1), ['error', '1', true]);
  assert.ok(memory.some(([name, , failed]) => name === 'saving' && failed));
  assert.deepEqual(refusals, [['shape', '2'], ['rate', '1']]);
  assert.deepEqual(work, [['islands put off', '4']]);
  assert.deepEqual(wire, [['bytes sent', '5.0 kB']]);
  assert.deepEqual(stage_bars(status).map(({ part }) => part <= 1), [true, true]);
});

test('a bar of the status page ends at its right, and the longest there is goes that far', () => {
  const slow = { ...status, report: { ...status.report, stages_ms: { step: { worst: 500 } } } };
  assert.deepEqual(stage_bars(slow).map(({ worst }) => worst), [undefined, 1]);
  const latency_ms = { waiting: { median: 8, worst: 16 }, sent: { median: 2, worst: 4 } };
  const bars = latency_bars({ now: { latency_ms } });
  assert.deepEqual(bars.map(({ part, worst }) => [part, worst]), [[0.5, 1], [0.125, 0.25]]);
});

test('the status page says the work of a tick in the unit of its length', () => {
  const now = { ...status.now, work: { budget_us: 9000, worst_us: 1500 } };
  assert.match(budget_text({ ...status, now }), /^A tick has 16.7 ms.*: 1.50 ms of 9.00 ms /);
  assert.equal(budget_text(status), 'A tick has 16.7 ms.');
});

test('a session without a name is called by its number', () => {
  const session = { session: 7, name: '', role: 'viewer', address: '10.0.0.1', program: 'bot', seconds: 61,
    sent_bytes: 1 };
  assert.deepEqual(session_row(session), ['#7', 'viewer', '10.0.0.1', 'bot', '1 min', '1 B']);
  assert.equal(session_row({ ...session, name: 'Ann' })[0], 'Ann');
});

const seen = {
  frame: { median_ms: 20, worst_ms: 40 }, pieces_near: 3, complete: true, pace: 0.5, latency_ms: null, predictions: 0,
  traffic: { received_bytes: 10, received_bytes_per_s: 1, sent_bytes: 5 }, connection: { replay: false }, status: null,
  draw: { method: 'mesh', draws: 1, triangles: 2, kept: 3, waiting: 4, driver: '', gl_errors: 0, first_gl_error: '' },
  mirror: { checks: 9, mismatches: 0, held_chunks: 1, edited_bricks: 2 },
};

test('a world that is slower than time is told of, but not a replay', () => {
  const named = (state) => brief(state).map(([name]) => name);
  assert.deepEqual(brief(seen).at(-1), ['time', '× 0.50']);
  assert.ok(!named({ ...seen, pace: 1 }).includes('time'));
  assert.ok(!named({ ...seen, connection: { replay: true } }).includes('time'));
});

test('rock that differed from the server, and what OpenGL refused, is marked', () => {
  const bad = (state) => all(state).flatMap(([, rows]) => rows).filter((row) => row[2]).map(([name]) => name);
  assert.deepEqual(bad(seen), []);
  const mirror = { ...seen.mirror, mismatches: 1 }, draw = { ...seen.draw, gl_errors: 2, first_gl_error: 'lost' };
  assert.deepEqual(bad({ ...seen, mirror, draw }), ['OpenGL errors', 'that differed']);
});

test('a fill may be as the ground, paint may not, and what a world lacks is its first', () => {
  const materials = [{ name: 'rock', colour: '#938e8b' }, { name: 'brick', colour: '#99543f' }];
  const chosen = (use, material) => materials_for({ use, material }, materials).chosen;
  assert.equal(materials_for({ use: 'fill', material: '' }, materials).list.length, 3);
  assert.equal(materials_for({ use: 'paint', material: '' }, materials).list.length, 2);
  assert.deepEqual(materials_for({ use: 'place', material: '' }, materials, [{ name: 'brick', m3: 1 }], { material: 'brick' }), { list: [materials[1]], chosen: 'brick' });
  assert.equal(chosen('fill', ''), '');
  assert.equal(chosen('paint', ''), 'rock');
  assert.equal(chosen('fill', 'brick'), 'brick');
  assert.equal(chosen('fill', 'amber'), 'rock');
  assert.equal(materials_for({ use: 'paint', material: 'amber' }, []).chosen, '');
});

/** A box about the origin as binary glTF, whose scene `change` may change. */
function box_glb(change = () => {}, edit_buffer = () => {}) {
  const scene = {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorFactor: [0.64, 0.25, 0, 1] } }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 8, type: 'VEC3' }, { bufferView: 1, componentType: 5123, count: 36, type: 'SCALAR' }],
    bufferViews: [{ buffer: 0, byteLength: 96 }, { buffer: 0, byteOffset: 96, byteLength: 72 }], buffers: [{ byteLength: 168 }],
  };
  change(scene);
  const places = [...Array(24).keys()].map((i) => ((Math.floor(i / 3) >> i % 3) & 1 ? 0.5 : -0.5));
  const corners = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
  const json = new TextEncoder().encode(JSON.stringify(scene)), padded = (json.length + 3) & ~3;
  const bytes = new Uint8Array(20 + padded + 8 + 168).fill(0x20), view = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, padded, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.set(json, 20);
  const buffer = 20 + padded + 8;
  view.setUint32(buffer - 8, 168, true);
  view.setUint32(buffer - 4, 0x004e4942, true);
  places.forEach((place, i) => view.setFloat32(buffer + 4 * i, place, true));
  corners.forEach((corner, i) => view.setUint16(buffer + 96 + 2 * i, corner, true));
  edit_buffer(view, buffer);
  return bytes;
}

/** The places, normals, colours and corners of what read_glb() returns. */
function mesh_of(bytes) {
  const [count, corners] = new Uint32Array(bytes.buffer, 0, 2), view = new DataView(bytes.buffer, 8);
  assert.equal(bytes.length, 8 + 20 * count + 4 * corners);
  const vertices = [...Array(count).keys()].map((i) => ({
    place: [0, 4, 8].map((at) => view.getFloat32(20 * i + at, true)),
    normal: [12, 13, 14].map((at) => view.getInt8(20 * i + at)),
    colour: [16, 17, 18, 19].map((at) => view.getUint8(20 * i + at)),
  }));
  return { vertices, corners: [...new Uint32Array(bytes.buffer, 8 + 20 * count)] };
}

test('a model is its triangles in their colours', () => {
  const mesh = mesh_of(read_glb(box_glb()));
  assert.equal(mesh.vertices.length, 8);
  assert.equal(mesh.corners.length, 36);
  assert.deepEqual(mesh.vertices[0], { place: [-0.5, -0.5, -0.5], normal: [0, 0, 0], colour: [204, 128, 0, 0] });
  const moved = mesh_of(read_glb(box_glb((scene) => { scene.nodes[0] = { mesh: 0, translation: [1, 2, 3], scale: [2, 1, 1] }; })));
  assert.deepEqual(moved.vertices[0].place, [0, 1.5, 2.5]);
  const turned = mesh_of(read_glb(box_glb((scene) => { scene.nodes[0].rotation = [0, 0, Math.SQRT1_2, Math.SQRT1_2]; })));
  [0.5, 0.5, -0.5].forEach((value, axis) => assert.ok(Math.abs(turned.vertices[1].place[axis] - value) < 1e-6));
  const inner = mesh_of(read_glb(box_glb((scene) => { scene.nodes = [{ children: [1], scale: [2, 2, 2] }, { mesh: 0, translation: [1, 0, 0] }]; })));
  assert.deepEqual(inner.vertices[7].place, [3, 1, 1]);
  const mirrored = mesh_of(read_glb(box_glb((scene) => { scene.nodes[0].scale = [-1, 1, 1]; })));
  assert.deepEqual(mirrored.corners.slice(0, 3), [2, 0, 1]);
  const normals = mesh_of(read_glb(box_glb((scene) => { scene.meshes[0].primitives[0].attributes.NORMAL = 0; })));
  assert.deepEqual(normals.vertices[7].normal, [73, 73, 73]);
});

test('a hostile model throws its reason, and is shown by its parts', (context) => {
  const good = box_glb();
  for (let length = 0; length < good.length; ++length) assert.throws(() => read_glb(good.slice(0, length)), `${length} bytes`);
  const faults = [
    [(scene) => { scene.accessors[0].count = 9; }, /beyond its buffer/], [(scene) => { scene.accessors[0].count = 4194304; }, /buffer/],
    [(scene) => { scene.accessors[0].count = -1; }, /whole number/], [(scene) => { scene.accessors[0].count = 'x'; }, /whole number/],
    [(scene) => { scene.accessors[1].count = 35; }, /whole triangles/], [(scene) => { scene.accessors[0].count = 7; }, /index/],
    [(scene) => { scene.bufferViews[1].byteOffset = 97; }, /buffer/], [(scene) => { scene.accessors[0].componentType = 5130; }, /type/],
    [(scene) => { scene.accessors[0].type = 'MAT4'; }, /type/], [(scene) => { scene.accessors[0].type = 'toString'; }, /type/],
    [(scene) => { scene.accessors[0].bufferView = 2; }, /lacks/], [(scene) => { scene.accessors[0].sparse = {}; }, /sparse/],
    [(scene) => { scene.bufferViews[0].buffer = 1; }, /another buffer/], [(scene) => { scene.buffers[0].uri = 'http://there'; }, /another file/],
    [(scene) => { scene.nodes[0].mesh = 1; }, /lacks/], [(scene) => { scene.nodes[0].children = [0]; }, /tree/],
    [(scene) => { scene.nodes[0].children = [4096]; }, /nodes/], [(scene) => { scene.nodes[0].children = { a: 1 }; }, /list/],
    [(scene) => { scene.nodes[0].translation = [1, 2]; }, /numbers/], [(scene) => { scene.nodes[0].scale = [1e30, 1, 1]; }, /bounds/],
    [(scene) => { scene.nodes[0].scale = [null, 1, 1]; }, /numbers/], [(scene) => { scene.meshes[0].primitives[0].mode = 1; }, /triangles/],
    [(scene) => { scene.meshes[0].primitives[0].indices = 0; }, /indices/], [(scene) => { scene.meshes[0].primitives[0].material = 7; }, /lacks/],
    [(scene) => { scene.scene = 3; }, /lacks/], [(scene) => { scene.extensionsRequired = ['KHR_draco_mesh_compression']; }, /extension/],
    [(scene) => { scene.nodes = [{ children: [...Array(4095).keys()].map((i) => i + 1) }, ...Array(4095).fill({ mesh: 0 })];
      scene.meshes[0].primitives = Array(3).fill(scene.meshes[0].primitives[0]); }, /too many/],
    [(scene) => { scene.nodes = [{ children: [...Array(4095).keys()].map((i) => i + 1) }, ...Array(4095).fill({ mesh: 0 })];
      scene.accessors[1].count = 3; scene.meshes[0].primitives = Array(5).fill(scene.meshes[0].primitives[0]); }, /too many vertices/],
  ];
  for (const [change, words] of faults) assert.throws(() => read_glb(box_glb(change)), words, String(change));
  const said = context.mock.method(console, 'warn', () => {});
  assert.equal(read_model(new Uint8Array(30)), null);
  assert.equal(said.mock.callCount(), 1);
  assert.ok(read_model(box_glb()) instanceof Uint8Array);
});

test('signs are read from their lines', () => {
  assert.deepEqual(read_signs(''), []);
  const [bar, marker] = read_signs('1\t#ff8040\t0.2500\t0.5000\t0.5000\t1.00\t0.00\t0.00\tscore\t12 of 40 t\n2\t#ffffff\t0.0000\t0.9660\t0.5000\t0.80\t1.00\t0.00\ttower\t\n');
  assert.deepEqual(bar, { kind: 1, colour: '#ff8040', share: 0.25, x: 0.5, y: 0.5, opacity: 1, way: null, name: 'score', words: '12 of 40 t' });
  assert.deepEqual(marker.way, [1, 0]);
  assert.equal(marker.words, '');
});

test('scripts of a game hear what comes, and send bytes', () => {
  const waiting = [{ channel: 'shop', bytes: new Uint8Array([1]) }, { channel: 'shop', bytes: new Uint8Array([2]) }], sent = [];
  const client = { take_heard: () => waiting.shift() ?? null, send: (channel, bytes) => sent.push([channel, [...bytes]]) > 0 };
  const game = new Game(client), heard = [];
  game.step();
  assert.equal(waiting.length, 2, 'nobody listens: the client keeps them');
  const stop = game.on('message', (channel, bytes) => heard.push([channel, ...bytes]));
  game.step();
  assert.deepEqual(heard, [['shop', 1], ['shop', 2]]);
  stop();
  waiting.push({ channel: 'shop', bytes: new Uint8Array([3]) });
  game.step();
  assert.equal(heard.length, 2);
  assert.equal(game.send('shop', 'ü'), true);
  game.send('shop', new Uint16Array([0x0102]).buffer);
  game.send('shop', new DataView(new Uint8Array([7, 8, 9]).buffer, 1, 1));
  assert.deepEqual(sent, [['shop', [0xc3, 0xbc]], ['shop', [2, 1]], ['shop', [8]]]);
  assert.throws(() => game.on('else', () => {}), TypeError);
  assert.throws(() => game.send('shop', 7), TypeError);
});

/** Gives each sample that the tile asks for a height, until it is complete; how many it asked for. */
function fill(tile, height) {
  let asked = 0;
  for (let index = [...tile.left][0]; index !== undefined; index = [...tile.left][0]) {
    tile.set(index, ROCK, height, 1);
    ++asked;
  }
  return asked;
}

test('a tile of the map asks for each sample once, the coarse ones first', () => {
  const tile = new Tile(1, 0, 0);
  assert.equal(tile.left.size, 4);
  for (const index of [...tile.left]) tile.set(index, ROCK, 5);
  assert.equal(tile.known(SIDE * SIDE - 1), 16 * SIDE + 16);
  assert.equal(fill(tile, 7), SIDE * SIDE - 4);
  assert.ok(tile.complete);
  assert.equal(tile.known(SIDE * SIDE - 1), SIDE * SIDE - 1);
  const coarse = new Tile(6, 0, 0);
  assert.equal(fill(coarse, 7), SIDE * SIDE / 4);
});

test('a tile that is asked for anew keeps what is known, and ends what it had begun first', () => {
  const tile = new Tile(0, 2, -1);
  assert.deepEqual(tile.place(0), { x: 2 * tile_m(0) + 0.25, z: -tile_m(0) + 0.25 });
  tile.set([...tile.left][0], VOID);
  tile.renew();
  assert.equal(tile.round, 0);
  while (tile.round === 0) tile.set([...tile.left][0], ROCK, 3);
  assert.equal(tile.left.size, 4);
  assert.ok(tile.states.every((state) => state !== UNKNOWN));
  fill(tile, 4);
  assert.ok(tile.complete && tile.round === 1);
});

test('tiles are found by place on both sides of the origin, and asked for anew where something changed', () => {
  const tiles = new Tiles();
  const seen = tiles.within(0, { lo: { x: -1, z: -1 }, hi: { x: 1, z: 1 } }, true);
  assert.deepEqual(seen.map(({ key }) => key), ['0/-1/-1', '0/0/-1', '0/-1/0', '0/0/0']);
  for (const tile of seen) fill(tile, tile.x + 10);
  assert.deepEqual(tiles.at(-0.1, 3), { height: 9, material: 1 });
  assert.equal(tiles.at(100, 0), null);
  assert.equal(tiles.sample(0, -1, 0).height, 9);
  tiles.renew({ lo: { x: 2, z: 2 }, hi: { x: 3, z: 3 } });
  assert.deepEqual(seen.map(({ complete }) => complete), [true, true, true, false]);
});

test('the map has round scales, levels by zoom, and light from the north-west', () => {
  assert.deepEqual(scale_of(0.5, 160), { metres: 50, pixels: 100, text: '50 m' });
  assert.equal(scale_of(20, 160).text, '2 km');
  for (const per_pixel of [0.05, 0.4, 3]) assert.ok(Math.abs(Math.log2(spacing_of(level_for(per_pixel)) / (8 * per_pixel))) <= 1);
  assert.ok(light_of(0, 1, 0, 1, 2) > light_of(0, 0, 0, 0, 2) && light_of(1, 0, 1, 0, 2) < light_of(0, 0, 0, 0, 2));
});

test('a curve breaks where samples are missing, and its top is a round number', () => {
  assert.deepEqual([0, 0.3, 7, 10, 11].map(round_above), [1, 0.5, 10, 10, 20]);
  const samples = [0, 10000, 90000].map((at_ms) => ({ at_ms, ms: 1 }));
  assert.equal(path_of(samples, ({ ms }) => ms, { first_ms: 0, span_ms: 100000 }, 2).replace(/[^ML]/g, ''), 'MLM');
});
