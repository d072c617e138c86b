// The first picture of the built page in Chromium, where the address says no camera: on every generated ground and every
// scene. SCREE_PICTURES names a folder for the pictures, for people.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { launch, open_page, until } from './browser.js';
import { agreement, silhouette } from './pictures.js';
import { host, run } from './server.js';

const WIDTH = 480, HEIGHT = 270, VIEW_M = 64;
const PLACES_AGREE = 0.95;
const TERRAINS = ['flat', 'noise', 'canyon'];
const SCENES = ['plain', 'cliffs', 'arch', 'tower', 'bridge', 'quarry', 'city', 'maunga-whau', 'store'];

let folder, browser;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'scree-first-'));
  browser = await launch();
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** What the page shows of that server, and what the native viewer does. */
async function first_pictures(name, options) {
  const server = await host(options);
  try {
    const { page } = await open_page(browser, `${server.url}#quality=low&view=${VIEW_M}`, { width: WIDTH, height: HEIGHT });
    await until(page, 'all within view is drawn', () => globalThis.scree?.state().complete);
    await until(page, 'the card is gone', () => getComputedStyle(document.querySelector('#gate')).visibility === 'hidden');
    await page.evaluate(() => document.body.classList.add('bare'));
    const shown = Buffer.from(await page.screenshot());
    const { camera } = await page.evaluate(() => globalThis.scree.state());
    await page.close();
    const file = join(folder, `${name}.png`);
    await run('scree-viewer', ['--host', '127.0.0.1', '--port', String(server.port), '--offscreen', '--size', `${WIDTH}x${HEIGHT}`, '--quality', 'low',
      '--view-radius', String(VIEW_M), '--screenshot', file]);
    return { shown, native: readFileSync(file), camera };
  } finally {
    await server.stop();
  }
}

async function check(t, name, options) {
  const { shown, native, camera } = await first_pictures(name, options);
  if (process.env.SCREE_PICTURES) writeFileSync(join(process.env.SCREE_PICTURES, `page_${name}.png`), shown);
  const { same, sky } = agreement(silhouette(shown), silhouette(native));
  t.diagnostic(`${name}: ${camera}; ${(100 * sky).toFixed(0)} % are sky, ${(100 * same).toFixed(1)} % as the viewer has them`);
  assert.ok(sky > 0.06 && sky < 0.7, `${name}: sky ${sky}`);
  assert.ok(same > PLACES_AGREE, `${name}: ${same} as the viewer`);
}

for (const terrain of TERRAINS)
  test(`the ground ${terrain} has ground and sky in its first picture`, (t) => check(t, terrain, ['--terrain', terrain]));

for (const scene of SCENES)
  test(`the scene ${scene} is in sight in its first picture`, async (t) => {
    const world = join(folder, `${scene}.world`);
    await run('scree-scene', ['make', scene, world]);
    await check(t, scene, ['--world', world]);
  });
