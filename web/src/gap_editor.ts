// The gap plan as a table: a row for each gap, with its method and verdict to choose.

import { button, choice, element, figure, grouped, toggle, headings } from './dom';
import { GapPreview } from './gap_preview';
import { oneTabStop } from './roving';
import type { GapCurves, GapPlan, PlannedGap, Session } from './served';
import type { Take } from './take';

const mostRows = 300;

export class GapEditor {
  readonly element = element('div');
  /** True if gaps are filled by this plan. */
  edited = false;
  /** True if every method is tried on every gap. */
  preview = false;
  private plan: GapPlan = { schema: '', gaps: [] };
  private readonly body = element('tbody');
  private readonly words = element('p', { class: 'empty' });
  private readonly looked: GapPreview;
  private take: Take | null = null;
  /** The first visible row, and the buttons for other rows. */
  private from = 0;
  private readonly pages = element('span', { class: 'controls', hidden: true });

  /** `curves` requests the curves of every method for a gap; null if a later request replaced this one. */
  constructor(private readonly session: Session, private readonly isJoints: boolean, private readonly goTo: (track: string, frame: number) => void,
    private readonly again: () => void, private readonly curves: (plan: string, row: number) => Promise<GapCurves | null>) {
    this.looked = new GapPreview((gap, method, isForced) => this.setMethod(gap, method, isForced), () => this.body.querySelector<HTMLElement>('[data-gap=curves]')?.focus());
    const heads = headings([[isJoints ? 'joint' : 'marker', 'Click a name to go to the gap.'], ['frames', 'First and last frame of the gap, as the file numbers them.'], ['length', 'Length of the gap in frames and seconds.'],
      ['verdict', 'fill: filled where the rules allow it; force: filled against the rules; refuse: stays open.'], ['method', 'How the gap is filled.'], ['curves', 'Compares the curves of all methods over the gap.'],
      ['filled by', 'The method that has filled the gap.'], ['expected error', 'How far the fill is expected to be from the truth, with its unit.'], ['why refused', 'Why the gap stays open.']]);
    heads[heads.length - 1].className = 'words';
    const tried = toggle('Try every method', 'show how far the fill of each method is from the one in use', false, (on) => {
      this.preview = on;
      again();
    });
    tried.dataset.action = 'preview';
    this.pages.append(button('\u2039', 'previous gaps', () => this.turn(-mostRows)), button('\u203a', 'next gaps', () => this.turn(mostRows)));
    const table = element('table', {}, element('thead', {}, element('tr', {}, ...heads)), this.body);
    this.element.append(element('div', { class: 'head' }, tried, button('Discard edits', 'fill by the controls above again', () => {
      this.edited = false;
      again();
    }), this.words, this.pages), element('p', { class: 'empty' }, 'Arrow keys move in the table. In a list of choices the up and down arrows change the choice; hold Ctrl to move.'),
      element('div', { class: 'scroll' }, table), this.looked.element);
    oneTabStop(table, 'tr');
  }

  text(): string { return JSON.stringify(this.plan); }

  show(plan: GapPlan, take: Take): void {
    this.plan = plan;
    this.take = take;
    this.list();
    const open = this.looked.open;
    if (open === null) return;
    const row = plan.gaps.findIndex((gap) => gap.name === open.name && gap.quantity === open.quantity && gap.first_frame === open.first_frame && gap.last_frame === open.last_frame);
    if (row < 0) this.looked.hide();
    else void this.look(row);
  }

  /** Shows further rows. */
  private turn(by: number): void {
    this.from += by;
    this.list();
  }

  private list(): void {
    const { gaps } = this.plan;
    const last = Math.floor(Math.max(0, gaps.length - 1) / mostRows) * mostRows;
    this.from = Math.max(0, Math.min(last, this.from));
    const end = Math.min(gaps.length, this.from + mostRows);
    this.pages.hidden = gaps.length <= mostRows;
    this.words.textContent = gaps.length === 0 ? 'The take has no gaps.' : this.pages.hidden ? '' : `gaps ${grouped(this.from + 1)} to ${grouped(end)} of ${grouped(gaps.length)}`;
    // The focused control keeps the focus.
    const focused = (document.activeElement as HTMLElement | null)?.dataset;
    this.body.replaceChildren(...gaps.slice(this.from, end).map((gap, i) => this.row(gap, this.from + i)));
    if (focused?.gap !== undefined) this.body.querySelector<HTMLElement>(`[data-gap="${focused.gap}"][data-row="${focused.row}"]`)?.focus();
  }

