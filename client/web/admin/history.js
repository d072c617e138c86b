// Who edited where and when, and taking it back: one filter says what is listed, and what an undo takes back (docs/undo.md).
import { make, write } from '../page/dom.js';
import { span, whole } from '../page/words.js';
import { attempt, confirm, field, say } from './ask.js';
import { bytes_of, text_of } from './wire.js';

const GAP_S = 60;
const EVERY_MS = 5000, PROGRESS_MS = 500;
/** Edits of one answer (limits::history_lines_max). */
const EDITS_MAX = 200;
const HALF_HEIGHT_M = 512, HALF_WIDTH_M = 4096, NEAR_SURFACE_M = 64;
const SINCE = [['10 minutes ago', 600], ['an hour ago', 3600], ['a day ago', 86400], ['the beginning', 0]];
/** UndoMode of proto/access.proto. */
const PREVIEW = 0, REFUSE_CONFLICTS = 1, KEEP_OTHERS = 2, OVER_OTHERS = 3, STOP = 4, PROGRESS = 5;

const flat = ({ lo_m, hi_m }) => ({ lo: { x: lo_m[0], z: lo_m[2] }, hi: { x: hi_m[0], z: hi_m[2] } });
const meets = (a, b) => a.lo.x <= b.hi.x && a.hi.x >= b.lo.x && a.lo.z <= b.hi.z && a.hi.z >= b.lo.z;

/** What names the author of an edit in a request: an undo, a name, or a session. */
export function by_of({ by, name, session }) {
  const undo = /^undo (\d+)/.exec(by);
  if (undo) return `undo:${undo[1]}`;
  return name || (session === undefined ? by : `session:${session}`);
}

/**
 * Edits that follow each other by one person, as one row: what follows from an edit is that person's, too, and there are many.
 * Of each: how many of its `kinds`, the ticks of the `first` and the `last`, and the box that all lie in.
 */
export function grouped(edits, gap_ticks) {
  const groups = [];
  for (const edit of edits) {
    const group = groups.at(-1);
    if (group?.by !== edit.by || group.first - edit.tick > gap_ticks) {
      groups.push({ ...edit, kinds: { [edit.kind]: 1 }, first: edit.tick, last: edit.tick });
      continue;
    }
    group.kinds[edit.kind] = (group.kinds[edit.kind] ?? 0) + 1;
    group.bricks += edit.bricks;
    group.pieces += edit.pieces;
    group.first = edit.tick;
    group.lo_m = group.lo_m.map((one, i) => Math.min(one, edit.lo_m[i]));
    group.hi_m = group.hi_m.map((one, i) => Math.max(one, edit.hi_m[i]));
  }
  return groups;
}

/** What a preview says, in words. */
export function words_of({ bricks, pieces, authors, bricks_with_earlier_edits: earlier }) {
  if (bricks === 0 && pieces === 0) return 'There is nothing to take back.';
  const whose = authors.length ? authors.join(', ') : 'everybody';
  return `This would take back ${whole(bricks)} bricks and ${whole(pieces)} pieces of ${whose}.`
    + (earlier > 0 ? ` In ${whole(earlier)} of the bricks, edits of up to a minute before go, too.` : '');
}

export function words_of_progress({ undo, over, stopped, bricks, bricks_done, pieces_done, bricks_changed_since: changed, requests_refused: refused }) {
  const state = over ? (stopped ? 'was stopped' : 'is over') : 'goes on';
  return `Undo ${undo} ${state}: ${whole(bricks_done)} of ${whole(bricks)} bricks and ${whole(pieces_done)} pieces are taken back.`
    + (changed > 0 ? ` ${whole(changed)} bricks stay, because somebody changed them meanwhile.` : '') + (refused > 0 ? ` The world refused ${whole(refused)} requests.` : '');
}

/** From the last key of a number to the question. */
const TYPED_MS = 400;

