// Answers the requests of the page by the module for JavaScript, in a worker of the same page: nothing is sent anywhere.

import type { Session } from './served';
import type { ViewTransport } from './view_transport';

export interface NamedBytes {
  name: string;
  bytes: Uint8Array;
}

/** What the page tells the worker: first the module and the files, then requests. */
export type ToWorker = { module: WebAssembly.Module; files: NamedBytes[]; take: string } | { id: number; action: string; body: string };
/** What the worker tells the page. `files`: those that a request to save has written. */
export type FromWorker = { session: Session } | { problem: string } | { stage: string; done: number } | { id: number; status: number; body: string; files: NamedBytes[] };

const stopped = JSON.stringify({ error: 'stopped' });

export class WorkerTransport implements ViewTransport {
  private worker: Worker | null = null;
  private readonly waiting = new Map<number, { long: boolean; answer: (reply: Response) => void }>();
  private opened: { done: (session: Session) => void; fail: (error: Error) => void } | null = null;
  private told = { stage: '', done: 0 };
  private next = 0;

  /** `start` makes a worker; `files` hold the take and what it needs; `save` gets each file that was written. */
  constructor(private readonly start: () => Worker, private readonly module: WebAssembly.Module, private readonly take: string,
    private readonly files: NamedBytes[], private readonly save: (file: NamedBytes) => void) {}

  /** Reads the take. */
  open(): Promise<Session> {
    return new Promise((done, fail) => {
      this.opened = { done, fail: (error) => { this.leave(); fail(error); } };
      this.begin();
    });
  }

  ask(action: string, asked: object = {}): Promise<Response> {
    if (action === 'progress') return Promise.resolve(new Response(JSON.stringify(this.told)));
    const long = action === 'run' || action === 'curves';
    // A worker cannot be told anything while it works: a run that another replaces ends with its worker.
    if (action === 'run' && [...this.waiting.values()].some((request) => request.long)) this.stop();
    const id = ++this.next;
    return new Promise((answer) => {
      this.waiting.set(id, { long, answer });
      this.post({ id, action, body: JSON.stringify(asked) });
    });
  }

  stop(): void {
    if (this.waiting.size === 0) return;
    this.worker?.terminate();
    this.refuseAll(409, stopped);
    this.begin();
  }

  leave(): void {
    this.worker?.terminate();
    this.worker = null;
    this.refuseAll(409, stopped);
  }

  placeOf(): string { return 'In the folder in which the browser saves downloads.'; }
  inWords(error: unknown): string { return error instanceof Error ? error.message : String(error); }

  private begin(): void {
    this.told = { stage: '', done: 0 };
    this.worker = this.start();
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.hear(data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.fail(event.message || 'the worker has ended');
    };
    this.post({ module: this.module, files: this.files, take: this.take });
  }

  private post(told: ToWorker): void { this.worker?.postMessage(told); }

  private hear(told: FromWorker): void {
    if ('session' in told) this.opened?.done(told.session);
    else if ('problem' in told) this.fail(told.problem);
    else if ('stage' in told) this.told = told;
    else {
      for (const file of told.files) this.keep(file);
      this.told = { stage: '', done: 0 };
      this.waiting.get(told.id)?.answer(new Response(told.body, { status: told.status }));
      this.waiting.delete(told.id);
    }
  }

  /** The page downloads it; side files are there for later workers as well. */
  private keep(file: NamedBytes): void {
    if (/\.(contacts|plan\.csv|gaps\.csv)$/.test(file.name)) {
      const before = this.files.findIndex(({ name }) => name === file.name);
      this.files.splice(before < 0 ? this.files.length : before, before < 0 ? 0 : 1, file);
    }
    this.save(file);
  }

  private fail(words: string): void {
    this.opened?.fail(new Error(words));
    this.worker?.terminate();
    this.refuseAll(500, JSON.stringify({ error: words }));
    if (this.worker !== null) this.begin();
  }

  private refuseAll(status: number, body: string): void {
    const requests = [...this.waiting.values()];
    this.waiting.clear();
    for (const { answer } of requests) answer(new Response(body, { status }));
  }
}
