// What a game's rules show: lines and bars above, markers at their places in the picture. Nothing where there is none.
import { $, make, write } from './dom.js';

const BAR = 1, MARKER = 2;

/** The text of scree_signs() (bridge.h). */
export function read_signs(text) {
  return text.split('\n').filter((line) => line !== '').map((line) => {
    const [kind, colour, share, x, y, opacity, right, down, name, words] = line.split('\t');
    return {
      kind: Number(kind), colour, share: Number(share), x: Number(x), y: Number(y), opacity: Number(opacity),
      way: right === '0.00' && down === '0.00' ? null : [Number(right), Number(down)], name, words,
    };
  });
}

/** As many children as there are values; each is made once, and shown again and again. */
function follow(parent, values, make_one, show) {
  while (parent.children.length > values.length) parent.lastChild.remove();
  values.forEach((value, i) => show(parent.children[i] ?? parent.appendChild(make_one()), value));
}

function show_row(row, { kind, colour, share, words }) {
  const [text, bar] = row.children;
  row.style.setProperty('--colour', colour);
  write(text, words);
  text.hidden = words === '';
  bar.hidden = kind !== BAR;
  bar.firstElementChild.style.width = `${100 * share}%`;
}

function show_marker(marker, { colour, x, y, opacity, way, words }, width, height) {
  const [diamond, text] = marker.children;
  marker.style.setProperty('--colour', colour);
  marker.style.opacity = opacity;
  marker.style.transform = `translate(${Math.round(x * width)}px, ${Math.round(y * height)}px)`;
  marker.toggleAttribute('data-beside', way !== null);
  diamond.style.setProperty('--turn', way ? `${Math.atan2(way[1], way[0])}rad` : '0rad');
  write(text, words);
  text.hidden = words === '';
  // At the right and left edge, words lie towards the middle; low down, above the diamond as everywhere.
  text.dataset.side = way && x < 0.2 ? 'right' : way && x > 0.8 ? 'left' : y < 0.12 ? 'below' : 'above';
}

export class Signs {
  #shown = '';

  /** Once a frame; `text` as scree_signs() has it. */
  show(text, width, height) {
    const looks = `${width} ${height} ${text}`;
    if (looks === this.#shown) return;
    this.#shown = looks;
    const all = read_signs(text);
    follow($('signs'), all.filter(({ kind }) => kind !== MARKER),
      () => make('li', {}, make('span'), make('div', { className: 'share' }, make('i'))), show_row);
    follow($('markers'), all.filter(({ kind }) => kind === MARKER), () => make('div', {}, make('i'), make('span')),
      (marker, sign) => show_marker(marker, sign, width, height));
  }
}
