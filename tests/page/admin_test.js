// The administrators' page in Chromium, by the real server: who comes in, what the keyboard alone does, and names that are markup.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { launch, open_page, until } from './browser.js';
import { PROGRAMS, host, run } from './server.js';
import { visit } from './visitor.js';

const WIDE = { width: 1280, height: 800 }, PHONE = { width: 390, height: 844, touch: true, ratio: 2 };
/** Of 32 bytes at most, as the protocol has names. */
const HOSTILE = '<img src=x onerror=alert(1)>';
const PARTS = ['overview', 'people', 'map', 'regions', 'settings', 'log', 'audit'];
const END_MS = 60000;
/** What a browser says of a server that is gone. */
const EXPECTED = /WebSocket connection to .* failed|ERR_CONNECTION_REFUSED|Failed to load resource|GL Driver Message/;

let folder, browser, server, admin, carver;
const file = (name) => join(folder, name);
const options = () => ['--terrain', 'canyon', '--world', file('hill.world'), '--bans', file('bans.txt'), '--token-key', file('world.key.pub'), '--anonymous', 'viewer'];

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'scree-admin-page-'));
  await run('scree-token', ['key', file('world.key')]);
  admin = made_token('admin', 'Host');
  carver = made_token('carver', 'Vera');
  server = await host(options());
  await run('scree-bot', ['--port', String(server.port), '--token', carver, '--carves', '4', '--rate', '4', '--seed', '7', '--linger']);
  browser = await launch();
});
after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(folder, { recursive: true, force: true });
});

const made_token = (role, name) => execFileSync(join(PROGRAMS, 'scree-token'), ['new', '--key', file('world.key'), '--role', role, '--name', name], { encoding: 'utf8' }).trim();

const open = (size = WIDE) => open_page(browser, `${server.url}admin`, size);
const asked = (page) => until(page, 'the token is asked for', () => document.querySelector('#ask:not([hidden])'));
const type_token = async (page, text) => {
  await page.focus('#token');
  await page.keyboard.type(text);
  await page.keyboard.press('Enter');
};
const is_in = (page) => until(page, 'the parts are there', () => document.body.hasAttribute('data-in') && document.querySelector('#state').textContent === 'Connected');
/** Comes in by the keyboard; where a wrong token came before, the server lets the address wait first. */
async function come_in(page) {
  for (let tries = 0; tries < 20; ++tries) {
    await asked(page);
    await type_token(page, admin);
    const there = await page.waitForFunction(() => document.body.hasAttribute('data-in') || (document.querySelector('#state').textContent === 'Not let in' && !document.querySelector('#ask').hidden));
    await there.dispose();
    if (await page.evaluate(() => document.body.hasAttribute('data-in'))) return is_in(page);
    await new Promise((resolve) => { setTimeout(resolve, 500); });
  }
  throw new Error('the administrator is not let in');
}
const show = async (page, part) => {
  await page.click(`#tab-${part}`);
  await until(page, `the part ${part}`, (name) => document.querySelector(`#part-${name}:not([hidden])`), part);
};
async function picture(page, name) {
  if (process.env.SCREE_PICTURES) writeFileSync(join(process.env.SCREE_PICTURES, `${name}.png`), await page.screenshot());
}
/** Presses the key until the focused element's label or text holds the words. */
async function tab_to(page, words, key = 'Tab') {
  for (let presses = 0; presses < 150; ++presses) {
    const at = await page.evaluate(() => { const { activeElement: on } = document; return `${on.getAttribute('aria-label') ?? ''} ${on.textContent.trim()} ${on.id}`; });
    if (at.includes(words)) {
      const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
      assert.notEqual(outline, 'none', `the focus on "${words}" is not seen`);
      return;
    }
    await page.keyboard.press(key);
  }
  throw new Error(`"${words}" is not reached by ${key}`);
}
const nothing_is_shown = (page) => page.evaluate(() => document.querySelector('#tabs').hidden && document.querySelector('#parts').hidden
  && !/127\.0\.0\.1|air-drag|Vera/.test(document.querySelector('#parts').textContent));
