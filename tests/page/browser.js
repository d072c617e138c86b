// Debian's Chromium without a display, with OpenGL by software; and pages that note whatever they complain about.
import puppeteer from 'puppeteer-core';

const CHROMIUM = '/usr/bin/chromium';
/** Milliseconds until anything that is waited for counts as missed; a browser on two busy cores is slow. */
export const WAIT_MS = 240000;

/** `options`: more of Chromium's own. */
export function launch(options = []) {
  return puppeteer.launch({
    executablePath: CHROMIUM, headless: true, protocolTimeout: 2 * WAIT_MS,
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
      '--disable-dev-shm-usage', '--disable-background-networking', '--disable-component-update', '--no-first-run', '--mute-audio', ...options],
  });
}

/** A page of that size; `complaints`: errors, warnings and refusals of its console. `touch`: a phone's. */
export async function open_page(browser, url, { width, height, touch = false, ratio = 1 }) {
  const context = await browser.createBrowserContext();
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => { if (['error', 'warn'].includes(message.type())) complaints.push(message.text()); });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('requestfailed', (request) => complaints.push(`${request.url()}: ${request.failure()?.errorText}`));
  await page.setViewport({ width, height, hasTouch: touch, isMobile: touch, deviceScaleFactor: ratio });
  page.setDefaultTimeout(WAIT_MS);
  await page.goto(url);
  return { page, complaints, close: () => context.close() };
}

/** Waits until the function in the page gives something; names what was waited for when it does not come. */
export async function until(page, what, condition, ...values) {
  try {
    return await page.waitForFunction(condition, { polling: 100, timeout: WAIT_MS }, ...values);
  } catch (error) {
    const told = await page.evaluate(() => document.body.innerText).catch(() => '');
    throw new Error(`${what}: not after ${WAIT_MS / 1000} s (${error.message}); the page says: ${told.slice(0, 500)}`);
  }
}
