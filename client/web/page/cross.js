// The cross in the middle, and what became of the last strike: a mark where it hit, or why it was refused.
import { $, write } from './dom.js';

/** Milliseconds for which a hit is marked, and a refusal, which has words to read. */
const HIT_MS = 350, REFUSED_MS = 1500;

export class Cross {
  #number = null;
  #until_ms = 0;

  follow({ mark }, now_ms) {
    if (this.#number !== null && mark.number !== this.#number) {
      $('cross').dataset.mark = mark.refused ? 'refused' : 'hit';
      write($('why'), mark.refused);
      this.#until_ms = now_ms + (mark.refused ? REFUSED_MS : HIT_MS);
    } else if (now_ms > this.#until_ms) {
      delete $('cross').dataset.mark;
      write($('why'), '');
    }
    this.#number = mark.number;
  }
}
