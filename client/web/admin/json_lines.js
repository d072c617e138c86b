// Lines of JSON, as the server answers ListLines (proto/access.proto), and how a new answer goes on from the one before.
import { text_of } from './wire.js';

/** The kinds of lines, by LinesOf. */
export const LINES = { audit: 0, log: 1, figures: 2, settings: 3 };

/** The objects of the lines; what is none is left out. */
export function objects_of(text) {
  return text.split('\n').flatMap((line) => {
    try {
      const value = JSON.parse(line);
      return value !== null && typeof value === 'object' ? [value] : [];
    } catch {
      return [];
    }
  });
}

/** Asks for the newest `most` lines; 0: all that there are. */
export async function ask_lines(session, kind, most = 0) {
  const { text } = await session.act('listLines', { of: LINES[kind], most });
  return objects_of(text_of(text));
}

/**
 * How many lines at the start of `more` are the last ones of `known`: the rest is new. -1: they share none, so that lines between
 * may be missing. Lines may be equal, so the longest run counts.
 */
export function overlap(known, more) {
  const before = known.slice(-more.length).map((line) => JSON.stringify(line));
  const after = more.map((line) => JSON.stringify(line));
  for (let length = Math.min(before.length, after.length); length > 0; --length)
    if (before.slice(-length).every((line, i) => line === after[i])) return length;
  return known.length === 0 || more.length === 0 ? 0 : -1;
}