export class History {
  element = make('div', { className: 'history' });
  /** The chosen box {lo, hi} in x and z, or null: everywhere. */
  box = null;
  #half_box = false; // some of its numbers are typed
  #session;
  #on;
  #rate_hz = 60;
  #groups = [];
  #timer = 0;
  #typing = 0;
  #progress_timer = 0;
  #preview = null;
  #corners = ['from x', 'from z', 'to x', 'to z'].map((label) => make('input', { type: 'number', step: 'any', min: -HALF_WIDTH_M, max: HALF_WIDTH_M, placeholder: label, aria: { label } }));
  #everywhere = make('button', { type: 'button' }, 'Everywhere instead');
  #who = make('input', { type: 'text', maxLength: 64, placeholder: 'everybody', autocomplete: 'off', spellcheck: false });
  #since = make('select', {}, ...SINCE.map(([words, value]) => make('option', { value }, words)));
  #tick = make('input', { type: 'number', min: 1, step: 1, placeholder: 'none' });
  #state = make('p', { className: 'dim', role: 'status' });
  #list = make('ol', { className: 'edits', aria: { label: 'Edits, the newest first' } });
  #look = make('button', { type: 'submit' }, 'Preview an undo');
  #result = make('div', { className: 'result', role: 'status' });
  #run = make('div', { className: 'run', hidden: true });
  #run_words = make('p', { role: 'status' });
  #run_bar = make('i');
  #stop = make('button', { type: 'button' }, 'Stop the undo');

