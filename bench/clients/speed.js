// As speed.c, by the npm package under Node: microseconds of the main thread's processor time. usage: node speed.js PORT
import { readFileSync } from 'node:fs';
import { performance } from 'node:perf_hooks';

import { connect } from 'scree-client';

const CARVES = 48, ROUNDS = 200, MESH_ROUNDS = 15, SIDE = 4;
const median = (times) => times.sort((a, b) => a - b)[Math.floor(times.length / 2)];
const us_of = (work) => {
  const begun = performance.now();
  work();
  return (performance.now() - begun) * 1000;
};
/** What the main thread has had of a processor until now; Linux says it. */
const cpu_us = () => Number(readFileSync(`/proc/self/task/${process.pid}/schedstat`, 'utf8').split(' ')[0]) / 1000;
const rest = (ms) => new Promise((resolve) => { setTimeout(resolve, ms); });

const client = await connect(`ws://127.0.0.1:${process.argv[2]}`, { once: true, eye: [0, 8, 0] });
await client.loaded();
let ticks = 0;
(async () => { for await (const { kind } of client.events()) if (kind === 'frame') ++ticks; })();
await rest(500);
ticks = 0;
const before_us = cpu_us();
for (let i = 0; i < CARVES; ++i) {
  const centre = [i % 8 * 5 - 18, 0, Math.floor(i / 8) * 5 - 14];
  client.carve({ centre, radius: 1.6, seeds: 24, randomSeed: i }).catch(() => {});
  await rest(110);
}
const tick_us = (cpu_us() - before_us) / ticks;

// Arrays of their own at each call, and as speed.c into those that there are.
let bodies = null;
const new_poses = median(Array.from({ length: ROUNDS }, () => us_of(() => { bodies = client.bodies(); })));
const poses = median(Array.from({ length: ROUNDS }, () => us_of(() => { client.bodies(-1, bodies); })));
const { count } = bodies;

let chunks = 0;
const mesh = median(Array.from({ length: MESH_ROUNDS }, () => us_of(() => {
  chunks = 0;
  for (let x = -SIDE / 2; x < SIDE / 2; ++x)
    for (let z = -SIDE / 2; z < SIDE / 2; ++z)
      for (let y = -1; y <= 0; ++y) if (client.meshChunk([x, y, z])) ++chunks;
})));
console.log(`${tick_us.toFixed(1)} ${(mesh / chunks).toFixed(1)} ${(poses * 1000 / count).toFixed(2)} ${count} pieces (in new arrays ${(new_poses * 1000 / count).toFixed(2)}), ${chunks} chunks, ${ticks} ticks`);
await client.close();
