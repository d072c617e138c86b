// What two pictures have in common: where there is sky and where there is rock.
import { PNG } from 'pngjs';

/** Of each pixel, whether it is sky: bluer than it is red, as no rock, soil or grass is. */
export function silhouette(png) {
  const { width, height, data } = PNG.sync.read(png);
  const sky = new Uint8Array(width * height);
  for (let i = 0; i < sky.length; ++i) sky[i] = data[4 * i + 2] >= data[4 * i] ? 1 : 0;
  return { width, height, sky };
}

/** The part of the pixels that agree, 0 to 1; and the part that is sky in the first. */
export function agreement(one, other) {
  if (one.width !== other.width || one.height !== other.height) throw new Error('pictures of two sizes');
  let same = 0, sky = 0;
  one.sky.forEach((is, i) => {
    same += is === other.sky[i];
    sky += is;
  });
  return { same: same / one.sky.length, sky: sky / one.sky.length };
}
