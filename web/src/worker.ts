// Runs in a worker: unpacks the JavaScript module, and answers requests about one take.

import { load } from 'kinemend';
import { unpackedLzma } from './lzma';
import { sevenBitBytes } from './seven_bits';
import { exercise } from './warm_up';
import type { FromWorker, NamedBytes, ToWorker } from './worker_transport';

const restMs = 100;

function tell(told: FromWorker, moved: Transferable[] = []): void { postMessage(told, { transfer: moved }); }

let tellAgainAt = 0;
let isWarmingUp = false;
function tellProgress(stage: string, done: number): void {
  if (isWarmingUp || performance.now() < tellAgainAt) return;
  tellAgainAt = performance.now() + restMs;
  tell({ stage, done });
}

type Kinemend = Awaited<ReturnType<typeof load>>;

async function begin(told: { module: WebAssembly.Module } | { packed: string; size: number }): Promise<Kinemend> {
  const isNew = !('module' in told);
  const module = isNew ? await WebAssembly.compile(unpackedLzma(sevenBitBytes(told.packed), told.size)) : told.module;
  if (isNew) tell({ module });
  const kinemend = await load({
    tell: tellProgress,
    instantiateWasm: (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void) => {
      void WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
      return {};
    },
  });
  if (isNew) setTimeout(() => warmUp(kinemend), 0);
  return kinemend;
}

/** Code that has run before cleans faster; a take that has already arrived does not wait for this. */
function warmUp(kinemend: Kinemend): void {
  if (isOpened) return;
  isWarmingUp = true;
  try {
    exercise(kinemend);
  } finally {
    isWarmingUp = false;
  }
}

async function bytesOf(file: File): Promise<Uint8Array> {
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch {
    throw new Error(`${file.name}: it has changed or is gone since it was opened; open it again`);
  }
}

async function open(kinemend: Kinemend, files: File[], take: string): Promise<Kinemend | null> {
  for (const file of files) kinemend.putFile(file.name, await bytesOf(file));
  const { code, report, messages } = kinemend.view.open(take);
  if (code === 0) tell({ session: JSON.parse(report) });
  else tell({ problem: messages.trim().replace(/^kinemend: (error: )?/, '') });
  return code === 0 ? kinemend : null;
}

function answer(kinemend: Kinemend, id: number, action: string, asked: string): void {
  const { status, body } = kinemend.view.ask(action, asked);
  const files: NamedBytes[] = [];
  if (action === 'save' && status === 200) {
    for (const name of JSON.parse(new TextDecoder().decode(body)).written as string[]) files.push({ name, bytes: kinemend.readFile(name) });
    // Saved files belong to the user and can be saved again under the same name.
    kinemend.removeFile(files[files.length - 1].name);
  }
  tell({ id, status, body, files }, [body.buffer, ...files.map(({ bytes }) => bytes.buffer)]);
}

const inWords = (error: unknown): string => (error instanceof Error ? error.message : String(error));

let begun: Promise<Kinemend> | null = null;
let isOpened = false;
let opened: Promise<Kinemend | null> = Promise.resolve(null);
onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if ('files' in data) {
    isOpened = true;
    opened = (begun as Promise<Kinemend>).then((kinemend) => open(kinemend, data.files, data.take)).catch((error: unknown) => {
      tell({ problem: inWords(error) });
      return null;
    });
  } else if ('id' in data) {
    const { id, action, body } = data;
    void opened.then((kinemend) => {
      if (kinemend !== null) answer(kinemend, id, action, body);
    }).catch((error: unknown) => tell({ problem: `internal error: ${String(error)}` }));
  } else {
    begun = begin(data);
    begun.catch((error: unknown) => tell({ broken: inWords(error) }));
  }
};
