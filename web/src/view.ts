// The page that `kinemend view` serves: the page of a take, with controls that run it anew.

import { jsonOf } from './codec';
import { button, choice, element, toggle } from './dom';
import { ContactEditor } from './contact_editor';
import { GapEditor, type GapPlan } from './gap_editor';
import type { GapCurves } from './gap_preview';
import type { Sight } from './line_editor';
import { MissingEditor } from './missing_editor';
import type { ReportDocument, TakeData } from './report';
import { showTake, type Shown } from './take_page';
import { themeButton } from './theme';

export interface Option {
  name: string;
  kind: 'switch' | 'choice' | 'whole' | 'number';
  help: string;
  default: string | number | boolean;
  unit?: string;
  choices?: string[];
  minimum?: number;
  maximum?: number;
}
/** What the page of `kinemend view` holds before there is a take: cli/view_session.cpp writes it. */
export interface Session {
  input: string;
  other: string;
  kind: 'joints' | 'markers';
  cleaned: string;
  filled: string;
  contacts: string;
  plan: string;
  gaps: string;
  with_gaps: boolean;
  methods: { name: string; summary: string; options: Option[] }[];
  fill_methods: { name: string; summary: string; joints: boolean; markers: boolean }[];
}
export type Value = string | number | boolean;

/** What a run is asked for, as the server reads it. */
interface Asked {
  command: 'clean' | 'fill';
  flags: Record<string, Value>;
  contacts?: string;
  plan?: string;
  gaps?: string;
  preview?: boolean;
}

const restMs = 150;
/** After so long a run says how far it is, and again and again. */
const tellMs = 600;

/** What this tab calls itself: a run overtakes those of its own tab. */
const tab = Array.from(crypto.getRandomValues(new Uint32Array(4)), (word) => word.toString(16)).join('-');

function ask(action: string, asked: object = {}): Promise<Response> {
  return fetch(action, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ tab, ...asked }) });
}

/** Says what the server is at until it is told to stop. */
function tellProgress(say: (words: string) => void): () => void {
  const timer = window.setInterval(() => {
    void ask('progress').then((reply) => reply.json()).then(({ stage, done }: { stage: string; done: number }) => {
      if (!ended && stage !== '') say(done > 0 ? `${stage}, ${Math.round(100 * done)} %` : `${stage}\u2026`);
    }).catch(() => undefined);
  }, tellMs);
  let ended = false;
  return () => {
    ended = true;
    window.clearInterval(timer);
  };
}

function inWords(error: unknown): string {
  return error instanceof TypeError ? 'kinemend view has ended' : error instanceof Error ? error.message : String(error);
}

/** Takes the data of a run out of the server's reply. */
async function dataOf(html: string): Promise<[ReportDocument, TakeData]> {
  const made = new DOMParser().parseFromString(html, 'text/html');
  for (const old of document.querySelectorAll('[id^="data-"]')) old.remove();
  for (const part of made.querySelectorAll('[id^="data-"]')) document.body.append(document.adoptNode(part));
  const report = await jsonOf<ReportDocument>('report');
  const take = await jsonOf<TakeData>('take');
  if (report === null || take === null) throw new Error('the reply holds no report');
  return [report, take];
}

/** Before anything is there: the take's name, and what the server is at. */
function emptyPage(page: HTMLElement, session: Session, ...parts: HTMLElement[]): void {
  const name = session.input.split(/[\\/]/).pop() ?? session.input;
  page.replaceChildren(element('header', {}, element('div', {}, element('h1', {}, name)), themeButton(() => undefined)), ...parts);
  page.dataset.ready = 'running';
}

function field(label: string, title: string, control: HTMLElement): HTMLElement {
  return element('label', { class: 'field', title }, element('span', {}, label), control);
}

/** A control of one option; `act` gets its value, undefined where it is the default. */
function optionControl(option: Option, act: (value: Value | undefined) => void, label = ''): HTMLElement {
  const told = label || option.name.replace(/_/g, ' ') + (option.unit ? ` (${option.unit})` : '');
  if (option.kind === 'switch') {
    const made = toggle(told, option.help, option.default === true, (on) => act(on === option.default ? undefined : on));
    made.dataset.flag = option.name;
    return made;
  }
  if (option.choices) {
    const made = choice(told, option.choices.map((one) => [one, one]), String(option.default), (value) => act(value === option.default ? undefined : value));
    made.dataset.flag = option.name;
    return field(told, option.help, made);
  }
  const made = element('input', { type: 'number', class: 'number', value: String(option.default), min: option.minimum, max: option.maximum, step: option.kind === 'whole' ? 1 : 'any', 'aria-label': told });
  made.dataset.flag = option.name;
  made.addEventListener('input', () => {
    if (made.value === '' || !made.checkValidity()) return;
    act(Number(made.value) === option.default ? undefined : Number(made.value));
  });
  return field(told, option.help, made);
}

