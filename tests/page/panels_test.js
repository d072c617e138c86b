// The page's panels in a browser, with a client that is none: what lies where, and what the hands' input leads to.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { launch, open_page, until } from './browser.js';
import { serve } from './static_server.js';

const SIZES = [[360, 640], [640, 360], [390, 844], [844, 390], [768, 1024], [1024, 768], [960, 480], [1280, 720], [1920, 1080]];
const LINES = Array.from({ length: 8 }, (_, i) => `Somebody: line ${i} ${'long '.repeat(i * 5)}`);

let server, browser;
let status = [200, {}];
before(async () => {
  server = await serve('page', '.', (request) => (status instanceof Function ? status(request) : status));
  browser = await launch();
});
after(async () => {
  await browser?.close();
  await server?.close();
});

const phone = (width) => ({ touch: width < 960 });
const opened = async (size, fake = {}, fragment = '') => {
  const query = `?fake=${encodeURIComponent(JSON.stringify(fake))}${fragment}`;
  const visit = await open_page(browser, server.url + query, { width: size[0], height: size[1], ...phone(size[0]) });
  await until(visit.page, 'the world is shown', () => document.querySelector('#gate.open') || document.querySelector('#gate_again:not([hidden])'));
  return visit;
};
const calls = (page, name) => page.evaluate((wanted) => globalThis.fake.calls.filter(([one]) => one === wanted), name);
/** The same once there are so many: a click follows a tap when the browser is sure that no second one comes. */
const calls_from = async (page, name, count) => {
  await until(page, `${name} ${count} times`, (wanted, least) => globalThis.fake.calls.filter(([one]) => one === wanted).length >= least, name, count);
  return calls(page, name);
};
/** Milliseconds after which a browser takes a touch for a long press. */
const LONG_PRESS_MS = 1000;
/** Milliseconds of the page's clock, more than between two drawings of its panels. */
const PANELS_MS = 250;
/** Once the page has taken all that was done so far into its panels, however long its frames are, and nothing moves. */
const settled = (page) => page.evaluate(async (panels_ms) => {
  const frame = () => new Promise((resolve) => { requestAnimationFrame(resolve); });
  for (const end_ms = performance.now() + panels_ms; await frame() < end_ms;);
  // The page's turn in a frame may come after this one's, and names are drawn in the frame after their panel.
  for (let i = 0; i < 2; ++i) await frame();
  await Promise.allSettled(document.getAnimations().map((one) => one.finished));
}, PANELS_MS);

/** Pairs of panels of which one covers the other, and what reaches over the edge of the window or of its panel. */
const find_overlaps = () => {
  const shown = ['#bar > div', '#tabs', '#readout', '#lines', '#say', '#panel', '#notice', '#tools', '#timeline', '#stick', '#buttons']
    .map((one) => [one, document.querySelector(one)]).filter(([, element]) => element?.getClientRects().length && element.clientHeight > 0);
  const found = [];
  const box = (element) => element.getBoundingClientRect();
  for (const [name, element] of shown) {
    const { left, top, right, bottom } = box(element);
    if (left < -0.5 || top < -0.5 || right > innerWidth + 0.5 || bottom > innerHeight + 0.5) found.push(`${name} reaches out of the window`);
    for (const child of element.querySelectorAll('button, select, input, output'))
      if (child.getClientRects().length && (box(child).left < left - 0.5 || box(child).right > right + 0.5)) found.push(`${name}: ${child.outerHTML.slice(0, 60)} reaches out`);
  }
  shown.forEach(([name, element], i) => {
    for (const [other, beside] of shown.slice(i + 1)) {
      const a = box(element), b = box(beside);
      if (a.left < b.right - 0.5 && b.left < a.right - 0.5 && a.top < b.bottom - 0.5 && b.top < a.bottom - 0.5) found.push(`${name} and ${other} overlap`);
    }
  });
  return found;
};

