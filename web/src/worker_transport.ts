// Answers the page's requests with the JavaScript module, in a worker of the same page: nothing is sent anywhere.

import type { Session } from './served';
import type { Engine } from './engine';
import type { Answer, ViewTransport } from './view_transport';

export interface NamedBytes {
  name: string;
  bytes: Uint8Array;
}

/** Messages from the page to the worker: the module, packed or compiled; the files; then requests. */
export type ToWorker = { packed: string; size: number } | { module: WebAssembly.Module } | { files: File[]; take: string } | { id: number; action: string; body: string };
/** Messages from the worker: the unpacked module or why unpacking failed; then about its take. A save request wrote `files`. */
export type FromWorker = { module: WebAssembly.Module } | { broken: string } | { session: Session } | { problem: string } | { stage: string; done: number }
  | { id: number; status: number; body: Uint8Array; files: NamedBytes[] };

const stopped = { error: 'stopped' };

/** An answer that uses the worker's bytes; a `Response` would copy them. */
function answerOf(status: number, body: Uint8Array): Answer {
  const text = (): string => new TextDecoder().decode(body);
  return {
    ok: status >= 200 && status < 300,
    status,
    text: () => Promise.resolve(text()),
    json: () => Promise.resolve(JSON.parse(text())),
    arrayBuffer: () => Promise.resolve(body.buffer as ArrayBuffer),
  };
}
const answerInJson = (status: number, told: object): Answer => answerOf(status, new TextEncoder().encode(JSON.stringify(told)));

export class WorkerTransport implements ViewTransport {
  private worker: Worker | null = null;
  private readonly waiting = new Map<number, { long: boolean; answer: (reply: Answer) => void }>();
  private opened: { done: (session: Session) => void; fail: (error: Error) => void } | null = null;
  private told = { stage: '', done: 0 };
  private next = 0;

  /** `files` are the take and its side files; the worker reads them. `save` is called with each written file. */
  constructor(private readonly engine: Engine, private readonly take: string, private readonly files: File[], private readonly save: (file: NamedBytes) => void) {}

  /** Reads the take. */
  open(): Promise<Session> {
    return new Promise((done, fail) => {
      this.opened = { done, fail: (error) => { this.leave(); fail(error); } };
      this.begin();
    });
  }

  ask(action: string, asked: object = {}): Promise<Answer> {
    if (action === 'progress') return Promise.resolve(answerInJson(200, this.told));
    const long = action === 'run' || action === 'curves';
    // A busy worker cannot receive messages, so a replaced run ends with its worker.
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
    this.worker = this.engine.worker();
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.hear(data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.fail(event.message || 'the worker has ended');
    };
    this.post({ files: this.files, take: this.take });
  }

  private post(told: ToWorker): void { this.worker?.postMessage(told); }

  private hear(told: FromWorker): void {
    if ('session' in told) this.opened?.done(told.session);
    else if ('problem' in told) this.fail(told.problem);
    else if ('broken' in told) this.fail(told.broken);
    else if ('stage' in told) this.told = told;
    else if ('id' in told) {
      for (const file of told.files) this.keep(file);
      this.told = { stage: '', done: 0 };
      this.waiting.get(told.id)?.answer(answerOf(told.status, told.body));
      this.waiting.delete(told.id);
    }
  }

  /** The page downloads the file; later workers get side files too. */
  private keep(file: NamedBytes): void {
    if (/\.(contacts|plan\.csv|gaps\.csv)$/.test(file.name)) {
      const before = this.files.findIndex(({ name }) => name === file.name);
      this.files.splice(before < 0 ? this.files.length : before, before < 0 ? 0 : 1, new File([file.bytes], file.name));
    }
    this.save(file);
  }

  private fail(words: string): void {
    this.opened?.fail(new Error(words));
    this.worker?.terminate();
    this.refuseAll(500, { error: words });
    if (this.worker !== null) this.begin();
  }

  private refuseAll(status: number, told: object): void {
    const requests = [...this.waiting.values()];
    this.waiting.clear();
    for (const { answer } of requests) answer(answerInJson(status, told));
  }
}
