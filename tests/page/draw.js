// Draws the page as a browser shows it, once all within view is there.
//   node draw.js URL FILE.png WIDTHxHEIGHT [RATIO [SELECTOR…]]: SELECTORs are clicked first; RATIO over 1: a phone's screen.
import { launch, open_page, until } from './browser.js';

const [url, file, size, ratio = '1', ...selectors] = process.argv.slice(2);
const [width, height] = size.split('x').map(Number);
const browser = await launch();
try {
  const { page } = await open_page(browser, url, { width, height, ratio: Number(ratio), touch: Number(ratio) > 1 });
  if (!new URL(url).pathname.startsWith('/status')) {
    await until(page, 'all within view is drawn', () => globalThis.scree?.state().complete);
    await until(page, 'the card is gone', () => getComputedStyle(document.querySelector('#gate')).visibility === 'hidden');
  }
  for (const selector of selectors) await page.click(selector);
  await new Promise((resolve) => { setTimeout(resolve, 1500); });
  await page.screenshot({ path: file });
} finally {
  await browser.close();
}
