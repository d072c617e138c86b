// Serves the page's files as they are, with the fake client in the wasm client's place, by the headers of the server
// (server/web); a free port of loopback.
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join } from 'node:path';

const TYPES = { '.html': 'text/html', '.css': 'text/css', '.js': 'text/javascript', '.svg': 'image/svg+xml', '.wasm': 'application/wasm' };
const HEADERS = {
  'Content-Security-Policy': "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; "
    + "connect-src 'self'; worker-src 'self' blob:; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
  'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp',
};

/** `page`: the folder of the page; `here`: of these tests; `status`: what /status.json answers, [code, object]. */
export async function serve(page, here, status = () => [404, {}]) {
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    if (pathname === '/status.json') {
      const [code, answer] = status(request);
      response.writeHead(code, { ...HEADERS, 'Content-Type': 'application/json' }).end(JSON.stringify(answer));
      return;
    }
    const name = { '/': 'index.html', '/status': 'status.html' }[pathname] ?? pathname.slice(1);
    const file = name === 'scree.js' ? join(here, 'fake_scree.js') : join(page, name);
    const content = name === 'scree.wasm' ? Buffer.alloc(4096) : /^[a-z_]+\.[a-z]+$/.test(name) ? await readFile(file).catch(() => null) : null;
    if (content === null) response.writeHead(404, HEADERS).end();
    else response.writeHead(200, { ...HEADERS, 'Content-Type': TYPES[extname(name)] ?? 'text/plain' }).end(content);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => new Promise((resolve) => { server.close(resolve); server.closeAllConnections(); }) };
}
