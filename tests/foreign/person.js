// The test of persons on foot, stores and regions, by the protocol alone: a builder of the team red walks, digs, carries and
// places; a director gives red a region and counts its rock; somebody of the team blue may not edit there. Masses are
// compared to the unit. Prints one line for each step.
//   node person.js SERVER TOKEN_PROGRAM PROTO
import { deepStrictEqual as same, ok } from 'node:assert';
import { execFileSync } from 'node:child_process';

import Long from 'long';

import { startServer } from './host.js';
import { Player, WALKS_M_S, sumOf, unpackStore } from './player.js';
import { bigOf } from './world.js';

const SPHERE = 0;
const BOX = 1;
const STORE = { WORLD: 1, TOKEN: 2, NAMED: 4 };
const FORBIDS_EDITS = 1;
const EDITORS_PERSONS = 2;
const RUNS_M_S = 7.5;
const BODY_HEIGHT_M = 1.7;
const REACH_M = 8;
const HEIGHT_OF_ORIGIN_M = BODY_HEIGHT_M / 2;

const [server, tokenProgram, proto] = process.argv.slice(2);
const near = (a, b, most, what) => ok(Math.abs(a - b) <= most, `${what}: ${a} in place of ${b}, at most ${most} apart`);
const apart = (a, b) => Math.hypot(a.x - b.x, a.y - b.y, a.z - b.z);
const speedOf = ({ speed_m_s }) => Math.hypot(speed_m_s.x, speed_m_s.z);
const flat = (a, b) => Math.hypot(a.x - b.x, a.z - b.z);
const beside = ({ x, y, z }, dx, dy, dz) => ({ x: x + dx, y: y + dy, z: z + dz });
const ball = (a, radius_m) => ({ kind: SPHERE, a, radius_m });
const box = (a, x, y, z) => ({ kind: BOX, a, b: { x, y, z } });
const text = (bytes) => Buffer.from(bytes).toString();
const say = (step, figures) => console.log(JSON.stringify({ step, ...figures }));

// ---- a world for three

execFileSync(tokenProgram, ['key', 'world.key']);
const token = (...words) => execFileSync(tokenProgram, ['new', '--key', 'world.key', ...words]).toString().trim();
const walking = ['--terrain', 'flat', '--persons', 'walk', '--spawn', '0,3,0', '--reach', String(REACH_M)];
const host = await startServer(server, [...walking, '--token-key', 'world.key.pub']);
const redToken = token('--role', 'builder', '--name', 'Rob', '--team', 'red');
const blueToken = token('--role', 'carver', '--name', 'Bea', '--team', 'blue');
const join = (name, words, eye) => Player.join({ name, port: host.port, proto, token: words, eye });
const red = await join('Rob', redToken);
const blue = await join('Bea', blueToken);
const director = await join('Ann', token('--role', 'director', '--name', 'Ann'), { x: 0, y: 6, z: 0 });

/** The id in a token's payload, behind the role (access.proto). */
const idOf = (words) => Buffer.from(words.slice('scree1.'.length), 'base64url').readBigUInt64LE(1);

/** The masses that somebody's own store has, which the server has said. */
const carriedBy = (player) => player.stores?.[0]?.masses ?? new Map();

/** Carries out a request that changes the own store, and resolves to the reply's mass when the store is told. */
async function moves(player, kind, content) {
  const before = player.stores;
  const reply = await player.demand(kind, content);
  await player.until('its store', () => player.stores !== before);
  return bigOf(reply.mass);
}

// ---- on foot

