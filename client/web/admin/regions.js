// Regions of the world: what each forbids and who may edit there; to add, change and remove.
import { make, write } from '../page/dom.js';
import { attempt, confirm, field } from './ask.js';
import { ROLES, name_of_role } from './roles.js';
import { Rows } from './rows.js';
import { bytes_of, text_of } from './wire.js';

const FORMS = ['box', 'sphere', 'cylinder'];
const FORBIDS = [['edits', 1], ['dents', 2], ['falls', 4], ['pieces', 8]];
const EDITORS = ['nobody', 'a role and above', 'persons and teams', 'everybody'];
const LASTS_MAX_S = 3.2e7;

const numbers = (...values) => values.map((value) => Number(value.toFixed(2))).join(' ');

/** Sizes as people say them: sides of a box, a diameter, a diameter and a height. */
export function size_of({ form, half }) {
  return [[2 * half.x, 2 * half.y, 2 * half.z], [2 * half.x], [2 * half.x, 2 * half.y]][form] ?? [];
}
export function half_of(form, [a = 0, b = 0, c = 0]) {
  return [{ x: a / 2, y: b / 2, z: c / 2 }, { x: a / 2 }, { x: a / 2, y: b / 2 }][form];
}

export function words_of_editors({ forbids, editors, role, persons, teams }) {
  if (!(forbids & 1)) return 'everybody';
  if (editors === 1) return `${name_of_role(role)} and above`;
  if (editors === 2) return [...persons.map(text_of), ...teams.map((team) => `team ${text_of(team)}`)].join(', ') || 'nobody';
  return EDITORS[editors] ?? 'nobody';
}

/** The numbers of a text such as "12 3.5 -4"; null where it is not so many. */
export function numbers_of(text, count) {
  const found = text.trim().split(/[\s,;]+/).map(Number);
  return found.length === count && found.every(Number.isFinite) ? found : null;
}

export class Regions {
  title = 'Regions';
  element = make('section', { className: 'regions' });
  /** As the server said last. */
  all = [];
  #session;
  #show_place;
  #rows;
  #form;

