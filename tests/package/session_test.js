// The package under Node, by the real server: requests, events, meshes, refusals, and ends.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { after, before, test } from 'node:test';
import { Worker } from 'node:worker_threads';

import { connect, ScreeError } from 'scree-client';

import { host } from './server.js';

const MB = 1 << 20;
let server, address, client;
before(async () => {
  server = await host(['--terrain', 'flat', '--anonymous', 'builder', '--reach', '0', '--requests-per-second', '100']);
  address = `ws://127.0.0.1:${server.port}`;
  client = await connect(address, { name: 'Ann', eye: [0, 8, 0], radius: 64, stones: true, meets: true });
  await client.loaded();
});
after(async () => {
  await client?.close();
  await server?.stop();
});

/** The first event that is wanted; fails when it does not come. */
async function event_where(events, wanted, what) {
  const late = setTimeout(() => events.return(), 60000);
  for await (const event of events) {
    if (!wanted(event)) continue;
    clearTimeout(late);
    return event;
  }
  throw new Error(`${what} does not come`);
}
const ground = (x, z) => client.cast([x, 60, z], [0, -1, 0], { of: ['terrain'] }).place;

test('a carve is answered, and its pieces and bricks are told', async () => {
  const events = client.events();
  const reply = await client.carve({ centre: ground(0, 0), radius: 1.2, seeds: 12, randomSeed: 3 });
  assert.ok(reply.count > 3 && reply.tick > 0, JSON.stringify(reply));
  assert.equal(reply.error, null);
  const terrain = await event_where(events, ({ kind }) => kind === 'terrain', 'terrain');
  assert.ok(terrain.bricks instanceof Int32Array && terrain.bricks.length % 3 === 0 && terrain.bricks.length > 0);
});

test('poses are written into an earlier answer, and into nothing else', async () => {
  await client.carve({ centre: ground(4, 8), radius: 1.2, seeds: 6 });
  const first = client.bodies(), fresh = client.bodies();
  first.positions.fill(0);
  const { buffer } = first.ids;
  assert.equal(client.bodies(-1, first), first);
  assert.equal(first.ids.buffer, buffer);
  assert.deepEqual({ ...first }, { ...fresh });
  // More than it has room for.
  for (let i = 0; i < 8; ++i) await client.carve({ centre: ground(6 + 3 * i, 12), radius: 1.4, seeds: 24, randomSeed: i });
  assert.ok(client.bodies(-1, first).count > fresh.count && first.ids.buffer !== buffer);
  assert.deepEqual({ ...first }, { ...client.bodies() });
  assert.throws(() => client.bodies(-1, { ids: new Uint32Array(8) }), { name: 'invalid' });
});

test('pieces have poses and meshes, and become terrain with a stone', async () => {
  const events = client.events(), later = client.events();
  const { count } = await client.carve({ centre: ground(8, 0), radius: 1.2, seeds: 6, speed: 4 });
  assert.ok(count > 0);
  const { id } = await event_where(events, ({ kind }) => kind === 'pieceAdded', 'a piece');
  const bodies = client.bodies();
  const at = bodies.ids.indexOf(id);
  assert.ok(at >= 0 && bodies.positions.length === 3 * bodies.count && bodies.rotations.length === 4 * bodies.count);
  assert.ok(Math.abs(Math.hypot(...bodies.rotations.subarray(4 * at, 4 * at + 4)) - 1) < 1e-3);
  assert_mesh(client.meshBody(id));
  assert.equal(client.meshBody(4e9), null);
  await event_where(later, (event) => event.kind === 'stone' && event.rotation.length === 4, 'a stone');
});

function assert_mesh(mesh) {
  const vertices = mesh.positions.length / 3;
  assert.ok(vertices > 0 && mesh.indices.length > 0 && mesh.indices.length % 3 === 0);
  for (const index of mesh.indices) assert.ok(index < vertices);
  for (let v = 0; v < vertices; ++v) {
    const length = Math.hypot(...mesh.normals.subarray(3 * v, 3 * v + 3));
    assert.ok(Math.abs(length - 1) < 0.02, `a normal is ${length} long`);
  }
  assert.equal(mesh.materials.length, vertices);
  assert.equal(mesh.shades.length, vertices);
  return mesh;
}

test('a mesher covers the ground, and its meshes stay as they are', async () => {
  const mesher = client.mesher({ radius: 32 });
  const shown = new Map();
  const begun = Date.now();
  while (!mesher.complete) {
    assert.ok(Date.now() - begun < 60000, 'the ground is not meshed');
    for (const mesh of mesher.update([0, 8, 0], 50)) shown.set(`${mesh.kind} ${mesh.id} ${mesh.level} ${mesh.node}`, mesh);
    await new Promise((resolve) => { setTimeout(resolve, 1); });
  }
  const meshes = [...shown.values()].filter(({ gone }) => !gone);
  assert.ok(meshes.length > 4, `${meshes.length} meshes`);
  for (const mesh of meshes) assert_mesh(mesh);
  assert.notEqual(meshes[0].positions.buffer, meshes[1].positions.buffer);
  mesher.close();
  assert.throws(() => mesher.update([0, 8, 0]), { name: 'closed' });
});

