// The report's figures and warnings, facts of the take, and how the report was made.

import { element, figure, grouped, words } from './dom';
import type { ReportDocument, TakeEntry } from './report';
import type { Take } from './take';

function pairs(rows: [string, string][]): HTMLElement {
  const list = element('dl');
  for (const [name, value] of rows) list.append(element('div', {}, element('dt', {}, name), element('dd', {}, value)));
  return list;
}

function box(title: string, ...parts: Node[]): HTMLElement {
  return element('section', { class: 'box' }, element('h2', {}, title), ...parts);
}

function lines(texts: string[]): HTMLElement {
  const list = element('ul');
  for (const text of texts) list.append(element('li', {}, text));
  return list;
}

function takeFacts(take: Take, entry: TakeEntry): [string, string][] {
  const { data } = take;
  const rows: [string, string][] = [['input', entry.input === '-' ? 'standard input' : entry.input]];
  if (entry.reference) rows.push(['reference', entry.reference]);
  if (entry.output) rows.push(['output', entry.output]);
  if (entry.format) rows.push(['format', entry.format.toUpperCase()]);
  rows.push([data.kind, grouped(data.names.length)]);
  const seconds = entry.frame_rate_hz > 0 ? entry.frames / entry.frame_rate_hz : 0;
  rows.push(['frames', `${grouped(entry.frames)} at ${figure(entry.frame_rate_hz)} Hz, ${figure(seconds)} s`]);
  if (entry.frames > 0) rows.push(['frame numbers', ` ${entry.first_frame} to ${entry.first_frame + entry.frames - 1}`]);
  if (entry.source) rows.push(['source', entry.source === 'unknown' ? String(entry.source_reason) : `${entry.source} (${entry.source_reason})`]);
  if (entry.calibration_frames) rows.push(['calibration frames', grouped(entry.calibration_frames)]);
  rows.push(['length unit', entry.unit ?? (entry.metres_per_unit ? `${figure(entry.metres_per_unit)} m` : 'not stated')]);
  rows.push(['up axis', `${data.stage.sign < 0 ? '\u2212' : ''}${data.stage.up.toUpperCase()}`]);
  if (data.step > 1) rows.push(['on this page', `1 frame in ${data.step}`]);
  return rows;
}

export function addFacts(holder: HTMLElement, take: Take, document: ReportDocument, entry: TakeEntry): void {
  const figures = Object.entries(entry.figures).map(([name, value]): [string, string] => [words(name), figure(value)]);
  if (figures.length > 0) holder.append(box('Figures', pairs(figures)));
  holder.append(box('Take', pairs(takeFacts(take, entry))));
  const made = box('Made by', element('p', {}, `kinemend ${document.kinemend}`), element('code', { tabindex: '0' }, take.data.command_line));
  const options = Object.entries(entry.options ?? {}).filter(([, value]) => value !== '');
  if (entry.method) made.append(element('p', {}, `method ${entry.method}`));
  if (options.length > 0) made.append(pairs(options.map(([name, value]) => [words(name), typeof value === 'number' ? figure(value) : String(value)])));
  holder.append(made);
  const warnings = [
    ...entry.warnings,
    ...entry.diagnostics.map((one) => (one.count > 1 ? `${one.message} (${grouped(one.count)} times)` : one.message)),
    ...(entry.fall_backs ?? []).map((one) => `cleaned by ${one.method} instead, because ${one.reason}: ${one.tracks.map((track) => track.name).join(', ')}`),
  ];
  if (warnings.length > 0) holder.append(box('Warnings', lines(warnings)));
  const left = [...(entry.leftovers ?? []).map((one) => `${one.what}: ${one.mend}`), ...(entry.notes ?? [])];
  if (left.length > 0) holder.append(box('Not changed', lines(left)));
}
