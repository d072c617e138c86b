// Who is there: every session, to kick it or ban its address; and the bans, to lift them.
import { make, write } from '../page/dom.js';
import { bytes, span } from '../page/words.js';
import { attempt, confirm, field } from './ask.js';
import { name_of_role } from './roles.js';
import { Rows } from './rows.js';
import { bytes_of, text_of } from './wire.js';

const EVERY_MS = 3000;
const MINUTES_MAX = 5256000, REASON_BYTES_MAX = 256;

const who = ({ session, name }) => (name ? `${name} (session ${session})` : `session ${session}`);
const minutes_field = { name: 'minutes', label: 'For so many minutes', type: 'number', required: true, min: 0, max: MINUTES_MAX, step: 1, value: '60', help: '0: until it is lifted' };
const reason_field = (help) => ({ name: 'reason', label: 'Reason', maxLength: REASON_BYTES_MAX, placeholder: 'may be empty', help });

export class People {
  title = 'People';
  element = make('section', { className: 'people' });
  #session;
  #own;
  #timer = 0;
  #people = [];
  #filter = make('input', { type: 'text', placeholder: 'Name, address, role', aria: { label: 'Show only' } });
  #count = make('p', { className: 'dim', role: 'status' });
  #sessions;
  #bans;

  /** `own(session)`: whether that is a connection of this page. */
  constructor(session, own) {
    this.#session = session;
    this.#own = own;
    this.#sessions = new Rows('Sessions', [
      { title: 'name', className: 'name', text: ({ name }) => name || 'no name' },
      { title: 'session', className: 'number', text: ({ session: number }) => String(number) },
      { title: 'role', text: ({ role }) => role },
      { title: 'address', text: ({ address, encrypted }) => `${address}${encrypted ? '' : ' (no TLS)'}` },
      { title: 'program', text: ({ program }) => program },
      { title: 'token', text: ({ token }) => token },
      { title: 'since', className: 'number', text: ({ joined_s }) => span(joined_s) },
      { title: 'sent', className: 'number', text: ({ sent_bytes }) => bytes(sent_bytes) },
      { title: '', className: 'acts', element: (row) => this.#acts(row) },
    ], 'Nobody is there.');
    this.#bans = new Rows('Bans', [
      { title: 'banned', className: 'name', text: ({ address }) => address },
      { title: 'for', text: ({ left_s }) => (left_s === 0 ? 'until it is lifted' : span(left_s)) },
      { title: 'reason', className: 'wide', text: ({ reason }) => reason },
      { title: '', className: 'acts', element: (row) => this.#lift_button(row) },
    ], 'Nobody is banned.');
    this.#filter.addEventListener('input', () => this.#show());
    this.element.append(
      make('section', { className: 'box' }, make('div', { className: 'row heading' }, make('h2', {}, 'Who is there'), this.#count, this.#filter), this.#sessions.element),
      make('section', { className: 'box' }, make('h2', {}, 'Bans'), this.#bans.element, this.#ban_form()));
  }

  #acts(row) {
    const kick = make('button', { type: 'button', aria: { label: `Kick ${who(row())}` } }, 'Kick');
    const ban = make('button', { type: 'button', aria: { label: `Ban the address of ${who(row())}` } }, 'Ban');
    kick.addEventListener('click', () => this.#kick(row()));
    ban.addEventListener('click', () => this.#ban(row()));
    return row().own ? make('span', { className: 'dim' }, 'this page') : make('span', { className: 'row' }, kick, ban);
  }

  #lift_button(row) {
    const lift = make('button', { type: 'button', aria: { label: `Lift the ban of ${row().address}` } }, 'Lift');
    lift.addEventListener('click', async () => {
      const { address } = row();
      if (await attempt(() => this.#session.act('liftBan', { address: bytes_of(address) }), `The ban of ${address} is lifted.`)) this.#refresh();
    });
    return lift;
  }

  #ban_form() {
    const address = make('input', { type: 'text', required: true, maxLength: 64, placeholder: '203.0.113.9', autocomplete: 'off', spellcheck: false });
    const minutes = make('input', { type: 'number', required: true, min: 0, max: MINUTES_MAX, step: 1, defaultValue: '60' });
    const reason = make('input', { type: 'text', maxLength: REASON_BYTES_MAX });
    const form = make('form', { className: 'row fields' }, field('Ban an address', address), field('Minutes (0: until lifted)', minutes), field('Reason', reason), make('button', { type: 'submit' }, 'Ban'));
    form.addEventListener('submit', async (event) => {
      event.preventDefault();
      const ban = { address: bytes_of(address.value.trim()), minutes: Number(minutes.value), reason: bytes_of(reason.value.trim()) };
      const sure = await confirm({ title: `Ban ${address.value.trim()}?`, words: 'Everybody from this address is refused, and whoever is there is sent away; administrators excepted.', act: 'Ban' });
      if (!sure || !await attempt(() => this.#session.act('ban', ban), `${address.value.trim()} is banned.`)) return;
      form.reset();
      this.#refresh();
    });
    return form;
  }

  async #kick(row) {
    const answer = await confirm({ title: `Kick ${who(row)}?`, words: 'The session ends, with your reason. The person may come again.', act: 'Kick', fields: [reason_field('')] });
    if (answer && await attempt(() => this.#session.act('kick', { session: row.session, reason: bytes_of(answer.reason) }), `${who(row)} was kicked.`)) this.#refresh();
  }

  async #ban(row) {
    const answer = await confirm({
      title: `Ban the address of ${who(row)}?`, act: 'Ban',
      words: `Everybody from ${row.address.replace(/:\d+$/, '')} is refused, and whoever is there is sent away; administrators excepted.`, fields: [minutes_field, reason_field('')],
    });
    if (!answer) return;
    const ban = { session: row.session, minutes: Math.min(Math.max(Math.round(Number(answer.minutes) || 0), 0), MINUTES_MAX), reason: bytes_of(answer.reason) };
    if (await attempt(() => this.#session.act('ban', ban), `The address of ${who(row)} is banned.`)) this.#refresh();
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
      const [{ sessions }, { bans }] = await Promise.all([this.#session.act('listSessions'), this.#session.act('listBans')]);
      this.#people = sessions.map((row) => ({
        session: row.session, name: text_of(row.name), role: name_of_role(row.role), address: text_of(row.address), program: text_of(row.program), encrypted: row.encrypted,
        token: row.tokenId === 0n ? 'none' : row.tokenId.toString(16).padStart(16, '0'), joined_s: row.joinedS, sent_bytes: Number(row.sentBytes), own: this.#own(row.session),
      }));
      this.#show();
      this.#bans.show(bans.map(({ address, leftS, reason }) => ({ address: text_of(address), left_s: Number(leftS), reason: text_of(reason) })), ({ address }) => address);
    } catch (error) {
      write(this.#count, error.message);
    }
  }

  #show() {
    const wanted = this.#filter.value.trim().toLowerCase();
    const shown = this.#people.filter(({ name, address, role, program, session }) => !wanted || [name, address, role, program, `#${session}`].some((text) => text.toLowerCase().includes(wanted)));
    this.#sessions.show(shown, ({ session }) => String(session));
    write(this.#count, shown.length === this.#people.length ? `${shown.length} sessions` : `${shown.length} of ${this.#people.length} sessions`);
  }
}
