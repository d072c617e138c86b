// Two thumbs on glass: the left half moves, the right half looks. Knows no elements: fingers come as numbers, places in
// pixels of CSS.

/** Of the stick: how far the thumb moves to full speed; beyond the second it runs. */
export const STICK = { full: 44, fast: 72, dead: 6 };
/** A finger that stayed so near and so short taps. */
export const TAP = { pixels: 10, ms: 260 };

/** Right and forward, −1 to 1, of a thumb that moved so far; and whether it runs. */
export function tilt(right, down) {
  const length = Math.hypot(right, down);
  if (length <= STICK.dead) return { right: 0, forward: 0, fast: false };
  const part = Math.min((length - STICK.dead) / (STICK.full - STICK.dead), 1) / length;
  return { right: right * part, forward: -down * part, fast: length >= STICK.fast };
}

export class Thumbs {
  #fingers = new Map();  // by pointer: its hand, where and when it began, and where it is
  #look = { right: 0, down: 0 };

  /** A finger came down; true: it is the stick's. */
  down(finger, x, y, width, now_ms) {
    const taken = [...this.#fingers.values()];
    const left = x < width / 2;
    const hand = left && !taken.some((one) => one.hand === 'move') ? 'move' : 'look';
    this.#fingers.set(finger, { hand, x0: x, y0: y, x, y, since_ms: now_ms, moved: false });
    return hand === 'move';
  }

  move(finger, x, y) {
    const one = this.#fingers.get(finger);
    if (!one) return;
    if (one.hand === 'look') {
      this.#look.right += x - one.x;
      this.#look.down += y - one.y;
    }
    one.x = x;
    one.y = y;
    one.moved ||= Math.hypot(x - one.x0, y - one.y0) > TAP.pixels;
  }

  /** It left; true: it tapped. */
  up(finger, now_ms) {
    const one = this.#fingers.get(finger);
    this.#fingers.delete(finger);
    return one !== undefined && !one.moved && now_ms - one.since_ms <= TAP.ms;
  }

  /** The stick: where it began, and how it is tilted; null: no thumb is on it. */
  stick() {
    for (const one of this.#fingers.values())
      if (one.hand === 'move')
        return { x: one.x0, y: one.y0, dx: one.x - one.x0, dy: one.y - one.y0, ...tilt(one.x - one.x0, one.y - one.y0) };
    return null;
  }

  /** How far to look since it was last asked. */
  take_look() {
    const look = this.#look;
    this.#look = { right: 0, down: 0 };
    return look;
  }
}