const text_of = (page, selector) => page.$eval(selector, (element) => element.textContent);

test('without a token, with a wrong one and with a carver’s, nothing is shown or done', async () => {
  const visitor = await visit(server.port, { name: 'Vera', token: carver });
  const { page, complaints, close } = await open();
  await asked(page);
  assert.match(await text_of(page, '#why'), /Without a token one is not an administrator/);
  assert.ok(await nothing_is_shown(page));
  await type_token(page, carver);
  await until(page, 'why a carver is not let in', () => /token of a carver/.test(document.querySelector('#why').textContent));
  assert.ok(await nothing_is_shown(page));
  await picture(page, 'admin_refused');
  await page.keyboard.press('2');
  assert.ok(await nothing_is_shown(page));
  await type_token(page, 'scree1.d3Jvbmc');
  await until(page, 'why a wrong token is not let in', () => /token/.test(document.querySelector('#why').textContent) && !/carver/.test(document.querySelector('#why').textContent) && document.querySelector('#state').textContent === 'Not let in');
  assert.ok(await nothing_is_shown(page));
  assert.equal(await page.$eval('#token', ({ value }) => value), '');
  // The address does not give a token away, and none is kept that another tab would have.
  assert.deepEqual(await page.evaluate(() => Object.keys(localStorage).filter((key) => localStorage.getItem(key).includes('scree1'))), []);
  assert.deepEqual(complaints.filter((one) => !EXPECTED.test(one)), []);
  await close();
  visitor.leave();
});

test('an administrator sees the server, in two sizes', async () => {
  const visitor = await visit(server.port, { name: 'Ben' });
  for (const [name, size] of Object.entries({ wide: WIDE, phone: PHONE })) {
    const { page, complaints, close } = await open(size);
    await come_in(page);
    for (const part of PARTS) {
      await show(page, part);
      if (part === 'overview') await until(page, 'figures', () => /GB|MB/.test(document.querySelectorAll('.head .value')[4].textContent));
      if (part === 'people') await until(page, 'people', () => document.querySelectorAll('#part-people tbody tr').length >= 2);
      if (part === 'settings') await until(page, 'settings', () => document.querySelectorAll('.setting').length > 10);
      if (part === 'log') await until(page, 'lines', () => document.querySelectorAll('#part-log li').length > 3);
      if (part === 'map') await until(page, 'the ground', () => document.querySelector('.map') && !document.querySelector('.map').hasAttribute('data-busy') && document.querySelector('.readout').textContent.includes('y'));
      if (part === 'map') await until(page, 'edits', () => document.querySelectorAll('.edits li').length > 0);
      await picture(page, `admin_${name}_${part}`);
      const out = await page.evaluate(() => {
        const wide = document.documentElement.scrollWidth > innerWidth + 1 ? ['the page'] : [];
        return [...wide, ...[...document.querySelectorAll('#parts > :not([hidden]) :is(button, input, select), #tabs button')].filter((one) => one.checkVisibility() && !one.closest('.scroll, .map') && one.getBoundingClientRect().right > innerWidth + 1).map((one) => one.outerHTML)];
      });
      assert.deepEqual(out, [], `${name}, ${part}: it reaches out of the window`);
    }
    assert.deepEqual(complaints.filter((one) => !EXPECTED.test(one)), []);
    await close();
  }
  visitor.leave();
});

test('figures that change move nothing', async () => {
  const { page, close } = await open();
  await come_in(page);
  await until(page, 'a status', () => /[0-9]/.test(document.querySelector('.head .value span').textContent));
  await until(page, 'figures', () => /MB/.test(document.querySelectorAll('.head .value')[4].textContent));
  const places = () => page.evaluate(() => JSON.stringify([...document.querySelectorAll('#part-overview :is(.head, .well, .chart)')].map((one) => { const { x, y, width, height } = one.getBoundingClientRect(); return [x, y, width, height]; })));
  const at_first = await places();
  const ticks = () => page.$eval('.well p', (text) => text.textContent);
  const tick = await ticks();
  await until(page, 'the next status', (before_it) => document.querySelector('.well p').textContent !== before_it, tick);
  assert.equal(await places(), at_first);
  await close();
});