class Controls {
  readonly element = element('section', { class: 'view-controls', 'aria-label': 'Controls' });
  private command: 'clean' | 'fill' = 'clean';
  private readonly general: Record<'clean' | 'fill', Record<string, Value>> = { clean: {}, fill: {} };
  private method = 'auto';
  private readonly options: Record<string, Record<string, Value>> = {};
  private readonly status = element('p', { class: 'status', role: 'status' }, 'reading\u2026');
  /** The same where the page is empty still. */
  private readonly first = element('section', {}, element('p', { class: 'empty' }, 'The take is read and cleaned; what comes of it is shown here.'));
  private readonly line = element('code', { class: 'line', tabindex: '0' });
  private readonly rows = { clean: element('div', { class: 'fields' }), fill: element('div', { class: 'fields' }) };
  private readonly optionRow = element('div', { class: 'fields own' });
  private readonly byPlan = element('p', { class: 'empty' }, 'The gap plan says how each gap is filled.');
  private readonly saved = element('p', { class: 'saved', role: 'status' });
  private readonly contacts: ContactEditor | null;
  private readonly gaps: GapEditor;
  private readonly missing: MissingEditor;
  private readonly contactBox: HTMLElement;
  private readonly gapBox: HTMLElement;
  private timer = 0;
  private turn = 0;
  private shown: Shown | null = null;
  private readonly isJoints: boolean;

  constructor(private readonly page: HTMLElement, private readonly session: Session) {
    this.isJoints = session.kind === 'joints';
    const again = (): void => this.later();
    const sight = (): Sight | null => this.shown;
    this.contacts = this.isJoints ? new ContactEditor(sight, () => ask('contacts'), again) : null;
    this.missing = new MissingEditor(sight, () => ask('gaps'), () => this.afterMarking(), this.isJoints ? 'joint' : 'marker');
    if (session.with_gaps) void this.missing.start(ask('gaps'));
    this.gaps = new GapEditor(session, this.isJoints, (track, frame) => this.goTo(track, frame), again, (plan, row) => this.curves(plan, row));
    const commands = choice('what to do', [['clean', 'Clean'], ['fill', 'Fill gaps only']], 'clean', (value) => {
      this.command = value as 'clean' | 'fill';
      this.draw();
      this.later();
    });
    commands.dataset.flag = 'command';
    this.contactBox = element('details', { class: 'editor' }, element('summary', {}, 'Contacts'), this.contacts?.element ?? '');
    this.gapBox = element('details', { class: 'editor' }, element('summary', {}, 'Gap plan'), this.gaps.element);
    const save = button('Save as', `write ${session.cleaned} or ${session.filled}`, () => void this.save());
    save.dataset.action = 'save';
    this.element.append(element('div', { class: 'head' }, element('h2', {}, 'Controls'), commands, save, element('span', { class: 'gap' }), this.status),
      this.rows.clean, this.rows.fill, this.contactBox, element('details', { class: 'editor' }, element('summary', {}, 'Missing samples'), this.missing.element), this.gapBox, this.line, this.saved);
    this.addClean();
    this.addFill();
    this.draw();
    emptyPage(page, session, this.element, this.first);
    void this.run();
  }

  private set(command: 'clean' | 'fill', name: string, value: Value | undefined): void {
    const own = this.general[command];
    if (value === undefined || value === '') delete own[name];
    else own[name] = value;
    this.later();
  }

  private text(command: 'clean' | 'fill', name: string, label: string, hint: string): HTMLElement {
    const made = element('input', { type: 'text', placeholder: hint, 'aria-label': label });
    made.dataset.flag = name;
    made.addEventListener('input', () => this.set(command, name, made.value.trim()));
    return field(label, hint, made);
  }
  private option(command: 'clean' | 'fill', label: string, option: Option): HTMLElement {
    return optionControl(option, (value) => this.set(command, option.name, value), label);
  }
  private fillMethods(): string[] {
    return this.session.fill_methods.filter((one) => (this.isJoints ? one.joints : one.markers)).map(({ name }) => name);
  }

