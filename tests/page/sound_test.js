// Sound: the built page in Chromium plays what pieces do, by the browser's thread of sound, and by its own where a page by
// plain http has no other.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { launch, open_page, until, WAIT_MS } from './browser.js';
import { host } from './server.js';

const WIDTH = 640, HEIGHT = 360;
const VIEW = '#camera=24,8,16,50,-12&quality=low&view=32';
/** A name of this machine that a browser takes for another one's. */
const LAN = 'scree.example';
const HEARD = 0.01;
/** What a browser says of how a driver works, and of a page by plain http. */
const EXPECTED = /GL Driver Message|Cross-Origin-Opener-Policy header has been ignored/;

let browser, server;
before(async () => {
  server = await host(['--terrain', 'canyon', '--web-host', LAN]);
  browser = await launch([`--host-resolver-rules=MAP ${LAN} 127.0.0.1`]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const opened = async (url) => {
  const visit = await open_page(browser, url + VIEW, { width: WIDTH, height: HEIGHT });
  await until(visit.page, 'the world is shown', () => document.querySelector('#gate.open') && globalThis.scree.state().loaded);
  return visit;
};
/** The first click takes the mouse; the second strikes, by the tool that breaks rock. */
const strike = async (page) => {
  await page.keyboard.press('Digit3');
  if (await page.evaluate(() => document.pointerLockElement === null)) {
    await page.mouse.click(WIDTH / 2, HEIGHT / 2);
    await until(page, 'the mouse is taken', () => document.pointerLockElement !== null);
  }
  await page.mouse.click(WIDTH / 2, HEIGHT / 2);
};
/** Strikes until a strike is heard: a slow page may miss a click, and rock may be gone where the last one hit. */
async function strikes_until_heard(page) {
  for (const ends_ms = Date.now() + WAIT_MS; Date.now() < ends_ms;) {
    await strike(page);
    const is_heard = page.waitForFunction((least) => globalThis.scree.sound() > least, { polling: 100, timeout: WAIT_MS / 6 }, HEARD);
    if (await is_heard.then(() => true, () => false)) return;
  }
  assert.fail(`no strike is heard: ${JSON.stringify(await page.evaluate(() => globalThis.scree.state()))}`);
}

async function strikes_are_heard(url, worklet) {
  const { page, complaints, close } = await opened(url);
  assert.equal(await page.evaluate(() => 'audioWorklet' in AudioContext.prototype), worklet);
  const asked = () => page.evaluate(() => performance.getEntriesByType('resource').filter(({ name }) => /\/sound\.[^/]*wasm/.test(name)).length);
  assert.equal(await asked(), 0, 'nothing of it is loaded before the first gesture');
  assert.equal(await page.evaluate(() => globalThis.scree.sound()), -1);
  await page.mouse.click(WIDTH / 2, HEIGHT / 2);
  await until(page, 'sound plays', () => globalThis.scree.sound() === 0);
  assert.equal(await asked(), 1);
  await strikes_until_heard(page);
  await until(page, 'it dies away', () => globalThis.scree.sound() === 0);
  await page.keyboard.press('Digit6');
  await until(page, 'it is off', () => globalThis.scree.sound() === -1);
  assert.equal(await page.evaluate(() => JSON.parse(localStorage.getItem('scree')).sound), false);
  await page.keyboard.press('Digit6');
  await until(page, 'it is on', () => globalThis.scree.sound() >= 0);
  await strikes_until_heard(page);
  assert.deepEqual(complaints.filter((one) => !EXPECTED.test(one)), []);
  await close();
}

test('strikes are heard by the thread of sound, after a gesture, and not while it is off', () => strikes_are_heard(server.url, true));

test('a page by plain http from elsewhere sounds as well', () => strikes_are_heard(`http://${LAN}:${server.port}/`, false));

test('a person who turned sound off has it off the next time', async () => {
  const { page, close } = await opened(server.url);
  await page.evaluate(() => localStorage.setItem('scree', JSON.stringify({ sound: false })));
  await page.reload();
  await until(page, 'the world is shown', () => document.querySelector('#gate.open') && globalThis.scree.state().loaded);
  await strike(page);
  await until(page, 'pieces fly', () => globalThis.scree.state().pieces_near > 0);
  assert.equal(await page.evaluate(() => globalThis.scree.sound()), -1);
  await page.keyboard.press('Digit6');
  await until(page, 'it plays', () => globalThis.scree.sound() >= 0);
  await close();
});