test('the keyboard alone kicks a person whose name is markup, and takes back edits', async () => {
  const { page, complaints, close } = await open();
  await come_in(page);
  const visitor = await visit(server.port, { name: HOSTILE });
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('2');
  await until(page, 'the person is there as text', (name) => [...document.querySelectorAll('#part-people td.name')].some((cell) => cell.textContent === name), HOSTILE);
  await tab_to(page, `Kick ${HOSTILE}`);
  await page.keyboard.press('Enter');
  await until(page, 'the question', () => document.querySelector('dialog[open]'));
  await page.keyboard.press('Escape');
  await until(page, 'no question', () => !document.querySelector('dialog'));
  await tab_to(page, `Kick ${HOSTILE}`);
  await page.keyboard.press('Enter');
  await until(page, 'the question', () => document.querySelector('dialog[open]'));
  await page.keyboard.type('not <b>here</b>');
  await picture(page, 'admin_kick');
  await page.keyboard.press('Enter');
  await Promise.race([visitor.ended, new Promise((_, reject) => { setTimeout(() => reject(new Error('the session did not end')), END_MS).unref(); })]);
  assert.match(visitor.said.toString('latin1'), /not <b>here<\/b>/);
  await until(page, 'it is said', () => /was kicked/.test(document.querySelector('#said').textContent));
  await until(page, 'the person is gone', (name) => ![...document.querySelectorAll('#part-people td.name')].some((cell) => cell.textContent === name), HOSTILE);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'tab-people', 'the focus goes where the row was');

  await page.keyboard.press('Escape');
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('3');
  await until(page, 'edits', () => document.querySelectorAll('.edits li').length > 0);
  await tab_to(page, 'Preview an undo of the edits of Vera');
  await page.keyboard.press('Enter');
  await until(page, 'the preview', () => /This would take back \d+/.test(document.querySelector('.result').textContent));
  await until(page, 'the ground', () => !document.querySelector('.map').hasAttribute('data-busy'));
  await picture(page, 'admin_preview');
  await tab_to(page, 'Take it back');
  await page.keyboard.press('Enter');
  await until(page, 'the question', () => document.querySelector('dialog[open]'));
  await picture(page, 'admin_undo');
  await tab_to(page, 'Take back');
  await page.keyboard.press('Enter');
  await until(page, 'the undo is over', () => /Undo 1 is over/.test(document.querySelector('.run').textContent));
  await until(page, 'it is in the history', () => [...document.querySelectorAll('.edits b')].some((one) => /undo 1/.test(one.textContent)));
  await until(page, 'the ground', () => !document.querySelector('.map').hasAttribute('data-busy'));
  await picture(page, 'admin_undone');

  for (const part of ['log', 'audit']) {
    await show(page, part);
    await until(page, `${part} has the kick`, (words) => [...document.querySelectorAll('.tall:not([hidden]) .text')].some((one) => one.textContent.includes(words)), 'not <b>here</b>');
    await picture(page, `admin_${part}`);
  }
  assert.equal(await page.evaluate(() => document.querySelectorAll('main img, main b:not(.edit b, figcaption b)').length), 0);
  assert.deepEqual(complaints.filter((one) => !EXPECTED.test(one)), []);
  await close();
});

