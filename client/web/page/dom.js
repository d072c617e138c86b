// Makes elements. Whatever a server or a person wrote goes in as text, never as markup.

/** An element: properties are set as they are; `data` and `aria` are objects of their own; children are elements or texts. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  const { data = {}, aria = {}, ...plain } = properties;
  Object.assign(element, plain);
  Object.assign(element.dataset, data);
  for (const [name, value] of Object.entries(aria)) element.setAttribute(`aria-${name}`, value);
  element.append(...children);
  return element;
}

export const $ = (id) => document.getElementById(id);

/** Writes the text only where it is another: the browser then lays nothing out anew. */
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function icon(name) {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  const use = document.createElementNS(space, 'use');
  svg.setAttribute('aria-hidden', 'true');
  use.setAttribute('href', `#i-${name}`);
  svg.append(use);
  return svg;
}

export function button(name, does, act, text) {
  const made = make('button', { type: 'button', title: does, aria: { label: does } }, icon(name));
  if (text) made.append(make('small', {}, text));
  made.addEventListener('click', act);
  return made;
}

/** A labelled slider. `write(value)` says the value in words; `show(value)` sets it unless a hand is on it. */
export function slider({ label, least, most, step, say, change }) {
  const input = make('input', { type: 'range', min: least, max: most, step, aria: { label } });
  const output = make('span', { className: 'value' });
  const element = make('label', { className: 'row' }, make('span', {}, label), output, input);
  const tell = () => write(output, say(Number(input.value)));
  let held = false;
  input.addEventListener('input', () => { change(Number(input.value)); tell(); });
  input.addEventListener('pointerdown', () => { held = true; });
  for (const end of ['pointerup', 'pointercancel', 'change']) input.addEventListener(end, () => { held = false; });
  return { element, show(value) { if (!held) { input.value = value; tell(); } } };
}

/** Buttons of which one is pressed. */
export function parts(legend, names, choose) {
  const row = make('div', { className: 'parts', role: 'group', aria: { label: legend } });
  const buttons = new Map();
  for (const name of names) {
    const one = make('button', { type: 'button', aria: { pressed: 'false' } }, name);
    one.addEventListener('click', () => choose(name));
    buttons.set(name, one);
    row.append(one);
  }
  const element = make('div', {}, make('h3', {}, legend), row);
  return { element, show(chosen) { for (const [name, one] of buttons) one.setAttribute('aria-pressed', String(name === chosen)); } };
}

/** The same of things that have a colour and may become others: `list` of {name, colour}. The name '' is shown as `none`. */
export function swatches(legend, none, choose) {
  const row = make('div', { className: 'parts swatches', role: 'group', aria: { label: legend } });
  const element = make('div', {}, make('h3', {}, legend), row);
  let shown = '', buttons = new Map();
  const rebuild = (list) => {
    buttons = new Map(list.map(({ name, colour }) => {
      const one = make('button', { type: 'button', aria: { pressed: 'false' } });
      if (colour) one.append(make('i', { className: 'swatch', style: `background:${/^#[0-9a-f]{6}$/.test(colour) ? colour : 'none'}` }));
      one.append(name || none);
      one.addEventListener('click', () => choose(name));
      return [name, one];
    }));
    row.replaceChildren(...buttons.values());
  };
  return {
    element,
    show(list, chosen) {
      const text = JSON.stringify(list);
      if (text !== shown) rebuild(list);
      shown = text;
      for (const [name, one] of buttons) one.setAttribute('aria-pressed', String(name === chosen));
    },
  };
}

export function check(label, explanation, change) {
  const input = make('input', { type: 'checkbox' });
  input.addEventListener('change', () => change(input.checked));
  const element = make('label', { className: 'check' }, input, make('span', {}, label));
  if (explanation) element.append(make('small', {}, explanation));
  return { element, show(on) { input.checked = on; } };
}