  private addClean(): void {
    const method = choice('method', this.session.methods.map(({ name }) => [name, name]), this.method, (value) => {
      this.method = value;
      this.drawOptions();
      this.later();
    });
    method.dataset.flag = 'method';
    const patterns = `${this.isJoints ? 'Left*' : 'L*'} (all)`;
    this.rows.clean.append(field('method', 'how to clean', method),
      this.option('clean', 'strength', { name: 'strength', kind: 'number', help: 'how far to go from the input (0) to the cleaned motion (1)', default: 1, minimum: 0, maximum: 1 }),
      this.text('clean', 'joints', this.isJoints ? 'joints' : 'markers', patterns), this.text('clean', 'exclude', 'not', 'none'), this.text('clean', 'range', 'frames', '121:240 or 1s:2.5s'),
      this.option('clean', 'fill gaps', { name: 'fill', kind: 'choice', help: 'fill gaps before anything is smoothed', default: 'off', choices: ['off', ...this.fillMethods()] }));
    if (this.isJoints) {
      this.rows.clean.append(this.option('clean', 'feet', { name: 'feet', kind: 'choice', help: 'stop feet that stand from sliding', default: 'off', choices: ['off', 'auto', 'force'] }),
        this.option('clean', 'largest change (deg)', { name: 'max_change_deg', kind: 'number', help: 'no rotation goes further than this from its input', default: 180, minimum: 0, maximum: 180 }),
        this.option('clean', 'root\u2019s path', { name: 'root_position', kind: 'switch', help: 'also clean the root\u2019s path', default: true }));
    } else {
      this.rows.clean.append(this.option('clean', 'undo swaps', { name: 'fix_swaps', kind: 'switch', help: 'undo swapped labels of markers first', default: false }));
    }
    this.rows.clean.append(this.optionRow);
    this.drawOptions();
  }

  /** Those of the method. */
  private drawOptions(): void {
    const chosen = this.session.methods.find(({ name }) => name === this.method);
    const own = (this.options[this.method] ??= {});
    this.optionRow.replaceChildren(element('p', { class: 'empty' }, chosen?.summary ?? ''), ...(chosen?.options ?? []).map((option) => {
      const made = optionControl(option, (value) => {
        if (value === undefined) delete own[option.name];
        else own[option.name] = value;
        this.later();
      });
      const given = own[option.name];
      const control = made.querySelector<HTMLInputElement | HTMLSelectElement>('input, select');
      if (control && given !== undefined) control.value = String(given);
      if (option.kind === 'switch') made.setAttribute('aria-pressed', String(given ?? option.default));
      return made;
    }));
  }

  private addFill(): void {
    this.rows.fill.append(this.option('fill', 'method', { name: 'method', kind: 'choice', help: 'how to fill', default: 'auto', choices: this.fillMethods() }),
      this.text('fill', 'names', this.isJoints ? 'joints' : 'markers', `${this.isJoints ? 'Left*' : 'L*'} (all)`), this.text('fill', 'range', 'frames', '121:240 or 1s:2.5s'),
      this.option('fill', 'fill all', { name: 'fill_all', kind: 'switch', help: 'also what the rules refuse', default: false }));
    if (!this.isJoints) this.rows.fill.append(this.text('fill', 'donor', 'donor', 'marker of pattern'));
    this.rows.fill.append(this.byPlan);
  }

  private draw(): void {
    for (const command of ['clean', 'fill'] as const) this.rows[command].hidden = command !== this.command;
    for (const control of this.rows.fill.querySelectorAll<HTMLInputElement>('input, select, button')) control.disabled = this.gaps.edited;
    this.byPlan.hidden = !this.gaps.edited;
    this.contactBox.hidden = this.contacts === null || this.command !== 'clean';
    this.gapBox.hidden = this.command !== 'fill';
  }

  private asked(): Asked {
    const gaps = this.missing.edited ? this.missing.text() : undefined;
    if (this.command === 'fill') {
      const plan = this.gaps.edited ? this.gaps.text() : undefined;
      return { command: 'fill', flags: plan === undefined ? this.general.fill : {}, plan, gaps, preview: this.gaps.preview };
    }
    const flags: Record<string, Value> = { ...this.general.clean, ...this.options[this.method] };
    if (this.method !== 'auto') flags.method = this.method;
    return { command: 'clean', flags, gaps, contacts: this.contacts?.edited ? this.contacts.text() : undefined };
  }

