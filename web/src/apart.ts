// Computes the distance between two bodies at which they never overlap.

import type { Take } from './take';

/** Number of frames to check, evenly over the take. Chosen by hand. */
const mostLookedAt = 1000;
/** Number of stray points: points farther from the middle than all others by a body height may overlap. */
const mostStrays = 2;
/** Gap between the two bodies, as a share of their height. */
const space = 0.15;

/** The middle of the body in a pose: the root joint, or the mean of the markers; null if nothing is visible. */
export function middleOf(take: Take, pose: ArrayLike<number>): [number, number, number] | null {
  if (take.isJoints) return take.told > 0 ? [pose[0], pose[1], pose[2]] : null;
  const sum: [number, number, number] = [0, 0, 0];
  let seen = 0;
  for (let p = 0; p < take.points; ++p) {
    if (!take.isShown(p) || Number.isNaN(pose[3 * p])) continue;
    for (let a = 0; a < 3; ++a) sum[a] += pose[3 * p + a];
    ++seen;
  }
  return seen > 0 ? [sum[0] / seen, sum[1] / seen, sum[2] / seen] : null;
}

/** The largest distance of the points of these poses from a middle, without strays. */
function reach(take: Take, poses: Float32Array[], [x, y, z]: [number, number, number]): number {
  const ways: number[] = [];
  for (const pose of poses) {
    for (let p = 0; p < take.points; ++p) {
      if (take.isShown(p) && !Number.isNaN(pose[3 * p])) ways.push(Math.hypot(pose[3 * p] - x, pose[3 * p + 1] - y, pose[3 * p + 2] - z));
    }
  }
  ways.sort((a, b) => a - b);
  const { height } = take.data.stage;
  for (let strays = 1; strays <= Math.min(mostStrays, ways.length - 1); ++strays) {
    const last = ways.length - 1 - strays;
    if (ways[last + 1] - ways[last] > height) return ways[last];
  }
  return ways[ways.length - 1] ?? 0;
}

/** The distance at which a plane between the two bodies, in any orientation, touches neither in any frame. */
export function distanceApart(take: Take): number {
  const poses = take.takes.map(() => new Float32Array(3 * take.points));
  const every = Math.max(1, Math.ceil(take.told / mostLookedAt));
  let farthest = 0;
  for (let f = 0; f < take.told; f += every) {
    take.takes.forEach((which, i) => take.pose(f, which, poses[i]));
    const middle = middleOf(take, poses[poses.length - 1]);
    if (middle !== null) farthest = Math.max(farthest, reach(take, poses, middle));
  }
  return 2 * farthest + space * take.data.stage.height;
}