test('no panel covers another, at any size', async () => {
  for (const size of SIZES)
    for (const replays of [false, true]) {
      const { page, complaints, close } = await opened(size, { replays });
      await page.evaluate((lines) => {
        const state = globalThis.fake.state;
        Object.assign(state, { lines, notice: 'radius 12 m is over this server\u2019s 8 m (limits.carve_radius_max_m)' });
        state.persons.list = Array.from({ length: 30 }, (_, i) => ({ session: i + 1, name: `person ${i} of a long name`, role: 'player' }));
      }, LINES);
      await settled(page);
      const where = `${size.join('x')}${replays ? ', replay' : ''}`;
      assert.deepEqual(await page.evaluate(find_overlaps), [], where);
      for (let tab = 0; tab < 5; ++tab) {
        await page.evaluate((i) => document.querySelectorAll('#tabs button')[i].click(), tab);
        await settled(page);
        assert.deepEqual(await page.evaluate(find_overlaps), [], `${where}, panel ${tab}`);
      }
      assert.deepEqual(complaints, [], where);
      await close();
    }
});

test('the first click takes the mouse and strikes nothing, the next one strikes', async () => {
  const { page, close } = await opened([1280, 720]);
  await page.mouse.click(640, 400);
  await until(page, 'the mouse is taken', () => document.pointerLockElement !== null);
  assert.equal((await calls(page, 'strike')).length, 0);
  await page.mouse.click(640, 400);
  assert.equal((await calls_from(page, 'strike', 1)).length, 1);
  await page.keyboard.press('Tab');
  await until(page, 'the mouse is free', () => document.pointerLockElement === null);
  await close();
});

test('two thumbs move, look and strike', async () => {
  const { page, close } = await opened([640, 360]);
  const left = await page.touchscreen.touchStart(100, 200);
  await left.move(100, 100);
  await settled(page);
  const [, right, up, forward, fast] = (await calls(page, 'move')).at(-1);
  assert.deepEqual([right, up, forward, fast], [0, 0, 1, 1]);
  await left.end();
  await settled(page);
  assert.deepEqual((await calls(page, 'move')).at(-1), ['move', 0, 0, 0, 0]);
  const look = await page.touchscreen.touchStart(500, 100);
  await look.move(520, 110);
  await look.end();
  await settled(page);
  const looked = (await calls(page, 'look')).reduce(([x, y], [, dx, dy]) => [x + dx, y + dy], [0, 0]);
  assert.deepEqual(looked, [20, 10]);
  await close();
});

test('a thumb strikes as it comes down, however long it stays, and while the other one moves', async () => {
  const { page, close } = await opened([640, 360]);
  /** A busy browser hands on touches late. */
  const struck = async (count) => {
    await calls_from(page, 'strike', count);
    await settled(page);
    assert.equal((await calls(page, 'strike')).length, count);
  };
  const [x, y] = await page.$eval('#strike', (one) => { const box = one.getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; });
  const long = await page.touchscreen.touchStart(x, y);
  await struck(1);
  await new Promise((resolve) => { setTimeout(resolve, LONG_PRESS_MS); });
  await long.end();
  await struck(1);
  await page.tap('#strike');
  await struck(2);
  const left = await page.touchscreen.touchStart(100, 200);
  await left.move(100, 100);
  const right = await page.touchscreen.touchStart(x, y);
  await right.end();
  await struck(3);
  await left.end();
  await page.$eval('#strike', (one) => one.click());
  await struck(4);
  await close();
});

test('keys are the world\u2019s, but for a person who writes', async () => {
  const { page, close } = await opened([1280, 720]);
  await page.keyboard.press('KeyW');
  assert.deepEqual((await calls_from(page, 'key', 2)).map(([, code, down]) => [code, down]), [['KeyW', 1], ['KeyW', 0]]);
  await page.keyboard.press('Enter');
  await until(page, 'the line is open', () => document.activeElement.id === 'line');
  await page.keyboard.type('wasd');
  await page.keyboard.press('Enter');
  assert.deepEqual(await calls_from(page, 'say', 1), [['say', 'wasd']]);
  assert.equal((await calls(page, 'key')).filter(([, code, down]) => down && code.startsWith('Key')).length, 1);
  await page.keyboard.press('F1');
  await until(page, 'all is hidden', () => document.body.classList.contains('bare'));
  await page.keyboard.press('F1');
  await until(page, 'all is shown', () => !document.body.classList.contains('bare'));
  await close();
});

