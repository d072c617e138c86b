// The status page: asks for status.json beside it once a second, and shows it.
import { Backoff } from './backoff.js';
import { $, make, write } from './dom.js';
import { Spark } from './spark.js';
import { budget_text, heads, latency_bars, lists, server_text, session_row, stage_bars } from './status_figures.js';
import { token } from './kept.js';
import { IN_CLEAR, insist, is_withheld, token_to_send } from './secrets.js';

const EVERY_MS = 1000, ANSWER_MS = 10000;
const SESSIONS_MAX = 200;

const backoff = new Backoff();
const curves = new Map();

function show_heads(status) {
  for (const { name, value, beside, curve, by_change, bad } of heads(status)) {
    let head = curves.get(name);
    if (!head) {
      head = { spark: new Spark(name), value: make('span'), beside: make('small') };
      head.element = make('div', { className: 'head' }, make('h3', {}, name), make('p', { className: 'value' }, head.value, head.beside), head.spark.element);
      curves.set(name, head);
      $('heads').append(head.element);
    }
    write(head.value, value);
    write(head.beside, beside);
    head.element.toggleAttribute('data-bad', bad);
    head.spark.add(by_change ? Math.max(curve - (head.before ?? curve), 0) : curve);
    head.before = curve;
    head.spark.draw();
  }
}

function show_bars(box, bars) {
  box.replaceChildren(...bars.flatMap(({ name, part, text, worst }) => {
    const bar = make('i', { aria: { hidden: 'true' } });
    bar.style.setProperty('--part', `${100 * part}%`);
    if (worst !== undefined) {
      bar.dataset.worst = '';
      bar.style.setProperty('--worst', `calc(${100 * worst}% - 2px)`);
    }
    return [make('span', {}, name), bar, make('span', {}, text)];
  }));
}

function show(status) {
  write($('server'), server_text(status));
  write($('budget'), budget_text(status));
  show_heads(status);
  show_bars($('stages').querySelector('.bars'), stage_bars(status));
  show_bars($('latency').querySelector('.bars'), latency_bars(status));
  for (const [id, rows] of Object.entries(lists(status)))
    $(id).querySelector('dl').replaceChildren(...rows.flatMap(([name, value, bad]) => {
      const described = make('dd', {}, value);
      described.toggleAttribute('data-bad', Boolean(bad));
      return [make('dt', {}, name), described];
    }));
  const sessions = status.sessions ?? [];
  $('sessions').querySelector('tbody').replaceChildren(...sessions.slice(0, SESSIONS_MAX).map((row) =>
    make('tr', {}, ...session_row(row).map((text) => make('td', {}, text)))));
  write($('sessions').querySelector('p'), sessions.length > SESSIONS_MAX ? `and ${sessions.length - SESSIONS_MAX} more` : sessions.length ? '' : 'Nobody is there.');
}

function tell(text, well) {
  write($('state'), text);
  $('state').dataset.well = well;
}

function ask_token(why) {
  tell('A token is needed', 'no');
  write($('why'), why);
  $('insist').hidden = !is_withheld();
  $('figures').hidden = true;
  $('ask').hidden = false;
  $('token').focus();
}

const WHY = {
  401: 'The server shows its figures only to administrators.',
  403: 'This token is not valid, or not a token of an administrator.',
  429: 'Too many wrong tokens came from here: wait a little.',
};

/** Why a token is asked for; undefined: the answer is about something else, as too many requests are. */
async function why_no_figures(answer) {
  const about_tokens = answer.status !== 429 || (await answer.text()).includes('token_guesses');
  return about_tokens ? WHY[answer.status] : undefined;
}

let next = 0;
let asking = false;

function go_on_after(wait_ms) {
  clearTimeout(next);
  next = setTimeout(go_on, wait_ms);
}

async function ask() {
  if (is_withheld()) return ask_token(`Your token was not sent. ${IN_CLEAR}`);
  const bearer = token_to_send();
  const answer = await fetch('status.json', {
    headers: bearer ? { authorization: `Bearer ${bearer}` } : {}, cache: 'no-store', signal: AbortSignal.timeout(ANSWER_MS),
  });
  const why = await why_no_figures(answer);
  if (why) return ask_token(why);
  if (!answer.ok) throw new Error(`the server answers ${answer.status}`);
  const status = await answer.json();
  $('ask').hidden = true;
  $('figures').hidden = false;
  show(status);
  tell('live', 'yes');
  backoff.well();
  go_on_after(EVERY_MS);
}

async function go_on() {
  if (document.hidden || asking) return go_on_after(EVERY_MS);
  asking = true;
  try {
    await ask();
  } catch (error) {
    const wait_ms = backoff.failed();
    tell(`${error.name === 'TimeoutError' || error.name === 'TypeError' ? 'The server does not answer' : error.message}; again in ${wait_ms / 1000} s`, 'no');
    go_on_after(wait_ms);
  }
  asking = false;
}

$('insist').addEventListener('click', () => {
  insist();
  go_on();
});
$('ask').addEventListener('submit', (event) => {
  event.preventDefault();
  token.keep($('token').value.trim());
  go_on();
});
go_on();