async function walks() {
  await red.refused('not_on_foot', 'dig', { shape: ball({ x: 2, y: 0, z: 0 }, 1) });
  const body = await red.stand();
  await blue.until('the body of somebody else', () => blue.world.pieces.get(body));
  same(bigOf(blue.world.pieces.get(body).prop.tag), bigOf(red.welcome.session), 'a body has the tag of its session');
  same(blue.persons.get(red.session), body, 'everybody is told who is on foot');
  const standing = await red.walk(60, {}); // visitors begin in the air, and fall
  const start = red.feet;
  ok(standing.stands, 'the person stands');
  near(flat(start, red.welcome.spawn), 0, 0.01, 'where visitors begin');
  const down = await red.question({
    ray: { from: beside(start, 0, 1, 0), direction: { y: -1 }, most_m: 4 },
    mask: { no_props: true },
  });
  near(down.hit.distance_m, 1, 0.05, 'the ground under the feet');

  const hz = red.welcome.tick_rate_hz;
  const walking = await red.walk(2 * hz, { x: 1 });
  near(walking.speed_m_s.x, WALKS_M_S, 0.01, 'the speed of a walk');
  near(walking.feet.x - start.x, 2 * WALKS_M_S, 2, 'the way of two seconds');
  near(walking.feet.z, start.z, 0.01, 'no other way');
  const turned = red.feet;
  const running = await red.walk(hz, { z: 0.6, x: -0.8, fast: true });
  near(speedOf(running), RUNS_M_S, 0.01, 'the speed of a run');
  near(flat(running.feet, turned), RUNS_M_S, 2, 'the way of a second');
  await red.until('a rest without inputs', () => speedOf(red.own) === 0);
  const jumping = await red.walk(hz / 4, { jump: true });
  ok(jumping.feet.y > start.y + 0.5, `a jump leads up to ${jumping.feet.y}`);
  near((await red.walk(hz, {})).feet.y, start.y, 0.02, 'and down again');
  await blue.until('the place of somebody else', () => {
    const { position } = blue.world.pieces.get(body);
    const [x, y, z] = position.map((steps) => steps / 1024);
    return flat({ x, z }, red.feet) < 0.01 && Math.abs(y - HEIGHT_OF_ORIGIN_M - red.feet.y) < 0.01;
  });
  say('walks', { body, feet: red.feet, inputs: red.own.taken });
}

/** Inputs and eyes that would lead elsewhere. */
async function lies() {
  const hz = red.welcome.tick_rate_hz;
  const refusalOf = (number) => red.until(`input ${number} to be refused`, () => red.refusedInputs.get(number));
  const before = red.feet;
  const { taken } = red.own;
  red.input({ x: 1 }, taken);
  same(await refusalOf(taken), 'walk_invalid', 'a number that was');
  red.input({ x: 1 }, taken + 602);
  same(await refusalOf(taken + 602), 'walk_invalid', 'a number of the future');
  red.input({ x: 2 }, taken + 2);
  same(await refusalOf(taken + 2), 'walk_invalid', 'twice the full speed');
  const away = { x: 300, y: 2, z: 0 };
  red.look(away);
  red.send('cursor', { eye: away, aim: away });
  await red.refused('reach', 'dig', { shape: ball(beside(away, 0, -2, 0), 1) });
  red.tell('shop', 'buy 1'); // nobody listens: skipped
  await red.refused('role', 'rules', Buffer.from([0x1a, 5, ...Buffer.from('score')]));
  same([red.game.signs, red.game.cues, red.game.heard], [[], [], []], 'a server without rules shows nothing');
  await red.refused('walk_invalid', 'stand', { place: away });
  await red.walk(hz / 4, {});
  near(apart(red.feet, before), 0, 1e-6, 'who lies stays in place');

  near(speedOf(await red.walk(hz, { x: -1, z: -1 })), WALKS_M_S, 0.01, 'the speed aslant');
  const from = red.feet;
  const first = red.own.taken + 1;
  for (let i = 0; i < 3 * hz; i++) red.input({ x: -1, fast: true });
  await red.until('inputs to be refused', () => red.refusedInputs.size > 2 * hz);
  same([...red.refusedInputs.values()].filter((name) => name === 'inputs_waiting').length > hz, true, 'too many at once');
  await red.until('a rest', () => speedOf(red.own) === 0);
  const isWithin = (number) => number >= first && number <= red.own.taken;
  const carriedOut = red.own.taken - first + 1 - [...red.refusedInputs.keys()].filter(isWithin).length;
  ok(from.x - red.feet.x <= (carriedOut * RUNS_M_S) / hz + 1, `${carriedOut} inputs led ${from.x - red.feet.x} m`);
  say('lies', { refused: red.refusedInputs.size, carriedOut, feet: red.feet });
}

// ---- digging and placing

/** What was dug is in the own store; of it a heap is placed some metres on, and partly dug again. */
async function digs() {
  const pit = ball(beside(red.feet, -2, -0.2, 0), 1.5);
  const dug = await moves(red, 'dig', { shape: pit });
  const [store] = red.stores;
  same([store.kind, store.number], [STORE.TOKEN, idOf(redToken)], 'the store of the token');
  ok(dug > 0n && sumOf(store.masses) === dug, `${dug} dug, ${sumOf(store.masses)} in the store`);
  const again = await moves(red, 'dig', { shape: ball(beside(red.feet, -2, -1.2, 0), 1.5) });
  same(sumOf(carriedBy(red)), dug + again, 'two digs');

  const there = beside(red.feet, 6, 0, 0);
  await red.walkTo(there, 1);
  same(sumOf(carriedBy(red)), dug + again, 'what is carried goes along');
  const masses = new Map(carriedBy(red));
  const [material, most] = [...masses].reduce((a, b) => (b[1] > a[1] ? b : a));
  const heap = box(beside(red.feet, 2.5, 0.5, 0), 0.75, 0.5, 0.75);
  await red.refused('in_the_way', 'place', { shape: box(red.feet, 0.5, 0.5, 0.5), material });
  await red.refused('store_lacks', 'place', { shape: box(beside(red.feet, 6, 0, 0), 4, 4, 4), material });
  const placed = await moves(red, 'place', { shape: heap, material });
  ok(placed > 0n && placed < most, `${placed} of ${most} placed`);
  same(carriedBy(red), new Map([...masses, [material, most - placed]]), 'what is left');
  const rubble = await moves(red, 'dig', { shape: ball(heap.a, 0.5) });
  ok(rubble > 0n && rubble < placed, `${rubble} of ${placed} dug again`);
  same(carriedBy(red), new Map([...masses, [material, most - placed + rubble]]), 'stones of rubble are rock');
  say('digs', { dug: Number(dug + again), material, placed: Number(placed), rubble: Number(rubble) });
}

