// The card before the world is there: what is loaded, what is missing, what the server says.
import { $, write } from './dom.js';
import { bytes } from './words.js';
import { token } from './kept.js';
import { IN_CLEAR, insist } from './secrets.js';

export class Gate {
  #open = false;
  #again = () => location.reload();

  constructor() {
    $('gate').querySelector('form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.#again();
    });
  }

  get open() { return this.#open; }

  /** The token must not be sent from here: the person sends it all the same, or comes without it. */
  ask_about_token() {
    this.#show('Your token was not sent', IN_CLEAR, null);
    const again = $('gate_again'), send = $('gate_insist'), text = again.textContent;
    write(again, 'Join without the token');
    again.hidden = send.hidden = false;
    return new Promise((resolve) => {
      const decide = (act) => () => {
        act();
        write(again, text);
        again.hidden = send.hidden = true;
        this.#again = () => location.reload();
        resolve();
      };
      this.#again = decide(() => token.keep(''));
      send.onclick = decide(insist);
    });
  }

  loading(come, part) { this.#show('Loading the viewer', bytes(come), part); }

  starting() { this.#show('Starting', 'The viewer is there.', 1); }

  /** It cannot go on. */
  failed(title, text) {
    this.#show(title, text, null);
    $('gate_again').hidden = false;
  }

  /** By the client's state, until the world is seen for the first time. */
  follow(state) {
    const { phase, text, retry_s } = state.connection;
    if (phase === 'refused') return this.#refused(text);
    if (phase === 'lost')
      return this.#show('The server does not answer', `${text}. The page tries again${retry_s === undefined ? '.' : ` in ${Math.ceil(retry_s)} s.`}`, null);
    if (phase === 'connecting') return this.#show('Connecting', location.host, null);
    if (state.draw.kept === 0 && !state.loaded) return this.#show('Making the terrain', 'Hills first, then what is near.', terrain_part(state));
    if (!this.#open) {
      this.#open = true;
      $('gate').classList.add('open');
    }
  }

  #refused(text) {
    this.#open = false;
    $('gate').classList.remove('open');
    this.#show('The server does not let you in', text, null);
    $('gate_token').hidden = false;
    $('gate_again').hidden = false;
    this.#again = () => {
      token.keep($('token').value.trim());
      location.reload();
    };
  }

  #show(title, text, part) {
    write($('gate_title'), title);
    write($('gate_text'), text);
    const progress = $('gate_progress');
    progress.hidden = part === null;
    if (part === null) return;
    progress.setAttribute('aria-valuenow', String(Math.round(100 * part)));
    progress.firstElementChild.style.width = `${100 * part}%`;
  }
}

/** How much of the terrain in view is drawn, 0 to 1. */
export function terrain_part({ draw, preparing, complete }) {
  if (complete) return 1;
  if (preparing) return preparing.share;
  return draw.kept / Math.max(draw.kept + draw.waiting, 1);
}
