// The page that `kinemend view` serves: the page of a take, with controls that rerun the program.

import { jsonOf, type Parts } from './codec';
import { button, choice, counted, element } from './dom';
import { ContactEditor } from './contact_editor';
import { GapEditor } from './gap_editor';
import type { Sight } from './line_editor';
import { MissingEditor } from './missing_editor';
import { field, optionControl, showProblem, type Option, type Value } from './option_control';
import type { ReportDocument, TakeData } from './report';
import { SaveDialog, type Saved } from './save_dialog';
import { partsOf, type GapCurves, type GapPlan, type Session, type ViewControls, type WhyNot } from './served';
import { Take } from './take';
import { showTake, type Shown } from './take_page';
import { themeButton } from './theme';
import { serverTransport, type ViewTransport } from './view_transport';

/** A run request in the form that the server reads. */
interface Asked {
  command: 'clean' | 'fill';
  flags: Record<string, Value>;
  contacts?: string;
  plan?: string;
  gaps?: string;
  preview?: boolean;
}

const restMs = 150;
/** Interval of progress reports of long runs, ms. */
const tellMs = 600;

/** Shows what the server is doing until the returned function is called. */
function tellProgress(transport: ViewTransport, say: (words: string) => void): () => void {
  const timer = window.setInterval(() => {
    void transport.ask('progress').then((reply) => reply.json()).then(({ stage, done }: { stage: string; done: number }) => {
      if (!ended && stage !== '') say(done > 0 ? `${stage}, ${Math.round(100 * done)} %` : `${stage}\u2026`);
    }).catch(() => undefined);
  }, tellMs);
  let ended = false;
  return () => {
    ended = true;
    window.clearInterval(timer);
  };
}

/** The report and the motion in the server's answer. */
async function dataOf(parts: Parts): Promise<[ReportDocument, Take]> {
  const report = await jsonOf<ReportDocument>('report', parts);
  const take = await jsonOf<TakeData>('take', parts);
  if (report === null || take === null) throw new Error('the answer contains no report');
  return [report, await Take.load(take, parts)];
}

/** Shown before there is a result: the take's name and the server's progress. */
function emptyPage(page: HTMLElement, session: Session, ...parts: HTMLElement[]): void {
  const name = session.input.split(/[\\/]/).pop() ?? session.input;
  page.replaceChildren(element('header', {}, element('div', {}, element('h1', {}, name)), themeButton(() => undefined)), ...parts);
  page.dataset.ready = 'running';
}

class Controls {
  readonly element = element('section', { class: 'view-controls', 'aria-label': 'Controls' });
  private command: 'clean' | 'fill' = 'clean';
  private readonly general: Record<'clean' | 'fill', Record<string, Value>> = { clean: {}, fill: {} };
  private preset: ViewControls['presets'][number] | null = null;
  private method: string;
  /** Labels of controls whose values are invalid, by "clean.strength". */
  private readonly refused = new Map<string, string>();
  private readonly options: Record<string, Record<string, Value>> = {};
  private readonly status = element('p', { class: 'status', role: 'status' }, 'reading\u2026');
  /** Shows the status while the page is still empty. */
  private readonly first = element('section', {}, element('p', { class: 'empty' }, 'The take is being read and cleaned. The result appears here.'));
  private readonly line = element('code', { class: 'line', tabindex: '0' });
  private readonly rows = { clean: element('div', { class: 'fields' }), fill: element('div', { class: 'fields' }) };
  private readonly optionRow = element('div', { class: 'fields own' });
  private readonly presets = choice('preset', [['', 'no preset']], '', (name) => this.choosePreset(name));
  private methods: HTMLSelectElement | null = null;
  private whyNot: WhyNot = {};
  private readonly unable = element('details', { class: 'unable', hidden: true });
  private readonly about = element('p', { class: 'empty' });
  private readonly byPlan = element('p', { class: 'empty' }, 'The gap plan below says how each gap is filled.');
  private readonly dialog: SaveDialog;
  private readonly stopping = button('Stop', 'end this run', () => this.stop());
  /** Where the take was last saved, by command. */
  private readonly names = { clean: '', fill: '' };
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
  private onFirst: ViewStart['onFirst'];

