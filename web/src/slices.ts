// Splits long work of the page into slices, between which the browser draws and handles events.

/** Half of a frame at 60 Hz. */
const sliceMs = 8;

const { port1, port2 } = new MessageChannel();
const waiting: (() => void)[] = [];
port1.onmessage = () => waiting.shift()?.();

/** Waits until the browser has handled pending work. Unlike with timers, a page in the background is not slowed down. */
export function pause(): Promise<void> {
  return new Promise((done) => {
    waiting.push(done);
    port2.postMessage(null);
  });
}

export class Slices {
  private end = performance.now() + sliceMs;

  /** Await it between parts of the work; it returns at once while the slice lasts. */
  async rest(): Promise<void> {
    if (performance.now() < this.end) return;
    await pause();
    this.end = performance.now() + sliceMs;
  }
}
