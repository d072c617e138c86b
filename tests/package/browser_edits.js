// As same_edits.js, by a page in Chromium, which the server of that port has at /edits.html.
//   node browser_edits.js PORT LIST FIRST STEP GO
import { readFileSync } from 'node:fs';

import { all_done } from './all_done.js';
import { launch, open_page } from './browser.js';

const [port, list, first, step, go] = process.argv.slice(2);
const browser = await launch();
try {
  const { page } = await open_page(browser, `http://127.0.0.1:${port}/edits.html`, { width: 300, height: 200 });
  await page.exposeFunction('all_done', () => all_done(go));
  await page.waitForFunction(() => globalThis.hash_after);
  console.log(await page.evaluate((...given) => globalThis.hash_after(...given), readFileSync(list, 'utf8'), Number(first), Number(step)));
} finally {
  await browser.close();
}
