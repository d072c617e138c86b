// The tool in hand: its row below the picture, and its page in the panel.
import { $, button, make, parts, slider, swatches, write } from './dom.js';
import { metres } from './words.js';

const SIZE_STEP_M = 0.25;

/** In the order in which a newcomer meets them: the crater is the usual tool. */
export const in_order = (kinds) => [...kinds].sort((a, b) => Number(b === 'crater') - Number(a === 'crater'));

/** Where there is little room, the shape in hand alone is shown: it goes to the next one. */
export class Tools {
  #client;
  #kinds = new Map();
  #use;
  #size = make('output', { aria: { label: 'Size' } });
  #tool = null;
  #walk;
  #range;

  constructor(client, catalogue) {
    this.#client = client;
    this.#range = catalogue.limits.tool_radius_m;
    const row = $('tools');
    for (const kind of in_order(catalogue.tools)) {
      const one = button(kind, `Tool: ${kind}`, () => (kind === this.#tool?.kind ? client.act('next_tool') : client.set('tool', kind)));
      one.className = 'kind';
      this.#kinds.set(kind, one);
      row.append(one);
    }
    const line = () => make('span', { className: 'between', role: 'separator' });
    this.#use = make('button', { type: 'button', title: 'Carve, fill, paint, dig or place (F)' });
    this.#use.addEventListener('click', () => client.act('next_use'));
    this.#walk = button('walk', 'Walk, or fly (Q)', () => client.act('walk'));
    row.append(line(), button('less', 'Smaller', () => this.#grow(-1)), this.#size, button('more', 'Larger', () => this.#grow(1)), line(),
      this.#use, this.#walk);
  }

  #grow(steps) {
    if (!this.#tool) return;
    const [least, most] = this.#range;
    this.#client.set('radius', Math.min(Math.max(this.#tool.radius_m + steps * SIZE_STEP_M, least), most));
  }

  follow({ tool, walks }) {
    this.#tool = tool;
    for (const [kind, one] of this.#kinds) one.setAttribute('aria-pressed', String(kind === tool.kind));
    write(this.#size, metres(tool.radius_m));
    write(this.#use, tool.use);
    this.#walk.setAttribute('aria-pressed', String(walks));
  }
}

/** What a tool may fill, paint or place with, and which of it is chosen: a world may lack what was kept. */
export function materials_for(tool, materials) {
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
  const element = make('section', {}, ...[kind, use, material, radius, blast, seeds, pattern].map((one) => one.element));
  return {
    title: 'Tool', icon: 'tool', element,
    show({ tool, materials }) {
      kind.show(tool.kind);
      use.show(tool.use);
      const { list, chosen } = materials_for(tool, materials);
      material.show(list, chosen);
      material.element.hidden = tool.use === 'carve' || tool.use === 'dig';
      for (const one of [blast, seeds, pattern]) one.element.hidden = tool.use !== 'carve';
      by_volume = tool.seeds_now;
      radius.show(tool.radius_m);
      blast.show(tool.blast_speed_m_s);
      seeds.show(tool.seeds);
      pattern.show(tool.pattern);
    },
  };
}
