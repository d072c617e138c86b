// Whether a token may leave this page. Without TLS everybody on the way can read it, and come in by it; so it goes to other
// machines only when the person says so, for as long as this tab is open.
import { token } from './kept.js';

const INSISTS_KEY = 'scree_insecure_token';

export const IN_CLEAR = 'This page came without TLS (http), so everybody on the way to the server could read your token, and use it. '
  + 'If the server has a certificate, open this page by https.';

/** Whether others can read what a page of this address sends: a browser's own machine is reached by no other one. */
export function is_read_on_the_way({ protocol, hostname }) {
  const here = hostname === 'localhost' || hostname.endsWith('.localhost') || hostname === '[::1]' || /^127(\.\d{1,3}){3}$/.test(hostname);
  return protocol !== 'https:' && !here;
}

/** The person wants to send the token all the same. */
export function insist() {
  try {
    sessionStorage.setItem(INSISTS_KEY, 'true');
  } catch { /* a browser that keeps nothing asks again */ }
}

function insists() {
  try {
    return sessionStorage.getItem(INSISTS_KEY) === 'true';
  } catch {
    return false;
  }
}

/** Whether there is a token that must not be sent from here. */
export const is_withheld = (place = globalThis.location) => token.load() !== '' && is_read_on_the_way(place) && !insists();

/** The token, as far as it may be sent from here. */
export const token_to_send = (place = globalThis.location) => (is_withheld(place) ? '' : token.load());
