// The WebSocket of the session, as the client wants it: it decides when one is opened, closed, and tried again.

/** Where a page of this address joins. */
export function session_url(location) {
  return `${location.protocol === 'https:' ? 'wss:' : 'ws:'}//${location.host}/session`;
}

/** Why a socket ended, in words, as far as its code says more than that. */
export function why_closed(code, reason) {
  if (reason) return reason;
  if (code === 1009) return 'a message was too long';
  if (code === 1011) return 'the server met an error';
  if (code === 1012 || code === 1001) return 'the server ends, or starts again';
  return '';
}

export class Socket {
  #client;
  #url;
  #make;
  #socket = null;

  constructor(client, url, make = (where) => new WebSocket(where)) {
    this.#client = client;
    this.#url = url;
    this.#make = make;
  }

  /** After each frame: what the client wants of it, and what it wants to say. */
  step() {
    const wish = this.#client.socket_wish();
    if (wish === 'open') this.#open();
    if (wish === 'close') this.#drop();
    this.#send();
  }

  /** Ends this connection, so that the client makes another: by another name, say. */
  renew() {
    if (!this.#socket) return;
    this.#drop();
    this.#client.socket_closed('');
  }

  #open() {
    this.#drop();
    const socket = this.#make(this.#url);
    this.#socket = socket;
    socket.binaryType = 'arraybuffer';
    const current = (act) => (event) => { if (socket === this.#socket) act(event); };
    socket.onopen = current(() => {
      this.#client.socket_opened();
      this.#send();
    });
    socket.onmessage = current(({ data }) => {
      if (data instanceof ArrayBuffer && this.#client.receive(new Uint8Array(data))) return;
      this.#drop();
      this.#client.socket_closed('a message was too long, or not binary');
    });
    socket.onclose = current(({ code, reason }) => {
      this.#socket = null;
      this.#client.socket_closed(why_closed(code, reason));
    });
  }

  #drop() {
    const socket = this.#socket;
    this.#socket = null;
    socket?.close();
  }

  #send() {
    if (this.#socket?.readyState !== 1) return;
    const bytes = this.#client.take_outgoing();
    if (bytes) this.#socket.send(bytes);
  }
}