  constructor(private readonly page: HTMLElement, private readonly session: Session, private readonly transport: ViewTransport, { flags = {}, onFirst }: ViewStart = {}) {
    this.general.clean = { ...flags };
    this.onFirst = onFirst;
    this.method = this.presetMethod;
    this.dialog = new SaveDialog((file, replace) => this.save(file, replace), (saved) => this.afterSaving(saved), transport);
    this.isJoints = session.kind === 'joints';
    const again = (): void => this.later();
    const sight = (): Sight | null => this.shown;
    this.contacts = this.isJoints ? new ContactEditor(sight, () => transport.ask('contacts'), again) : null;
    this.missing = new MissingEditor(sight, () => transport.ask('gaps'), () => this.afterMarking(), this.isJoints ? 'joint' : 'marker');
    if (session.with_gaps) void this.missing.start(transport.ask('gaps'));
    this.gaps = new GapEditor(session, this.isJoints, (track, frame) => this.goTo(track, frame), again, (plan, row) => this.curves(plan, row));
    const commands = choice('what to do', [['clean', 'Clean'], ['fill', 'Fill gaps only']], 'clean', (value) => {
      this.command = value as 'clean' | 'fill';
      this.draw();
      this.later();
    });
    commands.dataset.flag = 'command';
    this.contactBox = element('details', { class: 'editor' }, element('summary', {}, 'Contacts'), this.contacts?.element ?? '');
    this.gapBox = element('details', { class: 'editor' }, element('summary', {}, 'Gap plan'), this.gaps.element);
    this.presets.dataset.flag = 'preset';
    this.presets.title = 'settings of a live stream or of a gait laboratory';
    this.presets.append(...session.controls.presets.map(({ name, summary }) => element('option', { value: name, title: summary }, name)));
    const save = button('Save as\u2026', 'choose a file name and save the take', () => this.dialog.open(this.names[this.command] || (this.command === 'clean' ? session.cleaned : session.filled)));
    save.dataset.action = 'save';
    this.stopping.dataset.action = 'stop';
    this.stopping.hidden = true;
    this.element.append(element('div', { class: 'head' }, element('h2', {}, 'Controls'), commands, this.presets, save, element('span', { class: 'gap' }), this.status, this.stopping), this.about,
      this.rows.clean, this.rows.fill, this.contactBox, element('details', { class: 'editor' }, element('summary', {}, 'Missing samples'), this.missing.element), this.gapBox, this.line, this.saved, this.dialog.element);
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

  private text(command: 'clean' | 'fill', name: string, label: string, hint: string, title: string): HTMLElement {
    const made = element('input', { type: 'text', placeholder: hint, value: String(this.general[command][name] ?? ''), 'aria-label': label });
    made.dataset.flag = name;
    made.addEventListener('input', () => {
      showProblem(made, '');
      this.set(command, name, made.value.trim());
    });
    return field(label, title, made);
  }
  /** A control for a flag of the program; `own` overrides parts of the flag's option. */
  private option(command: 'clean' | 'fill', label: string, name: string, own: Partial<Option> = {}): HTMLElement {
    const flag = this.session.controls.flags[command].find((one) => one.name === name);
    if (flag === undefined) throw new Error(`the program has no flag ${name}`);
    const set = command === 'clean' ? this.preset?.values[name] : undefined;
    const option: Option = { ...flag, ...own };
    return optionControl(set === undefined ? option : { ...option, default: set }, this.general[command][name], {
      change: (value) => this.set(command, name, value),
      refuse: (told) => this.refuse(`${command}.${name}`, told),
    }, label);
  }
  /** Records that a control has an invalid value, which stops runs; `label` null: the value is valid again. */
  private refuse(name: string, label: string | null): void {
    if (label === null) this.refused.delete(name);
    else this.refused.set(name, label);
    this.sayRefused();
  }
  /** Shows which visible controls have invalid values; returns whether any has. */
  private sayRefused(): boolean {
    const names = [...this.refused].filter(([name]) => name.startsWith(`${this.command}.`)).map(([, label]) => label);
    if (names.length === 0) return false;
    window.clearTimeout(this.timer);
    ++this.turn;
    this.status.textContent = `not used: ${names.join(', ')}. The page shows the last result with valid values.`;
    this.status.classList.add('error');
    this.page.dataset.ready = 'error';
    return true;
  }

  private choosePreset(name: string): void {
    const own = this.general.clean;
    for (const set of Object.keys(this.preset?.values ?? {})) delete own[set];
    this.preset = this.session.controls.presets.find((one) => one.name === name) ?? null;
    for (const set of Object.keys(this.preset?.values ?? {})) delete own[set];
    for (const set of Object.keys(this.preset?.options ?? {})) delete this.options[set];
    this.method = this.presetMethod;
    this.addClean();
    this.draw();
    this.later();
  }
  /** The method used if none is chosen. */
  private get presetMethod(): string { return String(this.preset?.values.method ?? this.session.default_method); }

  private fillMethods(): string[] {
    return this.session.controls.fill_methods.filter((one) => (this.isJoints ? one.joints : one.markers)).map(({ name }) => name);
  }

  /** Also called after another preset is chosen, whose values are the defaults of the controls. */
  private addClean(): void {
    const method = choice('method', this.session.controls.methods.map(({ name }) => [name, name]), this.method, (value) => {
      this.method = value;
      this.drawOptions();
      this.later();
    });
    method.dataset.flag = 'method';
    this.methods = method;
    this.offerMethods();
    const nouns = this.isJoints ? 'joints' : 'markers';
    const pattern = this.isJoints ? 'Left*' : 'L*';
    for (const name of this.refused.keys()) if (name.startsWith('clean.')) this.refused.delete(name);
    this.rows.clean.replaceChildren(field('method', 'how to clean', method),
      this.option('clean', 'source', 'source', { default: this.session.source }),
      this.option('clean', 'strength', 'strength'),
      this.text('clean', 'joints', `${nouns} to clean`, `${pattern} (all)`, `names or patterns, separated by commas; empty: all ${nouns}`),
      this.text('clean', 'exclude', `${nouns} to leave out`, 'none', `names or patterns of ${nouns} that are not changed`),
      this.text('clean', 'range', 'frames', '121:240 or 1s:2.5s', 'clean only these frames, by their numbers or in seconds; empty: all frames'),
      this.option('clean', 'fill gaps', 'fill', { choices: ['off', ...this.fillMethods()] }));
    if (this.isJoints) {
      this.rows.clean.append(this.option('clean', 'hold feet', 'feet'), this.option('clean', 'largest change (deg)', 'max_change_deg'),
        this.option('clean', 'clean the root\u2019s position', 'root_position'));
    } else {
      this.rows.clean.append(this.option('clean', 'undo label swaps', 'fix_swaps'));
    }
    this.rows.clean.append(this.optionRow, this.unable);
    this.drawOptions();
  }

  /** Methods that cannot clean this take cannot be chosen, and the page says why. */
  private offerMethods(): void {
    const reasons = Object.entries(this.whyNot);
    for (const one of this.methods?.options ?? []) {
      one.disabled = one.value in this.whyNot;
      one.title = this.whyNot[one.value] ?? '';
    }
    this.unable.hidden = reasons.length === 0;
    this.unable.replaceChildren(element('summary', {}, `${counted(reasons.length, 'method')} cannot clean this take`),
      element('ul', {}, ...reasons.map(([name, reason]) => element('li', {}, element('b', {}, name), `: ${reason}`))));
  }

  /** Draws the controls of the method's options. */
  private drawOptions(): void {
    const chosen = this.session.controls.methods.find(({ name }) => name === this.method);
    const own = (this.options[this.method] ??= {});
    const set = this.preset?.options[this.method] ?? {};
    // The controls of the previous method are gone, with their values.
    for (const method of this.session.controls.methods) for (const { name } of method.options) this.refused.delete(`clean.${name}`);
    this.optionRow.replaceChildren(element('p', { class: 'empty' }, chosen?.summary ?? ''), ...(chosen?.options ?? []).map((option) => optionControl(
      { ...option, default: set[option.name] ?? option.default }, own[option.name], {
        change: (value) => {
          if (value === undefined) delete own[option.name];
          else own[option.name] = value;
          this.later();
        },
        refuse: (told) => this.refuse(`clean.${option.name}`, told),
      })));
  }

  private addFill(): void {
    const nouns = this.isJoints ? 'joints' : 'markers';
    this.rows.fill.append(this.option('fill', 'method', 'method', { choices: this.fillMethods() }),
      this.text('fill', 'joints', `${nouns} to fill`, `${this.isJoints ? 'Left*' : 'L*'} (all)`, `names or patterns, separated by commas; empty: all ${nouns}`),
      this.text('fill', 'range', 'frames', '121:240 or 1s:2.5s', 'fill only gaps in these frames, by their numbers or in seconds; empty: all frames'),
      this.option('fill', 'fill every gap', 'fill_all'));
    if (!this.isJoints) this.rows.fill.append(this.text('fill', 'donor', 'donor marker', 'LASI', 'the marker whose motion the method pattern copies'));
    this.rows.fill.append(this.byPlan);
  }

  private draw(): void {
    for (const command of ['clean', 'fill'] as const) this.rows[command].hidden = command !== this.command;
    for (const control of this.rows.fill.querySelectorAll<HTMLInputElement>('input, select, button')) control.disabled = this.gaps.edited;
    this.byPlan.hidden = !this.gaps.edited;
    this.presets.hidden = this.command !== 'clean';
    this.about.hidden = this.command !== 'clean' || this.preset === null;
    this.about.textContent = this.preset === null ? '' : `Preset ${this.preset.name}: ${this.preset.summary}.`;
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
    if (this.preset !== null) flags.preset = this.preset.name;
    if (this.method !== this.presetMethod) flags.method = this.method;
    return { command: 'clean', flags, gaps, contacts: this.contacts?.edited ? this.contacts.text() : undefined };
  }

  private async curves(plan: string, row: number): Promise<GapCurves | null> {
    const { gaps } = this.asked();
    const reply = await this.transport.ask('curves', { command: 'fill', flags: {}, plan, row, gaps });
    if (reply.status === 409) return null;
    const told = await reply.json();
    if (!reply.ok) throw new Error(told.error);
    return told as GapCurves;
  }

  /** A plan for earlier gaps does not fit the current ones. */
  private afterMarking(): void {
    this.gaps.edited = false;
    this.later();
  }

  /** Runs after a short pause in changes; stops the current run. */
  later(): void {
    if (this.sayRefused()) return;
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
    // If the message names an option, it is also shown beside its control.
    const flag = /--([a-z][a-z-]*)/.exec(text)?.[1].replace(/-/g, '_');
    const control = flag === undefined ? null : this.rows[this.command].querySelector<HTMLElement>(`[data-flag="${flag}"]`);
    if (control !== null) showProblem(control, text);
    if (this.shown === null) this.first.replaceChildren(element('p', { class: 'empty' }, 'There is nothing to show. The message above says why.'));
  }

  private async run(): Promise<void> {
    const turn = ++this.turn;
    this.stopping.hidden = false;
    const begun = performance.now();
    const since = (from: number): string => ((performance.now() - from) / 1000).toFixed(2);
    const ended = tellProgress(this.transport, (words) => { if (turn === this.turn) this.status.textContent = words; });
    try {
      const reply = await this.transport.ask('run', this.asked());
      if (turn !== this.turn) return;
      if (!reply.ok) return this.fail((await reply.json()).error);
      const parts = partsOf(await reply.arrayBuffer());
      if (turn !== this.turn) return;
      const answered = since(begun);
      ended();
      const [report, take] = await dataOf(parts);
      if (turn !== this.turn) return;
      await this.take(report, take, await jsonOf<GapPlan>('plan', parts), () => turn !== this.turn);
      if (turn !== this.turn) return;
      const whyNot = await jsonOf<WhyNot>('why_not', parts);
      if (whyNot !== null) this.whyNot = whyNot;
      this.offerMethods();
      this.page.dataset.ready = 'true';
      for (const control of this.rows[this.command].querySelectorAll<HTMLElement>('[aria-invalid]')) showProblem(control, '');
      this.status.classList.remove('error');
      this.status.textContent = 'done';
      this.page.dataset.runs = String(turn);
      if (this.shown !== null) this.onFirst?.(this.shown);
      this.onFirst = undefined;
      this.status.title = `shown after ${since(begun)} s, ${answered} s of them in the program`;
    } catch (error) {
      if (turn === this.turn) this.fail(this.transport.inWords(error));
    } finally {
      ended();
      if (turn === this.turn) this.stopping.hidden = true;
    }
  }

  private stop(): void {
    window.clearTimeout(this.timer);
    ++this.turn;
    this.transport.stop();
    this.stopping.hidden = true;
    this.status.textContent = 'stopped: the page shows the result before';
    this.page.dataset.ready = 'stopped';
    if (this.shown === null) this.first.replaceChildren(element('p', { class: 'empty' }, 'The run was stopped. Change a control to run again.'));
  }

  /** Call it before another take replaces this one. */
  dispose(): void {
    window.clearTimeout(this.timer);
    ++this.turn;
    this.shown?.dispose();
  }

  private async take(report: ReportDocument, take: Take, plan: GapPlan | null, isOver: () => boolean): Promise<void> {
    this.line.textContent = take.data.command_line;
    const scrolled = window.scrollY;
    this.shown = await showTake(this.page, report, take, { panel: [this.element], before: this.shown, isOver, onTheme: () => this.gaps.redraw() });
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

  private async save(file: string, replace: boolean): Promise<Saved> {
    if (this.refused.size > 0 && this.sayRefused()) return { error: 'A value of the controls is not allowed: correct it first.' };
    this.saved.textContent = 'saving\u2026';
    try {
      const saved = await (await this.transport.ask('save', { ...this.asked(), file, replace })).json() as Saved;
      if (saved.written === undefined) this.saved.textContent = '';
      return saved;
    } catch (error) {
      this.saved.textContent = '';
      throw error;
    }
  }

  private afterSaving(saved: Saved): void {
    const written = saved.written ?? [];
    this.names[this.command] = written[written.length - 1] ?? '';
    this.saved.textContent = `saved ${written.join(', ')}`;
    this.line.textContent = saved.command_line ?? '';
  }
}

/** Two takes compared, without controls. */
async function showComparison(page: HTMLElement, session: Session): Promise<void> {
  const status = element('p', { class: 'empty', role: 'status' }, 'reading\u2026');
  emptyPage(page, session, element('section', {}, status));
  const ended = tellProgress(serverTransport, (words) => { status.textContent = words; });
  try {
    const reply = await serverTransport.ask('run');
    if (!reply.ok) throw new Error((await reply.json()).error);
    const [report, take] = await dataOf(partsOf(await reply.arrayBuffer()));
    ended();
    await showTake(page, report, take);
    page.dataset.ready = 'true';
  } catch (error) {
    status.textContent = serverTransport.inWords(error);
    page.dataset.ready = 'error';
  } finally {
    ended();
  }
}

/** A page with controls. */
export interface ViewPage {
  /** Called before another take is shown in its place. */
  dispose(): void;
}

/** How a page starts. `flags` are those of `clean`; `onFirst` is called with the first result. */
export interface ViewStart {
  flags?: Record<string, Value>;
  onFirst?: (shown: Shown) => void;
}

export function startView(page: HTMLElement, session: Session, transport: ViewTransport = serverTransport, start: ViewStart = {}): ViewPage {
  // Closing a page stops its run.
  window.addEventListener('pagehide', () => transport.leave());
  if (session.other === '') return new Controls(page, session, transport, start);
  void showComparison(page, session);
  return { dispose: () => undefined };
}
