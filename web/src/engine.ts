// Makes the workers that hold the module for JavaScript. The first one unpacks and compiles it; later ones are given it compiled.

import type { FromWorker, ToWorker } from './worker_transport';

export class Engine {
  /** Settles when the module is compiled; fails where it cannot be. */
  readonly ready: Promise<void>;
  private module: WebAssembly.Module | null = null;
  private first: Worker | null;

  /** `packed`: the module as the page holds it (web/make_app.mjs); `size`: its bytes. */
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

  /** A worker for one take, with the module in it or on its way. Messages to it wait for the module. */
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
