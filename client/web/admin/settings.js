// The server's settings, changed in place: each with its bounds and its help. A changed one waits until Enter, or its button, sets it.
import { make, write } from '../page/dom.js';
import { say } from './ask.js';
import { ask_lines } from './json_lines.js';
import { text_of } from './wire.js';

const EVERY_MS = 5000;
const TEXT_BYTES_MAX = 64;

/** What may be set, in words. */
export function bounds_of({ least, greatest, unit, whole, choices, may_be }) {
  if (choices) return '';
  if (may_be) return String(may_be);
  return least === undefined || greatest === undefined ? '' : `${least} to ${greatest}${unit ? ` ${unit}` : ''}${whole ? ', whole' : ''}`;
}

class Row {
  name;
  #now = '';
  #input;
  #set = make('button', { type: 'submit', disabled: true }, 'Set');
  #words = make('p', { className: 'refused', role: 'alert' });

  constructor(setting, change) {
    const { name, help = '', choices, least } = setting;
    this.name = name;
    this.text = `${name} ${help}`.toLowerCase();
    const id = `setting-${name}`;
    this.#input = choices ? make('select', { id }, ...choices.map((one) => make('option', { value: String(one) }, String(one))))
      : make('input', { id, type: 'text', maxLength: TEXT_BYTES_MAX, autocomplete: 'off', spellcheck: false, inputMode: least === undefined ? 'text' : 'decimal' });
    this.#now = this.#input.value;
    const bounds = make('small', { id: `${id}-bounds` }, bounds_of(setting));
    this.#input.setAttribute('aria-describedby', bounds.id);
    this.element = make('form', { className: 'setting' }, make('label', { htmlFor: id }, name), make('p', { className: 'dim' }, help), make('div', { className: 'row' }, this.#input, this.#set), bounds, this.#words);
    for (const event of ['input', 'change']) this.#input.addEventListener(event, () => this.#mark());
    this.#input.addEventListener('keydown', (event) => { if (event.key === 'Escape') this.#write(this.#now); });
    this.element.addEventListener('submit', async (event) => {
      event.preventDefault();
      if (this.#input.value === this.#now) return;
      write(this.#words, '');
      try {
        await change(name, this.#input.value.trim());
        this.#now = this.#input.value;
      } catch (error) {
        write(this.#words, error.message);
      }
      this.#mark();
    });
  }

  /** What the server has; what somebody types here stays. */
  show(value) {
    const typed = this.#input.value !== this.#now;
    this.#now = value;
    if (!typed) this.#write(value);
    else this.#mark();
  }

  #write(value) {
    if (this.#input.tagName === 'SELECT' && ![...this.#input.options].some((one) => one.value === value)) this.#input.append(make('option', { value }, value));
    this.#input.value = value;
    write(this.#words, '');
    this.#mark();
  }

  #mark() {
    this.#set.disabled = this.#input.value === this.#now;
    this.element.toggleAttribute('data-changed', !this.#set.disabled);
  }
}

export class Settings {
  title = 'Settings';
  element = make('section', { className: 'box' });
  #session;
  #rows = new Map();
  #timer = 0;
  #grid = make('div', { className: 'settings' });
  #filter = make('input', { type: 'text', placeholder: 'Name or words', aria: { label: 'Show only settings with' } });
  #state = make('p', { className: 'dim', role: 'status' });

  constructor(session) {
    this.#session = session;
    this.#filter.addEventListener('input', () => this.#show_wanted());
    this.element.append(make('div', { className: 'row heading' }, make('h2', {}, 'Settings'), this.#state, this.#filter), this.#grid);
  }

  /** Of a status: values, where the server does not say more of its settings. */
  status({ settings }) {
    if (this.element.hidden) return;
    for (const { name, value } of settings) this.#rows.get(text_of(name))?.show(text_of(value));
    if (this.#rows.size === 0 && this.#state.dataset.poor) this.#take(settings.map(({ name, value }) => ({ name: text_of(name), value: text_of(value) })));
  }

  shown() {
    this.#refresh();
    clearInterval(this.#timer);
    this.#timer = setInterval(() => this.#refresh(), EVERY_MS);
  }

  hidden() { clearInterval(this.#timer); }

  async #refresh() {
    if (this.#session.phase !== 'joined' || document.hidden) return;
    try {
      this.#take(await ask_lines(this.#session, 'settings'));
    } catch (error) {
      this.#state.dataset.poor = 'true';
      write(this.#state, error.message);
    }
  }

  #take(settings) {
    for (const setting of settings) {
      let row = this.#rows.get(setting.name);
      if (!row) {
        row = new Row(setting, (name, value) => this.#change(name, value));
        this.#rows.set(setting.name, row);
        this.#grid.append(row.element);
      }
      row.show(String(setting.value));
    }
    this.#show_wanted();
  }

  async #change(name, value) {
    await this.#session.set({ [name]: value });
    say(`${name} is ${value} now.`);
  }

  #show_wanted() {
    const words = this.#filter.value.trim().toLowerCase();
    let shown = 0;
    for (const row of this.#rows.values()) {
      row.element.hidden = words !== '' && !row.text.includes(words);
      shown += row.element.hidden ? 0 : 1;
    }
    write(this.#state, shown === this.#rows.size ? `${shown} settings` : `${shown} of ${this.#rows.size} settings`);
  }
}
