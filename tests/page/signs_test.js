// What the rules of a game show and tell in the built page, in Chromium: lines, bars, markers, cues, and messages of a script.
// The server is game_host (game_host.cpp), which shows what it is told by messages.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { launch, open_page, until } from './browser.js';
import { host } from './server.js';

const WIDTH = 960, HEIGHT = 540;
const VIEW = '#camera=0,4,12,0,-10&quality=low&view=24';

let browser, server, page, complaints;
before(async () => {
  server = await host(['--terrain', 'flat'], 0, 'game_host');
  browser = await launch();
  ({ page, complaints } = await open_page(browser, server.url + VIEW, { width: WIDTH, height: HEIGHT }));
  await until(page, 'the world is there', () => document.querySelector('#gate.open') && globalThis.scree.state().complete);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const tell = (text) => page.evaluate((words) => globalThis.scree.send('game', words), text);
const rows = () => page.evaluate(() => [...document.querySelectorAll('#signs li')].map((row) => row.innerText.trim()));
async function picture(name) {
  if (process.env.SCREE_PICTURES) writeFileSync(join(process.env.SCREE_PICTURES, `${name}.png`), await page.screenshot());
}

test('where no sign is, the page shows none', async () => {
  assert.deepEqual(await rows(), []);
  assert.equal(await page.evaluate(() => document.querySelectorAll('#markers *').length + document.querySelector('#signs').clientHeight), 0);
  await picture('page_signs_none');
});

test('lines and bars come in the order of their names, and a countdown counts', async () => {
  assert.equal(await tell('line Demolition'), true);
  await tell('bar 0.25 12 of 40 t');
  await tell('count 90 Round 2');
  await until(page, 'three rows', () => document.querySelectorAll('#signs li').length === 3);
  const [bar, count, line] = await rows();
  assert.equal(bar, '12 of 40 t');
  assert.match(count, /^Round 2 1:[0-3]\d$/);
  assert.equal(line, 'Demolition');
  assert.equal(await page.evaluate(() => document.querySelector('#signs li .share i').style.width), '25%');
  await until(page, 'it counts on', (before) => document.querySelectorAll('#signs li')[1].innerText.trim() !== before, count);
  await picture('page_signs');
});

test('a marker lies at its place, and at the edge of the picture with an arrow when one looks away', async () => {
  await tell('marker 0 3.5 0 bring this down');
  await until(page, 'the marker', () => document.querySelectorAll('#markers div').length === 1);
  const place = () => page.evaluate(() => {
    const { x, y } = document.querySelector('#markers i').getBoundingClientRect();
    return { x, y, beside: document.querySelector('#markers div').hasAttribute('data-beside'), words: document.querySelector('#markers span').textContent };
  });
  const ahead = await place();
  assert.equal(ahead.words, 'bring this down');
  assert.equal(ahead.beside, false);
  assert.ok(Math.abs(ahead.x - WIDTH / 2) < 30 && ahead.y > 0.2 * HEIGHT && ahead.y < 0.8 * HEIGHT, JSON.stringify(ahead));
  await picture('page_marker');
  await page.evaluate(() => globalThis.scree.camera('0,4,12,120,0'));
  await until(page, 'the arrow', () => document.querySelector('#markers div')?.hasAttribute('data-beside'));
  const beside = await place();
  assert.ok(beside.x > 0.85 * WIDTH && beside.x < WIDTH, `who looks left has it on the right: ${JSON.stringify(beside)}`);
  await picture('page_marker_beside');
  await page.evaluate(() => globalThis.scree.camera('0,4,12,0,-10'));
});

test('F1 hides signs as all else', async () => {
  await page.keyboard.press('F1');
  await until(page, 'hidden', () => !document.querySelector('#signs li').checkVisibility({ visibilityProperty: true }));
  assert.equal(await page.evaluate(() => document.querySelector('#markers i').checkVisibility({ visibilityProperty: true })), false);
  await page.keyboard.press('F1');
});

test('signs that are taken away are gone', async () => {
  await tell('clear');
  await until(page, 'none', () => document.querySelectorAll('#signs li, #markers div').length === 0);
});

test('a script of the page gets messages, and what it throws harms nobody', async () => {
  const got = page.evaluate(() => new Promise((resolve) => {
    globalThis.scree.on('message', () => { throw new Error('a fault of the game'); });
    const stop = globalThis.scree.on('message', (channel, bytes) => {
      stop();
      resolve([channel, new TextDecoder().decode(bytes)]);
    });
    globalThis.scree.send('game', new TextEncoder().encode('echo grüß Gott'));
  }));
  assert.deepEqual(await got, ['game', 'grüß Gott']);
  assert.equal(await page.evaluate(() => globalThis.scree.send('', 'x') || globalThis.scree.send('game', new Uint8Array(5000))), false);
  for (const wrong of [() => globalThis.scree.on('nothing', () => {}), () => globalThis.scree.on('message', 7), () => globalThis.scree.send('game', 7)])
    assert.equal(await page.evaluate(`(() => { try { (${wrong})(); return ''; } catch (error) { return error.name; } })()`), 'TypeError');
});

test('cues are heard, lines of the rules are read', async () => {
  await page.mouse.click(WIDTH / 2, HEIGHT / 2);
  await until(page, 'sound plays', () => globalThis.scree.sound() === 0);
  await tell('thud');
  await until(page, 'the thud is heard', () => globalThis.scree.sound() > 0.01);
  await tell('say the tower falls');
  await until(page, 'the line', () => document.querySelector('#lines').innerText.includes('server: the tower falls'));
  await tell('dust');
  await new Promise((resolve) => { setTimeout(resolve, 500); });
  await picture('page_dust');
  assert.deepEqual(complaints.filter((one) => !/GL Driver Message|a fault of the game|JSHandle@error/.test(one)), []);
});
