// The package in a browser, in a page or in a worker.
import { Client } from './client.js';
import { load } from './load.js';

export { ScreeError } from './engine.js';

async function bytes_of(address) {
  const answer = await fetch(address ?? new URL('./scree_client.wasm', import.meta.url));
  if (!answer.ok) throw new Error(`${answer.url}: ${answer.status}`);
  return answer.arrayBuffer();
}

export async function connect(address, options = {}) {
  const module = await load(options.wasm, bytes_of);
  return Client.join(address, options, { module, WebSocket: globalThis.WebSocket });
}
