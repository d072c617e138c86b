// What a game's rules show and tell, as docs/protocol.md explains it: signs, cues, messages.
import { bigOf } from './world.js';

const SIGN_KINDS = ['line', 'bar', 'marker'];
const CUE_KINDS = ['thud', 'crack', 'ring', 'rattle', 'dust', 'sparks'];
const ALL = 0, SESSION = 1;

const textOf = (bytes) => Buffer.from(bytes).toString('utf8');
const placeOf = (place) => [place?.x ?? 0, place?.y ?? 0, place?.z ?? 0];

export function unpackSign({ name, to, kind, text, share, place, colour, until, counts }) {
  const audience = to ?? { kind: ALL };
  return {
    name: textOf(name), kind: SIGN_KINDS[kind], text: textOf(text), share, place: placeOf(place), colour,
    until: bigOf(until), counts,
    to: audience.kind === ALL ? 'all' : audience.kind === SESSION ? `session ${bigOf(audience.session)}` : `team '${textOf(audience.team)}'`,
  };
}

/** Kinds of a later version make nothing. */
export const unpackCues = ({ cues }) =>
  cues.filter(({ kind }) => kind < CUE_KINDS.length)
    .map(({ kind, place, size_m, energy_j, material }) => ({ kind: CUE_KINDS[kind], place: placeOf(place), size_m, energy_j, material }));

export const unpackMessage = ({ channel, data }) => ({ channel: textOf(channel), data: Buffer.from(data) });

/** "2:05"; null where the sign has ended. */
export function timeLeft({ until, counts }, tick, tickRateHz) {
  if (until === 0n) return '';
  if (tick >= until) return null;
  if (!counts) return '';
  const seconds = Math.ceil(Number(until - tick) / tickRateHz);
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, '0')}`;
}

/** Of one client. */
export class Game {
  signs = []; // as they came last
  cues = []; // all so far
  heard = []; // messages, all so far

  /** Whether the message is about the game. */
  receive(kind, message) {
    if (kind === 'signs') this.signs = message.signs.map(unpackSign);
    else if (kind === 'cues') this.cues.push(...unpackCues(message));
    else if (kind === 'channel') this.heard.push(unpackMessage(message));
    else return false;
    return true;
  }

  /** The words of lines and bars, in order. */
  rows(tick, tickRateHz) {
    return this.signs.filter(({ kind }) => kind !== 'marker').map((sign) => [sign, timeLeft(sign, tick, tickRateHz)])
      .filter(([, left]) => left !== null).sort(([a], [b]) => (a.name < b.name ? -1 : a.name > b.name ? 1 : 0))
      .map(([sign, left]) => `${sign.text} ${left}`.trim());
  }
}

// ---- as the examples of the page state them

const inWords = (place) => `(${place.join(', ')})`;

function signInWords({ name, to, kind, text, share, place, colour, until, counts }) {
  const words = [`${kind} '${name}' to ${to}: '${text}'`, `colour 0x${colour.toString(16).padStart(6, '0')}`];
  if (kind === 'bar') words.push(`share ${share}`);
  if (kind === 'marker') words.push(`at ${inWords(place)}`);
  if (until !== 0n) words.push(`until tick ${until}`);
  if (counts) words.push('counts');
  return words.join(', ');
}

/** The lines under an example; null for a message that is not about a game. */
export function gameInWords(kind, message) {
  if (kind === 'signs') return ['signs:', ...message.signs.map(unpackSign).map(signInWords)];
  if (kind === 'cues') return [`cues: tick ${bigOf(message.tick)}`, ...unpackCues(message).map((cue) =>
    `${cue.kind} at ${inWords(cue.place)}, ${cue.size_m} m, ${cue.energy_j} J, material ${cue.material}`)];
  if (kind === 'channel') return [`channel '${unpackMessage(message).channel}': ${unpackMessage(message).data.toString('hex')}`];
  return null;
}
