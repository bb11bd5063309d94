// Long work of the page in slices: between two of them the browser draws and listens.

/** Half of a frame at 60 Hz. */
const sliceMs = 8;

const { port1, port2 } = new MessageChannel();
const waiting: (() => void)[] = [];
port1.onmessage = () => waiting.shift()?.();

/** Until the browser has done what waits. A page in the background is not slowed down, as it is by timers. */
export function pause(): Promise<void> {
  return new Promise((done) => {
    waiting.push(done);
    port2.postMessage(null);
  });
}

export class Slices {
  private end = performance.now() + sliceMs;

  /** To be awaited between parts of the work; returns at once while the slice lasts. */
  async rest(): Promise<void> {
    if (performance.now() < this.end) return;
    await pause();
    this.end = performance.now() + sliceMs;
  }
}
