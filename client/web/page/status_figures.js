// What the status page says of /status.json (docs/browser.md), as texts and parts. Without elements.
import { bytes, ms, span, whole } from './words.js';

/** The large figures, each with a curve: name, value, what it is beside, the curve's number (`by_change`: how it grows), and whether it is bad. */
export function heads({ now, report, tick_rate_hz }) {
  const tick_ms = 1000 / tick_rate_hz;
  return [
    { name: 'Tick, median', value: ms(now.tick_median_ms), beside: `worst ${ms(now.tick_worst_ms)}`, curve: now.tick_median_ms,
      bad: now.tick_median_ms > tick_ms },
    { name: 'Late ticks', value: whole(report.late_ticks ?? 0), beside: `of ${whole(report.ticks)}`, curve: report.late_ticks ?? 0, by_change: true, bad: false },
    { name: 'Pieces', value: whole(now.pieces), beside: `${whole(report.pieces_made)} made, ${whole(report.pieces_merged)} merged`, curve: now.pieces, bad: false },
    { name: 'Sessions', value: whole(now.clients), beside: `${whole(report.sessions.joined)} joined`, curve: now.clients, bad: false },
    { name: 'Memory', value: `${whole(report.resident_mb)} MB`, beside: 'of the process', curve: report.resident_mb, bad: false },
    { name: 'Ledger error', value: whole(report.ledger.error), beside: 'units', curve: report.ledger.error, bad: report.ledger.error !== 0 },
  ];
}

/** Bars against the tick's length, or the largest: name, part 0 to 1, text; and the worst where there is one. */
export function stage_bars({ now, report, tick_rate_hz }) {
  const tick_ms = 1000 / tick_rate_hz;
  const mean = Object.values(now.stages_ms);
  const scale = Math.max(Math.min(tick_ms, 4 * Math.max(...mean, 0.05)), ...mean);
  return Object.entries(now.stages_ms).map(([name, value]) => {
    const worst = report.stages_ms?.[name]?.worst;
    return { name, part: value / scale, text: ms(value), worst: worst === undefined ? undefined : Math.min(worst / scale, 1) };
  });
}

export function latency_bars({ now }) {
  const rows = Object.entries(now.latency_ms ?? {});
  const scale = Math.max(...rows.map(([, row]) => row.worst), 1);
  return rows.map(([name, { median, worst }]) => ({ name, part: median / scale, worst: Math.min(worst / scale, 1), text: `${ms(median)}, worst ${ms(worst)}` }));
}

const readable = (name) => name.replaceAll('_', ' ');
const counts = (object) => Object.entries(object ?? {}).filter(([, value]) => typeof value === 'number').map(([name, value]) => [readable(name), whole(value)]);

/** The lists: by the id of their section, rows of name, value and whether that is bad. */
export function lists({ now, report }) {
  const { ledger, chunks, refusals } = report;
  const { budget_us, worst_us, ...put_off } = now.work ?? {};
  const by_reason = Object.entries(refusals?.by_reason ?? {}).sort((a, b) => b[1] - a[1]);
  return {
    ledger: [...['terrain', 'pieces', 'dust', 'poured', 'moved'].map((name) => [name, whole(ledger[name])]), ['error', whole(ledger.error), ledger.error !== 0]],
    work: counts(put_off),
    refusals: by_reason.length ? by_reason.map(([name, count]) => [name, whole(count)]) : [['none', '0']],
    memory: [['memory of the process', `${whole(report.resident_mb)} MB`], ...counts(chunks).map(([name, value]) => [`chunks: ${name}`, value]),
      ['saving', now.saving || 'the world ends with the server', now.saving === 'failed'], ['saved up to tick', now.saving ? whole(now.saved_tick) : '–']],
    wire: Object.entries(report).filter(([name, value]) => /bytes/.test(name) && typeof value === 'number').map(([name, value]) => [readable(name), bytes(value)])
      .concat(counts(report.web).map(([name, value]) => [`web: ${name}`, value])),
  };
}

export function budget_text({ now, tick_rate_hz }) {
  const length = `A tick has ${ms(1000 / tick_rate_hz)}.`;
  if (!now.work?.budget_us) return length;
  return `${length} Work in the last second: ${ms(now.work.worst_us / 1000)} of ${ms(now.work.budget_us / 1000)} by the server’s model. Bars: means of the last second; white: the worst since the start.`;
}

export function server_text({ version, report, replay, now }) {
  return `${version ?? ''} · ${replay ? 'replay, ' : ''}up ${span(report.seconds)} · tick ${whole(now.tick)}`;
}

export function session_row({ session, name, role, address, program, seconds, sent_bytes }) {
  return [name || `#${session}`, role, address, program, span(seconds), bytes(sent_bytes)];
}