test('names and lines are text, whatever they are', async () => {
  const { page, close } = await opened([1280, 720]);
  const evil = '<img src=x onerror="globalThis.broken = true"><script>globalThis.broken = true</script>';
  await page.evaluate((text) => {
    Object.assign(globalThis.fake.state, { lines: [text], notice: text, eye: text });
    globalThis.fake.state.persons.list = [{ session: 1, name: text, role: 'player' }, { session: 2, name: text, role: text }];
    globalThis.fake.names = [{ session: 2, name: text, colour: 'red; background: url(x)', x: 0.5, y: 0.5, metres: 3 }];
  }, evil);
  await page.keyboard.press('KeyL');
  await settled(page);
  assert.equal(await page.evaluate(() => globalThis.broken), undefined);
  assert.equal(await page.$eval('#lines li', (line) => line.textContent), evil);
  assert.equal(await page.$eval('#names span', (name) => name.textContent), evil);
  assert.equal(await page.$$eval('#screen img, #names img, #screen script', (found) => found.length), 0);
  await close();
});

test('the address has the view, but not the token', async () => {
  const { page, close } = await opened([1280, 720], {}, '#camera=1,2,3,4,5&method=raymarch&token=secret&name=Ann');
  assert.deepEqual((await calls(page, 'set_camera'))[0], ['set_camera', '1,2,3,4,5']);
  assert.deepEqual((await calls(page, 'set_method'))[0], ['set_method', 'raymarch']);
  assert.deepEqual((await calls(page, 'set_token'))[0], ['set_token', 'secret']);
  assert.deepEqual((await calls(page, 'set_name'))[0], ['set_name', 'Ann']);
  const entries = await page.evaluate(() => history.length);
  await page.evaluate(() => { globalThis.fake.state.camera = '7,8,9,10,11'; });
  await until(page, 'the address follows', () => location.hash.includes('camera=7,8,9,10,11'));
  assert.equal(await page.evaluate(() => location.href.includes('secret')), false);
  assert.equal(await page.evaluate(() => history.length), entries);
  await close();
});

test('a token and a name that come later by the address are used at once', async () => {
  const { page, close } = await opened([1280, 720]);
  await page.evaluate(() => { location.hash = '#token=later&name=Bob'; });
  await until(page, 'the token is told', () => globalThis.fake.calls.some(([name, value]) => name === 'set_token' && value === 'later'));
  assert.deepEqual((await calls(page, 'set_name')).at(-1), ['set_name', 'Bob']);
  assert.equal(await page.evaluate(() => location.href.includes('later')), false);
  await close();
});

test('without WebGL 2 the page says so in words, and keeps no token in its address', async () => {
  const { page, close } = await opened([360, 640], { begin: 1 }, '#token=secret');
  assert.match(await page.$eval('#gate', (gate) => gate.innerText), /WebGL 2/);
  assert.equal(await page.evaluate(() => location.href.includes('secret')), false);
  await close();
});

test('a refusal gives its reason and asks for a token', async () => {
  const { page, close } = await opened([360, 640]);
  await page.evaluate(() => { globalThis.fake.state.connection = { phase: 'refused', text: 'this server asks for a token', replay: false }; });
  await until(page, 'the token is asked for', () => document.querySelector('#gate_token').checkVisibility());
  assert.match(await page.$eval('#gate', (gate) => gate.innerText), /this server asks for a token/);
  await close();
});

