// A replay's events on its bar: columns and ticks as places, without elements. `marks` as of scree_marks().

/** Parts of the bar from `first` to `last`, 0 to 1. */
export function part_of(tick, { first, last }) {
  return Math.min(Math.max((tick - first) / Math.max(last - first, 1), 0), 1);
}

export function tick_at(part, { first, last }) {
  return first + Math.min(Math.max(part, 0), 1) * Math.max(last - first, 1);
}

/** From where to where a column goes, as parts of the bar. */
export function span_of(column, marks, playback) {
  const begin = marks.first + column * marks.ticks_per_column;
  return [part_of(begin, playback), part_of(begin + marks.ticks_per_column, playback)];
}

/** The kinds that there are, in order of the first mark of each, with the most in a column. */
export function rows_of(marks) {
  const most = new Map();
  for (const { kind, count } of marks.marks) most.set(kind, Math.max(most.get(kind) ?? 0, count));
  return most;
}

/** "3 carve, 1 fall": of the columns that come within `near` (a part of the bar) of a place. */
export function events_near(part, near, marks, playback) {
  const counts = new Map();
  for (const { kind, column, count } of marks.marks) {
    const [left, right] = span_of(column, marks, playback);
    if (left <= part + near && right >= part - near) counts.set(kind, (counts.get(kind) ?? 0) + count);
  }
  return [...counts].map(([kind, count]) => `${count} ${kind}`).join(', ');
}
