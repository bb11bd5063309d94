// Makes the workers that hold the JavaScript module. The first one unpacks and compiles it; later ones get it compiled.

import type { FromWorker, ToWorker } from './worker_transport';

export class Engine {
  /** Resolves when the module is compiled; rejects if it cannot be. */
  readonly ready: Promise<void>;
  private module: WebAssembly.Module | null = null;
  private first: Worker | null;

  /** `packed` is the module as stored in the page (web/make_app.mjs); `size` is its unpacked size in bytes. */
  constructor(private readonly make: () => Worker, private packed: string, private readonly size: number) {
    const worker = this.begun();
    this.first = worker;
    this.ready = new Promise((done, fail) => {
      worker.addEventListener('message', ({ data }: MessageEvent<FromWorker>) => {
        if ('module' in data) done();
        else if ('broken' in data) fail(new Error(data.broken));
      });
      worker.addEventListener('error', (event) => fail(new Error(event.message || 'the worker has ended')));
    });
    this.ready.catch(() => undefined);
  }

  /** A worker for one take; the module may still be loading, and messages wait for it. */
  worker(): Worker {
    const made = this.first ?? this.begun();
    this.first = null;
    return made;
  }

  private begun(): Worker {
    const worker = this.make();
    const told: ToWorker = this.module !== null ? { module: this.module } : { packed: this.packed, size: this.size };
    worker.addEventListener('message', ({ data }: MessageEvent<FromWorker>) => {
      if (!('module' in data)) return;
      this.module = data.module;
      this.packed = '';
    });
    worker.postMessage(told);
    return worker;
  }
}
