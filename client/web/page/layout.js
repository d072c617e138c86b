// How the panels lie, by the room that there is; style.css has a grid for each.

/** Pixels of CSS: beneath these, panels take turns. */
export const WIDE_LEAST = { width: 960, height: 480 };

/** 'wide', 'tall' (a phone upright, or a narrow window) or 'low' (a phone on its side). */
export function layout_of(width, height) {
  if (width >= WIDE_LEAST.width && height >= WIDE_LEAST.height) return 'wide';
  return width >= height && width >= 560 ? 'low' : 'tall';
}

/** Pixels of the device that are drawn: as many as the screen has, no more than `most` in all. */
export function buffer_size(width, height, ratio, most = 3840 * 2160) {
  const wanted = width * height * ratio * ratio;
  const used = wanted > most ? ratio * Math.sqrt(most / wanted) : ratio;
  return { width: Math.max(Math.round(width * used), 1), height: Math.max(Math.round(height * used), 1), ratio: used };
}
