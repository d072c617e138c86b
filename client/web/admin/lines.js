// The log, and the audit trail: lines that come from the server every few seconds, the newest below, which one may filter and hold.
import { make, write } from '../page/dom.js';
import { ask_lines, overlap } from './json_lines.js';

const EVERY_MS = 3000, AT_ONCE = 100;
/** Lines that are kept and shown; older ones go. */
const LINES_MAX = 2000;

const LEVELS = ['trace', 'debug', 'info', 'warn', 'error', 'critical'];
const rank = (level) => Math.max(LEVELS.indexOf(String(level).toLowerCase().replace('warning', 'warn')), 0);

export const LOG = {
  kind: 'log', title: 'Log', none: 'The log has no lines yet.',
  cells: ({ time, level, part, session, message }) => [['at', time_of(time)], ['level', level ?? ''], ['part', part ?? ''], ['text', `${session === undefined || String(message).startsWith(`session ${session}`) ? '' : `#${session} `}${message ?? ''}`]],
  level: ({ level }) => rank(level), levels: ['everything', 'info', 'warn', 'error'],
};
export const AUDIT = {
  kind: 'audit', title: 'Audit', none: 'No administrator has done anything yet.',
  cells: ({ time, who, act }) => [['at', time_of(time)], ['who', who ?? ''], ['text', act ?? '']],
};

/** The time of a line as the browser's clock has it; today's without the day. */
function time_of(said) {
  const time = new Date(said);
  if (Number.isNaN(time.getTime())) return String(said ?? '');
  const today = time.toDateString() === new Date().toDateString();
  return today ? time.toLocaleTimeString() : `${time.toLocaleDateString()} ${time.toLocaleTimeString()}`;
}

export class Lines {
  #session;
  #kind;
  #timer = 0;
  #asking = false;
  #known = [];
  #list = make('ol', { className: 'lines', tabIndex: 0 });
  #filter = make('input', { type: 'text', placeholder: 'Words', aria: { label: 'Show only lines with' } });
  #level = make('select', { aria: { label: 'Level' } });
  #follow = make('button', { type: 'button', aria: { pressed: 'true' } }, 'Follow');
  #state = make('p', { className: 'dim', role: 'status' });

  constructor(session, kind) {
    this.#session = session;
    this.#kind = kind;
    this.title = kind.title;
    this.#list.setAttribute('aria-label', kind.title);
    this.#list.dataset.kind = kind.kind;
    for (const level of kind.levels ?? []) this.#level.append(make('option', { value: level }, level === 'everything' ? level : `${level} and worse`));
    for (const [input, event] of [[this.#filter, 'input'], [this.#level, 'change']]) input.addEventListener(event, () => this.#show_all());
    this.#follow.addEventListener('click', () => this.#set_follow(this.#follow.getAttribute('aria-pressed') !== 'true'));
    this.#list.addEventListener('scroll', () => { if (this.#list.scrollTop + this.#list.clientHeight < this.#list.scrollHeight - 40) this.#set_follow(false); });
    this.element = make('section', { className: 'box tall' },
      make('div', { className: 'row heading' }, make('h2', {}, kind.title), this.#state, ...(kind.levels ? [this.#level] : []), this.#filter, this.#follow), this.#list);
  }

  #set_follow(on) {
    this.#follow.setAttribute('aria-pressed', String(on));
    if (on) this.#list.scrollTop = this.#list.scrollHeight;
  }

  #is_wanted(line) {
    if (this.#kind.levels && this.#level.value !== 'everything' && this.#kind.level(line) < rank(this.#level.value)) return false;
    const words = this.#filter.value.trim().toLowerCase();
    return !words || this.#kind.cells(line).some(([, text]) => String(text).toLowerCase().includes(words));
  }

  #item(line) {
    const item = make('li', {}, ...this.#kind.cells(line).map(([name, text]) => make('span', { className: name }, String(text))));
    if (this.#kind.level) item.dataset.level = LEVELS[this.#kind.level(line)];
    return item;
  }

  #show_all() {
    this.#list.replaceChildren(...this.#known.filter((line) => this.#is_wanted(line)).map((line) => this.#item(line)));
    this.#tell();
    if (this.#follow.getAttribute('aria-pressed') === 'true') this.#list.scrollTop = this.#list.scrollHeight;
  }

  #add(lines) {
    this.#known.push(...lines);
    const over = this.#known.length - LINES_MAX;
    if (over > 0) {
      this.#known.splice(0, over);
      return this.#show_all();
    }
    this.#list.append(...lines.filter((line) => this.#is_wanted(line)).map((line) => this.#item(line)));
    this.#tell();
    if (this.#follow.getAttribute('aria-pressed') === 'true') this.#list.scrollTop = this.#list.scrollHeight;
  }

  #tell() {
    const shown = this.#list.children.length;
    write(this.#state, this.#known.length === 0 ? this.#kind.none : shown === this.#known.length ? `${shown} lines` : `${shown} of ${this.#known.length} lines`);
  }

  shown() {
    this.#refresh();
    clearInterval(this.#timer);
    this.#timer = setInterval(() => this.#refresh(), EVERY_MS);
  }

  hidden() { clearInterval(this.#timer); }

  async #refresh() {
    if (this.#session.phase !== 'joined' || document.hidden || this.#asking) return;
    this.#asking = true;
    try {
      let lines = await ask_lines(this.#session, this.#kind.kind, this.#known.length ? AT_ONCE : 0);
      let known = overlap(this.#known, lines);
      if (known < 0) {
        lines = await ask_lines(this.#session, this.#kind.kind);
        known = overlap(this.#known, lines);
      }
      if (known < 0) this.#known = [];
      if (known < 0 || this.#known.length === 0) this.#list.replaceChildren();
      this.#add(lines.slice(Math.max(known, 0)));
    } catch (error) {
      write(this.#state, error.message);
    }
    this.#asking = false;
  }
}
