// Whole sessions: the built page in Chromium, by the real server. All tests look at one page, one after the other.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, readdirSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { launch, open_page, until } from './browser.js';
import { agreement, silhouette } from './pictures.js';
import { DIST, host, run } from './server.js';

const CAMERA = '30,9,19,63,-7', WIDTH = 640, HEIGHT = 360, VIEW_M = 32;
const VIEW = `#camera=${CAMERA}&quality=low&view=${VIEW_M}`;
const CODE_BYTES_MAX = 600 * 1024;
const FIELDS_AGREE = 0.98;

let folder, browser, server, page, complaints, loaded_bytes = 0;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'scree-page-'));
  server = await host(options());
  browser = await launch();
});
after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(folder, { recursive: true, force: true });
});

function options() {
  return ['--terrain', 'canyon', '--world', join(folder, 'world.scree'), '--record', join(folder, 'session.scree')];
}
const state = () => page.evaluate(() => globalThis.scree.state());
const all_in_view = () => until(page, 'all within view is drawn', () => globalThis.scree?.state().complete);
const hide = (hidden) => page.evaluate((bare) => document.body.classList.toggle('bare', bare), hidden);

async function picture() {
  await hide(true);
  const png = Buffer.from(await page.screenshot());
  await hide(false);
  return png;
}

/** The server's hash of the field, once it has been the same for some seconds. */
const last_hash = () => page.evaluate(async () => {
  let hash, since = 0;
  while (performance.now() - since < 3000) {
    const now = globalThis.scree.state().status?.field_hash;
    if (now !== hash) [hash, since] = [now, performance.now()];
    await new Promise((resolve) => { setTimeout(resolve, 200); });
  }
  return hash;
});

