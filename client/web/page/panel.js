// The panel at the side, with one page at a time, and the bar's buttons that choose it.
import { $, icon, make, write } from './dom.js';

export class Panel {
  #pages;
  #buttons = new Map();
  #open = null;
  #state = null;

  /** `pages`: by name, {title, icon, element, show(state)}. */
  constructor(pages) {
    this.#pages = pages;
    for (const [name, page] of Object.entries(pages)) {
      const choose = make('button', { type: 'button', title: page.title, data: { page: name }, aria: { label: page.title, expanded: 'false', controls: 'panel' } },
        icon(page.icon));
      choose.addEventListener('click', () => this.toggle(name));
      this.#buttons.set(name, choose);
      $('tabs').append(choose);
    }
  }

  get open() { return this.#open; }

  toggle(name) { this.show(this.#open === name ? null : name); }

  show(name) {
    const before = this.#open;
    this.#open = name;
    for (const [of, choose] of this.#buttons) choose.setAttribute('aria-expanded', String(of === name));
    document.body.toggleAttribute('data-open', name !== null);
    $('panel').hidden = name === null;
    if (name === null) {
      this.#buttons.get(before)?.focus({ preventScroll: true });
      return;
    }
    const page = this.#pages[name];
    const close = make('button', { type: 'button', aria: { label: 'Close' } }, icon('close'));
    close.addEventListener('click', () => this.show(null));
    $('panel').replaceChildren(make('header', {}, make('h2', {}, page.title), close), page.element);
    if (this.#state) page.show(this.#state);
    $('panel').scrollTop = 0;
    $('panel').setAttribute('aria-label', page.title);
  }

  /** A few times a second. */
  follow(state) {
    this.#state = state;
    if (this.#open) this.#pages[this.#open].show(state);
  }

  /** A number beside a page's symbol. */
  count(name, text) {
    const choose = this.#buttons.get(name);
    const count = choose.querySelector('.count') ?? choose.appendChild(make('span', { className: 'count' }));
    write(count, text);
    count.hidden = text === '';
  }
}
