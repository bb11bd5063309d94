// The page of one take.

import { Body, makeRenderer, type View } from './body';
import { Curves, type Kind, type Quantity } from './curves';
import { button, choice, counted, element, toggle } from './dom';
import { addFacts } from './facts';
import { Player } from './player';
import type { Finding, ReportDocument, TakeEntry } from './report';
import { TrackTable } from './tables';
import { pause } from './slices';
import { Stands } from './stands';
import type { Take } from './take';
import { themeButton } from './theme';
import { Timeline } from './timeline';
import { addTransport } from './transport';

const help = 'Keys: Space plays and pauses \u00b7 left and right arrow step one frame, with Shift ten \u00b7 Home and End go to the first and last frame \u00b7 comma and full stop go to the previous and next finding \u00b7 + and \u2212 zoom, 0 shows the whole take \u00b7 1 front, 2 side, 3 top, 4 orbit \u00b7 F follows the body \u00b7 L loops \u00b7 in a table the arrow keys move between its controls';

function nameOf(path: string): string {
  return path === '-' ? 'standard input' : path.split(/[\\/]/).pop() || path;
}

function section(title: string, className: string): [HTMLElement, HTMLElement] {
  const head = element('div', { class: 'head' }, element('h2', {}, title));
  const made = element('section', { class: className, 'aria-label': title }, head);
  return [made, head];
}

function addBody(take: Take, player: Player): [HTMLElement, Body | null] {
  const [made, head] = section('Motion', 'body');
  const view = element('div', { class: 'view' });
  made.append(view);
  if (!take.isEverSeen) {
    view.append(element('p', { class: 'empty' }, take.told === 0 ? 'The take has no frames.' : take.points === 0 ? 'The take has no positions.' : 'Every marker is missing in every frame.'));
    return [made, null];
  }
  const renderer = makeRenderer();
  if (renderer === null) {
    view.replaceChildren(element('p', { class: 'empty' }, 'This browser cannot show the body in 3D, because WebGL is off. The rest of the page works.'));
    return [made, null];
  }
  const body = new Body(view, take, player, renderer);
  const views: [View, string, string][] = [['front', 'Front', '1'], ['side', 'Side', '2'], ['top', 'Top', '3'], ['orbit', 'Orbit', '4']];
  for (const [key, label, letter] of views) head.append(button(label, `view from ${{ front: 'the front', side: 'the side', top: 'the top', orbit: 'a corner' }[key]} (${letter})`, () => body.look(key)));
  const options: [keyof Body['options'], string, string][] = [['follow', 'Follow', 'move the camera with the body (F)']];
  if (take.data.two) {
    options.push(['apart', 'Apart', 'show the two side by side']);
    options.push(['before', take.data.labels[0], `show ${take.data.labels[0]}`], ['after', take.data.labels[1], `show ${take.data.labels[1]}`]);
  }
  for (const [key, label, title] of options) {
    const made_toggle = toggle(label, title, body.options[key], (on) => {
      if (key === 'apart') return body.setApart(on);
      body.options[key] = on;
      body.refresh();
      if (key === 'follow' && on) body.recentre();
    });
    made_toggle.dataset.option = key;
    if (key === 'before' || key === 'after') made_toggle.classList.add(key);
    head.append(made_toggle);
  }
  return [made, body];
}

function addCurves(take: Take, player: Player): [HTMLElement, Curves] {
  const [made, head] = section('Curves', 'curves');
  const holder = element('div', { class: 'panels' });
  const curves = new Curves(holder, take, player);
  if (take.isJoints) {
    const quantities: [Quantity, string][] = [['rotation', 'angles'], ['position', 'position']];
    head.append(choice('curves of', quantities, 'rotation', (value) => {
      curves.quantity = value as Quantity;
      curves.rebuild();
    }));
  }
  const kinds: [Kind, string][] = [['values', 'Values'], ['difference', 'Difference'], ['speed', 'Speed'], ['acceleration', 'Acceleration'], ['spectrum', 'Spectrum']];
  for (const [kind, label] of kinds) {
    if (kind === 'difference' && !take.data.two) continue;
    head.append(toggle(label, `show the ${label.toLowerCase()} of the chosen ${take.isJoints ? 'joints' : 'markers'}`, curves.kinds.has(kind), (on) => {
      if (on) curves.kinds.add(kind);
      else curves.kinds.delete(kind);
      curves.rebuild();
    }));
  }
  head.append(element('span', { class: 'gap' }),
    button('\u2212', 'zoom out (-)', () => player.zoomBy(1.6)), button('+', 'zoom in (+)', () => player.zoomBy(0.625)),
    button('\u2039', 'earlier', () => player.zoom(player.from - (player.to - player.from) / 2, (player.from + player.to) / 2)),
    button('\u203a', 'later', () => player.zoom((player.from + player.to) / 2, player.to + (player.to - player.from) / 2)),
    button('All', 'show the whole take (0)', () => player.zoom(0, take.told - 1)));
  made.append(holder);
  return [made, curves];
}

