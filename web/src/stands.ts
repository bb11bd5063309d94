// The times in which each foot stands, as lanes: the surer a stand, the stronger its bar.

import { colour, element, figure, fittedContext, placeCursor } from './dom';
import type { Player } from './player';
import type { StageContact } from './report';
import type { Take } from './take';

const laneHeight = 16;
/** How visible a bar of confidence 0 is. */
const leastVisible = 0.15;

export class Stands {
  private readonly feet: string[];
  private readonly contacts: StageContact[];
  private readonly canvas = element('canvas', { role: 'img', 'aria-label': 'Times in which feet stand; stronger bars are surer' });
  private readonly cursor = element('i', { class: 'time-cursor' });
  private width = 1;

  constructor(holder: HTMLElement, private readonly take: Take, private readonly player: Player) {
    this.contacts = take.data.stage.contacts;
    this.feet = [...new Set(this.contacts.map(({ foot }) => foot))].sort((a, b) => a.localeCompare(b));
    if (this.feet.length === 0) {
      holder.append(element('p', { class: 'empty' }, 'No contacts of feet with the floor were found.'));
      return;
    }
    const lanes = element('div', { class: 'lanes' });
    for (const foot of this.feet) {
      const own = this.contacts.filter((contact) => contact.foot === foot);
      const seconds = own.reduce((sum, { first, last }) => sum + (last - first + 1) / this.rate, 0);
      lanes.append(element('p', { class: 'lane', title: `${foot}: ${own.length} times, ${figure(seconds)} s` }, element('span', {}, foot), element('span', { class: 'count' }, `${figure(seconds)} s`)));
    }
    this.canvas.style.height = `${laneHeight * this.feet.length}px`;
    holder.append(element('div', { class: 'stand-lanes' }, lanes, element('div', { class: 'lane-field' }, this.canvas, this.cursor)));
    this.canvas.addEventListener('click', (event) => {
      const span = this.player.to - this.player.from;
      this.player.seek(Math.round(this.player.from + (event.offsetX / this.canvas.clientWidth) * span));
    });
    this.canvas.addEventListener('mousemove', (event) => { this.canvas.title = this.textAt(event.offsetX, event.offsetY); });
    player.onMove(() => this.drawCursor());
    player.onZoom(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement as HTMLElement);
    this.draw();
  }

  /** Frames per second of the whole take, of which the page may hold one in several. */
  private get rate(): number { return (this.take.rate || 1) * this.take.data.step; }

  private x(frame: number): number {
    return ((frame / this.take.data.step - this.player.from) / (this.player.to - this.player.from)) * this.width;
  }

  private textAt(x: number, y: number): string {
    const foot = this.feet[Math.floor(y / laneHeight)];
    const found = this.contacts.find((contact) => contact.foot === foot && x >= this.x(contact.first) && x <= this.x(contact.last + 1));
    if (!found) return '';
    const { first_frame } = this.take.data;
    return `${foot} stands in frames ${found.first + first_frame} to ${found.last + first_frame}, confidence ${figure(found.confidence)}`;
  }

  draw(): void {
    const context = fittedContext(this.canvas);
    if (context === null) return;
    const { clientWidth } = this.canvas;
    this.width = clientWidth;
    context.fillStyle = colour('held');
    const laneOf = new Map(this.feet.map((foot, lane) => [foot, lane]));
    for (const contact of this.contacts) {
      const from = this.x(contact.first);
      const to = this.x(contact.last + 1);
      if (to < 0 || from > clientWidth) continue;
      context.globalAlpha = leastVisible + (1 - leastVisible) * contact.confidence;
      context.fillRect(from, (laneOf.get(contact.foot) ?? 0) * laneHeight + 3, Math.max(to - from, 1.5), laneHeight - 6);
    }
    context.globalAlpha = 1;
    this.drawCursor();
  }

  private drawCursor(): void {
    placeCursor(this.cursor, this.x(this.player.shown * this.take.data.step), this.width);
  }
}
