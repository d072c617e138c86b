// The state of a page in its address: #camera=30,9,19,63,-7&method=raymarch&quality=low&view=64. A link shows a friend the
// same view. `past` is the port of a server on the same host that replays this one's world, and `now` the one of the world that
// a replay is of: the page goes there and back. `name` and `token` may come by it, too; neither stays there, so that no link gives them away.

const NUMBER = '-?\\d{1,5}(?:\\.\\d{1,6})?';
const CAMERA = new RegExp(`^${NUMBER}(?:,${NUMBER}){4}$`);
const NAME = /^[a-z]{1,16}$/;
const PORT = /^[1-9]\d{0,4}$/;
const CONTROL = /[\u0000-\u001f\u007f]/;
/** Bytes of a token and of a name, as the protocol has them. */
const TOKEN_BYTES = 512, NAME_BYTES = 32;

const bytes_of = (text) => new TextEncoder().encode(text).length;

/**
 * What the fragment says, as far as it is well formed; all else is left out. `unfit` names a token that is none: who brings
 * one must not come in by the token that was kept.
 */
export function parse(fragment) {
  const said = new URLSearchParams(fragment.replace(/^#/, ''));
  const state = {};
  const take = (key, fits) => {
    const value = said.get(key);
    if (value !== null && fits(value)) state[key] = value;
  };
  take('camera', (value) => CAMERA.test(value));
  take('method', (value) => NAME.test(value));
  take('quality', (value) => NAME.test(value));
  take('view', (value) => /^\d{1,4}$/.test(value));
  take('past', (value) => PORT.test(value));
  take('now', (value) => PORT.test(value));
  take('name', (value) => bytes_of(value) <= NAME_BYTES && !CONTROL.test(value));
  take('token', (value) => value.length <= TOKEN_BYTES && /^[\x21-\x7e]+$/.test(value));
  if (said.get('token') && !state.token) state.unfit = 'token';
  return state;
}

/** The fragment that says the state, without what is nobody else's. Commas stay readable. */
export function format({ camera, method, quality, view, past, now }) {
  const parts = [];
  if (camera) parts.push(`camera=${camera}`);
  if (method) parts.push(`method=${method}`);
  if (quality && quality !== 'auto') parts.push(`quality=${quality}`);
  if (view) parts.push(`view=${Math.round(view)}`);
  if (past) parts.push(`past=${past}`);
  if (now) parts.push(`now=${now}`);
  return parts.length ? `#${parts.join('&')}` : '';
}

/** The page of another port of the same host. */
export function at_port({ protocol, hostname, pathname }, port, fragment) {
  return `${protocol}//${hostname}:${port}${pathname}${fragment}`;
}

/**
 * Writes the address when it has been another one for a while, and no more often than that: a browser's history gets no
 * entry, and none of them refuses for being asked too often.
 */
export class AddressBar {
  #shown;
  #write;
  #rest_ms;
  #seen = '';
  #since_ms = 0;

  constructor(shown, write, rest_ms = 700) {
    this.#shown = shown;
    this.#write = write;
    this.#rest_ms = rest_ms;
  }

  /** The state as it is at this time. */
  note(fragment, now_ms) {
    if (fragment !== this.#seen) {
      this.#seen = fragment;
      this.#since_ms = now_ms;
    }
    if (fragment === this.#shown || now_ms - this.#since_ms < this.#rest_ms) return;
    this.#shown = fragment;
    this.#write(fragment);
  }
}
