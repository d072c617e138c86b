// The parts of the page as tabs: the arrow keys choose among them, and so do the digits where nobody types.
import { $, icon, make } from '../page/dom.js';

const FORWARD = new Set(['ArrowDown', 'ArrowRight']), BACK = new Set(['ArrowUp', 'ArrowLeft']);

export class Parts {
  #parts;
  #tabs = new Map();
  #shown = '';

  /** `parts`: by name, {title, element, shown(), hidden()}; the last two where they are needed. */
  constructor(parts) {
    this.#parts = parts;
    for (const [name, part] of Object.entries(parts)) {
      const tab = make('button', { type: 'button', id: `tab-${name}`, tabIndex: -1, role: 'tab', aria: { selected: 'false', controls: `part-${name}` } },
        icon(name), make('span', {}, part.title));
      tab.addEventListener('click', () => this.show(name));
      this.#tabs.set(name, tab);
      $('tabs').append(tab);
      Object.assign(part.element, { id: `part-${name}`, hidden: true, role: 'tabpanel' });
      part.element.setAttribute('aria-labelledby', tab.id);
      $('parts').append(part.element);
    }
    $('tabs').addEventListener('keydown', (event) => this.#key(event));
    addEventListener('keydown', (event) => this.#digit(event));
    // What had the focus may go with its row: then the part's tab has it, and a key goes nowhere else.
    let within = false;
    for (const event of ['focusin', 'pointerdown']) addEventListener(event, ({ type, target }) => { within = type === 'focusin' && $('parts').contains(target); });
    new MutationObserver(() => { if (within && document.activeElement === document.body) this.focus(); }).observe($('parts'), { childList: true, subtree: true, attributes: true, attributeFilter: ['hidden', 'disabled'] });
    addEventListener('hashchange', () => { if (this.#shown) this.show(location.hash.slice(1)); });
  }

  get names() { return [...this.#tabs.keys()]; }
  get shown() { return this.#shown; }

  /** Shows that part, or the first one where there is none of the name. */
  show(wanted) {
    const name = this.#tabs.has(wanted) ? wanted : this.names[0];
    if (name === this.#shown) return;
    const before = this.#parts[this.#shown];
    if (before) {
      before.element.hidden = true;
      before.hidden?.();
    }
    this.#shown = name;
    for (const [of, tab] of this.#tabs) {
      tab.setAttribute('aria-selected', String(of === name));
      tab.tabIndex = of === name ? 0 : -1;
    }
    this.#parts[name].element.hidden = false;
    history.replaceState(null, '', `#${name}`);
    this.#parts[name].shown?.();
  }

  /** The shown part's tab gets the focus. */
  focus() { this.#tabs.get(this.#shown)?.focus({ preventScroll: true }); }

  /** The shown part is told once more: after the connection is there again. */
  again() { this.#parts[this.#shown]?.shown?.(); }

  /** None is shown from now on. */
  leave() {
    const before = this.#parts[this.#shown];
    if (before) before.element.hidden = true;
    before?.hidden?.();
    this.#shown = '';
  }

  #key(event) {
    const { names } = this;
    const at = names.indexOf(this.#shown);
    const step = FORWARD.has(event.key) ? 1 : BACK.has(event.key) ? -1 : 0;
    const to = event.key === 'Home' ? 0 : event.key === 'End' ? names.length - 1 : step ? (at + step + names.length) % names.length : -1;
    if (to < 0) return;
    event.preventDefault();
    this.show(names[to]);
    this.#tabs.get(names[to]).focus();
  }

  #digit(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest?.('input, select, textarea, dialog, canvas')) return;
    const name = this.names[Number(event.key) - 1];
    if (!name || $('tabs').hidden) return;
    this.show(name);
    this.#tabs.get(name).focus();
  }
}
