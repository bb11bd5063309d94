// The motion: angles and positions of tracks at any frame, and poses by forward kinematics.

import { bytesOf, emptySamples, readFirstPart, readSecondPart, type Parts, type Samples } from './codec';
import { shortNames } from './names';
import type { Gaps, TakeData } from './report';

export type Which = 'before' | 'after';
type Quat = [number, number, number, number];

const axisOf: Record<string, number> = { X: 0, Y: 1, Z: 2, x: 0, y: 1, z: 2 };
const halfDegree = Math.PI / 360;

function multiply(a: Quat, b: Quat): Quat {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

/** The vector of the rotation that leads from `a` to `b`, degrees. */
export function turnBetween(a: Quat, b: Quat): [number, number, number] {
  const [w, x, y, z] = multiply([a[0], -a[1], -a[2], -a[3]], b);
  const sine = Math.hypot(x, y, z);
  if (sine < 1e-12) return [0, 0, 0];
  const scale = (2 * Math.atan2(sine, Math.abs(w)) * (w < 0 ? -1 : 1) * 180) / Math.PI / sine;
  return [x * scale, y * scale, z * scale];
}

/** Writes `p`, rotated by `q` and added to the point at `from`, to `to`. */
function addTurned(q: Quat, p: ArrayLike<number>, result: Float32Array, from: number, to: number): void {
  const [w, x, y, z] = q;
  const tx = 2 * (y * p[2] - z * p[1]);
  const ty = 2 * (z * p[0] - x * p[2]);
  const tz = 2 * (x * p[1] - y * p[0]);
  result[to] = result[from] + p[0] + w * tx + y * tz - z * ty;
  result[to + 1] = result[from + 1] + p[1] + w * ty + z * tx - x * tz;
  result[to + 2] = result[from + 2] + p[2] + w * tz + x * ty - y * tx;
}

/** Whether each track has a sample, by frame; null: all have. */
function masks(gaps: Gap3[], frames: number, step: number): Map<number, Uint8Array> {
  const result = new Map<number, Uint8Array>();
  for (const [track, first, last] of gaps) {
    const mask = result.get(track) ?? new Uint8Array(frames);
    mask.fill(1, Math.ceil(first / step), Math.floor(last / step) + 1);
    result.set(track, mask);
  }
  return result;
}
type Gap3 = Gaps['own'][number];

export class Take {
  /** Number of frames stored in the page; stored frame i is frame i * step of the take. */
  readonly told: number;
  readonly points: number;
  whole: boolean;
  private readonly samples: Samples[];
  private readonly rotationChannels: number[] = [];
  private readonly translatedChannels = new Map<number, number>();
  private readonly missing = new Map<string, Map<number, Uint8Array>>();
  private readonly short: string[];

  private constructor(readonly data: TakeData, private readonly parts: Parts) {
    this.told = data.told;
    this.samples = emptySamples(data.quanta.length, data.told, data.two);
    this.points = data.names.length + (data.skeleton?.ends.length ?? 0);
    this.whole = data.stride === 1;
    this.short = shortNames(data.names);
    const skeleton = data.skeleton;
    if (skeleton) {
      let next = 3;
      for (const joint of skeleton.translated) {
        this.translatedChannels.set(joint, next);
        next += 3;
      }
      for (const order of skeleton.orders) {
        this.rotationChannels.push(next);
        next += order.length;
      }
    }
    for (const which of ['before', 'after'] as const) {
      const gaps = data.gaps[which];
      if (gaps === null) continue;
      this.missing.set(`${which} own`, masks(gaps.own, data.told, data.step));
      this.missing.set(`${which} positions`, masks(gaps.positions, data.told, data.step));
    }
  }

  static async load(data: TakeData, parts: Parts = bytesOf): Promise<Take> {
    const take = new Take(data, parts);
    const bytes = await parts('first');
    if (bytes !== null) await readFirstPart(bytes, take.samples, data.stride);
    return take;
  }

  /** Loads the stored frames between those of the first part; only long takes have them. */
  async loadRest(): Promise<void> {
    const bytes = this.whole ? null : await this.parts('second');
    if (bytes !== null) await readSecondPart(bytes, this.samples, this.data.stride);
    this.whole = true;
  }

  get isJoints(): boolean {
    return this.data.skeleton !== undefined;
  }
  get takes(): Which[] {
    return this.data.two ? ['before', 'after'] : ['before'];
  }
  /** The cleaned take, or the only one. */
  get last(): Which {
    return this.data.two ? 'after' : 'before';
  }
  get rate(): number {
    return this.data.rate / this.data.step;
  }
  /** The name of a track, as spelled in the file. */
  nameOf(track: number): string { return this.data.names[track] || `(no name, ${track + 1})`; }
  /** A short name for places with little space; different names stay different. */
  shortName(track: number): string { return this.short[track] || this.nameOf(track); }
  /** The tracks that a finding names: one, or several with commas between them. */
  tracksOf(name: string | null): number[] {
    const whole = this.data.names.indexOf(name ?? '');
    return whole >= 0 ? [whole] : (name ?? '').split(', ').map((one) => this.data.names.indexOf(one)).filter((track) => track >= 0);
  }

  /** Mean distance of the two takes in a frame, over all points that both have. */
  distance(frame: number): number {
    if (!this.data.two) return 0;
    const before = this.pose(frame, 'before'), after = this.pose(frame, 'after');
    let sum = 0, count = 0;
    for (let p = 0; p < this.points; ++p) {
      const way = Math.hypot(after[3 * p] - before[3 * p], after[3 * p + 1] - before[3 * p + 1], after[3 * p + 2] - before[3 * p + 2]);
      if (!this.isShown(p) || Number.isNaN(way)) continue;
      sum += way;
      ++count;
    }
    return count > 0 ? sum / count : 0;
  }

  /** The file's number of a stored frame. */
  number(frame: number): number {
    return frame * this.data.step + this.data.first_frame;
  }
  /** The stored frame nearest to a frame number of the file. */
  frameOf(number: number): number {
    const frame = Math.round((number - this.data.first_frame) / this.data.step);
    return Math.max(0, Math.min(this.told - 1, frame));
  }

  private value(channel: number, frame: number, which: Which): number {
    const samples = this.samples[channel];
    const source = which === 'after' && samples.after !== null ? samples.after : samples.before;
    return source[frame] * this.data.quanta[channel];
  }

  isShown(point: number): boolean {
    return this.data.shown?.[point] ?? true;
  }
  isMissing(track: number, frame: number, which: Which): boolean {
    return this.missing.get(`${which} own`)?.get(track)?.[frame] === 1;
  }
  private isPositionMissing(track: number, frame: number, which: Which): boolean {
    return this.missing.get(`${which} positions`)?.get(track)?.[frame] === 1;
  }

  /** The first frame in which a point is observed; 0 if there is none. */
  firstSeen(): number { return Math.max(0, this.findSeen()); }
  /** Whether any point is observed in any frame. */
  get isEverSeen(): boolean { return this.findSeen() >= 0; }

  private findSeen(): number {
    if (this.told === 0 || this.points === 0) return -1;
    if (this.isJoints) return 0;
    for (let f = 0; f < this.told; ++f) {
      for (let m = 0; m < this.points; ++m) {
        if (this.isShown(m) && !this.isMissing(m, f, this.last)) return f;
      }
    }
    return -1;
  }

  /** The axes a joint rotates about; empty for one that never rotates. */
  order(joint: number): string {
    return this.data.skeleton?.orders[joint] ?? '';
  }
  angle(joint: number, axis: number, frame: number, which: Which): number | null {
    if (this.isMissing(joint, frame, which)) return null;
    return this.value(this.rotationChannels[joint] + axis, frame, which);
  }
  /** The samples of a channel and its quantum: for loops over all frames. */
  private channel(channel: number, which: Which): [Int32Array, number] {
    const { before, after } = this.samples[channel];
    return [which === 'after' && after !== null ? after : before, this.data.quanta[channel]];
  }
  /** Rotations of all frames: w, x, y, z of each. */
  rotations(joint: number, which: Which): Float64Array {
    const result = new Float64Array(4 * this.told);
    for (let f = 0; f < this.told; ++f) result[4 * f] = 1;
    [...this.order(joint)].forEach((axis, a) => {
      const [samples, quantum] = this.channel(this.rotationChannels[joint] + a, which);
      // A rotation about one axis mixes w with that axis, and the two others.
      const i = 1 + axisOf[axis], j = 1 + (i % 3), k = 1 + (j % 3);
      for (let f = 0, at = 0; f < this.told; ++f, at += 4) {
        const half = samples[f] * quantum * halfDegree;
        const c = Math.cos(half), s = Math.sin(half);
        const w = result[at], x = result[at + i], y = result[at + j], z = result[at + k];
        result[at] = w * c - x * s;
        result[at + i] = w * s + x * c;
        result[at + j] = y * c + z * s;
        result[at + k] = z * c - y * s;
      }
    });
    return result;
  }
  /** The angle between the two takes in each frame, degrees; null where either is missing. */
  turnsApart(joint: number): (number | null)[] {
    const before = this.rotations(joint, 'before'), after = this.rotations(joint, 'after');
    const noneBefore = this.missing.get('before own')?.get(joint), noneAfter = this.missing.get('after own')?.get(joint);
    const result = new Array<number | null>(this.told);
    for (let f = 0, at = 0; f < this.told; ++f, at += 4) {
      if (noneBefore?.[f] === 1 || noneAfter?.[f] === 1) {
        result[f] = null;
        continue;
      }
      const [w, x, y, z] = [before[at], before[at + 1], before[at + 2], before[at + 3]];
      const [W, X, Y, Z] = [after[at], after[at + 1], after[at + 2], after[at + 3]];
      const sine = Math.hypot(w * X - x * W - y * Z + z * Y, w * Y + x * Z - y * W - z * X, w * Z - x * Y + y * X - z * W);
      result[f] = (2 * Math.atan2(sine, Math.abs(w * W + x * X + y * Y + z * Z)) * 180) / Math.PI;
    }
    return result;
  }
  rotation(joint: number, frame: number, which: Which): Quat {
    let result: Quat = [1, 0, 0, 0];
    const order = this.order(joint);
    for (let a = 0; a < order.length; ++a) {
      const half = this.value(this.rotationChannels[joint] + a, frame, which) * halfDegree;
      const turn: Quat = [Math.cos(half), 0, 0, 0];
      turn[1 + axisOf[order[a]]] = Math.sin(half);
      result = multiply(result, turn);
    }
    return result;
  }

  private vector(channel: number, frame: number, which: Which): [number, number, number] {
    return [this.value(channel, frame, which), this.value(channel + 1, frame, which), this.value(channel + 2, frame, which)];
  }

  /** Positions of all joints and end sites, or of all markers; x of a missing one is NaN. */
  pose(frame: number, which: Which, result = new Float32Array(3 * this.points)): Float32Array {
    const skeleton = this.data.skeleton;
    if (this.told === 0) return result.fill(NaN);
    if (!skeleton) {
      for (let m = 0; m < this.points; ++m) {
        result.set(this.vector(3 * m, frame, which), 3 * m);
        if (this.isMissing(m, frame, which)) result[3 * m] = NaN;
      }
      return result;
    }
    const turns: Quat[] = [];
    skeleton.parents.forEach((parent, joint) => {
      const local = multiply(skeleton.rests[joint], this.rotation(joint, frame, which));
      const channel = joint === 0 ? 0 : this.translatedChannels.get(joint);
      const offset = channel === undefined ? skeleton.offsets[joint] : this.vector(channel, frame, which);
      if (parent < 0) {
        turns.push(local);
        result.set(offset, 3 * joint);
      } else {
        turns.push(multiply(turns[parent], local));
        addTurned(turns[parent], offset, result, 3 * parent, 3 * joint);
      }
    });
    skeleton.ends.forEach((end, i) => addTurned(turns[end.parent], end.offset, result, 3 * end.parent, 3 * (skeleton.parents.length + i)));
    return result;
  }

  /** Positions of a track by frame: x, y and z, null where missing. */
  path(track: number, which: Which): (number | null)[][] {
    const axes: (number | null)[][] = [[], [], []];
    const isRoot = this.isJoints && track === 0;
    const pose = new Float32Array(3 * this.points);
    for (let f = 0; f < this.told; ++f) {
      const own = !this.isJoints || isRoot;
      const at = own ? this.vector(3 * (isRoot ? 0 : track), f, which) : this.pose(f, which, pose).subarray(3 * track, 3 * track + 3);
      const gone = isRoot ? this.isPositionMissing(0, f, which) : this.isMissing(track, f, which);
      for (let a = 0; a < 3; ++a) axes[a].push(gone ? null : at[a]);
    }
    return axes;
  }
  angles(joint: number, which: Which): (number | null)[][] {
    const gone = this.missing.get(`${which} own`)?.get(joint);
    return [...this.order(joint)].map((_, a) => {
      const [samples, quantum] = this.channel(this.rotationChannels[joint] + a, which);
      const values = new Array<number | null>(this.told);
      for (let f = 0; f < this.told; ++f) values[f] = gone?.[f] === 1 ? null : samples[f] * quantum;
      return values;
    });
  }
}
