// Runs in a worker: the module for JavaScript answers requests about one take.

import { load } from 'kinemend';
import type { FromWorker, NamedBytes, ToWorker } from './worker_transport';

const restMs = 100;

function tell(told: FromWorker): void { postMessage(told); }

let tellAgainAt = 0;
function tellProgress(stage: string, done: number): void {
  if (performance.now() < tellAgainAt) return;
  tellAgainAt = performance.now() + restMs;
  tell({ stage, done });
}

type Kinemend = Awaited<ReturnType<typeof load>>;

async function begin(module: WebAssembly.Module, files: NamedBytes[], take: string): Promise<Kinemend | null> {
  try {
    const kinemend = await load({
      tell: tellProgress,
      instantiateWasm: (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void) => {
        void WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
        return {};
      },
    });
    for (const { name, bytes } of files) kinemend.putFile(name, bytes);
    const { code, report, messages } = kinemend.view.open(take);
    if (code === 0) tell({ session: JSON.parse(report) });
    else tell({ problem: messages.trim().replace(/^kinemend: (error: )?/, '') });
    return code === 0 ? kinemend : null;
  } catch (error) {
    tell({ problem: String(error) });
    return null;
  }
}

function answer(kinemend: Kinemend, id: number, action: string, body: string): void {
  const { status, body: reply } = kinemend.view.ask(action, body);
  const files: NamedBytes[] = [];
  if (action === 'save' && status === 200) {
    for (const name of JSON.parse(reply).written as string[]) files.push({ name, bytes: kinemend.readFile(name) });
    // What was saved is the person's: it can be saved again under the same name.
    kinemend.removeFile(files[files.length - 1].name);
  }
  tell({ id, status, body: reply, files });
}

let started: Promise<Kinemend | null> = Promise.resolve(null);
onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if ('module' in data) {
    started = begin(data.module, data.files, data.take);
    return;
  }
  const { id, action, body } = data;
  void started.then((kinemend) => {
    if (kinemend === null) return;
    answer(kinemend, id, action, body);
  }).catch((error: unknown) => tell({ problem: `internal error: ${String(error)}` }));
};
