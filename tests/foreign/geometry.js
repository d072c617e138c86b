// Whether known ground is complete, and where its surface is. A brick that is missing where the surface passes shows as
// two voxels side by side whose codes are farther apart than a voxel: distances change by one voxel in one step.
import { keyOf } from './world.js';

const CODES_PER_VOXEL = 127 / 3;
const STEP_MAX = Math.ceil(CODES_PER_VOXEL) + 1; // two roundings
const AXES = [64, 8, 1]; // step of the index along x, y, z

/** The pairs of voxels on both sides of the face between a brick and its neighbour along an axis. */
function* facePairs(axis) {
  const [u, v] = AXES.filter((_, other) => other !== axis);
  for (let i = 0; i < 8; i++) for (let j = 0; j < 8; j++) yield [7 * AXES[axis] + i * u + j * v, i * u + j * v];
}
const PAIRS = [0, 1, 2].map((axis) => [...facePairs(axis)]);

const neighbour = (coord, axis) => coord.map((number, other) => number + (other === axis ? 1 : 0));

/** Throws where ground lacks a brick. Returns how many faces between bricks were compared. */
export function checkComplete(world) {
  let faces = 0;
  for (const [key, codes] of world.ground) {
    const coord = key.split(',').map(Number);
    for (const axis of [0, 1, 2]) {
      const other = world.ground.get(keyOf(neighbour(coord, axis)));
      if (!other) continue;
      faces++;
      for (const [here, there] of PAIRS[axis])
        if (Math.abs(codes[here] - other[there]) > STEP_MAX)
          throw new Error(`ground leaps from ${codes[here]} to ${other[there]} between ${key} and its neighbour`);
    }
  }
  return faces;
}

/** Bricks of ground with a surface whose first voxels lie within the radius of the middle (metres). */
export function surfaceBricks(world, middle, radius, voxelSize) {
  const bricks = [...world.ground.keys()].map((key) => key.split(',').map(Number));
  const isNear = (brick) => Math.hypot(...brick.map((number, axis) => 8 * number * voxelSize - middle[axis])) <= radius;
  return bricks.filter((brick) => isNear(brick) && surfaceIn(world, brick, voxelSize));
}

/** A place (metres) where rock of the brick, as it is now, lies under air; null where there is none. */
export function surfaceIn(world, brick, voxelSize) {
  const codes = world.codes(brick);
  const i = codes.findIndex((code, at) => code < 0 && (at >> 3) % 8 < 7 && codes[at + 8] >= 0);
  if (i < 0) return null;
  return [i >> 6, (i >> 3) & 7, i & 7].map((number, axis) => (8 * brick[axis] + number) * voxelSize);
}

/** Coordinates of the chunks within the radius of the middle (metres), nearest first. */
export function chunksAround(middle, radius, voxelSize) {
  const side = 32 * voxelSize;
  const reach = Math.ceil(radius / side);
  const home = middle.map((number) => Math.floor(number / side));
  const found = [];
  for (let x = -reach; x <= reach; x++)
    for (let y = -reach; y <= reach; y++)
      for (let z = -reach; z <= reach; z++) {
        const chunk = [home[0] + x, home[1] + y, home[2] + z];
        const nearest = middle.map((number, axis) => Math.min(Math.max(number, chunk[axis] * side), (chunk[axis] + 1) * side));
        const distance = Math.hypot(...nearest.map((number, axis) => number - middle[axis]));
        if (distance <= radius) found.push({ chunk, distance });
      }
  return found.sort((a, b) => a.distance - b.distance).map(({ chunk }) => chunk);
}
