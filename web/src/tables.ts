// The table of joints or markers, sorted by any of its columns.

import { meaningOf, unitOf, worstFirst } from './columns';
import { button, element, figure, words } from './dom';
import type { Player } from './player';
import type { Finding, TakeEntry, TrackRow } from './report';
import { oneTabStop } from './roving';
import type { Take } from './take';

/** Counts the findings of each track, for reports without a table of tracks. */
function countedRows(names: string[], findings: Finding[]): TrackRow[] {
  return names.map((name) => {
    const own = findings.filter((finding) => finding.track === name);
    const frames = (list: Finding[]): number => list.reduce((sum, finding) => sum + finding.last_frame - finding.first_frame + 1, 0);
    const refused = own.filter((finding) => finding.verdict === 'refused');
    const done = own.filter((finding) => finding.verdict !== 'refused');
    return { name, filled: done.length, 'filled frames': frames(done), refused: refused.length, 'refused frames': frames(refused) };
  });
}

export class TrackTable {
  private column: string | null = null;
  private falling = true;
  private readonly rows: { track: number; figures: Record<string, string | number | null>; row: HTMLTableRowElement }[] = [];
  private readonly body = element('tbody');
  private readonly heads = new Map<string, HTMLElement>();

  constructor(holder: HTMLElement, private readonly take: Take, private readonly player: Player, entry: TakeEntry) {
    const tracks = entry.tracks.length > 0 || entry.findings.length === 0 ? entry.tracks : countedRows(take.data.names, entry.findings);
    const given = new Map(tracks.map((row) => [String(row.name), row]));
    // Two markers may have the same name; their index distinguishes them.
    const inOrder = tracks.length === take.data.names.length;
    const columns = tracks.length > 0 ? Object.keys(tracks[0]).filter((key) => key !== 'name') : [];
    const noun = take.isJoints ? 'joint' : 'marker';
    const search = element('input', { type: 'search', placeholder: `find a ${noun}`, 'aria-label': `find a ${noun}` });
    search.addEventListener('input', () => this.filter(search.value));
    const head = element('tr', {}, this.head('name', noun, `Names of the ${noun}s, as the file spells them.`));
    for (const column of columns) {
      const unit = unitOf(column, entry.track_unit);
      head.append(this.head(column, words(column) + (unit && `, ${unit}`), meaningOf(column, noun, entry.track_unit)));
    }
    take.data.names.forEach((name, track) => {
      const figures = (inOrder ? tracks[track] : given.get(name)) ?? {};
      const row = element('tr', {}, element('th', { scope: 'row' }, button(take.shortName(track), `${take.nameOf(track)}: show its curves and its path`, () => player.toggleTrack(track))));
      for (const column of columns) row.append(element('td', {}, figure(figures[column] as number | null)));
      this.rows.push({ track, figures: { ...figures, name }, row });
    });
    if (take.data.names.length === 0) {
      holder.append(element('p', { class: 'empty' }, `The take has no ${noun}s.`));
      return;
    }
    const table = element('table', {}, element('thead', {}, head), this.body);
    holder.append(search, element('div', { class: 'scroll' }, table));
    const first = worstFirst.find((name) => columns.includes(name));
    this.sort(first ?? null);
    player.onChoice(() => this.mark());
    this.mark();
    oneTabStop(table, 'tr');
  }

  /** The track in the first row. */
  get worst(): number { return this.rows[0]?.track ?? 0; }

  /** Scrolls the table, not the page, to the first chosen track. */
  reveal(): void {
    const row = this.rows.find(({ track }) => this.player.chosen.includes(track))?.row;
    const holder = row?.closest<HTMLElement>('.scroll');
    if (row && holder) holder.scrollTop = Math.max(0, row.offsetTop + row.offsetHeight - holder.clientHeight);
  }

  private head(column: string, text: string, meaning: string): HTMLElement {
    const made = button(text, `${meaning} Click to sort by this column.`.trim(), () => this.sort(column));
    made.setAttribute('aria-description', meaning);
    const cell = element('th', { scope: 'col' }, made);
    this.heads.set(column, cell);
    return cell;
  }

  private sort(column: string | null): void {
    if (column !== null) {
      this.falling = this.column === column ? !this.falling : column !== 'name';
      this.column = column;
      const sign = this.falling ? -1 : 1;
      const value = (row: { figures: Record<string, string | number | null> }): number => Number(row.figures[column] ?? -Infinity);
      this.rows.sort((a, b) => column === 'name'
        ? sign * String(a.figures.name).localeCompare(String(b.figures.name))
        : sign * (value(a) - value(b) || 0) || a.track - b.track);
    }
    for (const [name, cell] of this.heads) cell.setAttribute('aria-sort', name !== this.column ? 'none' : this.falling ? 'descending' : 'ascending');
    this.body.replaceChildren(...this.rows.map(({ row }) => row));
  }

  private filter(text: string): void {
    const wanted = text.toLowerCase();
    for (const { track, row } of this.rows) row.hidden = !(this.take.data.names[track] ?? '').toLowerCase().includes(wanted);
  }

  private mark(): void {
    for (const { track, row } of this.rows) {
      const chosen = this.player.chosen.includes(track);
      row.classList.toggle('chosen', chosen);
      row.querySelector('button')?.setAttribute('aria-pressed', String(chosen));
    }
  }
}
