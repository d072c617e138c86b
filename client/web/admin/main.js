// The administrators' page: comes in by a token, and shows its parts only to a session that may administer. It is an ordinary client
// of the server (docs/protocol.md): all that it shows and does goes through the messages that scree admin sends.
import { $, write } from '../page/dom.js';
import { token } from '../page/kept.js';
import { IN_CLEAR, insist, is_withheld, token_to_send } from '../page/secrets.js';
import { bytes_of, Role } from './wire.js';
import { AUDIT, LOG, Lines } from './lines.js';
import { MapPart } from './map.js';
import { Overview } from './overview.js';
import { Parts } from './parts.js';
import { People } from './people.js';
import { Regions } from './regions.js';
import { name_of_role } from './roles.js';
import { Session } from './session.js';
import { Settings } from './settings.js';

const TELL_MS = 500;
const NO_ADMINISTRATORS = 'Without a token one is not an administrator here.';

const hello = () => ({ token: bytes_of(token_to_send()) });
const session = new Session(() => ({ ...hello(), administers: true }), { changed: tell, joined, message });

const overview = new Overview(session);
const map = new MapPart(session, hello);
const people = new People(session, (number) => map.owns(number) || session.welcome?.session === number);
const settings = new Settings(session);
const regions = new Regions(session, (place, radius_m) => {
  parts.show('map');
  map.show_place(place, radius_m);
});
const parts = new Parts({ overview, people, map, regions, settings, log: new Lines(session, LOG), audit: new Lines(session, AUDIT) });

/** Nothing is shown but to an administrator. */
function show_parts(on) {
  for (const id of ['tabs', 'parts', 'forget']) $(id).hidden = !on;
  document.body.toggleAttribute('data-in', on);
}

function joined(welcome) {
  if (welcome.role !== Role.ADMIN) {
    const why = token.load() ? `This is a token of a ${name_of_role(welcome.role)}: this page is for administrators.` : NO_ADMINISTRATORS;
    return session.stop('refused', why, 'role');
  }
  $('ask').hidden = true;
  show_parts(true);
  overview.joined(welcome);
  map.joined(welcome);
  if (parts.shown) parts.again();
  else parts.show(location.hash.slice(1));
  if (document.activeElement === document.body) parts.focus();
}

function message({ case: name, value }) {
  if (name === 'status') {
    overview.status(value);
    settings.status(value);
  } else if (name === 'regions') {
    regions.show(value.regions);
    map.regions(value.regions);
  }
}

function ask_token(why) {
  show_parts(false);
  parts.leave();
  write($('why'), why);
  $('insist').hidden = !is_withheld();
  $('ask').hidden = false;
  if (document.activeElement !== $('token')) $('token').focus();
}

/** A token that does not hold is kept no longer: the server takes each attempt with one for a guess. */
const is_void = (name) => name.startsWith('token_') && name !== 'token_missing' && name !== 'token_guesses';

/** Says how the connection is. */
function tell() {
  const { phase, why, why_name, retry_at_ms } = session;
  const left_s = Math.max(Math.ceil((retry_at_ms - performance.now()) / 1000), 0);
  const words = {
    off: 'Not connected', connecting: 'Asking the server', joined: 'Connected', refused: 'Not let in',
    lost: `The connection is lost, next attempt in ${left_s} s${why ? ` (${why})` : ''}`,
  };
  write($('state'), words[phase]);
  $('state').dataset.well = { joined: 'yes', connecting: '' }[phase] ?? 'no';
  $('retry').hidden = phase !== 'lost';
  document.body.toggleAttribute('data-lost', phase === 'lost' || phase === 'connecting');
  if (phase === 'refused' && is_void(why_name)) token.keep('');
  if (phase === 'refused' && $('ask').hidden) ask_token(why);
}

function come_in() {
  if (is_withheld()) return ask_token(`Your token was not sent. ${IN_CLEAR}`);
  session.retry();
}

setInterval(() => { if (session.phase === 'lost') tell(); }, TELL_MS);
$('retry').addEventListener('click', () => session.retry());
$('insist').addEventListener('click', () => {
  insist();
  come_in();
});
$('ask').addEventListener('submit', (event) => {
  event.preventDefault();
  token.keep($('token').value.trim());
  $('token').value = '';
  $('ask').hidden = true;
  come_in();
});
$('forget').addEventListener('click', () => {
  token.keep('');
  session.stop('refused', 'The token is forgotten.');
});
come_in();