test('a timeline is dragged, and played by its buttons', async () => {
  const { page, close } = await opened([1280, 720], { replays: true });
  const box = await (await page.$('#timeline .track')).boundingBox();
  await page.mouse.move(box.x + box.width / 4, box.y + 10);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2, box.y + 10, { steps: 4 });
  await page.mouse.up();
  const sought = (await calls(page, 'replay_seek')).map(([, tick]) => tick);
  assert.ok(Math.abs(sought[0] - 960) < 5 && Math.abs(sought.at(-1) - 1920) < 5, sought.join());
  const buttons = [['Play or hold (J)', 'replay_play'], ['The next event (0)', 'replay_next_event'], ['The previous event (9)', 'replay_previous_event']];
  for (const [i, [label, action]] of buttons.entries()) {
    await page.click(`#timeline [aria-label="${label}"]`);
    assert.deepEqual((await calls_from(page, 'act', i + 1)).at(-1), ['act', action]);
  }
  await page.select('#timeline select', '4');
  assert.deepEqual((await calls_from(page, 'replay_speed', 1)).at(-1), ['replay_speed', 4]);
  await close();
});

test('every control has a name, and texts have contrast', async () => {
  const { page, close } = await opened([1280, 720], { replays: true });
  for (let tab = 0; tab < 5; ++tab) {
    await page.evaluate((i) => document.querySelectorAll('#tabs button')[i].click(), tab);
    const { children } = await page.accessibility.snapshot({ interestingOnly: true });
    const nameless = children.filter(({ role, name }) => ['button', 'slider', 'textbox', 'checkbox', 'radio', 'combobox'].includes(role) && !name);
    assert.deepEqual(nameless, []);
  }
  const ratio = await page.evaluate(() => {
    const shine = (text) => {
      const [r, g, b] = text.match(/[\d.]+/g).slice(0, 3).map((part) => (part / 255 <= 0.03928 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    // The worst ground: a sheet of 88 % over a white sky.
    const ground = shine('rgb(52, 47, 45)');
    return Math.min(...[...document.querySelectorAll('#screen *')].filter((one) => one.checkVisibility() && one.children.length === 0 && one.textContent.trim() && !one.closest('[aria-pressed="true"], [type="submit"]'))
      .map((one) => (shine(getComputedStyle(one).color) + 0.05) / (ground + 0.05)));
  });
  assert.ok(ratio >= 4.5, `contrast ${ratio}`);
  await close();
});

test('the status page asks for a token, and shows what it then gets', async () => {
  const figures = {
    version: '1.0', tick_rate_hz: 60, replay: false,
    now: { tick: 600, clients: 1, pieces: 3, tick_median_ms: 2, tick_worst_ms: 30, stages_ms: { commands: 1, step: 8 }, latency_ms: { waiting: { median: 8, worst: 16 } }, work: { budget_us: 9000, worst_us: 100 }, saving: '', saved_tick: 0 },
    report: { ticks: 600, late_ticks: 5, seconds: 10, pieces_made: 9, pieces_merged: 6, resident_mb: 100, sessions: { joined: 4 }, ledger: { terrain: 1, pieces: 2, dust: 3, poured: 4, moved: 5, error: 0 }, refusals: { total: 0, by_reason: {} } },
    sessions: [{ session: 1, name: '<b>Ann</b>', role: 'player', address: '127.0.0.1', program: 'viewer', seconds: 70, sent_bytes: 123456 }],
  };
  status = (request) => (request.headers.authorization === 'Bearer right' ? [200, figures] : request.headers.authorization ? [403, {}] : [401, {}]);
  const { page, close } = await open_page(browser, `${server.url}status`, { width: 360, height: 640, touch: true });
  await until(page, 'the token is asked for', () => !document.querySelector('#ask').hidden);
  await page.type('#token', 'wrong');
  await page.keyboard.press('Enter');
  await until(page, 'the wrong token is refused', () => document.querySelector('#why').textContent.includes('not valid'));
  await page.$eval('#token', (input) => { input.value = ''; });
  await page.type('#token', 'right');
  await page.keyboard.press('Enter');
  await until(page, 'the figures are there', () => document.querySelectorAll('#sessions tbody tr').length === 1);
  assert.equal(await page.$eval('#sessions td', (cell) => cell.textContent), '<b>Ann</b>');
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
  await close();
});
