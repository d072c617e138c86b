// The tool in hand: its row below the picture with what one carries, and its page in the panel.
import { $, button, make, parts, slider, swatches, write } from './dom.js';
import { metres } from './words.js';

const SIZE_STEP_M = 0.25;
/** A material's part of the bar, percent: a little is seen, too. And of what the store holds, over which the next bite may not fit. */
const PART_LEAST = 0.8, FULL = 0.97;

/** In the order in which a newcomer meets them: the crater is the usual tool. */
export const in_order = (kinds) => [...kinds].sort((a, b) => Number(b === 'crater') - Number(a === 'crater'));

const cubic = (m3) => `${m3.toFixed(m3 < 100 ? 1 : 0)} m³`;

/** What a click does: "takes 6.2 m³". */
export function aim_text({ use }, aim) {
  if (!aim) return 'nothing to aim at';
  if (aim.beyond) return 'too far away';
  if (use === 'paint') return aim.material;
  if (aim.m3 === null) return use === 'place' ? 'nothing to place' : '';
  return use === 'dig' || use === 'carve' ? `takes ${cubic(aim.m3)}` : `puts ${cubic(aim.m3)}${aim.material && ` of ${aim.material}`}`;
}

/** What one carries, in words, and whether there is room for little more. */
export function carried_text(carried, store_m3) {
  const sum = carried.reduce((all, { m3 }) => all + m3, 0);
  if (store_m3 && sum >= FULL * store_m3) return { full: true, text: `Your store of ${cubic(store_m3)} is full: 2 places rock, U gives all to the world` };
  if (!carried.length) return { full: false, text: 'You carry nothing' };
  const list = carried.map(({ name, m3 }) => `${name} ${cubic(m3)}`).join(', ');
  return { full: false, text: store_m3 ? `You carry ${cubic(sum)} of ${cubic(store_m3)}: ${list}` : `You carry ${list}` };
}

/** The parts of the bar: [name, percent of the whole]. */
export function bar_parts(carried, store_m3) {
  const whole = store_m3 || carried.reduce((all, { m3 }) => all + m3, 0);
  return carried.map(({ name, m3 }) => [name, Math.min(Math.max(100 * m3 / whole, PART_LEAST), 100)]);
}

/** Where there is little room, the use in hand alone is shown: it goes to the next one. */
export class Tools {
  #client;
  #uses = new Map();
  #shape;
  #size = make('output', { aria: { label: 'Size' } });
  #aim = make('output', { className: 'aim', aria: { label: 'What a click does' } });
  #bar = make('div', { className: 'store', aria: { hidden: 'true' } });
  #carried = make('p');
  #tool = null;
  #walk;
  #range;

