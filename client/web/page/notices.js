// One line of what is worth a word now: the server's refusals and a lost connection before the page's own hints.
import { $, write } from './dom.js';

const OWN_MS = 4000;

export class Notices {
  #own = '';
  #until_ms = 0;
  #hint = '';

  /** For some seconds. */
  say(text) {
    this.#own = text;
    this.#until_ms = performance.now() + OWN_MS;
  }

  /** As long as nothing else is to be said; '': none. */
  hint(text) { this.#hint = text; }

  follow({ connection, notice, mark }) {
    const lost = connection.phase === 'lost' || connection.phase === 'connecting';
    const retry = connection.retry_s === undefined ? 'trying again…' : `next attempt in ${Math.ceil(connection.retry_s)} s`;
    const own = performance.now() < this.#until_ms ? this.#own : '';
    const text = lost ? `The connection is lost, ${retry}. The world stays as it was.` : notice || own || this.#hint;
    const line = $('notice');
    write(line, text);
    line.hidden = text === '';
    line.toggleAttribute('data-grave', lost || (notice !== '' && mark.refused !== ''));
    $('retry').hidden = connection.phase !== 'lost';
  }
}
