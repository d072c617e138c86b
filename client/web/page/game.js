// What scripts of a game may do in this page: `scree.on("message", (channel, bytes) => …)` listens to the messages of the
// server's rules, `scree.send(channel, bytes)` sends one (docs/browser.md).

const encoder = new TextEncoder();

/** Bytes of a text, of an ArrayBuffer, or of a view of one. */
function bytes_of(data) {
  if (typeof data === 'string') return encoder.encode(data);
  if (data instanceof ArrayBuffer) return new Uint8Array(data);
  if (ArrayBuffer.isView(data)) return new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
  throw new TypeError('scree.send() takes a text, an ArrayBuffer or a view of one');
}

export class Game {
  #client;
  #listeners = [];

  constructor(client) { this.#client = client; }

  /** Calls it with each message from now on; returns what stops that. */
  on(event, listener) {
    if (event !== 'message') throw new TypeError(`scree.on() knows no event '${event}'; it knows 'message'`);
    if (typeof listener !== 'function') throw new TypeError('scree.on() takes a function');
    this.#listeners.push(listener);
    return () => { this.#listeners = this.#listeners.filter((one) => one !== listener); };
  }

  /** False: the channel has not 1 to 32 bytes, there are more than 4,096, or there is no connection. */
  send(channel, data) { return this.#client.send(String(channel), bytes_of(data)); }

  /** Once a frame. What a listener throws goes to the console, and the page goes on. */
  step() {
    if (this.#listeners.length === 0) return;
    for (let heard = this.#client.take_heard(); heard; heard = this.#client.take_heard())
      for (const listener of this.#listeners) {
        try {
          listener(heard.channel, heard.bytes);
        } catch (error) {
          console.error(error);
        }
      }
  }
}