/** Gives all that it carries to the world; what the director moves from there to red is that. */
async function transfers() {
  const mine = new Map(carriedBy(red));
  await red.refused('role', 'transfer', { from: {}, to: { kind: STORE.NAMED, name: Buffer.from('red') } });
  const given = await moves(red, 'transfer', { from: {}, to: { kind: STORE.WORLD } });
  same(given, sumOf(mine), 'all was given');
  same(carriedBy(red), new Map(), 'and nothing is left');
  const all = await storesOfAll();
  same(all.map(({ kind, masses }) => [kind, masses]), [[STORE.WORLD, mine]], 'the world has it');
  const [material] = mine.keys();
  const to = { kind: STORE.NAMED, name: Buffer.from('red') };
  const moved = bigOf((await director.demand('transfer', { from: { kind: STORE.WORLD }, to, material, mass: 1000 })).mass);
  same(moved, 1000n, 'as much as was said');
  const named = (await storesOfAll()).find(({ kind }) => kind === STORE.NAMED);
  same([named.name, named.masses], ['red', new Map([[material, 1000n]])]);
  const { tick } = director.status;
  await director.until('the ledger', () => bigOf(director.status.tick) > bigOf(tick));
  same(bigOf(director.status.ledger_stored), sumOf(mine), 'the ledger has what stores have');
  say('transfers', { given: Number(given) });
}

const storesOfAll = async () => (await director.demand('admin', { list_stores: {} })).stores.map(unpackStore);

// ---- a region

const MILL = { x: 0, y: 0, z: 24 };
const HALF_M = 6;
const MEMBERS = ['cut', 'pieces', 'dust', 'carried', 'back', 'away'];

async function massesOfMill() {
  const region = Buffer.from('mill');
  const { region_masses: rows } = await director.demand('admin', { list_region_masses: { region } });
  const { id } = director.regions[0];
  return rows.map((row) => {
    const { cut, pieces, dust, carried, back, away } = Object.fromEntries(MEMBERS.map((member) => [member, bigOf(row[member])]));
    same(cut, pieces + dust + carried + back + away, 'a row adds up');
    same(row.region, id, 'the region of a row');
    same(bigOf(row.party), bigOf(red.welcome.session), 'the party of a row');
    return { material: row.material, cut, pieces, dust, carried, back, away };
  });
}

const sumOfRows = (rows, member) => rows.reduce((sum, row) => sum + row[member], 0n);
const carriedInRows = (rows) => new Map(rows.filter(({ carried }) => carried > 0n).map((row) => [row.material, row.carried]));

/** Red's region: blue is refused there, red digs there, and every unit of it is known. */
async function region() {
  const mill = {
    name: Buffer.from('mill'),
    form: 0,
    centre: MILL,
    half: { x: HALF_M, y: HALF_M, z: HALF_M },
    forbids: FORBIDS_EDITS,
    editors: EDITORS_PERSONS,
    teams: [Buffer.from('red')],
    counts: true,
  };
  await red.refused('role', 'set_region', { region: mill });
  await director.demand('set_region', { region: mill });
  for (const player of [red, blue, director]) {
    const [seen, ...others] = await player.until('regions', () => player.regions.length > 0 && player.regions);
    same(others, []);
    same([text(seen.name), text(seen.teams[0]), seen.forbids, seen.counts], ['mill', 'red', FORBIDS_EDITS, true]);
    same([seen.centre.z, seen.half.x], [MILL.z, HALF_M]);
  }
  await blue.stand();
  await blue.refused('role', 'place', { shape: ball(beside(blue.feet, 2, 0, 0), 0.5), material: 0, solid: true });
  await Promise.all([red, blue].map((player) => player.walkTo(MILL, HALF_M + 0.5)));
  const edge = { x: red.feet.x, y: 0, z: red.feet.z + 2.5 };
  for (const player of [blue, director]) {
    player.look(player === blue ? blue.feet : { x: 0, y: 6, z: 16 });
    const words = await player.refused('in_region', 'dig', { shape: ball(edge, 1) });
    ok(words.includes('mill') && words.includes('red'), words);
  }
  same(blue.stores, null, 'who is refused has nothing');
  same(await massesOfMill(), [], 'nothing is broken yet');

  const dug = await moves(red, 'dig', { shape: ball(edge, 1.5) });
  const rows = await massesOfMill();
  same([sumOfRows(rows, 'cut'), sumOfRows(rows, 'carried')], [dug, dug], 'all of it is carried');
  same(carriedInRows(rows), carriedBy(red), 'by material, too');
  say('region', { dug: Number(dug) });
  return { dug, edge };
}

