// The page without a program: its module reads, cleans and saves the takes dropped on it.

import 'uplot/dist/uPlot.min.css';
import './style.css';
import { warmRenderer } from './body';
import { bytesOf } from './codec';
import { button, element } from './dom';
import { Engine } from './engine';
import { pressOption } from './take_page';
import { themeButton } from './theme';
import { startView, type ViewPage, type ViewStart } from './view';
import { WorkerTransport, type NamedBytes } from './worker_transport';

/** Files that belong to a take but are not takes. */
const beside = /\.(asf|bin|png|jpe?g|contacts)$/i;
const endings = '.bvh,.amc,.asf,.c3d,.trc,.tsv,.csv,.npz,.fbx,.glb,.gltf,.bin';

function download({ name, bytes }: NamedBytes): void {
  const address = URL.createObjectURL(new Blob([bytes], { type: 'application/octet-stream' }));
  element('a', { href: address, download: name }).click();
  window.setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

class App {
  private readonly page = document.getElementById('page') as HTMLElement;
  private readonly choose = element('input', { type: 'file', multiple: '', accept: endings, 'aria-label': 'take to open' });
  private readonly status = element('span', { role: 'status', class: 'status' });
  private view: ViewPage | null = null;
  private transport: WorkerTransport | null = null;
  private example: Uint8Array | null = null;

  constructor(private readonly engine: Engine) {
    this.choose.hidden = true;
    this.choose.addEventListener('change', () => {
      void this.open([...(this.choose.files ?? [])]);
      this.choose.value = '';
    });
    const open = button('Open\u2026', 'choose a take on this computer', () => this.choose.click());
    open.dataset.action = 'open';
    document.getElementById('bar')?.append(element('strong', {}, 'Kinemend'), open, this.choose, element('span', { class: 'empty' }, 'Takes stay on this computer.'), this.status);
    addEventListener('dragover', (event) => event.preventDefault());
    addEventListener('drop', (event) => {
      event.preventDefault();
      void this.open([...(event.dataTransfer?.files ?? [])]);
    });
    this.welcome();
    this.status.textContent = 'starting\u2026';
    void warmRenderer().catch(() => undefined);
    engine.ready.then(() => this.say(''), (error: unknown) => cannotStart(error));
  }

  /** Shows the work that the page does while no take is open. */
  private say(words: string): void { if (this.transport === null) this.status.textContent = words; }

  private welcome(): void {
    const example = button('Try it with an example', 'a walk that trembles and whose feet slide: it is cleaned at once, and played before and after', () => void this.openExample());
    example.dataset.action = 'example';
    this.page.replaceChildren(element('header', {}, element('div', {}, element('h1', {}, 'Clean a take')), themeButton(() => undefined)),
      element('section', { class: 'drop' },
        element('p', {}, 'Drop a take anywhere on this page, or use Open.'),
        element('p', {}, example),
        element('p', { class: 'empty' }, 'BVH, AMC with its ASF, C3D, TRC, TSV, CSV, NPZ, FBX, GLB, or glTF with its buffers. Drop files that belong together at the same time.'),
        element('p', { class: 'empty' }, 'This page works without a network. It sends nothing and stores nothing.')));
    this.page.dataset.ready = 'waiting';
  }

  /** Opens the example take of the page (web/make_app.mjs) with held feet, beside the original and playing. */
  private async openExample(): Promise<void> {
    this.example ??= await bytesOf('example');
    if (this.example === null) return;
    await this.open([new File([this.example as BlobPart], 'sliding_walk.bvh')], {
      flags: { feet: 'auto' },
      onFirst: ({ player, body }) => {
        if (body !== null && !body.options.apart) pressOption('apart');
        player.seek(0);
        if (!matchMedia('(prefers-reduced-motion: reduce)').matches) player.play();
      },
    });
  }

  private async open(files: File[], start: ViewStart = {}): Promise<void> {
    const take = files.find(({ name }) => !beside.test(name)) ?? files[0];
    if (take === undefined) return;
    this.close();
    this.page.dataset.ready = 'opening';
    this.status.classList.remove('error');
    this.status.textContent = `opening ${take.name}\u2026`;
    try {
      const transport = new WorkerTransport(this.engine, take.name, files, download);
      this.transport = transport;
      const session = await transport.open();
      if (this.transport !== transport) return;
      this.status.textContent = '';
      this.view = startView(this.page, session, transport, start);
    } catch (error) {
      this.transport = null;
      this.welcome();
      this.status.textContent = error instanceof Error ? error.message : String(error);
      this.status.classList.add('error');
      this.page.dataset.ready = 'error';
    }
  }

  private close(): void {
    this.view?.dispose();
    this.transport?.leave();
    this.view = null;
    this.page.replaceChildren();
  }
}

function cannotStart(error: unknown): void {
  const page = document.getElementById('page') as HTMLElement;
  page.replaceChildren(element('h1', {}, 'This page cannot start'), element('p', {}, String(error)),
    element('p', {}, 'It needs a browser of 2023 or later, and the file must be complete.'));
  page.dataset.ready = 'failed';
}

async function start(): Promise<void> {
  const worker = await bytesOf('worker');
  const module = document.getElementById('data-module');
  if (worker === null || module === null) throw new Error('the page is incomplete');
  const packed = module.textContent ?? '';
  module.textContent = '';
  const address = URL.createObjectURL(new Blob([worker], { type: 'text/javascript' }));
  new App(new Engine(() => new Worker(address), packed, Number(module.dataset.size)));
}

start().catch(cannotStart);