  /** `on`: {height(place), chosen(box), marks({edits, previews, lit}), go(box), changed(box)}. */
  constructor(session, on) {
    this.#session = session;
    this.#on = on;
    this.#since.value = 3600;
    const form = make('form', { noValidate: true },
      make('fieldset', { className: 'where' }, make('legend', {}, 'Where: everywhere, or in a box that you drag or type'), ...this.#corners, this.#everywhere),
      make('div', { className: 'fields' }, field('Whose edits', this.#who), field('Since', this.#since), field('Or all that changed after tick', this.#tick)),
      make('div', { className: 'row' }, this.#look), this.#result, this.#run);
    this.#run.append(this.#run_words, make('div', { className: 'progress' }, this.#run_bar), this.#stop);
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.#ask_preview();
    });
    for (const input of this.#corners) input.addEventListener('input', () => this.#take_corners());
    for (const input of [this.#who, this.#since, this.#tick]) input.addEventListener('change', () => this.#filtered());
    this.#everywhere.addEventListener('click', () => this.choose(null));
    this.#stop.addEventListener('click', () => attempt(() => this.#undo(STOP), 'The undo stops.'));
    for (const end of ['pointerleave', 'focusout']) this.#list.addEventListener(end, () => this.#on.marks({ lit: null }));
    this.element.append(form, make('div', { className: 'row heading' }, make('h3', {}, 'Who edited there'), this.#state), this.#list);
    this.choose(null);
  }

  joined(welcome) { this.#rate_hz = welcome.tickRateHz; }

  shown() {
    this.#refresh();
    this.#follow_run();
    clearInterval(this.#timer);
    this.#timer = setInterval(() => this.#refresh(), EVERY_MS);
  }

  hidden() {
    clearInterval(this.#timer);
    clearTimeout(this.#progress_timer);
  }

  /** From the map, or null: everywhere. */
  choose(box) {
    this.box = box;
    this.#half_box = false;
    const values = box ? [box.lo.x, box.lo.z, box.hi.x, box.hi.z] : [];
    this.#corners.forEach((input, i) => { input.value = box ? values[i].toFixed(1) : ''; });
    this.#everywhere.disabled = box === null;
    this.#on.chosen(box);
    this.#filtered();
  }

  /** As typed: the box is as soon as it has four numbers. With fewer, nothing is asked for: it would be asked for everywhere. */
  #take_corners() {
    const [x0, z0, x1, z1] = this.#corners.map((input) => (input.value === '' || !input.validity.valid ? NaN : Number(input.value)));
    this.#half_box = ![x0, z0, x1, z1].every(Number.isFinite) && this.#corners.some(({ value, validity }) => value !== '' || validity.badInput);
    this.box = [x0, z0, x1, z1].every(Number.isFinite)
      ? { lo: { x: Math.min(x0, x1), z: Math.min(z0, z1) }, hi: { x: Math.max(x0, x1), z: Math.max(z0, z1) } } : null;
    this.#everywhere.disabled = this.box === null && !this.#half_box;
    this.#on.chosen(this.box);
    this.#forget_preview();
    clearTimeout(this.#typing);
    this.#typing = setTimeout(() => this.#refresh(), TYPED_MS);
  }

  #terms_of_place() {
    if (this.#half_box) throw new Error('The box needs four numbers within the world, or none.');
    return this.box;
  }

  #filtered() {
    this.#forget_preview();
    this.#refresh();
  }

  #forget_preview() {
    this.#preview = null;
    this.#result.replaceChildren();
    this.#on.marks({ previews: [] });
  }

  #terms() {
    return { by: bytes_of(this.#who.value.trim()), sinceS: Number(this.#since.value) };
  }

  // ---- the list

  async #ask_edits(terms) {
    const box = this.#terms_of_place();
    const request = { ...terms, asJson: true };
    if (box) {
      const middle = { x: (box.lo.x + box.hi.x) / 2, z: (box.lo.z + box.hi.z) / 2 }, height = this.#on.height(middle);
      request.at = { ...middle, y: height ?? 0 };
      request.radiusM = Math.hypot((box.hi.x - box.lo.x) / 2, (box.hi.z - box.lo.z) / 2, height === undefined ? HALF_HEIGHT_M : NEAR_SURFACE_M);
    }
    const { text } = await this.#session.act('listHistory', request);
    const { edits, tick } = JSON.parse(text_of(text));
    return { tick, edits: edits.filter((edit) => !box || meets(flat(edit), box)) };
  }

  async #refresh() {
    if (this.#session.phase !== 'joined' || document.hidden) return;
    try {
      const { edits, tick } = await this.#ask_edits(this.#terms());
      this.#show(edits, tick);
    } catch (error) {
      this.#show([], 0);
      write(this.#state, error.message);
    }
  }

  #show(edits, tick) {
    const ago = (group) => `${span(Math.max(tick - group.last, 0) / this.#rate_hz)} ago`;
    const shown = JSON.stringify(edits);
    write(this.#state, edits.length === 0 ? 'Nobody, as far as this server remembers.' : `${edits.length}${edits.length >= EDITS_MAX ? ' newest' : ''} edits`);
    if (shown !== this.#list.dataset.shown) {
      this.#list.dataset.shown = shown;
      this.#groups = grouped(edits, GAP_S * this.#rate_hz);
      const focused = [...this.#list.querySelectorAll('button')].indexOf(document.activeElement);
      this.#list.replaceChildren(...this.#groups.map((group) => this.#item(group)));
      if (focused >= 0) this.#list.querySelectorAll('button')[focused]?.focus({ preventScroll: true });
      this.#on.marks({ edits: edits.map(flat), lit: null });
    }
    this.#list.querySelectorAll('.ago').forEach((element, i) => write(element, ago(this.#groups[i])));
  }

  #item(group) {
    const { by, bricks, pieces } = group;
    const what = Object.entries(group.kinds).map(([kind, count]) => `${whole(count)} ${count === 1 ? kind.replace(/s$/, '') : kind}`).join(', ');
    const go = make('button', { type: 'button', className: 'edit', aria: { label: `${by}: ${what}; show on the map` } },
      make('b', { title: by }, by), make('span', { className: 'ago dim' }), make('span', {}, `${what}: ${whole(bricks)} bricks, ${whole(pieces)} pieces`));
    const back = make('button', { type: 'button', title: 'Preview an undo of this person’s edits', aria: { label: `Preview an undo of the edits of ${by}` } }, 'Undo…');
    go.addEventListener('click', () => this.#on.go(flat(group)));
    for (const event of ['focus', 'pointerenter']) go.addEventListener(event, () => this.#on.marks({ lit: flat(group) }));
    back.addEventListener('click', () => {
      this.#who.value = by_of(group);
      this.#filtered();
      this.#ask_preview();
    });
    return make('li', {}, go, back);
  }

  // ---- undo

  async #undo(mode) {
    const request = { ...this.#terms(), mode, toTick: BigInt(Math.max(Math.round(Number(this.#tick.value) || 0), 0)), asJson: true };
    const is_about_run = mode === STOP || mode === PROGRESS, box = is_about_run ? null : this.#terms_of_place();
    if (box) Object.assign(request, { lo: { ...box.lo, y: -HALF_HEIGHT_M }, hi: { ...box.hi, y: HALF_HEIGHT_M } });
    const { text } = await this.#session.act('undo', is_about_run ? { mode, asJson: true } : request);
    return JSON.parse(text_of(text));
  }

  async #ask_preview() {
    this.#forget_preview();
    let preview;
    try {
      preview = await this.#undo(PREVIEW);
    } catch (error) {
      return this.#result.replaceChildren(make('p', { className: 'refused' }, error.message));
    }
    this.#preview = preview;
    this.#on.marks({ previews: preview.bricks > 0 ? [flat(preview)] : [] });
    const parts = [make('p', {}, words_of(preview))];
    const others = Object.entries(preview.others);
    if (others.length) parts.push(this.#choice(preview, others));
    if (preview.bricks + preview.pieces > 0) {
      const go = make('button', { type: 'button', className: 'danger' }, 'Take it back…');
      go.addEventListener('click', () => this.#take_back());
      parts.push(make('div', { className: 'row' }, go));
    }
    this.#result.replaceChildren(...parts);
    this.#result.querySelector('input, button')?.focus();
  }

  #choice({ bricks_of_others: held }, others) {
    const one = (value, text, checked) => make('label', { className: 'tick' }, make('input', { type: 'radio', name: 'others', value, checked }), make('span', {}, text));
    return make('fieldset', {}, make('legend', {}, `Others edited ${whole(held)} of these bricks since: ${others.map(([who, bricks]) => `${who} ${whole(bricks)}`).join(', ')}`),
      one(KEEP_OTHERS, 'keep what others did there last', true), one(OVER_OTHERS, 'take that back, too', false));
  }

  async #take_back() {
    const chosen = this.#result.querySelector('input[name="others"]:checked');
    const mode = chosen ? Number(chosen.value) : REFUSE_CONFLICTS;
    const where = this.box ? 'in the box' : 'everywhere';
    const sure = await confirm({ title: 'Take it back?', act: 'Take back', words: [`${words_of(this.#preview)} It lies ${where}.`,
      ...(mode === OVER_OTHERS ? ['What others did to these bricks since is lost.'] : []), 'What hangs loose afterwards falls. The undo itself can be taken back, as undo:N.'] });
    if (!sure) return;
    const begun = await attempt(() => this.#undo(mode));
    if (!begun) return;
    say(`Undo ${begun.undo} takes back ${whole(begun.bricks)} bricks and ${whole(begun.pieces)} pieces.`);
    const box = begun.bricks > 0 ? flat(begun) : null;
    this.#who.value = '';
    this.#tick.value = '';
    this.#filtered();
    this.#follow_run(box);
  }

  /** Says how far the last undo is, until it is over. */
  async #follow_run(box = null) {
    clearTimeout(this.#progress_timer);
    if (this.#session.phase !== 'joined') return;
    let progress;
    try {
      progress = await this.#undo(PROGRESS);
    } catch {
      return;  // a server that remembers nothing
    }
    this.#run.hidden = progress.undo === 0;
    if (progress.undo === 0) return;
    write(this.#run_words, words_of_progress(progress));
    this.#run_bar.style.width = `${100 * (progress.bricks > 0 ? Math.min(progress.bricks_done / progress.bricks, 1) : 1)}%`;
    this.#stop.hidden = progress.over;
    if (box) this.#on.changed(box);
    if (box && progress.over) this.#refresh();
    if (!progress.over) this.#progress_timer = setTimeout(() => this.#follow_run(box), PROGRESS_MS);
  }
}
