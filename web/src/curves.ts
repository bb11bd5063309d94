// Curves of the chosen tracks: values, difference, speed, acceleration, spectrum.

import uPlot from 'uplot';
import { colour, describeCanvas, element, isolated } from './dom';
import type { Player } from './player';
import { pause } from './slices';
import { accelerationOf, accelerationOfSteps, speedOf, spectrumOf, turningSpeed } from './signal';
import { turnBetween, type Take, type Which } from './take';

type Values = (number | null)[];
export type Kind = 'values' | 'difference' | 'speed' | 'acceleration' | 'spectrum';
export type Quantity = 'rotation' | 'position';

interface Line {
  label: string;
  values: Values;
  colour: string;
  width: number;
  dash?: number[];
}

/** Longer takes are drawn one panel at a time, so that the page stays responsive. Chosen by hand, not swept. */
const framesAtOnce = 10_000;
/** Numbers that change faster cannot be read. */
const restOfLegend_ms = 100;
const axisColours = ['axis-1', 'axis-2', 'axis-3'];
const superscript = '\u00b2';

/** The plotting library hides the points of a hidden line, so that there must be some; the style sheet hides them all. */
const hiddenPoints: uPlot.Cursor.Points = { show: () => element('i') };

/** Power at the level of rounding errors is left out, because the logarithmic axis would span thirty decades and never finish its ticks. */
function aboveRounding(density: number[]): Values {
  const least = Math.max(1e-15, 1e-12 * Math.max(...density));
  return density.map((value) => (value > least ? value : null));
}

/** Ticks are at whole frames. */
export const frameSteps = [1, 2, 5].flatMap((digit) => Array.from({ length: 9 }, (_, power) => digit * 10 ** power)).sort((a, b) => a - b);

/** Shortens a number to fit beside the panel. */
function tickText(tick: number): string {
  const rounded = Number(tick.toPrecision(10));
  return Math.abs(rounded) >= 1e5 ? `${(rounded / 1000).toLocaleString('en-US')}k` : rounded.toLocaleString('en-US', { maximumFractionDigits: 6 });
}

/** One track of one quantity in both takes. */
class Signal {
  readonly names: string[];
  readonly unit: string;
  private readonly axes = new Map<Which, Values[]>();

  constructor(readonly take: Take, readonly track: number, readonly quantity: Quantity) {
    const turns = quantity === 'rotation';
    this.names = turns ? [...take.order(track)] : ['X', 'Y', 'Z'];
    this.unit = turns ? 'deg' : take.data.unit || 'units';
    for (const which of take.takes) this.axes.set(which, turns ? take.angles(track, which) : take.path(track, which));
  }

  of(which: Which): Values[] { return this.axes.get(which) ?? []; }

  private turns(which: Which): (number[] | null)[] {
    const { take, track } = this;
    return Array.from({ length: Math.max(0, take.told - 1) }, (_, f) =>
      take.isMissing(track, f, which) || take.isMissing(track, f + 1, which) ? null : turnBetween(take.rotation(track, f, which), take.rotation(track, f + 1, which)));
  }
  speed(which: Which): Values {
    if (this.quantity === 'position') return speedOf(this.of(which), this.take.rate);
    return turningSpeed(this.turns(which), this.take.rate, this.take.told);
  }
  acceleration(which: Which): Values {
    if (this.quantity === 'position') return accelerationOf(this.of(which), this.take.rate);
    return accelerationOfSteps(this.turns(which), this.take.rate, this.take.told);
  }
  difference(): Values {
    const { take, track } = this;
    if (this.quantity === 'rotation') return take.turnsApart(track);
    const before = this.of('before');
    const after = this.of('after');
    return Array.from({ length: take.told }, (_, f) => {
      if (before.some((axis) => axis[f] === null) || after.some((axis) => axis[f] === null)) return null;
      return Math.hypot(...before.map((axis, a) => (after[a][f] as number) - (axis[f] as number)));
    });
  }
}