test('a chunk has a mesh where it has a surface', () => {
  const { voxel } = client.status();
  const chunk = ground(20, 20).map((metres) => Math.floor(metres / (32 * voxel)));
  const mesh = assert_mesh(client.meshChunk(chunk));
  assert.deepEqual(mesh.node, chunk);
  assert.equal(client.meshChunk([0, 200, 0]), null);
});

test('questions about space are answered from the copy', () => {
  const hit = client.cast([20, 60, 20], { x: 0, y: -2, z: 0 });
  assert.equal(hit.kind, 'terrain');
  assert.ok(hit.normal[1] > 0.9 && hit.exact && !hit.inside);
  assert.equal(client.cast([20, 60, 20], [0, 1, 0]), null);
  const [above, below] = client.distances([...hit.place.with(1, hit.place[1] + 0.2), ...hit.place.with(1, hit.place[1] - 0.2)]);
  assert.ok(Math.abs(above - 0.2) < 0.06 && Math.abs(below + 0.2) < 0.06, `${above}, ${below}`);
  assert.ok(Math.abs(client.nearest(hit.place.with(1, hit.place[1] + 1)).distance - 1) < 0.06);
  assert.deepEqual(client.overlap(hit.place, 0.5), { terrain: true, ids: new Uint32Array(0) });
  const { voxel } = client.status();
  const at = hit.place.map((metres) => Math.floor(metres / voxel));
  const column = client.codes([at[0], at[1] - 4, at[2]], [at[0] + 1, at[1] + 4, at[2] + 1]);
  assert.ok(column.length === 8 && column[0] < 0 && column[7] > 0, String(column));
  assert.ok(client.material(hit.material).name.length > 0);
  assert.equal(client.findMaterial(client.material(1).name), 1);
  assert.equal(client.material(999), null);
});

test('a refusal rejects with its name, and what cannot be is thrown', async () => {
  await assert.rejects(client.carve({ centre: [0, 5, 0], radius: 500, seeds: 4 }), (error) => {
    assert.ok(error instanceof ScreeError && error.name.length > 0 && error.message.length > 10, String(error));
    return true;
  });
  await assert.rejects(client.carve({ centre: [0, 5], radius: 1 }), { name: 'invalid' });
  await assert.rejects(client.carve({ centre: [0, NaN, 0], radius: 1 }), { name: 'invalid' });
  await assert.rejects(client.paint({ centre: [0, 5, 0], radius: 1, material: 'cheese' }), { name: 'invalid' });
  await assert.rejects(client.fill({ shape: 'cone', centre: [0, 5, 0], radius: 1 }), { name: 'invalid' });
  await assert.rejects(client.breakPiece({ piece: 4e9, at: [0, 5, 0] }), ScreeError);
  assert.throws(() => client.cast([0, 0, 0], [0, 0, 0]), { name: 'invalid' });
});

test('what is no list, no number or no word is refused, and the client lives on', async () => {
  const wrong = [
    () => client.distances({ x: 6, y: 0, z: -24 }), () => client.distances([1, 2, 3, 4]), () => client.distances({ length: 3e9 }),
    () => client.codes([0, 0, 0], [1.9, 2, 2]), () => client.codes([2 ** 33, 0, 0], [2 ** 33 + 2, 2, 2]), () => client.meshChunk([NaN, 0, 0]),
    () => client.material('rock'), () => client.findMaterial(NaN), () => client.cast([0, 60, 0], [0, -1, 0], { of: ['terain'] }),
    () => client.cast([1, 2, 3, 4], [0, -1, 0]), () => client.send('ch', 5), () => client.say('a\0b'),
  ];
  for (const call of wrong) assert.throws(call, ScreeError, String(call));
  const shape = { centre: ground(14, 14), radius: 1 };
  const refused = [null, { ...shape, seeds: -1 }, { ...shape, seeds: 2 ** 32 + 1 }, { ...shape, piece: NaN }, { ...shape, shape: 'toString' }];
  for (const given of refused) await assert.rejects(client.carve(given), ScreeError, JSON.stringify(given));
  await assert.rejects(client.fill({ ...shape, material: 1.5 }), ScreeError);
  await assert.rejects(client.addBody({ radius: 0.5, position: [6, 10, -20], mass: -1 }), { name: 'invalid' });
  assert.equal(client.codes({ x: 0, y: 0, z: 0 }, { x: 2, y: 2, z: 2 }).length, 8);
  assert.equal(client.cast({ x: 14, y: 60, z: 14, length: () => 60 }, [0, -1, 0])?.kind, 'terrain', 'a vector of three.js has a function length');
  assert.ok(client.status().connected && ground(14, 14));
});

