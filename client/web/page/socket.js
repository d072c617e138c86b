// The WebSocket of the session, as the client wants it: it decides when one is opened, closed, and tried again.
//
// A browser does not tell a page why a WebSocket could not be opened: mostly a proxy in between is why. So each attempt has a
// name, by which the page asks the server afterwards what it saw of it.

/** Where a page of this address joins: beside the page, which may lie under a path of a proxy. */
export function session_url(location) {
  const url = new URL('session', `${location.protocol}//${location.host}${location.pathname ?? '/'}`);
  url.protocol = location.protocol === 'https:' ? 'wss:' : 'ws:';
  return url.href;
}

/** Where the server says what it saw of an attempt. */
export function told_url(session) {
  return session.replace(/^ws/, 'http').replace(/session$/, 'session.json');
}

const new_name = () => [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16).padStart(2, '0')).join('');

const UNSEEN = 'The server has seen no request for a WebSocket from this page: a proxy between them passes the page on, and "session" beside it not.';

/** What the server saw of an attempt: { words, pass }. Without words it does not answer. */
export async function ask_why(session, name, ask = (url) => fetch(url, { cache: 'no-store', signal: AbortSignal.timeout(5000) })) {
  try {
    const answer = await ask(`${told_url(session)}?attempt=${name}`);
    if (!answer.ok) return { words: `The server, or a proxy before it, answers ${answer.status}: ${(await answer.text()).trim().slice(0, 300)}` };
    const { seen, words, pass } = await answer.json();
    return { words: seen ? words : UNSEEN, pass };
  } catch {
    return {};
  }
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
  #why;
  #socket = null;
  #pass = '';     // by which a page shows that it is of the server's site, where a proxy hides the site's name
  #attempt = '';  // the one that is opened, or asked about

  constructor(client, url, make = (where) => new WebSocket(where), why = ask_why) {
    this.#client = client;
    this.#url = url;
    this.#make = make;
    this.#why = why;
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
    if (!this.#socket && !this.#attempt) return;
    this.#drop();
    this.#client.socket_closed('');
  }

  #open() {
    this.#drop();
    const attempt = new_name();
    const socket = this.#make(`${this.#url}?attempt=${attempt}${this.#pass && `&pass=${this.#pass}`}`);
    this.#socket = socket;
    this.#attempt = attempt;
    let opened = false;
    socket.binaryType = 'arraybuffer';
    const current = (act) => (event) => { if (socket === this.#socket) act(event); };
    socket.onopen = current(() => {
      opened = true;
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
      if (opened) this.#client.socket_closed(why_closed(code, reason));
      else this.#failed(attempt);
    });
  }

  /** It could not be opened: another time with a pass, or never. */
  async #failed(attempt) {
    const { words = '', pass = '' } = await this.#why(this.#url, attempt);
    if (this.#attempt !== attempt) return; // the client did not wait
    if (!pass || pass === this.#pass) return this.#client.socket_closed(words);
    this.#pass = pass;
    this.#open();
  }

  #drop() {
    const socket = this.#socket;
    this.#socket = null;
    this.#attempt = '';
    socket?.close();
  }

  #send() {
    if (this.#socket?.readyState !== 1) return;
    const bytes = this.#client.take_outgoing();
    if (bytes) this.#socket.send(bytes);
  }
}