export class Curves {
  quantity: Quantity;
  kinds = new Set<Kind>(['values', 'difference']);
  plots: uPlot[] = [];
  private readonly signals = new Map<string, Signal>();
  private isStarted = false;
  private isZooming = false;
  private turn = 0;
  /** Resolves when all panels are drawn. */
  whole: Promise<void> = Promise.resolve();

  constructor(private readonly holder: HTMLElement, private readonly take: Take, private readonly player: Player) {
    this.quantity = take.isJoints ? 'rotation' : 'position';
    if (!take.data.two) this.kinds = new Set<Kind>(['values']);
    player.onChoice(() => this.rebuild());
    player.onZoom(() => this.rescale());
    player.onMove(() => this.drawCursor());
    new ResizeObserver(() => this.resize()).observe(holder);
  }

  /** Call it after the rest of a long take is loaded. */
  forget(): void {
    this.signals.clear();
    this.rebuild();
  }

  private signal(track: number): Signal {
    const key = `${this.quantity} ${track}`;
    const known = this.signals.get(key);
    if (known) return known;
    const made = new Signal(this.take, track, this.quantity);
    this.signals.set(key, made);
    return made;
  }

  private label(which: Which): string { return this.take.data.labels[which === 'before' ? 0 : 1]; }

  private pair(of: (which: Which) => Values): Line[] {
    return this.take.takes.map((which) => ({
      label: this.take.data.two ? this.label(which) : 'value',
      values: of(which),
      colour: this.take.data.two ? which : 'after',
      width: which === this.take.last ? 1.5 : 1,
    }));
  }

  private lines(signal: Signal, kind: Kind): Line[] {
    if (kind === 'speed') return this.pair((which) => signal.speed(which));
    if (kind === 'acceleration') return this.pair((which) => signal.acceleration(which));
    if (kind === 'difference') return [{ label: 'difference', values: signal.difference(), colour: 'text', width: 1.25 }];
    const lines: Line[] = [];
    for (const which of this.take.takes) {
      const isFaint = which === 'before' && this.take.data.two;
      signal.of(which).forEach((values, a) => lines.push({
        label: this.take.data.two ? `${signal.names[a]} ${this.label(which)}` : signal.names[a],
        values,
        colour: axisColours[a] + (isFaint ? '-faint' : ''),
        width: isFaint ? 1 : 1.6,
      }));
    }
    return lines;
  }

  private unit(signal: Signal, kind: Kind): string {
    if (kind === 'speed') return `${signal.unit}/s`;
    if (kind === 'acceleration') return `${signal.unit}/s${superscript}`;
    return signal.unit;
  }

  /** Draws for the first time. */
  start(): void {
    this.isStarted = true;
    this.rebuild();
  }

  rebuild(): void {
    if (!this.isStarted) return;
    ++this.turn;
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    this.holder.replaceChildren();
    if (this.take.told === 0) {
      this.holder.append(element('p', { class: 'empty' }, 'The take has no frames.'));
      return;
    }
    if (this.player.chosen.length === 0) {
      const noun = this.take.isJoints ? 'joint' : 'marker';
      this.holder.append(element('p', { class: 'empty' }, `Choose a ${noun} in the table to show its curves.`));
      return;
    }
    const panels = this.player.chosen.flatMap((track) => this.panelsOf(track));
    if (this.take.told <= framesAtOnce) {
      for (const add of panels) add();
      this.rescale();
      this.drawCursor();
      this.whole = Promise.resolve();
    } else {
      this.whole = this.addInTurn(panels, this.turn);
    }
  }

  private async addInTurn(panels: (() => void)[], turn: number): Promise<void> {
    for (const add of panels) {
      await pause();
      if (turn !== this.turn) return;
      add();
      this.rescale();
      this.drawCursor();
    }
  }