/** What a browser says of a server that is gone, and of how a driver works. */
const EXPECTED = /WebSocket connection to .* failed|ERR_CONNECTION_REFUSED|GL Driver Message \(OpenGL, Performance/;

/** No check failed, OpenGL met no error, and the browser complains of nothing else. */
async function assert_well() {
  const { draw, mirror } = await state();
  assert.equal(draw.gl_errors, 0, draw.first_gl_error);
  assert.equal(mirror.mismatches, 0);
  assert.deepEqual(complaints.filter((one) => !EXPECTED.test(one)), []);
}

test('the page opens, joins, and draws all within view', async (t) => {
  const visit = await open_page(browser, 'about:blank', { width: WIDTH, height: HEIGHT });
  ({ page, complaints } = visit);
  const wire = await page.createCDPSession();
  await wire.send('Network.enable');
  wire.on('Network.loadingFinished', ({ encodedDataLength }) => { loaded_bytes += encodedDataLength; });
  const begun = Date.now();
  await page.goto(server.url + VIEW);
  await until(page, 'the world is shown', () => document.querySelector('#gate.open'));
  t.diagnostic(`first picture after ${Date.now() - begun} ms`);
  await all_in_view();
  t.diagnostic(`all within ${VIEW_M} m after ${Date.now() - begun} ms, at ${WIDTH}x${HEIGHT}`);
  await assert_well();
});

// As web_dist.mjs counts it: scree.wasm and scree.js.
test('its code is small', async (t) => {
  const code = readdirSync(DIST).filter((name) => /^scree\..*\.(js|wasm)\.gz$/.test(name)).reduce((sum, name) => sum + statSync(join(DIST, name)).size, 0);
  t.diagnostic(`${code} bytes of code, compressed; ${loaded_bytes} were loaded, with all else and the answers' heads`);
  assert.ok(loaded_bytes > code / 2 && code <= CODE_BYTES_MAX, `${code} bytes`);
});

test('mesh and raymarch draw what the native viewer draws', async (t) => {
  for (const method of ['mesh', 'raymarch']) {
    await page.evaluate((name) => { location.hash = location.hash.replace(/&method=[a-z]*|$/, `&method=${name}`); }, method);
    await until(page, `${method} draws`, (name) => { const { draw, complete, preparing } = globalThis.scree.state(); return draw.method === name && complete && !preparing; }, method);
    const native = join(folder, `${method}.png`);
    await run('scree-viewer', ['--host', '127.0.0.1', '--port', String(server.port), '--offscreen', '--size', `${WIDTH}x${HEIGHT}`, `--camera=${CAMERA}`, '--method', method,
      '--quality', 'low', '--view-radius', String(VIEW_M), '--screenshot', native]);
    const { same, sky } = agreement(silhouette(readFileSync(native)), silhouette(await picture()));
    t.diagnostic(`${method}: ${(100 * same).toFixed(2)} % of the pixels agree, ${(100 * sky).toFixed(0)} % are sky`);
    assert.ok(sky > 0.05 && sky < 0.95, `${method}: sky ${sky}`);
    assert.ok(same >= FIELDS_AGREE, `${method}: ${same}`);
    await assert_well();
  }
});

test('a click carves; pieces fly, and are terrain again; the field is the server\u2019s', async () => {
  const made = (await state()).mirror.pieces_made;
  await page.mouse.click(WIDTH / 2, HEIGHT / 2);
  await until(page, 'the mouse is taken', () => document.pointerLockElement !== null);
  assert.equal((await state()).mirror.pieces_made, made);
  await page.keyboard.press('Digit3');
  await page.mouse.click(WIDTH / 2, HEIGHT / 2);
  await until(page, 'pieces fly', () => globalThis.scree.state().pieces_near > 0);
  await until(page, 'all pieces are terrain', () => { const { status, pieces_near, mirror } = globalThis.scree.state(); return pieces_near === 0 && status?.pieces === 0 && mirror.pieces_merged > 0; });
  assert.ok((await state()).mirror.checks > 0);
  await assert_well();
});

test('a blast of dozens of pieces arrives', async (t) => {
  await page.evaluate(() => {
    globalThis.longest_ms = 0;
    new PerformanceObserver((list) => { for (const { duration } of list.getEntries()) globalThis.longest_ms = Math.max(globalThis.longest_ms, duration); }).observe({ entryTypes: ['longtask'] });
  });
  await page.keyboard.press('Tab');
  await page.click('#tabs button');
  await page.$eval('#panel input[aria-label="Pieces"]', (input) => {
    input.value = 64;
    input.dispatchEvent(new Event('input'));
    input.dispatchEvent(new Event('change'));
  });
  await page.click('#panel header button');
  await page.evaluate((camera) => globalThis.scree.camera(camera), '24,8,16,50,-12');
  await page.evaluate(() => new Promise((resolve) => { setTimeout(resolve, 1000); }));
  await all_in_view();
  await page.mouse.click(WIDTH / 2, HEIGHT / 2);
  await until(page, 'the mouse is taken', () => document.pointerLockElement !== null);
  const before_ms = await page.evaluate(() => { const ms = globalThis.longest_ms; globalThis.longest_ms = 0; return ms; });
  await page.mouse.click(WIDTH / 2, HEIGHT / 2);
  // Natural sizes: half as many as asked for, and more; the finest are dust.
  await until(page, 'they fly', () => globalThis.scree.state().pieces_near >= 25);
  await until(page, 'they come to rest', () => globalThis.scree.state().status?.pieces === 0);
  const { frame } = await state();
  t.diagnostic(`longest task ${await page.evaluate(() => globalThis.longest_ms)} ms (before: ${before_ms}), longest message ${frame.apply_worst_ms.toFixed(1)} ms, longest job ${frame.work_worst_ms.toFixed(1)} ms; software draws in these tasks, too`);
  await assert_well();
});

test('after a restart of the server the page comes back to the same world', async () => {
  const { camera } = await state();
  const hash = await last_hash();
  await server.stop();
  await until(page, 'the page says that the connection is lost', () => /connection is lost/.test(document.querySelector('#notice').textContent));
  server = await host(options(), server.port);
  await until(page, 'it is connected again', () => globalThis.scree.state().connection.phase === 'connected');
  await until(page, 'it knows the world again', () => globalThis.scree.state().status !== null);
  assert.equal(await last_hash(), hash);
  assert.equal((await state()).camera, camera);
  await all_in_view();
  await assert_well();
});

test('a replay has its timeline, which is dragged', async () => {
  await page.goto('about:blank');
  await server.stop();
  server = await host(['--replay', join(folder, 'session.scree')]);
  complaints.length = 0;
  await page.goto(server.url + VIEW);
  await until(page, 'the timeline is there', () => globalThis.scree?.state().playback && document.querySelector('#timeline').checkVisibility());
  await until(page, 'the card is gone', () => getComputedStyle(document.querySelector('#gate')).visibility === 'hidden');
  await until(page, 'it has marks', () => document.querySelectorAll('#timeline .legend span').length > 0);
  const box = await (await page.$('#timeline .track')).boundingBox();
  const { first, last } = (await state()).playback;
  await page.mouse.click(box.x + box.width * 0.9, box.y + 10);
  await until(page, 'the moment is the one that was clicked', ([tick]) => globalThis.scree.state().playback.moment >= tick, [first + 0.85 * (last - first)]);
  await page.click('#timeline [aria-label^="Play"]');
  await until(page, 'the replay holds', () => globalThis.scree.state().playback.playing === false);
  await page.mouse.click(box.x + box.width * 0.05, box.y + 10);
  await until(page, 'it goes back', ([tick]) => globalThis.scree.state().playback.moment <= tick, [first + 0.1 * (last - first)]);
  await until(page, 'the field is there', () => globalThis.scree.state().mirror !== null);
  await assert_well();
});

test('the status page shows the server live', async () => {
  const visit = await open_page(browser, `${server.url}status`, { width: 1280, height: 800 });
  await until(visit.page, 'figures are there', () => document.querySelectorAll('#stages .bars i').length > 0);
  const tick = await visit.page.$eval('#server', (text) => text.textContent);
  await until(visit.page, 'they go on', (before) => document.querySelector('#server').textContent !== before, tick);
  assert.deepEqual(visit.complaints, []);
  await visit.close();
});
