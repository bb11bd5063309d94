// A small take that the module cleans in advance, so that the browser compiles the code and runs it faster later.

import type { Kinemend } from 'kinemend';

const joints = 24;
const frames = 360;
const name = 'warm_up.bvh';

function take(): Uint8Array {
  const lines = ['HIERARCHY', 'ROOT J0', '{', 'OFFSET 0 90 0', 'CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation'];
  for (let j = 1; j < joints; ++j) lines.push(`JOINT J${j}`, '{', 'OFFSET 0 8 1', 'CHANNELS 3 Zrotation Xrotation Yrotation');
  lines.push('End Site', '{', 'OFFSET 0 5 0', '}', ...Array<string>(joints).fill('}'), 'MOTION', `Frames: ${frames}`, 'Frame Time: 0.0083333');
  // A slow swing with a degree of jitter that never repeats.
  const value = (f: number, c: number): string => (20 * Math.sin(f / 40 + c) + Math.sin(f * (f + 7 * c))).toFixed(4);
  for (let f = 0; f < frames; ++f) lines.push(Array.from({ length: 3 + 3 * joints }, (_, c) => value(f, c)).join(' '));
  return new TextEncoder().encode(`${lines.join('\n')}\n`);
}

/** Reads and cleans the take as the page does. */
export function exercise(kinemend: Kinemend): void {
  kinemend.putFile(name, take());
  kinemend.view.open(name);
  kinemend.view.ask('run', JSON.stringify({ command: 'clean', flags: {} }));
  kinemend.removeFile(name);
}
