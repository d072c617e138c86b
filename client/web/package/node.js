// The package under Node, on its main thread or in a worker.
import { readFile } from 'node:fs/promises';

import { Client } from './client.js';
import { ScreeError } from './engine.js';
import { load } from './load.js';

export { ScreeError } from './engine.js';

const bytes_of = (address) => readFile(address ?? new URL('./scree_client.wasm', import.meta.url));

/** Node's own WebSocket, since Node 22, or that of the package ws. */
async function web_socket() {
  if (globalThis.WebSocket) return globalThis.WebSocket;
  try {
    const { default: WebSocket } = await import('ws');
    return class extends WebSocket {
      constructor(url) {
        super(url, { perMessageDeflate: false }); // the bytes are packed already
      }
    };
  } catch {
    throw new ScreeError('invalid', 'this Node has no WebSocket: "npm install ws", or pass a class as options.WebSocket');
  }
}

export async function connect(address, options = {}) {
  const module = await load(options.wasm, bytes_of);
  return Client.join(address, options, { module, WebSocket: options.WebSocket ?? await web_socket() });
}
