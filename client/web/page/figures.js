// Figures: in brief in the picture's corner, and all of them in the panel.
import { $, make, write } from './dom.js';
import { Spark } from './spark.js';
import { bytes, ms, whole } from './words.js';

/** The brief ones: names and values. */
export function brief(state) {
  const { frame, status, pace, traffic } = state;
  const rows = [['frames', frame.median_ms > 0 ? `${Math.round(1000 / frame.median_ms)} Hz` : '–'],
    ['terrain', state.complete ? 'all in view' : 'loading'],
    ['pieces', whole(status?.pieces ?? state.pieces_near)],
    ['network', `${bytes(traffic.received_bytes_per_s)}/s`]];
  if (state.props_near > 0) rows.push(['props', whole(state.props_near)]);
  if (!state.connection.replay && pace < 0.98) rows.push(['time', `× ${pace.toFixed(2)}`]);
  return rows;
}

/** All others, in groups: [title, [[name, value, is it bad]…]]. */
export function all(state) {
  const { frame, draw, mirror, status, traffic } = state;
  const groups = [['Drawing', [['method', draw.method], ['frame, median', ms(frame.median_ms)], ['frame, worst of 120', ms(frame.worst_ms)],
    ['draws', whole(draw.draws)], ['triangles', whole(draw.triangles)], ['blocks or bricks', `${whole(draw.kept)} kept, ${whole(draw.waiting)} wait`],
    ['OpenGL', draw.driver], ['OpenGL errors', `${draw.gl_errors}${draw.gl_errors ? `: ${draw.first_gl_error}` : ''}`, draw.gl_errors > 0]]]];
  groups.push(['Network', [['received', `${bytes(traffic.received_bytes)}, ${bytes(traffic.received_bytes_per_s)}/s`], ['sent', bytes(traffic.sent_bytes)],
    ['own request', state.latency_ms === null ? '–' : ms(state.latency_ms)], ['carves not answered', whole(state.predictions)]]]);
  if (mirror)
    groups.push(['The same rock?', [['checks', whole(mirror.checks)], ['that differed', whole(mirror.mismatches), mirror.mismatches > 0],
      ['chunks followed', whole(mirror.held_chunks)], ['edited bricks', whole(mirror.edited_bricks)]]]);
  if (status)
    groups.push(['Server', [['tick', `${whole(state.tick)}${state.connection.replay ? '' : `, ${whole(state.lost_ticks)} lost`}`],
      ['tick, median', ms(status.tick_median_ms)], ['tick, worst', ms(status.tick_worst_ms)], ['persons and programs', whole(status.clients)],
      ['pieces', `${whole(status.pieces)} alive, ${whole(status.pieces_merged)} merged`], ['dust', `${status.ledger.dust.toFixed(2)} m³`],
      ['field', status.field_hash]]]);
  return groups;
}

export function show_brief(state) {
  const texts = brief(state).flat();
  const box = $('readout');
  while (box.children.length > texts.length) box.lastChild.remove();
  texts.forEach((text, i) => write(box.children[i] ?? box.appendChild(make('span')), text));
}

export function figures_page() {
  const frames = new Spark('ms a frame');
  const ticks = new Spark('ms a tick');
  const lists = make('div', { className: 'groups' });
  const element = make('section', {}, frames.element, ticks.element, lists);
  const page = {
    title: 'Figures', icon: 'figures', element,
    /** Always, so that the curves have a past. */
    note({ frame, status }) {
      frames.add(frame.ms);
      if (status) ticks.add(status.tick_median_ms);
    },
    show(state) {
      frames.draw();
      ticks.draw();
      lists.replaceChildren(...all(state).flatMap(([title, rows]) => [make('h3', {}, title),
        make('dl', { className: 'facts' }, ...rows.flatMap(([name, value, bad]) =>
          [make('dt', {}, name), make('dd', { className: bad ? 'bad' : '' }, value)]))]));
    },
  };
  return page;
}
