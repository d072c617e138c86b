// The built page in Chromium behind Debian's nginx, by configurations as beginners write them: it joins, or says which lines
// are missing.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { connect, createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { launch, open_page, until } from './browser.js';
import { host } from './server.js';

const NGINX = ['/usr/sbin/nginx', '/usr/bin/nginx'].find(existsSync);
const UPGRADE = 'proxy_http_version 1.1; proxy_set_header Upgrade $http_upgrade; proxy_set_header Connection "upgrade";';

/** Each with the path under which it serves the page, and the lines of its location. */
const PROXIES = {
  beginner: { path: '/', lines: '' },
  own_host: { path: '/', lines: UPGRADE },
  by_the_book: { path: '/', lines: `${UPGRADE} proxy_set_header Host $http_host; proxy_set_header X-Forwarded-For $proxy_add_x_forwarded_for;` },
  under_a_path: { path: '/scree/', lines: `${UPGRADE} proxy_set_header Host $http_host;` },
};

const free_port = () => new Promise((done) => {
  const server = createServer().listen(0, '127.0.0.1', () => { const { port } = server.address(); server.close(() => done(port)); });
});
const listens = (port) => new Promise((done) => {
  const socket = connect(port, '127.0.0.1', () => { socket.destroy(); done(true); });
  socket.on('error', () => done(false));
});

let folder, browser, server, nginx;
before(async () => {
  if (!NGINX) return;
  folder = mkdtempSync(join(tmpdir(), 'scree-proxy-'));
  server = await host([]);
  const servers = [];
  for (const proxy of Object.values(PROXIES)) {
    proxy.port = await free_port();
    const to = `${server.url.slice(0, -1)}${proxy.path === '/' ? '' : '/'}`;
    servers.push(`server { listen 127.0.0.1:${proxy.port}; location ${proxy.path} { proxy_pass ${to}; ${proxy.lines} } }`);
  }
  const places = ['client_body', 'proxy', 'fastcgi', 'uwsgi', 'scgi'].map((kind) => `${kind}_temp_path ${folder}/${kind};`);
  writeFileSync(join(folder, 'nginx.conf'), `daemon off; master_process off; pid ${folder}/pid; error_log ${folder}/errors;
    events { worker_connections 256; } http { access_log off; ${places.join(' ')} ${servers.join('\n')} }`);
  nginx = spawn(NGINX, ['-p', folder, '-e', join(folder, 'errors'), '-c', join(folder, 'nginx.conf')], { stdio: 'ignore' });
  for (let i = 0; i < 300 && !await listens(PROXIES.beginner.port); ++i) await new Promise((again) => { setTimeout(again, 100); });
  browser = await launch();
});
after(async () => {
  await browser?.close();
  nginx?.kill('SIGKILL');
  await server?.stop();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

async function visit(name, act) {
  const { port, path } = PROXIES[name];
  const { page, close } = await open_page(browser, `http://127.0.0.1:${port}${path}#quality=low&view=16`, { width: 320, height: 180 });
  await act(page);
  await close();
}
const skip = NGINX ? false : 'nginx is not installed';

test('behind a proxy without upgrade the page names the lines that are missing', { skip }, () => visit('beginner', async (page) => {
  await until(page, 'the missing lines', () => document.getElementById('gate_text').textContent.includes('proxy_http_version 1.1;'));
  const text = await page.$eval('#gate_text', (element) => element.textContent);
  assert.match(text, /proxy_set_header Upgrade \$http_upgrade; proxy_set_header Connection "upgrade";/);
}));

for (const name of ['own_host', 'by_the_book', 'under_a_path'])
  test(`the page joins behind the proxy ${name}`, { skip }, () => visit(name, async (page) => {
    await until(page, 'the page has joined', () => globalThis.scree?.state().connection.phase === 'connected');
  }));
