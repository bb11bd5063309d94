// Everything found and changed over time, as lanes by kind and as a list.

import { button, colour, counted, element, figure, fittedContext, isolated, placeCursor, words } from './dom';
import type { Player } from './player';
import type { Finding } from './report';
import { oneTabStop } from './roving';
import type { Take } from './take';
import { rankOf, worstFrame, worstOf } from './worst';

const laneHeight = 18;
const mostListed = 200;

/** A given take supplies short track names. */
export function textOf(finding: Finding, take?: Take): string {
  const frames = finding.first_frame === finding.last_frame ? `frame ${finding.first_frame}` : `frames ${finding.first_frame} to ${finding.last_frame}`;
  const parts = [`${words(finding.kind)} ${words(finding.verdict)}`.trim()];
  const tracks = take?.tracksOf(finding.track) ?? [];
  if (finding.track) parts.push(tracks.length > 0 ? tracks.map((track) => isolated((take as Take).shortName(track))).join(', ') : isolated(finding.track));
  parts.push(frames);
  if (finding.method) parts.push(`by ${finding.method}`);
  if (finding.amount !== null) parts.push(`${figure(finding.amount)} ${finding.unit ?? ''}`.trim());
  if (finding.reason) parts.push(finding.reason);
  return parts.join(' \u00b7 ');
}

export class Timeline {
  selected = -1;
  /** Width of the canvas, cached because querying the browser is slow. */
  private width = 1;
  readonly shown: Finding[];
  private readonly kinds: string[];
  private readonly hidden = new Set<string>();
  private readonly canvas = element('canvas', { tabindex: '0', role: 'slider', 'aria-valuemin': '0', 'aria-label': 'Findings over time: arrow keys step from one to the next' });
  private readonly lanes = element('div', { class: 'lanes' });
  private readonly cursor = element('i', { class: 'time-cursor' });
  private readonly words = element('p', { class: 'selected', role: 'status' });
  private readonly tally = element('span', { class: 'tally' });
  private readonly list = element('ol', { class: 'findings' });
  private readonly all: Finding[];

