// The WebSocket of a client, as its engine wants it: the engine decides when one is opened, closed, and tried again.
import { ScreeError } from './engine.js';

const CLOSING_MS = 2000;

/** The address of a server's session: "ws://host:port" and the path "session" under what path there is. */
export function session_url(address) {
  let url;
  try {
    url = new URL(address);
  } catch {
    throw new ScreeError('invalid', `"${address}" is no address: ws://HOST:PORT or wss://HOST:PORT`);
  }
  url.protocol = url.protocol.replace(/^http/, 'ws');
  if (!/^wss?:$/.test(url.protocol)) throw new ScreeError('invalid', `"${address}" is no address of a WebSocket (ws: or wss:)`);
  if (!/(^|\/)session$/.test(url.pathname)) url.pathname = `${url.pathname.replace(/\/$/, '')}/session`;
  url.hash = '';
  return url;
}

const WISH_OPEN = 1, WISH_CLOSE = 2;

export class Connection {
  #engine;
  #url;
  #WebSocket;
  #heard;
  #socket = null;

  /** `heard` is called after bytes have come, or the socket's state is another. */
  constructor(engine, url, WebSocket, heard) {
    this.#engine = engine;
    this.#url = url.href;
    this.#WebSocket = WebSocket;
    this.#heard = heard;
  }

  /** What the engine wants of the socket, and what it wants to say. */
  step() {
    const wish = this.#engine.call.scree_socket_wish();
    if (wish === WISH_OPEN) this.#open();
    if (wish === WISH_CLOSE) this.#drop();
    this.send();
  }

  send() {
    if (this.#socket?.readyState !== 1) return;
    const bytes = this.#engine.call.scree_outgoing();
    if (bytes > 0) this.#socket.send(this.#engine.copy(Uint8Array, this.#engine.call.scree_outgoing_bytes(), bytes));
  }

  /** Resolves when the socket is closed, or has been given up. */
  async close() {
    const socket = this.#socket;
    this.#socket = null;
    if (!socket || socket.readyState === 3) return;
    await new Promise((resolve) => {
      const limit = setTimeout(() => {
        socket.terminate?.();
        resolve();
      }, CLOSING_MS);
      socket.onclose = () => {
        clearTimeout(limit);
        resolve();
      };
      socket.close();
    });
  }

  #open() {
    this.#drop();
    const socket = new this.#WebSocket(this.#url);
    this.#socket = socket;
    let why = '';
    socket.binaryType = 'arraybuffer';
    const current = (act) => (event) => {
      if (socket !== this.#socket) return;
      act(event);
      this.#heard();
    };
    socket.onopen = current(() => this.#engine.call.scree_socket_opened());
    socket.onmessage = current(({ data }) => {
      if (data instanceof ArrayBuffer && this.#receive(new Uint8Array(data))) return;
      this.#drop();
      this.#closed('a message was too long, or not binary');
    });
    socket.onerror = (event) => {
      why = event.message ?? '';
      if (why.includes('Parse Error')) why = 'what answers there speaks no HTTP: a server with --web off has no WebSocket';
    };
    socket.onclose = current(({ reason }) => {
      this.#socket = null;
      this.#closed(reason || why);
    });
  }

  #receive(bytes) {
    const at = this.#engine.call.scree_incoming(bytes.length);
    if (at === 0) return false;
    this.#engine.view(Uint8Array, at, bytes.length).set(bytes);
    this.#engine.call.scree_received(bytes.length);
    return true;
  }

  #closed(why) {
    this.#engine.with_texts((texts) => this.#engine.call.scree_socket_closed(texts.add(why)));
  }

  #drop() {
    const socket = this.#socket;
    this.#socket = null;
    socket?.close();
  }
}