  /** `show_place(place, radius_m)`: on the map. */
  constructor(session, show_place) {
    this.#session = session;
    this.#show_place = show_place;
    this.#rows = new Rows('Regions', [
      { title: 'name', className: 'name', text: ({ name }) => text_of(name) },
      { title: 'form', text: (region) => `${FORMS[region.form] ?? '?'} ${numbers(...size_of(region))} m` },
      { title: 'middle', text: ({ centre }) => numbers(centre.x, centre.y, centre.z) },
      { title: 'forbids', text: ({ forbids }) => FORBIDS.filter(([, bit]) => forbids & bit).map(([name]) => name).join(', ') || 'nothing' },
      { title: 'who may edit', text: words_of_editors },
      { title: 'also', text: ({ tells, counts, until }) => [tells && 'tells', counts && 'counts', until > 0n && `until tick ${until}`].filter(Boolean).join(', ') || '–' },
      { title: '', className: 'acts', element: (row) => this.#acts(row) },
    ], 'This world has no regions.');
    this.#form = new RegionForm((region, lasts_s) => this.#set(region, lasts_s));
    this.element.append(make('section', { className: 'box' }, make('h2', {}, 'Regions'), this.#rows.element), this.#form.element);
  }

  show(regions) {
    this.all = regions;
    this.#rows.show(regions, ({ id }) => String(id));
  }

  #acts(row) {
    const act = (text, does, run) => {
      const made = make('button', { type: 'button', aria: { label: `${does} ${text_of(row().name)}` } }, text);
      made.addEventListener('click', run);
      return made;
    };
    return make('span', { className: 'row' }, act('Map', 'Show on the map:', () => this.#show_place(row().centre, Math.max(row().half.x, row().half.z))),
      act('Change', 'Change', () => this.#form.fill(row())), act('Remove', 'Remove', () => this.#remove(row())));
  }

  async #remove({ name }) {
    const words = text_of(name);
    if (!await confirm({ title: `Remove the region ${words}?`, words: 'What it forbade is allowed from then on. What hung on it is searched for support, and may fall.', act: 'Remove' })) return;
    await attempt(() => this.#session.request('removeRegion', { name }), `The region ${words} is removed.`);
  }

  async #set(region, lasts_s) {
    return attempt(() => this.#session.request('setRegion', { region, lastsS: lasts_s }), `The region ${text_of(region.name)} is set.`);
  }
}

class RegionForm {
  #name = make('input', { type: 'text', required: true, maxLength: 32, autocomplete: 'off' });
  #shape = make('select', {}, ...FORMS.map((name, i) => make('option', { value: i }, name)));
  #size = make('input', { type: 'text', required: true, autocomplete: 'off' });
  #middle = make('input', { type: 'text', required: true, placeholder: 'x y z', autocomplete: 'off' });
  #forbids = new Map(FORBIDS.map(([name, bit]) => [bit, make('input', { type: 'checkbox', name })]));
  #editors = make('select', {}, ...EDITORS.map((name, i) => make('option', { value: i }, name)));
  #role = make('select', {}, ...ROLES.map(([name, number]) => make('option', { value: number }, name)));
  #persons = make('input', { type: 'text', placeholder: 'Ann, Ben', autocomplete: 'off' });
  #teams = make('input', { type: 'text', placeholder: 'red', autocomplete: 'off' });
  #tells = make('input', { type: 'checkbox' });
  #counts = make('input', { type: 'checkbox' });
  #lasts = make('input', { type: 'number', min: 0, max: LASTS_MAX_S, step: 'any', defaultValue: '0' });
  #words = make('p', { className: 'refused', role: 'alert' });
  #fields;

  constructor(set) {
    const tick = (input, text) => make('label', { className: 'tick' }, input, make('span', {}, text));
    this.#fields = { role: field('Role', this.#role), persons: field('Names', this.#persons), teams: field('Teams', this.#teams) };
    this.element = make('form', { className: 'box region-form' }, make('h2', {}, 'Add a region, or change the one of that name'), make('div', { className: 'fields' },
      field('Name', this.#name), field('Form', this.#shape), field('Size, m', this.#size), field('Middle, m', this.#middle), field('Seconds that it lasts (0: until removed)', this.#lasts)),
    make('fieldset', { className: 'row' }, make('legend', {}, 'Forbids'), ...FORBIDS.map(([name, bit]) => tick(this.#forbids.get(bit), name))),
    make('div', { className: 'fields' }, field('Who may edit all the same', this.#editors), ...Object.values(this.#fields)),
    make('div', { className: 'row' }, tick(this.#tells, 'tells who comes and goes'), tick(this.#counts, 'counts what becomes of its rock')), this.#words,
    make('div', { className: 'row' }, make('button', { type: 'submit' }, 'Set the region')));
    for (const input of [this.#shape, this.#editors]) input.addEventListener('change', () => this.#follow());
    this.#follow();
    this.element.addEventListener('submit', async (event) => {
      event.preventDefault();
      const region = this.#read();
      if (region && await set(region, Number(this.#lasts.value) || 0)) this.element.reset(), this.#follow();
    });
  }

  #follow() {
    this.#size.placeholder = ['sides x y z', 'diameter', 'diameter height'][this.#shape.value];
    this.#fields.role.hidden = this.#editors.value !== '1';
    for (const name of ['persons', 'teams']) this.#fields[name].hidden = this.#editors.value !== '2';
  }

  #read() {
    const form = Number(this.#shape.value), count = [3, 1, 2][form];
    const size = numbers_of(this.#size.value, count), middle = numbers_of(this.#middle.value, 3);
    write(this.#words, !size ? `A ${FORMS[form]} has ${count} ${count === 1 ? 'number' : 'numbers'} for its size: ${this.#size.placeholder}.` : !middle ? 'The middle has three numbers: x y z.' : '');
    if (!size || !middle) return null;
    const names = (input) => input.value.split(',').map((name) => name.trim()).filter(Boolean).map(bytes_of);
    return {
      name: bytes_of(this.#name.value.trim()), form, centre: { x: middle[0], y: middle[1], z: middle[2] }, half: half_of(form, size),
      forbids: [...this.#forbids].reduce((bits, [bit, { checked }]) => (checked ? bits | bit : bits), 0), editors: Number(this.#editors.value), role: Number(this.#role.value),
      persons: names(this.#persons), teams: names(this.#teams), tells: this.#tells.checked, counts: this.#counts.checked,
    };
  }

  fill(region) {
    const { name, form, centre, forbids, editors, role, persons, teams, tells, counts } = region;
    this.#name.value = text_of(name);
    this.#shape.value = form;
    this.#size.value = numbers(...size_of(region));
    this.#middle.value = numbers(centre.x, centre.y, centre.z);
    for (const [bit, input] of this.#forbids) input.checked = Boolean(forbids & bit);
    this.#editors.value = editors;
    this.#role.value = role;
    this.#persons.value = persons.map(text_of).join(', ');
    this.#teams.value = teams.map(text_of).join(', ');
    this.#tells.checked = tells;
    this.#counts.checked = counts;
    this.#follow();
    this.element.scrollIntoView({ block: 'nearest' });
    this.#size.focus();
  }
}