test('a client that leaves what was carved keeps it for its return', async () => {
  const wanderer = await connect(address, { eye: [0, 5, 0], radius: 32 });
  await wanderer.loaded();
  await wanderer.carve({ centre: [3, 0, 3], radius: 1, seeds: 8 });
  for (let x = 0; x <= 300; x += 50) {
    wanderer.follow([x, 5, 0], 32);
    await new Promise((resolve) => { setTimeout(resolve, 250); });
    assert.ok(wanderer.status().connected);
  }
  await wanderer.close();
});

test('fills, paints, blasts and bodies go by the same way', async () => {
  await client.fill({ shape: 'box', centre: ground(20, 0), half: [1, 1, 1], material: 1 });
  await client.paint({ centre: ground(20, 0), radius: 2, material: client.material(2).name });
  assert.equal(client.material(client.cast([20, 60, 0], [0, -1, 0]).material).name, client.material(2).name);
  await client.blast({ centre: ground(-12, 0), energy: 1e5 });
});

test('lines and persons are heard', async () => {
  const events = client.events();
  const other = await connect(address, { name: 'Ben', meets: true });
  await event_where(events, (event) => event.kind === 'person' && event.name === 'Ben', 'Ben');
  other.say('good day');
  const { text } = await event_where(client.events(), ({ kind }) => kind === 'said', 'a line');
  assert.equal(text, 'good day');
  await other.close();
});

test('the copy has the server\'s hash when all pieces have merged', async () => {
  const rest = () => {
    const status = client.status();
    return status.pieces === 0 && status.serverHash === status.fieldHash && status.serverTick > 0;
  };
  await event_where(client.events(), ({ kind }) => kind === 'status' && rest(), 'rest');
  const { fieldHash, mismatches } = client.status();
  assert.notEqual(fieldHash, 0n);
  assert.equal(mismatches, 0);
});

test('a closed client refuses, and its events end', async () => {
  const other = await connect(address);
  const events = other.events();
  const pending = other.carve({ centre: [0, 5, 0], radius: 1, seeds: 4 });
  await Promise.all([other.close(), assert.rejects(pending, { name: 'closed' })]);
  for await (const event of events) assert.ok(event.kind);
  assert.throws(() => other.status(), { name: 'closed' });
  await assert.rejects(other.carve({ centre: [0, 5, 0], radius: 1 }), { name: 'closed' });
});

test('no server, no address, and a token in the clear are errors in words', async () => {
  await assert.rejects(connect('ws://127.0.0.1:1'), (error) => error.name === 'connection_lost' && /127\.0\.0\.1/.test(error.message));
  await assert.rejects(connect('nowhere'), { name: 'invalid' });
  await assert.rejects(connect('ftp://127.0.0.1'), { name: 'invalid' });
  await assert.rejects(connect('ws://192.0.2.1', { token: 'x' }), (error) => error.name === 'invalid' && /wss:/.test(error.message));
});

test('a client works in a worker', async () => {
  const worker = new Worker(`
    import('scree-client').then(async ({ connect }) => {
      const client = await connect('${address}');
      require('worker_threads').parentPort.postMessage(client.status().tick);
      await client.close();
    });`, { eval: true });
  const [tick] = await once(worker, 'message');
  assert.ok(tick > 0);
  const [code] = await once(worker, 'exit');
  assert.equal(code, 0);
});

test('the bot of the examples carves, and its process ends', async () => {
  const bot = spawn(process.execPath, ['examples/javascript/bot/bot.js', address], { stdio: ['ignore', 'pipe', 'inherit'] });
  let said = '';
  bot.stdout.on('data', (data) => { said += data; });
  const limit = setTimeout(() => bot.kill('SIGKILL'), 60000);
  const [code] = await once(bot, 'close');
  clearTimeout(limit);
  assert.equal(code, 0);
  assert.equal(said.match(/^tick \d+: \d+ pieces/gm)?.length, 10, said);
});

test('a hundred clients, one after the other, leave nothing', async (t) => {
  const visit = async (times) => {
    for (let i = 0; i < times; ++i) {
      const other = await connect(address, { radius: 16 });
      await other.close();
    }
    for (let i = 0; i < 3; ++i) {
      globalThis.gc();
      await new Promise((resolve) => { setTimeout(resolve, 50); });
    }
    return process.memoryUsage();
  };
  const few = await visit(20), many = await visit(100);
  const grown = Object.fromEntries(Object.keys(few).map((key) => [key, ((many[key] - few[key]) / MB).toFixed(1)]));
  t.diagnostic(`MiB: ${JSON.stringify(grown)}; resident ${(many.rss / MB).toFixed(0)}`);
  assert.ok(many.heapUsed - few.heapUsed < 2 * MB && many.arrayBuffers - few.arrayBuffers < 2 * MB, JSON.stringify(grown));
  assert.ok(many.rss - few.rss < 40 * MB, JSON.stringify(grown));
});
