// Compares the methods over one gap: a curve and a button for each method.

import uPlot from 'uplot';
import { frameSteps } from './curves';
import { button, colour, describeCanvas, element, figure, isolated } from './dom';
import type { GapCurves, PlannedGap } from './served';
import type { Take } from './take';

type Curve = GapCurves['curves'][number];

const height = 170;

export class GapPreview {
  readonly element = element('section', { class: 'gap-preview', hidden: true, tabindex: '-1' });
  private readonly head = element('h3');
  private readonly words = element('p', { class: 'status', role: 'status' });
  private readonly plots = element('div', { class: 'gap-plots' });
  private readonly methods = element('div', { class: 'gap-methods', role: 'group', 'aria-label': 'method of this gap' });
  private shown: uPlot[] = [];
  private curves: GapCurves | null = null;
  private gap: PlannedGap | null = null;
  private take: Take | null = null;

  /** `choose` fills the gap with a method, with the verdict `force` if its rules refuse. */
  constructor(private readonly choose: (gap: PlannedGap, method: string, isForced: boolean) => void, close: () => void) {
    const closing = button('Close', 'close the comparison', () => {
      this.hide();
      close();
    });
    this.element.append(element('div', { class: 'head' }, this.head, element('span', { class: 'gap' }), closing), this.words, this.methods, this.plots);
    new ResizeObserver(() => this.resize()).observe(this.plots);
  }

  /** The gap whose curves are shown or being computed. */
  get open(): PlannedGap | null { return this.element.hidden ? null : this.gap; }

  hide(): void {
    this.element.hidden = true;
    this.gap = null;
    this.clear();
  }

  /** Shows that curves are awaited; curves of the same gap stay. */
  wait(gap: PlannedGap): void {
    const isSame = this.gap !== null && this.gap.name === gap.name && this.gap.quantity === gap.quantity && this.gap.first_frame === gap.first_frame;
    if (!isSame) this.clear();
    this.gap = gap;
    this.element.hidden = false;
    this.head.textContent = `${isolated(gap.name)}, frames ${gap.first_frame} to ${gap.last_frame}`;
    this.say('trying every method\u2026');
    if (this.curves !== null) this.mark();
  }

  say(text: string): void { this.words.textContent = text; }

  show(curves: GapCurves, take: Take): void {
    this.curves = curves;
    this.take = take;
    this.say('Click a curve or a name to fill the gap by that method. Dotted: the method refuses this gap.');
    this.mark();
    this.redraw();
  }

  private clear(): void {
    this.curves = null;
    for (const plot of this.shown) plot.destroy();
    this.shown = [];
    this.plots.replaceChildren();
    this.methods.replaceChildren();
  }

  private stroke(place: number): string { return `method-${(place % 10) + 1}`; }

  /** Draws the buttons; a focused one keeps the focus. */
  private mark(): void {
    const { gap, curves } = this;
    if (gap === null || curves === null) return;
    const focused = (document.activeElement as HTMLElement | null)?.dataset.method;
    this.methods.replaceChildren(...curves.curves.map((curve, place) => {
      const chosen = curve.method === gap.method && gap.verdict !== 'refuse';
      const made = button('', curve.filled ? `fill the gap by ${curve.method}` : `fill the gap by ${curve.method}, although the method refuses it`, () => this.choose(gap, curve.method, !curve.filled), chosen);
      made.dataset.method = curve.method;
      made.dataset.filled = String(curve.filled);
      const sample = element('i', { class: 'swatch' });
      sample.style.background = this.isDrawn(curve) ? `var(--${this.stroke(place)})` : 'none';
      made.append(sample, element('span', { class: 'name' }, curve.method), element('span', { class: 'told' }, this.told(curve, gap)));
      made.addEventListener('focus', () => this.stress(place));
      made.addEventListener('mouseenter', () => this.stress(place));
      made.addEventListener('mouseleave', () => this.stress(null));
      made.addEventListener('blur', () => this.stress(null));
      return made;
    }));
    if (focused !== undefined) this.methods.querySelector<HTMLElement>(`[data-method="${focused}"]`)?.focus();
  }

  private isDrawn(curve: Curve): boolean {
    const gap = this.gap;
    const curves = this.curves;
    if (gap === null || curves === null || this.take === null) return false;
    const at = gap.first_frame - this.take.data.first_frame - curves.first;
    return curve.values.some((values) => values[at] !== null && values[at] !== undefined);
  }

