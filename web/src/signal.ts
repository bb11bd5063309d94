// Speed, acceleration and spectrum of sampled tracks.

type Values = (number | null)[];

/** Path length from each frame to the next times the rate; null if a sample is missing. */
function lengths(vectors: (number[] | null)[], rate: number): Values {
  return vectors.map((v) => (v === null ? null : Math.hypot(...v) * rate));
}

function steps(axes: Values[]): (number[] | null)[] {
  const frames = axes[0]?.length ?? 0;
  return Array.from({ length: Math.max(0, frames - 1) }, (_, f) => {
    const vector: number[] = [];
    for (const axis of axes) {
      const from = axis[f];
      const to = axis[f + 1];
      if (from === null || to === null) return null;
      vector.push(to - from);
    }
    return vector;
  });
}

/** Speed along a path, units per second. One value per frame; the last is repeated. */
export function speedOf(axes: Values[], rate: number): Values {
  return sameLength(lengths(steps(axes), rate), axes[0]?.length ?? 0);
}
/** Acceleration, units per second squared. */
export function accelerationOf(axes: Values[], rate: number): Values {
  return accelerationOfSteps(steps(axes), rate, axes[0]?.length ?? 0);
}
/** The same for rotations, from rotation vectors between frames. */
export function turningSpeed(turns: (number[] | null)[], rate: number, frames: number): Values {
  return sameLength(lengths(turns, rate), frames);
}
export function accelerationOfSteps(all: (number[] | null)[], rate: number, frames: number): Values {
  const changes = all.slice(1).map((step, i) => {
    const last = all[i];
    return step === null || last === null ? null : step.map((value, a) => value - last[a]);
  });
  return sameLength([null, ...lengths(changes, rate * rate)], frames);
}
function sameLength(values: Values, frames: number): Values {
  const result = values.slice(0, frames);
  while (result.length < frames) result.push(result.length > 1 ? result[result.length - 1] : null);
  return result;
}

/** Fourier transform in place; the length is a power of two. */
function transform(re: Float64Array, im: Float64Array): void {
  const n = re.length;
  for (let i = 1, j = 0; i < n; ++i) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      [re[i], re[j]] = [re[j], re[i]];
      [im[i], im[j]] = [im[j], im[i]];
    }
  }
  for (let size = 2; size <= n; size *= 2) {
    const turn = (-2 * Math.PI) / size;
    for (let start = 0; start < n; start += size) {
      for (let k = 0; k < size / 2; ++k) {
        const cosine = Math.cos(turn * k);
        const sine = Math.sin(turn * k);
        const a = start + k;
        const b = a + size / 2;
        const x = re[b] * cosine - im[b] * sine;
        const y = re[b] * sine + im[b] * cosine;
        re[b] = re[a] - x;
        im[b] = im[a] - y;
        re[a] += x;
        im[a] += y;
      }
    }
  }
}

export interface Spectrum {
  hertz: number[];
  density: number[];
}

/** Power density of all axes together by Welch's method (Hann windows of up to `longest` samples that
 * overlap by half, each without its mean), units squared per hertz. Windows with gaps are left out. */
export function spectrumOf(axes: Values[], rate: number, longest = 1024): Spectrum {
  const frames = axes[0]?.length ?? 0;
  let size = 8;
  while (size * 2 <= Math.min(longest, frames)) size *= 2;
  const density = new Float64Array(size / 2 + 1);
  const window = Float64Array.from({ length: size }, (_, i) => 0.5 - 0.5 * Math.cos((2 * Math.PI * i) / size));
  const power = window.reduce((sum, w) => sum + w * w, 0);
  let windows = 0;
  for (const axis of axes) {
    for (let start = 0; start + size <= frames; start += size / 2) {
      const part = axis.slice(start, start + size);
      if (part.some((value) => value === null)) continue;
      const mean = (part as number[]).reduce((sum, value) => sum + value, 0) / size;
      const re = Float64Array.from(part as number[], (value, i) => (value - mean) * window[i]);
      const im = new Float64Array(size);
      transform(re, im);
      for (let k = 0; k < density.length; ++k) {
        const sides = k === 0 || k === size / 2 ? 1 : 2;
        density[k] += (sides * (re[k] ** 2 + im[k] ** 2)) / (rate * power);
      }
      ++windows;
    }
  }
  const segments = windows / Math.max(1, axes.length);
  const used = windows > 0 ? density.length - 1 : 0;
  return {
    hertz: Array.from({ length: used }, (_, k) => ((k + 1) * rate) / size),
    density: Array.from({ length: used }, (_, k) => density[k + 1] / segments),
  };
}
