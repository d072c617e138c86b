// How the world is drawn: the panel's page for it.
import { check, make, parts, slider } from './dom.js';

/** `wish(name, value)`: as Client.set(). `act`: the page's own actions, by name (main.js). */
export function view_page(wish, catalogue, act) {
  const { limits } = catalogue;
  const set = (name) => (value) => wish(name, value);
  const methods = new Map();
  const list = make('div', { className: 'choices', role: 'radiogroup', aria: { label: 'Method' } });
  for (const { name, summary, missing } of catalogue.methods) {
    const input = make('input', { type: 'radio', name: 'method', value: name, disabled: missing !== null });
    input.addEventListener('change', () => set('method')(name));
    const label = make('label', {}, input, make('span', {}, name), make('small', {}, missing ?? summary));
    if (missing !== null) label.setAttribute('aria-disabled', 'true');
    methods.set(name, input);
    list.append(label);
  }
  const qualities = catalogue.qualities.includes('auto') ? catalogue.qualities : ['auto', ...catalogue.qualities];
  const quality = parts('Quality', qualities, set('quality'));
  const range = (label, name, [least, most], step, say) => slider({ label, least, most, step, say, change: set(name) });
  const far = range('How far one sees', 'view_radius', limits.view_radius_m, 4, (value) => `${value.toFixed(0)} m`);
  const lens = range('Field of view', 'field_of_view', limits.field_of_view_degrees, 1, (value) => `${value.toFixed(0)}°`);
  const hand = range('Mouse and thumb', 'look_speed', [Math.max(limits.look_speed[0], 0.1), Math.min(limits.look_speed[1], 4)], 0.1, (value) => `× ${value.toFixed(1)}`);
  const dust = check('Dust', 'of breaks, blows and merges', (on) => set('particles')(on));
  const details = check('Grass and stones', 'on the ground, but at low quality', (on) => set('details')(on));
  const shake = check('Blows shake the eye', 'the stronger, the nearer', (on) => set('shake')(on));
  const predict = check('Own carves at once', 'shown before the server has answered', (on) => set('predict')(on));
  const overlay = check('Borders', 'chunks, interest, bodies, contacts', (on) => set('overlay')(on));
  const sound = check('Sound', 'of breaks, blows and merges', () => act('mute'));
  const does = (text, action) => {
    const one = make('button', { type: 'button' }, text);
    one.addEventListener('click', () => act(action));
    return one;
  };
  const element = make('section', {}, make('div', {}, make('h3', {}, 'Method'), list), quality.element, far.element, lens.element, hand.element,
    make('div', { className: 'checks' }, dust.element, details.element, shake.element, sound.element, predict.element, overlay.element),
    make('div', { className: 'wide' }, does('Copy link', 'copy_place'), does('Picture', 'picture'), does('Full screen', 'full_screen'), does('Hide all', 'hide')));
  return {
    title: 'View', icon: 'view', element,
    show({ view, sound: sounds }) {
      const chosen = methods.get(view.method);
      if (chosen) chosen.checked = true;
      quality.show(view.quality_auto ? 'auto' : view.quality);
      far.show(view.view_radius_m);
      lens.show(view.field_of_view_degrees);
      hand.show(view.look_speed);
      dust.show(view.particles);
      details.show(view.details);
      shake.show(view.shake);
      sound.show(sounds);
      predict.show(view.predict);
      overlay.show(view.overlay);
    },
  };
}