/** Presses a button above the body. */
export function pressOption(option: string): void { document.querySelector<HTMLButtonElement>(`[data-option="${option}"]`)?.click(); }

function listenToKeys(player: Player, take: Take, timeline: Timeline, body: Body | null, signal: AbortSignal): void {
  const keys: Record<string, (event: KeyboardEvent) => void> = {
    ' ': () => (player.playing ? player.pause() : player.play()),
    ArrowLeft: (event) => player.step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => player.step(event.shiftKey ? 10 : 1),
    Home: () => player.jump(0),
    End: () => player.jump(take.told - 1),
    ',': () => timeline.go(-1),
    '.': () => timeline.go(1),
    '+': () => player.zoomBy(0.625),
    '=': () => player.zoomBy(0.625),
    '-': () => player.zoomBy(1.6),
    '0': () => player.zoom(0, take.told - 1),
    '1': () => body?.look('front'),
    '2': () => body?.look('side'),
    '3': () => body?.look('top'),
    '4': () => body?.look('orbit'),
    f: () => pressOption('follow'),
    l: () => [...document.querySelectorAll('button')].find((one) => one.textContent === 'Loop')?.click(),
  };
  document.addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.altKey || event.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName)) return;
    // The space bar presses a button with the focus.
    if (event.key === ' ' && /^(BUTTON|SUMMARY)$/.test(target.tagName)) return;
    const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act(event);
  }, { signal });
}

/** The shown page of one take. */
export interface Shown {
  take: Take;
  player: Player;
  body: Body | null;
  timeline: Timeline;
  /** Null for a take without contacts. */
  stands: Stands | null;
  curves: Curves;
  /** Called before another page replaces this one. */
  dispose(): void;
}

/** Time, zoom, selection and camera are kept when the same take is shown again. */
function lookAsBefore(now: Shown, before: Shown): void {
  if (before.take.told !== now.take.told || before.take.data.names.length !== now.take.data.names.length) return;
  now.player.speed = before.player.speed;
  now.player.loop = before.player.loop;
  now.player.zoom(before.player.from, before.player.to);
  now.player.choose(before.player.chosen);
  now.player.seek(before.player.frame);
  if (now.body && before.body) {
    for (const [option, on] of Object.entries(before.body.options)) if (now.body.options[option as keyof Body['options']] !== on) pressOption(option);
    now.body.seeFrom(before.body.viewpoint());
  }
}

/** Warnings as findings, at the frames named in their text, or over the whole take. */
function warningsOf(entry: TakeEntry, names: string[]): Finding[] {
  const last = entry.first_frame + Math.max(0, entry.frames - 1);
  return entry.frames === 0 ? [] : entry.warnings.map((reason) => {
    const frames = /\bframes? (-?\d+)(?: to (-?\d+))?/.exec(reason);
    const time = /\bat (\d+(?:\.\d+)?) s\b/.exec(reason);
    const begin = frames ? Number(frames[1]) : time ? entry.first_frame + Math.round(Number(time[1]) * entry.frame_rate_hz) : null;
    const first = begin === null ? entry.first_frame : Math.min(last, Math.max(entry.first_frame, begin));
    const end = begin === null ? last : Math.min(last, Math.max(first, Number(frames?.[2] ?? begin)));
    const track = names.find((name) => reason.startsWith(`${name}: `)) ?? null;
    return { kind: 'warning', verdict: '', track, first_frame: first, last_frame: end, amount: null, unit: null, reason };
  });
}