test('a box on the map, by mouse and by keys, bounds the history', async () => {
  const { page, close } = await open();
  await come_in(page);
  await show(page, 'map');
  const corners = () => page.$$eval('.where input', (inputs) => inputs.map(({ value }) => value));
  const { x, y, width, height } = await (await page.$('.map')).boundingBox();
  await page.keyboard.down('Shift');
  await page.mouse.move(x + width / 3, y + height / 3);
  await page.mouse.down();
  await page.mouse.move(x + width / 2, y + height / 2, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up('Shift');
  const by_mouse = (await corners()).map(Number);
  assert.ok(by_mouse[0] < by_mouse[2] && by_mouse[1] < by_mouse[3], by_mouse.join(' '));
  await page.focus('.map canvas');
  await page.keyboard.press('Escape');
  assert.deepEqual(await corners(), ['', '', '', '']);
  await page.focus('.where input');
  await page.keyboard.type('4');
  await page.click('.history button[type=submit]');
  await until(page, 'half a box is refused', () => /four numbers/.test(document.querySelector('.result .refused')?.textContent));
  await page.focus('.map canvas');
  await page.keyboard.press('Escape');
  assert.deepEqual(await corners(), ['', '', '', '']);
  for (const key of ['b', 'ArrowRight', 'ArrowDown', 'Enter']) await page.keyboard.press(key);
  const by_keys = (await corners()).map(Number);
  assert.ok(by_keys[0] < by_keys[2] && by_keys[1] < by_keys[3], by_keys.join(' '));
  await page.mouse.click(x + width / 2, y + height / 2);
  await until(page, 'another box', (before_it) => document.querySelector('.where input').value !== before_it, by_keys[0].toFixed(1));
  await close();
});

test('settings, regions and bans: what is refused is said, what is done is shown', async () => {
  const { page, close } = await open();
  await come_in(page);
  await show(page, 'settings');
  await until(page, 'air-drag', () => document.querySelector('#setting-air-drag')?.value);
  const set = async (value) => {
    await page.$eval('#setting-air-drag', (input) => { input.value = ''; });
    await page.focus('#setting-air-drag');
    await page.keyboard.type(value);
    await page.keyboard.press('Enter');
  };
  await set('1e9');
  await until(page, 'the refusal', () => document.querySelector('#setting-air-drag').closest('form').querySelector('.refused').textContent !== '');
  await picture(page, 'admin_setting');
  assert.equal(await page.$$eval('.setting[data-changed]', (changed) => changed.length), 1);
  await set('5');
  await until(page, 'it is set', () => /air-drag is 5 now/.test(document.querySelector('#said').textContent));

  await show(page, 'regions');
  const fields = await page.$$('.region-form .fields input');
  for (const [i, words] of ['mill<b>', '12 8 12', '0 5 0'].entries()) await fields[i].type(words);
  await page.click('.region-form input[name="edits"]');
  await page.keyboard.press('Enter');
  await until(page, 'the region', () => document.querySelector('#part-regions td.name')?.textContent === 'mill<b>');
  await picture(page, 'admin_region');
  await page.click('#part-regions td.acts button:last-child');
  await until(page, 'the question', () => document.querySelector('dialog[open]'));
  await page.click('dialog button.danger');
  await until(page, 'no region', () => document.querySelectorAll('#part-regions tbody tr').length === 0);

  await show(page, 'people');
  await page.type('#part-people form input', '203.0.113.9');
  await page.keyboard.press('Enter');
  await until(page, 'the question', () => document.querySelector('dialog[open]'));
  await page.click('dialog button.danger');
  await until(page, 'the ban', () => [...document.querySelectorAll('#part-people td.name')].some((cell) => cell.textContent === '203.0.113.9'));
  await picture(page, 'admin_ban');
  await page.click('button[aria-label="Lift the ban of 203.0.113.9"]');
  await until(page, 'no ban', () => ![...document.querySelectorAll('#part-people td.name')].some((cell) => cell.textContent === '203.0.113.9'));
  await close();
});

test('a lost connection is said, and comes back', async () => {
  const { page, close } = await open();
  await come_in(page);
  await server.stop();
  await until(page, 'it is said', () => /connection is lost/.test(document.querySelector('#state').textContent));
  await picture(page, 'admin_lost');
  server = await host(options(), server.port);
  await is_in(page);
  assert.ok(await page.evaluate(() => document.querySelector('#part-overview').checkVisibility()));
  await close();
});