  constructor(holder: HTMLElement, private readonly take: Take, private readonly player: Player, findings: Finding[],
    private readonly onSelect: (finding: Finding) => void) {
    this.all = findings.map((finding, i) => ({ finding, i })).sort((a, b) => a.finding.first_frame - b.finding.first_frame || a.i - b.i).map(({ finding }) => finding);
    this.shown = [...this.all];
    this.kinds = [...new Set(findings.map((finding) => finding.kind))].sort((a, b) => rankOf(a) - rankOf(b) || a.localeCompare(b));
    // Smoothing is nearly everywhere: it is drawn, but the arrows skip it.
    if (this.kinds.length > 1 && this.kinds.includes('noise')) this.hidden.add('noise');
    if (findings.length === 0) {
      holder.append(element('p', { class: 'empty' }, 'Nothing was found, and nothing was changed.'));
      return;
    }
    const previous = button('\u2039', 'previous finding (,)', () => this.go(-1));
    const next = button('\u203a', 'next finding (.)', () => this.go(1));
    holder.append(element('div', { class: 'timeline' }, this.lanes, element('div', { class: 'lane-field' }, this.canvas, this.cursor)), element('div', { class: 'finding' }, previous, next, this.words, this.tally),
      element('details', {}, element('summary', {}, 'List of findings'), this.list));
    this.addLanes();
    oneTabStop(this.list, 'li');
    this.filter();
    this.canvas.addEventListener('click', (event) => this.click(event));
    this.canvas.addEventListener('mousemove', (event) => {
      const found = this.at(event);
      this.canvas.title = found === null ? '' : textOf(found);
    });
    this.canvas.addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowRight' && event.key !== 'ArrowLeft') return;
      event.preventDefault();
      event.stopPropagation();
      this.go(event.key === 'ArrowRight' ? 1 : -1);
    });
    player.onMove(() => this.drawCursor());
    player.onZoom(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement as HTMLElement);
    this.describe();
    this.draw();
  }

  private addLanes(): void {
    for (const kind of this.kinds) {
      const count = this.all.filter((finding) => finding.kind === kind).length;
      const row = button('', `show ${words(kind)} in the list, and stop at it with the arrows`, () => {
        if (!this.hidden.delete(kind)) this.hidden.add(kind);
        row.setAttribute('aria-pressed', String(!this.hidden.has(kind)));
        this.filter();
      }, !this.hidden.has(kind));
      const sample = element('i', { class: 'swatch' });
      sample.style.background = `var(--kind-${kind}, var(--kind-other))`;
      row.append(sample, element('span', {}, words(kind)), element('span', { class: 'count' }, String(count)));
      this.lanes.append(row);
    }
    this.canvas.style.height = `${laneHeight * this.kinds.length}px`;
  }

  private filter(): void {
    const current = this.shown[this.selected];
    this.shown.splice(0, this.shown.length, ...this.all.filter((finding) => !this.hidden.has(finding.kind)));
    this.selected = current ? this.shown.indexOf(current) : -1;
    this.list.replaceChildren(...this.shown.slice(0, mostListed).map((finding, i) => {
      const row = element('button', { type: 'button', title: textOf(finding) }, textOf(finding, this.take));
      row.addEventListener('click', () => this.select(i));
      return element('li', {}, row);
    }));
    if (this.shown.length > mostListed) this.list.append(element('li', { class: 'empty' }, `and ${counted(this.shown.length - mostListed, 'more finding')}`));
    this.describe();
    this.draw();
  }

  /** Counts findings; drawn warnings and spans that were only smoothed are not findings. */
  private counts(): string {
    const count = (kind: string): number => this.all.filter((one) => one.kind === kind).length;
    const warnings = count('warning');
    const smoothed = count('noise');
    return [counted(this.all.length - warnings - smoothed, 'finding'), ...(warnings > 0 ? [counted(warnings, 'warning')] : []), ...(smoothed > 0 ? [counted(smoothed, 'smoothed span')] : [])].join(', ');
  }

  private describe(): void {
    const finding = this.shown[this.selected];
    this.canvas.setAttribute('aria-valuemax', String(this.shown.length));
    this.canvas.setAttribute('aria-valuenow', String(this.selected + 1));
    this.canvas.setAttribute('aria-valuetext', finding ? textOf(finding) : `${counted(this.shown.length, 'finding')}, none is chosen`);
    this.words.textContent = finding ? textOf(finding, this.take) : 'Click a bar to go to its frame.';
    this.words.title = finding ? textOf(finding) : '';
    this.tally.textContent = this.counts();
    this.list.querySelector('[aria-current]')?.removeAttribute('aria-current');
    this.list.children[this.selected]?.setAttribute('aria-current', 'true');
    const row = this.list.children[this.selected] as HTMLElement | undefined;
    // Scrolls the list, not the page.
    if (row) this.list.scrollTop = Math.max(0, row.offsetTop - this.list.offsetTop - this.list.clientHeight / 2);
  }

  /** Chooses the worst finding and goes to the frame with the largest error or change. Returns null for a take without findings. */
  showWorst(): Finding | null {
    const worst = worstOf(this.all);
    if (worst === null) return null;
    this.unhide(worst.kind);
    this.select(this.shown.indexOf(worst));
    this.player.jump(worstFrame(this.take, worst));
    return worst;
  }

  go(by: number): void {
    if (this.shown.length === 0) return;
    if (this.selected < 0) {
      const number = this.take.number(this.player.shown);
      const after = this.shown.findIndex((finding) => finding.first_frame > number);
      const start = by > 0 ? after : (after < 0 ? this.shown.length : after) - 1;
      return this.select((start + this.shown.length) % this.shown.length);
    }
    this.select((this.selected + by + this.shown.length) % this.shown.length);
  }

  select(index: number): void {
    const finding = this.shown[index];
    if (!finding) return;
    this.selected = index;
    this.player.pause();
    this.player.jump(this.take.frameOf(finding.first_frame));
    this.onSelect(finding);
    this.describe();
    this.draw();
  }

  private x(frame: number): number {
    return ((frame - this.player.from) / (this.player.to - this.player.from)) * this.width;
  }
  private span(finding: Finding): [number, number] {
    const { step, first_frame } = this.take.data;
    const from = this.x((finding.first_frame - first_frame) / step);
    const to = this.x((finding.last_frame - first_frame + 1) / step);
    return [from, Math.max(to, from + 3)];
  }

  private at(event: MouseEvent): Finding | null {
    const kind = this.kinds[Math.floor(event.offsetY / laneHeight)];
    let best: Finding | null = null;
    let width = Infinity;
    for (const finding of this.all) {
      if (finding.kind !== kind) continue;
      const [from, to] = this.span(finding);
      if (event.offsetX < from - 2 || event.offsetX > to + 2 || to - from >= width) continue;
      best = finding;
      width = to - from;
    }
    return best;
  }

  private unhide(kind: string): void {
    if (!this.hidden.delete(kind)) return;
    this.lanes.children[this.kinds.indexOf(kind)]?.setAttribute('aria-pressed', 'true');
    this.filter();
  }

  private click(event: MouseEvent): void {
    const finding = this.at(event);
    if (finding === null) {
      const width = this.player.to - this.player.from;
      return this.player.seek(Math.round(this.player.from + (event.offsetX / this.canvas.clientWidth) * width));
    }
    this.unhide(finding.kind);
    this.select(this.shown.indexOf(finding));
  }

  draw(): void {
    const context = fittedContext(this.canvas);
    if (context === null) return;
    const { clientWidth } = this.canvas;
    this.width = clientWidth;
    context.strokeStyle = colour('grid');
    for (let lane = 1; lane < this.kinds.length; ++lane) {
      context.beginPath();
      context.moveTo(0, lane * laneHeight - 0.5);
      context.lineTo(clientWidth, lane * laneHeight - 0.5);
      context.stroke();
    }
    const paints = this.kinds.map((kind) => colour(`kind-${kind}`) || colour('kind-other'));
    const laneOf = new Map(this.kinds.map((kind, lane) => [kind, lane]));
    for (const finding of this.all) {
      const [from, to] = this.span(finding);
      if (to < 0 || from > clientWidth) continue;
      const lane = laneOf.get(finding.kind) ?? 0;
      const chosen = finding === this.shown[this.selected];
      this.bar(context, from, lane * laneHeight + 3, to - from, paints[lane], finding.verdict === 'refused', chosen);
    }
    this.drawCursor();
  }

  /** Drawn separately from the bars, of which there may be thousands. */
  private drawCursor(): void {
    placeCursor(this.cursor, this.x(this.player.shown), this.width);
  }

  /** A refused finding is drawn as an outline. */
  private bar(context: CanvasRenderingContext2D, x: number, y: number, width: number, paint: string, hollow: boolean, chosen: boolean): void {
    const height = laneHeight - 7;
    context.globalAlpha = chosen || hollow ? 1 : 0.75;
    context.fillStyle = paint;
    context.strokeStyle = chosen ? colour('text') : paint;
    context.lineWidth = chosen ? 2 : 1.5;
    if (!hollow) context.fillRect(x, y, width, height);
    if (hollow || chosen) context.strokeRect(x + 0.75, y + 0.75, Math.max(1.5, width - 1.5), height - 1.5);
    context.globalAlpha = 1;
  }
}
