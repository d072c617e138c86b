// Numbers as people read them.

export function bytes(count) {
  if (count < 1000) return `${Math.round(count)} B`;
  const units = ['kB', 'MB', 'GB', 'TB'];
  let value = count / 1000, unit = 0;
  while (value >= 999.5 && unit < units.length - 1) { value /= 1000; ++unit; }
  return `${value.toFixed(value < 10 ? 1 : 0)} ${units[unit]}`;
}

export const whole = (count) => Math.round(count).toLocaleString('en').replaceAll(',', '\u00a0');

export const ms = (value) => `${value.toFixed(value < 10 ? 2 : value < 100 ? 1 : 0)} ms`;

export const metres = (value) => `${value.toFixed(value < 10 ? 1 : 0)} m`;

/** "1:02", "1:02:03": of a tick. */
export function time(tick, rate_hz) {
  const seconds = Math.floor(Math.max(tick, 0) / rate_hz);
  const two = (number) => String(number).padStart(2, '0');
  const minutes = Math.floor(seconds / 60);
  return minutes < 60 ? `${minutes}:${two(seconds % 60)}`
    : `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${two(seconds % 60)}`;
}

export function span(seconds) {
  if (seconds < 60) return `${Math.floor(seconds)} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min`;
  if (seconds < 86400) return `${Math.floor(seconds / 3600)} h ${Math.floor(seconds / 60) % 60} min`;
  return `${Math.floor(seconds / 86400)} d ${Math.floor(seconds / 3600) % 24} h`;
}