  /** Each function adds one panel. */
  private panelsOf(track: number): (() => void)[] {
    const order: Kind[] = ['values', 'difference', 'speed', 'acceleration', 'spectrum'];
    const kinds = order.filter((kind) => this.kinds.has(kind) && (kind !== 'difference' || this.take.data.two));
    let isEmpty = false;
    return [() => { isEmpty = this.addWords(track); }, ...kinds.map((kind) => () => { if (!isEmpty) this.addKind(track, kind); })];
  }

  /** Shows why there is nothing to draw; returns whether that is so. */
  private addWords(track: number): boolean {
    const signal = this.signal(track);
    const name = this.take.nameOf(track);
    if (signal.names.length === 0) {
      this.holder.append(element('p', { class: 'empty' }, `${name} has no rotation in this take.`));
      return true;
    }
    if (this.take.takes.every((which) => signal.of(which).every((values) => values.every((value) => value === null)))) {
      this.holder.append(element('p', { class: 'empty' }, `${isolated(name)} is missing in every frame.`));
      return true;
    }
    return false;
  }

  private addKind(track: number, kind: Kind): void {
    const signal = this.signal(track);
    const name = this.take.nameOf(track);
    const what = kind === 'values' ? (this.quantity === 'rotation' ? 'angles' : 'position') : kind;
    const unit = kind === 'spectrum' ? `${signal.unit}${superscript}/Hz` : this.unit(signal, kind);
    const panel = element('figure', { class: 'panel' }, element('figcaption', {}, element('b', {}, isolated(name)), ` ${what}, ${unit}`));
    this.holder.append(panel);
    if (kind === 'spectrum') this.addSpectrum(panel, signal);
    else this.addPanel(panel, this.lines(signal, kind));
    describeCanvas(panel.querySelector('canvas'), `${name}, ${what} in ${unit}${this.take.data.two ? `: ${this.take.data.labels.join(' and ')}` : ''}`);
  }

  private common(width: number): Pick<uPlot.Options, 'width' | 'height'> & { axis: Partial<uPlot.Axis> } {
    return {
      width,
      height: 150,
      axis: { stroke: colour('quiet'), grid: { stroke: colour('grid'), width: 1 }, ticks: { stroke: colour('grid'), width: 1 }, font: '11px system-ui, sans-serif' },
    };
  }

  private get width(): number { return Math.max(200, this.holder.clientWidth - 2); }

  private addPanel(panel: HTMLElement, lines: Line[]): void {
    const { axis, ...size } = this.common(this.width);
    const x = Array.from({ length: this.take.told }, (_, f) => this.take.number(f));
    const options: uPlot.Options = {
      ...size,
      padding: [6, 22, 0, 0],
      scales: { x: { time: false } },
      cursor: { y: false, sync: { key: 'kinemend' }, drag: { x: true, y: false, setScale: true }, points: hiddenPoints },
      series: [{ label: 'frame' }, ...lines.map((line) => ({ label: line.label, stroke: colour(line.colour), width: line.width, points: { show: this.take.told < 3 } }))],
      axes: [{ ...axis, size: 30, incrs: frameSteps }, { ...axis, size: 68, values: (_plot, ticks) => ticks.map(tickText) }],
      hooks: {
        setScale: [(plot, key) => { if (key === 'x') this.takeZoom(plot); }],
        draw: [(plot) => this.cursorIn(plot)],
        ready: [(plot) => this.listen(plot)],
      },
    };
    this.plots.push(new uPlot(options, [x, ...lines.map((line) => line.values)] as uPlot.AlignedData, panel));
  }

