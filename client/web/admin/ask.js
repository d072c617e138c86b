// Asks once before an act that cannot be taken back, in the page; and says what became of an act.
import { $, make } from '../page/dom.js';

const SAID_MS = 9000;
let clearing = 0;

/** One line at the edge of the page, which screen readers say; `bad`: of a refusal. */
export function say(text, bad = false) {
  clearTimeout(clearing);
  const line = make('p', {}, text);
  line.toggleAttribute('data-bad', bad);
  $('said').replaceChildren(line);
  clearing = setTimeout(() => $('said').replaceChildren(), SAID_MS);
}

/** Does it, and says how it went: `done` may be made of the answer. Gives the answer, or undefined where it was refused. */
export async function attempt(act, done) {
  try {
    const answer = await act();
    if (done) say(typeof done === 'function' ? done(answer) : done);
    return answer ?? true;
  } catch (error) {
    say(error.message, true);
    return undefined;
  }
}

/** A labelled input, one row of a form. */
export function field(label, input, help = '') {
  const element = make('label', { className: 'field' }, make('span', {}, label), input);
  if (help) element.append(make('small', {}, help));
  return element;
}

/**
 * A question with its answer's name on the button, such as 'Kick'. `fields`: rows of {name, label, value, type, help, ...}, as inputs.
 * Gives their values by name, or null where the person thought better of it. Escape is that, too.
 */
export function confirm({ title, words, act, fields = [] }) {
  const inputs = new Map(fields.map(({ name, label, help, ...properties }) => [name, { label, help, input: make('input', { type: 'text', autocomplete: 'off', name, ...properties }) }]));
  const back = make('button', { type: 'button' }, 'Cancel');
  const go = make('button', { type: 'submit', className: 'danger' }, act);
  const form = make('form', {}, make('h2', { id: 'asked' }, title), ...[words].flat().map((line) => make('p', { className: 'dim' }, line)),
    ...[...inputs.values()].map(({ label, input, help }) => field(label, input, help)), make('div', { className: 'row' }, back, go));
  const dialog = make('dialog', { className: 'sheet', aria: { labelledby: 'asked' } }, form);
  document.body.append(dialog);
  return new Promise((resolve) => {
    let answer = null;
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      answer = Object.fromEntries([...inputs].map(([name, { input }]) => [name, input.value.trim()]));
      dialog.close();
    });
    back.addEventListener('click', () => dialog.close());
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(answer);
    });
    dialog.showModal();
    ([...inputs.values()][0]?.input ?? back).focus();
  });
}
