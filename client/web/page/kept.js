// What a browser keeps of a person's choices for the next time. A browser may refuse to keep anything.

const KEY = 'scree';
/** A proxy may serve several servers, each under its path: a token is for one of them. */
const TOKEN_KEY = KEY + (globalThis.location?.pathname ?? '/').replace(/[^/]*$/, '').replace(/\/$/, '');

function attempt(act, otherwise) {
  try {
    return act();
  } catch {
    return otherwise;
  }
}

export function load() {
  const kept = attempt(() => JSON.parse(localStorage.getItem(KEY)), null);
  return kept !== null && typeof kept === 'object' ? kept : {};
}

export function keep(choices) {
  attempt(() => localStorage.setItem(KEY, JSON.stringify({ ...load(), ...choices })));
}

/** The token, as long as this tab is open. */
export const token = {
  load: () => attempt(() => sessionStorage.getItem(TOKEN_KEY), null) ?? '',
  keep: (text) => attempt(() => sessionStorage.setItem(TOKEN_KEY, text)),
};

/** Tells the client what was kept; what it does not know any more it leaves out. */
export function restore(client) {
  // Who asks for little motion sees no shaking, unless they switched it on here.
  if (globalThis.matchMedia?.('(prefers-reduced-motion: reduce)').matches) client.set('shake', false);
  const kept = load();
  for (const [name, value] of Object.entries({ ...kept.tool, ...kept.view }))
    if (typeof value === 'string' || typeof value === 'number' || typeof value === 'boolean') SETTERS[name]?.(client, value);
}

const SETTERS = Object.fromEntries(Object.entries({
  kind: 'tool', use: 'use', material: 'material', pattern: 'pattern', radius_m: 'radius', blast_speed_m_s: 'blast', seeds: 'seeds',
  particles: 'particles', details: 'details', shake: 'shake', predict: 'predict', field_of_view_degrees: 'field_of_view', look_speed: 'look_speed',
}).map(([name, wish]) => [name, (client, value) => client.set(wish, value)]));

/** Of a state (bridge.h), what restore() takes. */
export function choices_of({ tool, view }) {
  const { kind, use, material, pattern, radius_m, blast_speed_m_s, seeds } = tool;
  const { particles, details, shake, predict, field_of_view_degrees, look_speed } = view;
  return { tool: { kind, use, material, pattern, radius_m, blast_speed_m_s, seeds }, view: { particles, details, shake, predict, field_of_view_degrees, look_speed } };
}
