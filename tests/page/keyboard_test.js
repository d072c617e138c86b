// The built page in Chromium, by the keyboard alone: from its start to ten digs at one spot, a place, and the world's store.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { launch, open_page, until } from './browser.js';
import { host } from './server.js';

const EYE_M = 3;
const VIEW = `#camera=0,${EYE_M},6,0,-20&quality=low&view=16`;

let folder, browser, server, replay, page, complaints;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'scree-keyboard-'));
  server = await host(['--terrain', 'flat', '--record', join(folder, 'session.scree')]);
  browser = await launch();
  ({ page, complaints } = await open_page(browser, server.url + VIEW, { width: 640, height: 360 }));
});
after(async () => {
  await browser?.close();
  await replay?.stop();
  await server?.stop();
  rmSync(folder, { recursive: true, force: true });
});

const state = () => page.evaluate(() => globalThis.scree.state());
const answered = (number) => until(page, `answer ${number}`, (wanted) => globalThis.scree.state().mark.number >= wanted, number);
async function picture(name) {
  if (process.env.SCREE_PICTURES) writeFileSync(join(process.env.SCREE_PICTURES, `${name}.png`), await page.screenshot());
}

test('the keyboard alone digs ten times at one spot, places, and gives away', async (t) => {
  await until(page, 'the world is there', () => document.querySelector('#gate.open') && globalThis.scree.state().complete);
  assert.equal((await state()).tool.use, 'dig');
  await page.keyboard.down('ArrowDown');
  await until(page, 'it looks down', () => Number(globalThis.scree.state().camera.split(',')[4]) < -85);
  await page.keyboard.up('ArrowDown');
  const { camera } = await state();
  await picture('page_before');
  for (let dig = 1; dig <= 10; ++dig) {
    await page.keyboard.press('KeyE');
    await answered(dig);
    assert.equal((await state()).mark.refused, '');
  }
  const dug = await state();
  assert.equal(dug.camera, camera);
  const sum = dug.carried.reduce((all, { m3 }) => all + m3, 0);
  t.diagnostic(`ten digs took ${sum.toFixed(1)} m³`);
  await until(page, 'the ledger has it', (wanted) => Math.abs((globalThis.scree.state().status?.ledger.stored ?? 0) - wanted) < 1e-3, sum);
  const { ledger } = (await state()).status;
  assert.ok(Math.abs(ledger.terrain + ledger.pieces + ledger.dust + ledger.stored - ledger.poured) < 1e-6);
  await until(page, 'the bar has it', () => document.querySelectorAll('#tools .store i').length > 0);
  // A shaft of that much rock, as wide as the tool at most, is deeper than 3 m.
  assert.ok(sum / (Math.PI * dug.tool.radius_m ** 2) > 3, `${sum} m³`);
  await picture('page_dug');
  await page.keyboard.press('Digit2');
  await page.keyboard.press('KeyE');
  await answered(11);
  assert.equal((await state()).mark.refused, '');
  await page.keyboard.press('KeyU');
  await until(page, 'nothing is carried', () => globalThis.scree.state().carried.length === 0);
  await page.keyboard.press('KeyE');
  await until(page, 'the reason at the cross', () => document.querySelector('#why').textContent === 'you carry nothing');
  await picture('page_refused');
  assert.deepEqual(complaints.filter((one) => !/GL Driver Message/.test(one)), []);
});

test('a key that is held digs again and again', async () => {
  await page.keyboard.press('Digit1');
  const { number } = (await state()).mark;
  await page.keyboard.down('KeyE');
  await answered(number + 3);
  await page.keyboard.up('KeyE');
});

test('figures come by I, and all of them by F3', async () => {
  const shown = (id) => page.evaluate((name) => document.getElementById(name).checkVisibility(), id);
  assert.equal(await shown('readout'), false);
  await page.keyboard.press('KeyI');
  await until(page, 'figures', () => document.querySelector('#readout').checkVisibility());
  await page.keyboard.press('F3');
  await until(page, 'all figures', () => document.querySelector('#panel').checkVisibility());
  await page.keyboard.press('KeyI');
  await page.keyboard.press('F3');
  await until(page, 'none', () => !document.querySelector('#readout').checkVisibility() && !document.querySelector('#panel').checkVisibility());
});

test('J rewinds where a replay of the world runs, and Backspace returns', async () => {
  replay = await host(['--replay', join(folder, 'session.scree')]);
  await page.evaluate((port) => { location.hash = `${location.hash}&past=${port}`; }, replay.port);
  const { camera } = await state();
  await page.keyboard.press('KeyJ');
  await until(page, 'time runs backwards', () => { const playback = globalThis.scree?.state().playback; return playback?.playing && playback.speed === -1; });
  assert.equal(new URL(page.url()).port, String(replay.port));
  assert.equal((await state()).camera, camera);
  assert.equal(await page.evaluate(() => document.querySelector('#tools').checkVisibility() || document.querySelector('[data-page="tool"]').checkVisibility()), false,
    'a replay shows no tools');
  await picture('page_past');
  await page.keyboard.press('Backspace');
  await until(page, 'the present', (port) => location.port === port && globalThis.scree?.state().connection.phase === 'connected' && !globalThis.scree.state().playback, String(server.port));
});
