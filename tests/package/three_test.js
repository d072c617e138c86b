// The example of three.js in Chromium, by the real server, which serves it: it draws ground and sky with shadows, a click
// carves, pieces are shown, and the console has no complaint. SCREE_PICTURES names a folder for its pictures, for people.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { PNG } from 'pngjs';

const WIDTH = 480, HEIGHT = 270, LINES_MAX = 200;
const example = join(process.cwd(), 'examples', 'javascript', 'three');
process.env.SCREE_DIST = join(example, 'dist');
const { launch, open_page, until } = await import('./browser.js');
const { host } = await import('./server.js');

/** What a browser says of how a driver works. */
const EXPECTED = /GL Driver Message \(OpenGL, Performance/;

let server, browser;
before(async () => {
  execFileSync('npm', ['run', 'build', '--silent'], { cwd: example, stdio: ['ignore', 'ignore', 'inherit'] });
  server = await host(['--terrain', 'canyon', '--seed', '1']);
  browser = await launch();
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

test('the example has at most 200 lines', () => {
  const lines = ['index.html', 'main.js'].map((name) => readFileSync(join(example, name), 'utf8').split('\n').length - 1);
  assert.ok(lines[0] + lines[1] <= LINES_MAX, `${lines}`);
});

test('its modules are those of this test', () => {
  const pins = (file) => JSON.parse(readFileSync(file, 'utf8'));
  const own = pins(join(example, 'package.json')), ours = pins('package.json').dependencies;
  for (const [name, version] of Object.entries({ ...own.dependencies, ...own.devDependencies })) assert.equal(ours[name], version, name);
});

/** Shares of the picture: as the sky is, and dark. */
function shares(bytes) {
  const { data } = PNG.sync.read(bytes);
  let sky = 0, dark = 0;
  for (let i = 0; i < data.length; i += 4) {
    const [r, g, b] = data.subarray(i, i + 3);
    if (b > r + 8 && b > 120) ++sky;
    if (r + g + b < 210) ++dark;
  }
  return { sky: 4 * sky / data.length, dark: 4 * dark / data.length };
}

function keep(name, bytes) {
  if (process.env.SCREE_PICTURES) writeFileSync(join(process.env.SCREE_PICTURES, name), bytes);
}

test('it draws the world, and carves by a click', async (t) => {
  const { page, complaints } = await open_page(browser, server.url, { width: WIDTH, height: HEIGHT });
  await until(page, 'all is shown', () => document.querySelector('#state').value.startsWith('all is shown'));
  const before_click = Buffer.from(await page.screenshot());
  keep('three_world.png', before_click);
  const { sky, dark } = shares(before_click);
  t.diagnostic(`sky ${sky.toFixed(2)}, dark ${dark.toFixed(2)}; ${await page.evaluate(() => document.querySelector('#state').value)}`);
  assert.ok(sky > 0.02 && sky < 0.8, `sky ${sky}`);
  assert.ok(dark > 0.005, `no shadows: ${dark}`);

  // On a machine that draws a frame in seconds, pieces may have merged before they are shown: then it carves again.
  const has_pieces = () => /[1-9]\d* pieces/.test(document.querySelector('#state').value);
  const shows_pieces = () => page.waitForFunction(has_pieces, { timeout: 30_000 }).then(() => true, () => false);
  for (let carves = 0, shown = false; !shown; ++carves) {
    assert.ok(carves < 6, 'no piece is ever shown');
    await page.mouse.click(WIDTH / 2, 0.75 * HEIGHT);
    shown = await shows_pieces();
  }
  keep('three_pieces.png', Buffer.from(await page.screenshot()));
  await until(page, 'all have merged', () => /all is shown: \d+ blocks of terrain, 0 pieces/.test(document.querySelector('#state').value));
  const after_merge = Buffer.from(await page.screenshot());
  keep('three_merged.png', after_merge);
  const old = PNG.sync.read(before_click).data;
  const changed = PNG.sync.read(after_merge).data.filter((value, i) => Math.abs(value - old[i]) > 16).length;
  assert.ok(changed > 1000, `${changed} values changed`);
  assert.deepEqual(complaints.filter((one) => !EXPECTED.test(one)), []);
});
