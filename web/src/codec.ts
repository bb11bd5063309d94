// Unpacks the data written by src/report/page/codec.cpp.

import { Slices } from './slices';

/** Returns the packed bytes of an element of the page and empties the element. */
export function packedBytesOf(holder: HTMLElement): Uint8Array {
  const text = atob(holder.textContent ?? '');
  holder.textContent = '';
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  return packed;
}

/** The bytes of an element of the page; null if it does not exist. */
export async function bytesOf(name: string): Promise<Uint8Array | null> {
  const holder = document.getElementById(`data-${name}`);
  if (holder === null) return null;
  const deflated = packedBytesOf(holder);
  const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export async function jsonOf<T>(name: string, parts: Parts = bytesOf): Promise<T | null> {
  const bytes = await parts(name);
  return bytes === null ? null : (JSON.parse(new TextDecoder().decode(bytes)) as T);
}

/** Data of a page by name, from its elements or from an answer (served.ts). */
export type Parts = (name: string) => Promise<Uint8Array | null>;

/** Multiples of one channel's quantum, one number per frame. */
export interface Samples {
  before: Int32Array;
  after: Int32Array | null;
}

export function emptySamples(channels: number, frames: number, two: boolean): Samples[] {
  return Array.from({ length: channels }, () => ({
    before: new Int32Array(frames),
    after: two ? new Int32Array(frames) : null,
  }));
}

class Reader {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}

  byte(): number {
    return this.bytes[this.at++] ?? 0;
  }

  remainders(count: number): Int32Array {
    const result = new Int32Array(count);
    const bytes = this.bytes;
    for (let plane = 0; plane < 4; ++plane) {
      const shift = 8 * plane;
      const from = this.at + plane * count;
      for (let i = 0; i < count; ++i) result[i] |= bytes[from + i] << shift;
    }
    this.at += 4 * count;
    for (let i = 0; i < count; ++i) result[i] = (result[i] >>> 1) ^ -(result[i] & 1);
    return result;
  }
}

function lineBetween(from: number, to: number, part: number, stride: number): number {
  return (from + Math.floor(((to - from) * part) / stride)) | 0;
}

function fillBetween(samples: Int32Array, stride: number): void {
  for (let f = 0; f < samples.length; ++f) {
    const part = f % stride;
    if (part === 0) continue;
    const left = f - part;
    const right = left + stride;
    samples[f] = right < samples.length ? lineBetween(samples[left], samples[right], part, stride) : samples[left];
  }
}

function readFirst(reader: Reader, samples: Int32Array, stride: number): void {
  const prediction = reader.byte();
  const remainders = reader.remainders(Math.ceil(samples.length / stride));
  let last = 0;
  let beforeLast = 0;
  remainders.forEach((remainder, i) => {
    const predicted = prediction === 0 ? 0 : prediction === 1 ? last : 2 * last - beforeLast;
    const sample = (remainder + predicted) | 0;
    beforeLast = i === 0 ? sample : last;
    last = sample;
    samples[i * stride] = sample;
  });
  if (stride > 1) fillBetween(samples, stride);
}

function readSecond(reader: Reader, samples: Int32Array, stride: number): void {
  const prediction = reader.byte();
  const remainders = reader.remainders(samples.length - Math.ceil(samples.length / stride));
  let next = 0;
  for (let f = 0; f < samples.length; ++f) {
    // These samples already hold the straight line between the frames of the first part.
    if (f % stride !== 0) samples[f] = (remainders[next++] + (prediction === 0 ? 0 : samples[f])) | 0;
  }
}

type Read = (reader: Reader, samples: Int32Array, stride: number) => void;

async function readPart(bytes: Uint8Array, all: Samples[], stride: number, read: Read): Promise<void> {
  const reader = new Reader(bytes);
  const slices = new Slices();
  for (const channel of all) {
    await slices.rest();
    if (channel.before.length === 0) continue;
    if (channel.after === null) {
      read(reader, channel.before, stride);
      continue;
    }
    const [first, other] = reader.byte() === 1 ? [channel.before, channel.after] : [channel.after, channel.before];
    // The second take is stored as a difference, so its prediction is a difference too.
    for (let f = 0; f < other.length; ++f) other[f] = (other[f] - first[f]) | 0;
    read(reader, first, stride);
    read(reader, other, stride);
    for (let f = 0; f < other.length; ++f) other[f] = (other[f] + first[f]) | 0;
  }
}

export function readFirstPart(bytes: Uint8Array, all: Samples[], stride: number): Promise<void> {
  return readPart(bytes, all, stride, readFirst);
}
export function readSecondPart(bytes: Uint8Array, all: Samples[], stride: number): Promise<void> {
  return readPart(bytes, all, stride, readSecond);
}