export interface Around {
  /** Controls below the title. */
  panel?: HTMLElement[];
  /** The page that this one replaces. */
  before?: Shown | null;
  /** Called when the theme changes. */
  onTheme?: () => void;
  /** Returns whether a newer result is awaited; then this one is not shown, and an error says so. */
  isOver?: () => boolean;
}

/** The caller reports that the page is ready if it still is the latest. */
export async function showTake(page: HTMLElement, document_: ReportDocument, take: Take, { panel = [], before = null, onTheme, isOver = () => false }: Around = {}): Promise<Shown> {
  const ended = new AbortController();
  const entry = document_.takes[0];
  const { data } = take;
  const player = new Player(take.told, take.rate || 1);
  const loading = element('span', { class: 'loading' }, take.whole ? '' : 'loading the remaining frames\u2026');
  const title = element('h1', {}, nameOf(entry.input));
  const verdict = element('p', { class: 'verdict' }, entry.verdict ?? '');
  const [tableSection] = section(take.isJoints ? 'Joints' : 'Markers', 'tracks');
  const table = new TrackTable(tableSection, take, player, entry);
  const [timelineSection] = section('Findings and changes', 'found');
  const timeline = new Timeline(timelineSection, take, player, [...entry.findings, ...warningsOf(entry, data.names)], (finding) => {
    const tracks = take.tracksOf(finding.track);
    if (tracks.length > 0) player.choose(tracks.slice(0, 4));
  });
  const [standsSection] = section('Standing feet', 'stands');
  const stands = data.stage.contacts.length > 0 ? new Stands(standsSection, take, player) : null;
  await pause();
  if (isOver()) throw new Error('another result replaces this one');
  // The canvas of the body leaves its old page first: from here on, nothing is awaited until this page is shown.
  const [bodySection, body] = addBody(take, player);
  const transport = element('div', { class: 'transport' });
  addTransport(transport, take, player);
  bodySection.append(transport);
  const [curvesSection, curves] = addCurves(take, player);
  const facts = element('div', { class: 'facts' });
  addFacts(facts, take, document_, entry);
  const theme = themeButton(() => {
    body?.paint();
    timeline.draw();
    stands?.draw();
    curves.rebuild();
    onTheme?.();
  }, ended.signal);
  const header = element('header', {}, element('div', {}, title, verdict), loading, theme);
  const parts = [
    element('div', { class: 'top' }, bodySection, tableSection),
    timelineSection, ...(stands === null ? [] : [standsSection]), curvesSection, facts,
    element('footer', {}, element('p', {}, help)),
  ];
  // An element that is removed and inserted again would lose the focus.
  for (const child of [...page.children]) if (!panel.includes(child as HTMLElement)) child.remove();
  page.prepend(header);
  page.append(...panel.filter((one) => one.parentNode !== page), ...parts);
  if (data.step > 1) page.querySelector('header')?.after(element('p', { class: 'note' }, `This take is long: the page shows 1 frame in ${data.step}. The findings cover all ${counted(data.frames, 'frame')}.`));
  if (take.told > 0 && data.names.length > 0) player.choose([table.worst]);
  else player.choose([]);
  // The first frames may be a calibration pose.
  player.seek(Math.max(take.firstSeen(), take.frameOf(data.first_frame + (entry.calibration_frames ?? 0))));
  if (before === null && timeline.showWorst() !== null) table.reveal();
  body?.resize();
  body?.look('orbit');
  listenToKeys(player, take, timeline, body, ended.signal);
  const shown: Shown = {
    take, player, body, curves, timeline, stands,
    dispose: () => {
      ended.abort();
      player.pause();
      body?.dispose();
    },
  };
  Object.assign(window, { kinemend: shown });
  if (before !== null) {
    lookAsBefore(shown, before);
    before.dispose();
  }
  await pause();
  curves.start();
  await take.loadRest();
  loading.remove();
  if (data.stride > 1 && !ended.signal.aborted) {
    curves.forget();
    player.refresh();
  }
  await curves.whole;
  return shown;
}