  /** A click sets the time, the wheel zooms, a double click shows the whole take. */
  private listen(plot: uPlot): void {
    plot.over.append(element('i', { class: 'time-cursor' }));
    this.cursorIn(plot);
    let from = 0;
    plot.over.addEventListener('mousedown', (event) => { from = event.clientX; });
    plot.over.addEventListener('click', (event) => {
      if (Math.abs(event.clientX - from) < 3) this.player.seek(this.take.frameOf(plot.posToVal(event.offsetX, 'x')));
    });
    plot.over.addEventListener('dblclick', () => this.player.zoom(0, this.take.told - 1));
    plot.over.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && !event.shiftKey) return;
      event.preventDefault();
      const at = this.take.frameOf(plot.posToVal(event.offsetX, 'x'));
      this.player.zoomBy(event.deltaY + event.deltaX > 0 ? 1.25 : 0.8, at);
    }, { passive: false });
  }

  private takeZoom(plot: uPlot): void {
    const { min, max } = plot.scales.x;
    if (this.isZooming || min === undefined || max === undefined || min === null || max === null || plot.status !== 1) return;
    const { step, first_frame } = this.take.data;
    this.player.zoom((min - first_frame) / step, (max - first_frame) / step);
  }

  private rescale(): void {
    this.isZooming = true;
    const min = this.take.number(this.player.from);
    const max = this.take.number(this.player.to);
    for (const plot of this.plots) plot.setScale('x', { min, max });
    // Scales are set when the plots next draw.
    queueMicrotask(() => queueMicrotask(() => { this.isZooming = false; }));
  }

  /** Moves the time line over the curves, because redrawing all curves for each frame would take too long. */
  private cursorIn(plot: uPlot): void {
    const line = plot.over.querySelector<HTMLElement>('.time-cursor');
    if (line === null) return;
    const x = plot.valToPos(this.take.number(this.player.shown), 'x');
    line.hidden = !(x >= 0 && x <= plot.over.clientWidth);
    if (!line.hidden) line.style.transform = `translateX(${x}px)`;
  }
  private drawCursor(): void {
    for (const plot of this.plots) this.cursorIn(plot);
    const now = performance.now();
    if (this.player.playing && now - this.told < restOfLegend_ms) return;
    this.told = now;
    for (const plot of this.plots) {
      // The legend shows the values at the mouse, or else at the current time.
      queueMicrotask(() => { if ((plot.cursor.left ?? -1) < 0) plot.setLegend({ idx: this.player.shown }, false); });
    }
  }
  private told = 0;

  private addSpectrum(panel: HTMLElement, signal: Signal): void {
    const { axis, ...size } = this.common(this.width);
    const spectra = this.take.takes.map((which) => spectrumOf(signal.of(which), this.take.rate));
    if (spectra.every((spectrum) => spectrum.hertz.length === 0)) {
      panel.append(element('p', { class: 'empty' }, 'A spectrum needs more samples without a gap.'));
      return;
    }
    const hertz = spectra.find((spectrum) => spectrum.hertz.length > 0)?.hertz ?? [];
    const series = this.take.takes.map((which) => ({
      label: this.take.data.two ? this.label(which) : 'density',
      stroke: colour(this.take.data.two ? which : 'after'),
      width: 1.5,
    }));
    const plot = new uPlot({
      ...size,
      padding: [6, 22, 0, 0],
      scales: { x: { time: false }, y: { distr: 3 } },
      cursor: { y: false, points: hiddenPoints },
      series: [{ label: 'Hz' }, ...series],
      axes: [{ ...axis, size: 30, values: (_plot, ticks) => ticks.map((tick) => `${tick} Hz`) }, { ...axis, size: 68, values: (_plot, ticks) => ticks.map((tick) => (tick === null || Math.log10(tick) % 1 ? '' : tick.toExponential(0))) }],
    }, [hertz, ...spectra.map(({ density }) => aboveRounding(density))] as uPlot.AlignedData, panel);
    panel.dataset.spectrum = 'true';
    this.spectra.push(plot);
  }
  private spectra: uPlot[] = [];

  private resize(): void {
    for (const plot of [...this.plots, ...this.spectra]) {
      if (Math.abs(plot.width - this.width) > 1) plot.setSize({ width: this.width, height: 150 });
    }
  }
}
