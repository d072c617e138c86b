// All keys, buttons and gestures: the panel's page for them.
import { make } from './dom.js';

/** What no single key does: by keys and mouse, by gamepad, and what it is. */
const MOTIONS = [
  ['click', '', 'takes the mouse; Tab or Esc frees it'],
  ['left click', 'right trigger', 'use the tool where the cross is; held, again and again'],
  ['W A S D', 'left stick', 'move; Shift or the left trigger: faster'],
  ['Space, C', 'stick presses', 'up, down; on foot, Space jumps'],
  ['mouse, arrows', 'right stick', 'look; the wheel sets the size of the tool'],
];
const FINGERS = [
  ['left thumb', 'moves; far out, it runs'],
  ['right thumb', 'looks around'],
  ['star', 'uses the tool where the cross is'],
];
/** Keys that a browser has taken for itself. */
const OTHER_KEYS = { picture: 'F2', full_screen: 'F11', free_mouse: 'Tab' };
/** What a page cannot do, or has no place for. */
const ABSENT = ['menu', 'record_path', 'graphs', 'larger_text', 'smaller_text'];
const DOES = { picture: 'save the picture', copy_place: 'copy the link to this view', panel: 'tools', all_figures: 'all figures' };

/** Rows of keys, gamepad's buttons and words, of a live world or a replay. */
export function rows(controls, replay) {
  const told = controls.filter(({ action, of_replay, of_world }) => !ABSENT.includes(action) && !(replay ? of_world : of_replay));
  return [...MOTIONS.filter(([key]) => !replay || key !== 'left click'), ...told.map(({ action, key, button, does }) =>
    [OTHER_KEYS[action] ?? key, button.replace(/^pad /, ''), DOES[action] ?? does])].filter(([key, button]) => key || button);
}

export function help_page({ controls }) {
  const list = (pairs) => make('dl', { className: 'keys' },
    ...pairs.flatMap(([key, does]) => [make('dt', {}, make('kbd', {}, key)), make('dd', {}, does)]));
  const keys = make('div');
  const pad = make('div');
  let shown = null;
  return {
    title: 'Help', icon: 'help',
    element: make('section', {}, make('div', {}, make('h3', {}, 'Keys and mouse'), keys), make('div', {}, make('h3', {}, 'Touch'), list(FINGERS)),
      make('div', {}, make('h3', {}, 'Gamepad'), pad)),
    show({ connection }) {
      if (shown === connection.replay) return;
      shown = connection.replay;
      const all = rows(controls, connection.replay);
      keys.replaceChildren(list(all.filter(([key]) => key).map(([key, , does]) => [key, does])));
      pad.replaceChildren(list(all.filter(([, button]) => button).map(([, button, does]) => [button, does])));
    },
  };
}