/** What becomes of it: back in the region, elsewhere, in pieces. */
async function becomes({ dug, edge }) {
  const material = [...carriedBy(red)].reduce((a, b) => (b[1] > a[1] ? b : a))[0];
  const within = beside(edge, 3, 0.5, 0.5);
  const solid = true; // rubble would slide, and carry away some of the soil below
  const back = await moves(red, 'place', { shape: box(within, 0.5, 0.5, 0.5), material, solid });
  let rows = await massesOfMill();
  // A little of the soil on which it lies becomes rock, or moves to the next brick: that is cut, and back at once.
  const moved = sumOfRows(rows, 'cut') - dug;
  ok(moved >= 0n && moved < dug / 10n, `${moved} moved`);
  same([sumOfRows(rows, 'back'), sumOfRows(rows, 'away')], [back + moved, 0n], 'it is terrain there again');
  same(carriedInRows(rows), carriedBy(red), 'the rest is carried');
  const away = await moves(red, 'place', { shape: box(beside(red.feet, 2.5, 0.5, -2), 0.5, 0.5, 0.5), material, solid });
  rows = await massesOfMill();
  same(sumOfRows(rows, 'cut'), dug + moved, 'no more was broken');
  same([sumOfRows(rows, 'back'), sumOfRows(rows, 'away')], [back + moved, away], 'it is terrain elsewhere');
  same(carriedInRows(rows), carriedBy(red), 'the rest is carried');

  const shape = ball(beside(edge, -3, 0, 1), 1);
  const { pieces } = await red.demand('carve', { shape, pattern: 1, seeds: 8, random_seed: 5, impact: edge, blast_speed_m_s: 2 });
  ok(pieces > 1, `${pieces} pieces`);
  for (let i = 0; i < 10; i++) {
    rows = await massesOfMill();
    ok(sumOfRows(rows, 'cut') > dug + moved, 'a carve counts');
    same(carriedInRows(rows), carriedBy(red), 'nobody carries what was carved');
  }
  say('becomes', Object.fromEntries(MEMBERS.map((member) => [member, Number(sumOfRows(rows, member))])));
}

/** The director takes what red carries, mixed with rock from elsewhere: it is known still. */
async function changesHands() {
  const mine = new Map(carriedBy(red));
  const from = { kind: STORE.TOKEN, number: Long.fromString(idOf(redToken).toString(), true) };
  await director.demand('transfer', { from, to: { kind: STORE.NAMED, name: Buffer.from('red') } });
  await red.until('its store', () => carriedBy(red).size === 0);
  same(carriedInRows(await massesOfMill()), mine, 'carried by the team');
}

/** Everybody leaves; the copies of the world are the server's. */
async function ends() {
  await director.demand('remove_region', { name: Buffer.from('mill') });
  await red.until('no regions', () => red.regions.length === 0);
  await red.demand('stand', { away: true });
  await blue.until('its leave', () => !blue.persons.has(red.session));
  await red.refused('not_on_foot', 'place', { shape: ball(beside(MILL, 0, 1, 0), 0.5), material: 0 });
  await director.until('rest', () => director.status.pieces === 0 && director.status.chunks_waiting === 0);
  await director.until('the hash of the server', () => director.world.fieldHash() === bigOf(director.status.field_hash));
  const stored = (await storesOfAll()).reduce((sum, { masses }) => sum + sumOf(masses), 0n);
  same(bigOf(director.status.ledger_stored), stored, 'the ledger has what stores have');
  for (const player of [red, blue, director]) player.leave();
  say('ends', { checks: director.world.counts.checks, patched: director.world.counts.patched });
}

await walks();
await lies();
await digs();
await transfers();
await becomes(await region());
await changesHands();
await ends();
same(await host.stop(), 0, "the server's exit status");