  /** Redraws, also after a change of theme. */
  redraw(): void { this.looked.redraw(); }

  /** Requests the curves of every method for the gap of a row. */
  private async look(row: number): Promise<void> {
    const gap = this.plan.gaps[row];
    this.looked.wait(gap);
    try {
      const curves = await this.curves(this.text(), row);
      if (curves !== null && this.take !== null && this.looked.open === gap) this.looked.show(curves, this.take);
    } catch (error) {
      this.looked.say(error instanceof TypeError ? 'kinemend view has ended' : error instanceof Error ? error.message : String(error));
    }
  }

  private setMethod(gap: PlannedGap, method: string, isForced?: boolean): void {
    gap.method = method;
    if (isForced !== undefined) gap.verdict = isForced ? 'force' : 'fill';
    else if (gap.verdict === 'refuse') gap.verdict = 'fill';
    this.change();
  }

  private change(): void {
    this.edited = true;
    this.again();
  }

  private row(gap: PlannedGap, row: number): HTMLTableRowElement {
    const where = button(gap.name, 'go to this gap', () => this.goTo(gap.name, gap.first_frame));
    const verdict = choice(`verdict of ${gap.name}, frames ${gap.first_frame} to ${gap.last_frame}`, [['fill', 'fill'], ['force', 'force'], ['refuse', 'refuse']], gap.verdict, (value) => {
      gap.verdict = value;
      // The user refuses it now, not the rules.
      if (value === 'refuse') gap.reason = '';
      this.change();
    });
    verdict.dataset.gap = 'verdict';
    const methods = this.session.controls.fill_methods.filter((one) => (this.isJoints ? one.joints : one.markers)).map(({ name }): [string, string] => [name, this.told(gap, name)]);
    const method = choice(`method of ${gap.name}, frames ${gap.first_frame} to ${gap.last_frame}`, methods, gap.method, (value) => this.setMethod(gap, value));
    method.dataset.gap = 'method';
    const curves = button('Compare', `compare the curves of every method over ${gap.name}, frames ${gap.first_frame} to ${gap.last_frame}`, () => void this.look(row));
    curves.dataset.gap = 'curves';
    for (const control of [where, verdict, method, curves]) control.dataset.row = String(row);
    where.dataset.gap = 'name';
    const error = gap.expected_error === null ? '\u2013' : `${figure(gap.expected_error)} ${gap.unit}`.trim();
    const cells = [`${gap.first_frame}\u2013${gap.last_frame}`, `${grouped(gap.length_frames)} (${figure(gap.length_s)} s)`, verdict, method, curves, gap.verdict === 'refuse' ? '\u2013' : gap.filled_by, error, gap.reason];
    const name = element('th', { scope: 'row' }, where, gap.quantity === 'position' && this.isJoints ? ' (position)' : '');
    const made = element('tr', { class: gap.reason === '' ? '' : 'failed' }, name, ...cells.map((cell, i) => element('td', { class: i === cells.length - 1 ? 'words' : '' }, cell)));
    if (gap.evidence.length > 0) made.title = `filled from ${gap.evidence.join(', ')}`;
    return made;
  }

  /** "spline (differs by 0.4 mm)" if it was tried. */
  private told(gap: PlannedGap, method: string): string {
    const shown = gap.previews?.find((one) => one.method === method);
    if (!shown || (method === gap.method && shown.filled)) return method;
    if (!shown.filled) return `${method} (refused)`;
    return shown.distance === null ? method : `${method} (differs by ${`${figure(shown.distance)} ${gap.unit}`.trim()})`;
  }
}