  constructor(client, catalogue) {
    this.#client = client;
    this.#range = catalogue.limits.tool_radius_m;
    const row = make('div', { className: 'row' });
    catalogue.uses.forEach((use, i) => {
      const one = button(use, `${use} (${i + 1})`, () => (use === this.#tool?.use ? client.act('next_use') : client.set('use', use)), `${i + 1} ${use}`);
      one.className = 'use';
      this.#uses.set(use, one);
      row.append(one);
    });
    const line = () => make('span', { className: 'between', role: 'separator' });
    this.#shape = button('crater', 'Shape (T)', () => client.act('next_tool'));
    this.#walk = button('walk', 'Walk, or fly (Q)', () => client.act('walk'));
    row.append(line(), this.#shape, button('less', 'Smaller', () => this.#grow(-1)), this.#size, button('more', 'Larger', () => this.#grow(1)), line(),
      this.#walk);
    $('tools').append(row, make('div', { className: 'carried' }, this.#bar, make('div', {}, this.#carried, this.#aim)));
  }

  #grow(steps) {
    if (!this.#tool) return;
    const [least, most] = this.#range;
    this.#client.set('radius', Math.min(Math.max(this.#tool.radius_m + steps * SIZE_STEP_M, least), most));
  }

  follow({ tool, walks, aim, carried, store_m3, materials }) {
    if (this.#tool?.kind !== tool.kind) this.#shape.querySelector('use').setAttribute('href', `#i-${tool.kind}`);
    this.#tool = tool;
    for (const [use, one] of this.#uses) one.setAttribute('aria-pressed', String(use === tool.use));
    write(this.#size, `${tool.radius_m.toFixed(2)} m`);
    this.#walk.setAttribute('aria-pressed', String(walks));
    write(this.#aim, aim_text(tool, aim));
    const { full, text } = carried_text(carried, store_m3);
    write(this.#carried, text);
    this.#carried.toggleAttribute('data-full', full);
    this.#fill(bar_parts(carried, store_m3), materials);
  }

  #fill(shown, materials) {
    while (this.#bar.children.length > shown.length) this.#bar.lastChild.remove();
    shown.forEach(([name, percent], i) => {
      const part = this.#bar.children[i] ?? this.#bar.appendChild(make('i'));
      const colour = materials.find((one) => one.name === name)?.colour ?? '';
      part.style.width = `${percent}%`;
      part.style.background = /^#[0-9a-f]{6}$/.test(colour) ? colour : 'var(--dim)';
    });
  }
}

/**
 * What a tool may place, fill or paint with, and which of it is chosen: a world may lack what was kept. One places of what
 * one carries, and `aim` knows which.
 */
export function materials_for(tool, materials, carried = [], aim = null) {
  if (tool.use === 'place')
    return { list: materials.filter(({ name }) => carried.some((one) => one.name === name)), chosen: aim?.material ?? tool.material };
  const fills = tool.use === 'fill';
  const list = fills ? [{ name: '', colour: '' }, ...materials] : materials;
  if (list.some(({ name }) => name === tool.material)) return { list, chosen: tool.material };
  return { list, chosen: materials[0]?.name ?? '' };
}

/** The page of the panel. */
export function tool_page(client, catalogue) {
  const { limits } = catalogue;
  const set = (name) => (value) => client.set(name, value);
  const kind = parts('Shape', in_order(catalogue.tools), set('tool'));
  const use = parts('A click does', catalogue.uses, set('use'));
  const material = swatches('Material', 'as the ground', set('material'));
  const pattern = parts('Cracks run', catalogue.patterns, set('pattern'));
  const range = (label, name, [least, most], step, say) => slider({ label, least, most, step, say, change: set(name) });
  const radius = range('Size', 'radius', limits.tool_radius_m, SIZE_STEP_M, metres);
  const blast = range('Blast', 'blast', limits.blast_speed_m_s, 0.5, (value) => `${value.toFixed(1)} m/s`);
  let by_volume = 0;
  const seeds = range('Pieces', 'seeds', limits.seeds, 1, (value) => (value > 0 ? String(value) : `by volume: ${by_volume}`));
  const give = make('button', { type: 'button' }, "Give all you carry to the world's store");
  give.addEventListener('click', () => client.act('give_away'));
  const element = make('section', {}, ...[kind, use, material, radius, blast, seeds, pattern].map((one) => one.element), give);
  return {
    title: 'Tool', icon: 'tool', element,
    show({ tool, materials, carried, aim }) {
      kind.show(tool.kind);
      use.show(tool.use);
      const { list, chosen } = materials_for(tool, materials, carried, aim);
      material.show(list, chosen);
      material.element.hidden = tool.use === 'dig' || tool.use === 'carve' || list.length === 0;
      give.hidden = carried.length === 0;
      for (const one of [blast, seeds, pattern]) one.element.hidden = tool.use !== 'carve';
      by_volume = tool.seeds_now;
      radius.show(tool.radius_m);
      blast.show(tool.blast_speed_m_s);
      seeds.show(tool.seeds);
      pattern.show(tool.pattern);
    },
  };
}