  private told(curve: Curve, gap: PlannedGap): string {
    if (!curve.filled) return `refused: ${curve.reason}`;
    const parts: string[] = [];
    if (curve.expected_error !== null) parts.push(`expected error ${figure(curve.expected_error)} ${gap.unit}`.trim());
    if (curve.distance !== null && curve.distance > 0) parts.push(`${figure(curve.distance)} ${gap.unit}`.trim() + ' from the fill of the plan');
    return parts.join(', ');
  }

  private stress(place: number | null): void {
    for (const plot of this.shown) plot.setSeries(place === null ? null : place + 1, { focus: true });
  }

  private get width(): number {
    const columns = Math.max(1, Math.min(this.curves?.axes.length ?? 1, Math.floor(this.plots.clientWidth / 260)));
    return Math.max(180, Math.floor(this.plots.clientWidth / columns) - 12);
  }

  private resize(): void {
    for (const plot of this.shown) {
      if (Math.abs(plot.width - this.width) > 1) plot.setSize({ width: this.width, height });
    }
  }

  /** Redraws, also after a change of theme. */
  redraw(): void {
    const { gap, curves, take } = this;
    if (gap === null || curves === null || take === null) return;
    for (const plot of this.shown) plot.destroy();
    this.shown = [];
    this.plots.replaceChildren(...curves.axes.map((name) => element('figure', { class: 'panel' }, element('figcaption', {}, element('b', {}, name), ` ${gap.unit}`))));
    curves.axes.forEach((_, axis) => this.addPlot(this.plots.children[axis] as HTMLElement, gap, curves, take, axis));
  }

  private addPlot(holder: HTMLElement, gap: PlannedGap, curves: GapCurves, take: Take, axis: number): void {
    const first = curves.first + take.data.first_frame;
    const x = Array.from({ length: curves.last - curves.first + 1 }, (_, i) => first + i);
    const inGap = (frame: number): boolean => frame >= gap.first_frame && frame <= gap.last_frame;
    // Each curve includes the samples beside the gap, so that it joins them.
    const own = curves.curves.map((curve) => curve.values[axis].map((value, i) => (inGap(x[i] + 1) || inGap(x[i] - 1) || inGap(x[i]) ? value : null)));
    const measured = (curves.curves[0]?.values[axis] ?? []).map((value, i) => (inGap(x[i]) ? null : value));
    const line = { stroke: colour('quiet'), grid: { stroke: colour('grid'), width: 1 }, ticks: { stroke: colour('grid'), width: 1 }, font: '11px system-ui, sans-serif' };
    let near = -1;
    const plot = new uPlot({
      width: this.width,
      height,
      padding: [6, 22, 0, 0],
      legend: { show: false },
      scales: { x: { time: false } },
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false }, focus: { prox: 14 } },
      focus: { alpha: 0.2 },
      series: [{ label: 'frame' },
        ...curves.curves.map((curve, place) => ({ label: curve.method, stroke: colour(this.stroke(place)), width: curve.method === gap.method ? 3 : 1.5, dash: curve.method === gap.method ? undefined : curve.filled ? [6, 3] : [2, 4], points: { show: false } })),
        { label: 'measured', stroke: colour('text'), width: 2, points: { show: gap.length_frames < 3 } }],
      axes: [{ ...line, size: 28, incrs: frameSteps }, { ...line, size: 60 }],
      hooks: {
        drawClear: [(made) => this.shade(made, gap)],
        setSeries: [(_made, index) => { near = index === null ? -1 : index - 1; }],
      },
    }, [x, ...own, measured] as uPlot.AlignedData, holder);
    plot.over.addEventListener('click', () => {
      const curve = curves.curves[near];
      if (curve) this.choose(this.gap ?? gap, curve.method, !curve.filled);
    });
    describeCanvas(holder.querySelector('canvas'), `${gap.name}, ${curves.axes[axis]}${gap.unit ? ` in ${gap.unit}` : ''}: curves of ${curves.curves.map(({ method }) => method).join(', ')} over frames ${gap.first_frame} to ${gap.last_frame}`);
    this.shown.push(plot);
  }

  /** Shades the gap behind the curves. */
  private shade(plot: uPlot, gap: PlannedGap): void {
    const from = plot.valToPos(gap.first_frame - 0.5, 'x', true);
    const to = plot.valToPos(gap.last_frame + 0.5, 'x', true);
    plot.ctx.save();
    plot.ctx.fillStyle = colour('chosen');
    plot.ctx.fillRect(from, plot.bbox.top, to - from, plot.bbox.height);
    plot.ctx.restore();
  }
}
