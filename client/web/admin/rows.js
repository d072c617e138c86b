// A table whose rows stay the same elements while their figures change, so that focus, selection and layout stay, too.
import { make, write } from '../page/dom.js';

export class Rows {
  #body = make('tbody');
  #shown = new Map();
  #columns;
  #none;

  /** `columns`: {name, title, text(row), className, element(row)}; those with `element` get it once, when their row is made. `none`: of no rows. */
  constructor(caption, columns, none) {
    this.#columns = columns;
    this.#none = make('p', { className: 'dim none' }, none);
    const heads = columns.map(({ title, className = '' }) => make('th', { scope: 'col', className }, title));
    this.element = make('div', { className: 'scroll' }, make('table', {}, make('caption', { className: 'away' }, caption), make('thead', {}, make('tr', {}, ...heads)), this.#body), this.#none);
  }

  /** Shows these, by `key(row)`, in this order. */
  show(rows, key) {
    const keys = new Set(rows.map(key));
    for (const [one, { line }] of this.#shown) {
      if (keys.has(one)) continue;
      line.remove();
      this.#shown.delete(one);
    }
    rows.forEach((row, place) => {
      const one = key(row);
      let shown = this.#shown.get(one);
      if (!shown) {
        shown = this.#make(row);
        this.#shown.set(one, shown);
      }
      shown.row = row;
      for (const [cell, text] of shown.texts) {
        write(cell, text(row));
        if (cell.classList.contains('name')) cell.title = text(row);
      }
      if (this.#body.children[place] !== shown.line) this.#body.insertBefore(shown.line, this.#body.children[place] ?? null);
    });
    this.#none.hidden = rows.length > 0;
  }

  #make(first) {
    const shown = { line: make('tr'), texts: [], row: first };
    for (const { title, text, element, className = '' } of this.#columns) {
      const cell = make('td', { className, data: { title } });
      if (element) cell.append(element(() => shown.row));
      else shown.texts.push([cell, text]);
      shown.line.append(cell);
    }
    return shown;
  }
}
