// How long to wait after failures: twice as long after each, up to a minute.

export class Backoff {
  #least_ms;
  #most_ms;
  #failures = 0;

  constructor(least_ms = 1000, most_ms = 60000) {
    this.#least_ms = least_ms;
    this.#most_ms = most_ms;
  }

  well() { this.#failures = 0; }

  /** The wait after another failure. */
  failed() {
    return Math.min(this.#least_ms * 2 ** Math.min(this.#failures++, 20), this.#most_ms);
  }
}