  private async curves(plan: string, row: number): Promise<GapCurves | null> {
    const { gaps } = this.asked();
    const reply = await ask('curves', { command: 'fill', flags: {}, plan, row, gaps });
    if (reply.status === 409) return null;
    const told = await reply.json();
    if (!reply.ok) throw new Error(told.error);
    return told as GapCurves;
  }

  /** Other gaps: a plan of those that were there is none of these. */
  private afterMarking(): void {
    this.gaps.edited = false;
    this.later();
  }

  /** Runs when nothing has been changed for a moment; a run that is under way is overtaken. */
  later(): void {
    window.clearTimeout(this.timer);
    this.status.textContent = 'running\u2026';
    this.page.dataset.ready = 'running';
    this.timer = window.setTimeout(() => void this.run(), restMs);
  }

  private fail(text: string): void {
    this.status.textContent = text;
    this.status.classList.add('error');
    this.page.dataset.ready = 'error';
    this.page.dataset.runs = String(this.turn);
    if (this.shown === null) this.first.replaceChildren(element('p', { class: 'empty' }, 'There is nothing to show: the controls say why.'));
  }

  private async run(): Promise<void> {
    const turn = ++this.turn;
    const begun = performance.now();
    const since = (from: number): string => ((performance.now() - from) / 1000).toFixed(2);
    const ended = tellProgress((words) => { if (turn === this.turn) this.status.textContent = words; });
    try {
      const reply = await ask('run', this.asked());
      if (turn !== this.turn) return;
      if (!reply.ok) return this.fail((await reply.json()).error);
      const html = await reply.text();
      if (turn !== this.turn) return;
      const answered = since(begun);
      ended();
      const [report, take] = await dataOf(html);
      await this.take(report, take);
      this.status.classList.remove('error');
      this.status.textContent = 'done';
      this.page.dataset.runs = String(turn);
      this.status.title = `in ${since(begun)} s, ${answered} s until the answer was here`;
    } catch (error) {
      if (turn === this.turn) this.fail(inWords(error));
    } finally {
      ended();
    }
  }

  private async take(report: ReportDocument, take: TakeData): Promise<void> {
    this.line.textContent = take.command_line;
    const plan = await jsonOf<GapPlan>('plan');
    const scrolled = window.scrollY;
    this.shown = await showTake(this.page, report, take, { panel: [this.element], before: this.shown, onTheme: () => this.gaps.redraw() });
    if (plan !== null) {
      this.gaps.show(plan, this.shown.take);
      this.draw();
    }
    window.scrollTo(0, scrolled);
  }

  private goTo(name: string, frame: number): void {
    const track = this.shown?.take.data.names.indexOf(name) ?? -1;
    if (this.shown === null || track < 0) return;
    this.shown.player.choose([track]);
    this.shown.player.jump(this.shown.take.frameOf(frame));
  }

  private async save(): Promise<void> {
    this.saved.textContent = 'saving\u2026';
    this.saved.classList.remove('error');
    try {
      const reply = await ask('save', this.asked());
      const told = await reply.json();
      this.saved.classList.toggle('error', !reply.ok);
      this.saved.textContent = reply.ok ? `saved ${told.written.join(', ')}` : told.error;
      if (reply.ok) this.line.textContent = told.command_line;
    } catch (error) {
      this.saved.classList.add('error');
      this.saved.textContent = inWords(error);
    }
  }
}

/** Two takes beside each other, without controls. */
async function showComparison(page: HTMLElement, session: Session): Promise<void> {
  const status = element('p', { class: 'empty', role: 'status' }, 'reading\u2026');
  emptyPage(page, session, element('section', {}, status));
  const ended = tellProgress((words) => { status.textContent = words; });
  try {
    const reply = await ask('run');
    if (!reply.ok) throw new Error((await reply.json()).error);
    const [report, take] = await dataOf(await reply.text());
    ended();
    await showTake(page, report, take);
  } catch (error) {
    status.textContent = inWords(error);
    page.dataset.ready = 'error';
  } finally {
    ended();
  }
}

export function startView(page: HTMLElement, session: Session): void {
  // A run that nobody waits for any more is given up.
  window.addEventListener('pagehide', () => navigator.sendBeacon('leave', new Blob([JSON.stringify({ tab })], { type: 'application/json' })));
  if (session.other !== '') void showComparison(page, session);
  else new Controls(page, session);
}
