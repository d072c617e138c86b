// Who is there: their names in the picture, the panel's page, and what is said.
import { $, make, write } from './dom.js';

/** Lines that are shown at once. */
const LINES_MAX = 8;

/** Names over the picture; `shown` as scree_names() has them. */
export function draw_names(shown, width, height) {
  const labels = $('names');
  while (labels.children.length > shown.length) labels.lastChild.remove();
  shown.forEach(({ name, colour, x, y }, i) => {
    const label = labels.children[i] ?? labels.appendChild(make('span'));
    write(label, name);
    label.style.setProperty('--colour', colour);
    label.style.transform = `translate(${Math.round(x * width)}px, ${Math.round(y * height)}px) translate(-50%, -120%)`;
  });
}

/** `rename(name)`: joins again under that name; `talk()`: opens the line to all. `colours`: of sessions, as the names in the picture told them. */
export function people_page(client, catalogue, rename, colours, talk) {
  const name = make('input', { id: 'name', type: 'text', maxLength: catalogue.limits.name_bytes, placeholder: 'without a name', autocomplete: 'nickname' });
  const form = make('form', { className: 'name' }, name, make('button', { type: 'submit' }, 'Set'));
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    rename(name.value.trim());
    name.blur();
  });
  const list = make('ol', { className: 'persons' });
  const more = make('p', { className: 'dim' });
  const eye = make('button', { type: 'button' }, "Look through the next person's eye");
  eye.addEventListener('click', () => client.act('next_eye'));
  const say = make('button', { type: 'button' }, 'Say something to all');
  say.addEventListener('click', talk);
  const element = make('section', {}, make('div', {}, make('h3', {}, 'Your name, as others see it'), form),
    make('div', {}, make('h3', {}, 'Who is there'), list, more), make('div', { className: 'stack' }, say, eye));
  return {
    title: 'People', icon: 'people', element, name,
    show({ persons, connection }) {
      say.hidden = !persons.chat;
      list.replaceChildren(...persons.list.map((person) => {
        const me = person.session === connection.session;
        const dot = make('i');
        if (colours.has(person.session)) dot.style.setProperty('--colour', colours.get(person.session));
        return make('li', {}, dot, make('span', {}, person.name), make('small', {}, me ? 'you' : person.role));
      }));
      write(more, persons.more ? `and ${persons.more} more` : persons.list.length < 2 ? 'Nobody else: send somebody the link.' : '');
    },
  };
}

/** What is said, lower left; Enter opens the line to write. */
export class Talk {
  #client;
  #left;

  constructor(client, left) {
    this.#client = client;
    this.#left = left;
    $('say').addEventListener('submit', (event) => {
      event.preventDefault();
      const text = $('line').value.trim();
      if (text === '' || this.#client.say(text)) this.close();
    });
    $('line').addEventListener('keydown', (event) => { if (event.key === 'Escape') this.close(); });
  }

  open() {
    $('say').hidden = false;
    $('line').focus();
  }

  close() {
    $('line').value = '';
    $('say').hidden = true;
    this.#left();
  }

  follow({ lines }) {
    const shown = lines.slice(-LINES_MAX);
    const list = $('lines');
    while (list.children.length > shown.length) list.firstChild.remove();
    shown.forEach((line, i) => write(list.children[i] ?? list.appendChild(make('li')), line));
  }
}
