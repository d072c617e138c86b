// Keys: which are the world's, which the browser's, and which belong to what has the focus.

/** Keys of the page itself, beside those of the client's table: a browser needs F11 and F12. */
export const OWN_KEYS = { F2: 'picture' };

/** What an element with the focus needs itself. `kind`: 'text', 'slider', 'choice' (a list), 'button', or null. */
export function is_taken(code, kind) {
  if (kind === 'text') return true;
  const arrow = code.startsWith('Arrow') || code === 'Home' || code === 'End' || code === 'PageUp' || code === 'PageDown';
  if (kind === 'slider') return arrow;
  if (kind === 'choice') return arrow || code === 'Enter' || code === 'Space' || code.startsWith('Key');
  if (kind === 'button') return code === 'Enter' || code === 'Space';
  return false;
}

export function kind_of(element) {
  if (!element) return null;
  if (element.tagName === 'SELECT') return 'choice';
  if (element.tagName === 'BUTTON' || element.tagName === 'A') return 'button';
  if (element.getAttribute?.('role') === 'slider') return 'slider';
  if (element.tagName !== 'INPUT') return element.tagName === 'TEXTAREA' ? 'text' : null;
  if (element.type === 'range' || element.type === 'radio') return 'slider';
  return element.type === 'checkbox' ? 'button' : 'text';
}

/** Passes keys on to the client; `act` does the page's own. */
export function listen(client, act) {
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || is_taken(event.code, kind_of(document.activeElement))) return;
    if (event.code === 'Tab' && document.pointerLockElement) act('free_mouse');
    else if (OWN_KEYS[event.code]) act(OWN_KEYS[event.code]);
    else if (!client.key(event.code, true)) return;
    event.preventDefault();
  });
  addEventListener('keyup', (event) => client.key(event.code, false));
  addEventListener('blur', () => client.keys_up());
  document.addEventListener('focusin', (event) => {
    if (kind_of(event.target) === 'text') client.keys_up();
  });
}
