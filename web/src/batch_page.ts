// The index of a batch: failed takes first, then those that most need review.

import { choice, counted, element, figure, grouped, headings, words } from './dom';
import { oneTabStop } from './roving';
import { themeButton } from './theme';

interface Row {
  name: string;
  status: string;
  input?: string;
  verdict?: string | null;
  error?: string;
  frames?: number;
  frame_rate_hz?: number;
  method?: string;
  figures?: Record<string, number | null>;
  warnings?: string[];
}
export interface Batch {
  command_line: string;
  summary: { kinemend: string; figures: Record<string, number | null> };
  rows: { row: Row; page: string; picture?: string }[];
}

function repaired(row: Row): number {
  return (row.figures?.frames_repaired ?? 0) / Math.max(1, row.frames ?? 1);
}
/** Rank of a row; the largest most needs review. */
function badness(row: Row): number {
  return (row.status === 'failed' ? 1e9 : 0) + 1e3 * (row.warnings?.length ?? 0) + repaired(row);
}

const filters: [string, string, (row: Row) => boolean][] = [
  ['all', 'all takes', () => true],
  ['failed', 'failed', (row) => row.status === 'failed'],
  ['warnings', 'with warnings', (row) => (row.warnings?.length ?? 0) > 0],
  ['repaired', 'with repairs', (row) => repaired(row) > 0],
  ['refused', 'with gaps left', (row) => (row.figures?.gaps_refused ?? 0) + (row.figures?.gaps_left ?? 0) > 0],
  ['clean', 'nothing to review', (row) => badness(row) === 0],
];

function line({ row, page, picture }: Batch['rows'][number]): HTMLTableRowElement {
  const link = page === '' ? element('span', {}, row.name) : element('a', { href: page.split('/').map(encodeURIComponent).join('/') }, row.name);
  const name = element('th', { scope: 'row' }, link);
  // Scripts in a picture do not run.
  if (picture) name.append(element('img', { class: 'poses', src: `data:image/svg+xml,${encodeURIComponent(picture)}`, alt: `poses of ${row.name}`, loading: 'lazy' }));
  const made = element('tr', {}, name);
  const share = element('td', { class: 'share' });
  const bar = element('i');
  bar.style.width = `${Math.min(100, 100 * repaired(row))}%`;
  share.append(bar, element('span', {}, row.status === 'failed' ? '\u2013' : `${figure(100 * repaired(row))} %`));
  const seconds = row.frames && row.frame_rate_hz ? row.frames / row.frame_rate_hz : null;
  made.append(element('td', { class: 'words' }, row.error ?? row.verdict ?? '', ...(row.warnings ?? []).map((text) => element('p', { class: 'warning' }, text))),
    share, element('td', {}, figure(row.figures?.spikes)), element('td', {}, figure(row.figures?.gaps)), element('td', {}, seconds === null ? '\u2013' : `${figure(seconds)} s`));
  made.className = row.status;
  return made;
}

export function showBatch(page: HTMLElement, batch: Batch): void {
  const takes = batch.rows.filter(({ row }) => row.status !== 'copied').sort((a, b) => badness(b.row) - badness(a.row) || a.row.name.localeCompare(b.row.name));
  const body = element('tbody');
  const count = element('p', { class: 'verdict', role: 'status' });
  const search = element('input', { type: 'search', placeholder: 'find a take', 'aria-label': 'find a take' });
  let kind = 'all';
  const update = (): void => {
    const fits = filters.find(([name]) => name === kind)?.[2] ?? ((): boolean => true);
    const text = search.value.toLowerCase();
    const shown = takes.filter(({ row }) => fits(row) && `${row.name} ${row.verdict ?? ''} ${row.error ?? ''}`.toLowerCase().includes(text));
    body.replaceChildren(...shown.map(line));
    count.textContent = `${grouped(shown.length)} of ${counted(takes.length, 'take')}; needs review, worst first`;
    if (shown.length === 0) body.append(element('tr', {}, element('td', { colspan: '6', class: 'words empty' }, 'No take matches.')));
  };
  search.addEventListener('input', update);
  const select = choice('which takes', filters.map(([name, label, fits]) => [name, `${label} (${grouped(takes.filter(({ row }) => fits(row)).length)})`]), kind, (value) => {
    kind = value;
    update();
  });
  const head = element('tr', {}, ...headings([['take', 'Name of the file; a link leads to the page of this take.'], ['what was found', 'The verdict of this take, its warnings, or why it failed.'],
    ['frames repaired', 'Share of the frames in which a spike was repaired or a gap filled, in percent.'], ['spikes', 'Number of spikes that were repaired.'], ['gaps', 'Number of gaps that were filled.'],
    ['length', 'Duration of the take, in seconds.']]));
  const sums = element('dl');
  for (const [name, value] of Object.entries(batch.summary.figures)) sums.append(element('div', {}, element('dt', {}, words(name)), element('dd', {}, figure(value))));
  const table = element('table', {}, element('thead', {}, head), body);
  oneTabStop(table, 'tr');
  page.replaceChildren(
    element('header', {}, element('div', {}, element('h1', {}, 'Batch'), count), themeButton(() => undefined)),
    element('section', { class: 'batch' }, element('div', { class: 'head' }, select, search),
      element('div', { class: 'scroll', tabindex: takes.some(({ page: link }) => link !== '') ? undefined : '0' }, table)),
    element('div', { class: 'facts' }, element('section', { class: 'box' }, element('h2', {}, 'All takes'), sums),
      element('section', { class: 'box' }, element('h2', {}, 'Made by'), element('p', {}, `kinemend ${batch.summary.kinemend}`), element('code', { tabindex: '0' }, batch.command_line))));
  update();
  page.dataset.ready = 'true';
}
