// The report's figures and warnings, facts of the take, and how the report was made.

import { feetFigure, isFeetFigure } from './columns';
import { counted, element, figure, grouped, words } from './dom';
import type { Contact, FeetFigures, ReportDocument, TakeEntry } from './report';
import type { Take } from './take';

/** A name, its value, and its tooltip. */
type Fact = [name: string, value: string, meaning?: string];

function pairs(rows: Fact[]): HTMLElement {
  const list = element('dl');
  for (const [name, value, title] of rows) list.append(element('div', { title }, element('dt', {}, name), element('dd', {}, value)));
  return list;
}

function box(title: string, ...parts: Node[]): HTMLElement {
  return element('section', { class: 'box' }, element('h2', {}, title), ...parts);
}

/** Number of frames in which a foot stands; overlapping contacts of heel and toe are counted once. */
function standing(contacts: Contact[]): number {
  const frames = new Set<number>();
  for (const { first_frame, last_frame } of contacts) for (let f = first_frame; f <= last_frame; ++f) frames.add(f);
  return frames.size;
}

/** Short reason why a contact was not changed (src/feet/slides.cpp). */
function kindOf({ reason }: Contact): string {
  if (reason?.startsWith('stands still')) return 'stand still already';
  if (reason?.endsWith('intended')) return 'slide on purpose';
  if (reason?.endsWith('farther than an error does')) return 'uncertain: slide too far for an error';
  return `left: ${reason ?? ''}`;
}

/** Measurements of feet, and the changes to them. */
function feetFacts(entry: TakeEntry): Fact[] {
  const rows: Fact[] = Object.entries(entry.figures).filter(([name, value]) => isFeetFigure(name) && value !== null).map(([name, value]) => {
    const [label, unit, meaning] = feetFigure(name);
    return [label, `${figure(value)} ${unit}`.trim(), meaning];
  });
  const { feet } = entry;
  if (!feet) return rows;
  const contacts = feet.contacts ?? [];
  const left = contacts.filter(({ held }) => !held);
  const time = (all: Contact[]): string => `${counted(all.length, 'contact')}, ${figure(standing(all) / (entry.frame_rate_hz || 1))} s`;
  rows.push(['feet stand', contacts.length === 0 ? 'no contacts found' : time(contacts), 'Times in which a heel or a toe is on the floor, and seconds in which at least one is.'],
    ['expected', `about ${figure(feet.time.expected_s)} s`, 'The time in which feet likely stand, from the motion of the whole body, summed over feet. Much more than is found: contacts are missing.']);
  if (contacts.length === 0) return rows;
  rows.push(['confidence', figure(feet.time.confidence), 'How likely feet stand in the contacts, on average; 1 is certain.']);
  rows.push(['held', time(contacts.filter(({ held }) => held)), 'Contacts whose sliding was taken out.']);
  const kinds = new Map<string, Contact[]>();
  for (const contact of left) kinds.set(kindOf(contact), [...(kinds.get(kindOf(contact)) ?? []), contact]);
  for (const [kind, own] of kinds) rows.push([kind, time(own), 'Contacts that were left as they are.']);
  rows.push(['frames adjusted', grouped(feet.frames_adjusted), 'Frames in which a leg or the root was moved to hold a foot.']);
  const { before, after } = feet;
  if (!before || !after) return rows;
  const scale = feet.metres_per_unit ? 100 * feet.metres_per_unit : 1;
  const unit = feet.metres_per_unit ? 'cm' : 'units';
  const pair = (key: keyof FeetFigures, by: number, told: string): string => `${figure(by * before[key])} \u2192 ${figure(by * after[key])} ${told}`;
  rows.push(['slide a frame', pair('slide', scale, unit), 'Mean distance that a standing foot travels over the floor from one frame to the next, before and after.'],
    ['slide at most', pair('most_slide', scale, unit), 'The farthest that a standing foot travels from where it began to stand, before and after.'],
    ['depth below the floor', pair('sink', scale, unit), 'How far a standing foot is below the floor at most, before and after.'],
    ['knee pop', pair('knee_pop_deg', 1, 'deg'), 'The largest sudden change of a knee\u2019s angle from frame to frame, before and after. Much more than before: holding the feet jerks the knees.']);
  return rows;
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
  const figures = Object.entries(entry.figures).filter(([name]) => !isFeetFigure(name)).map(([name, value]): [string, string] => [words(name), figure(value)]);
  if (figures.length > 0) holder.append(box('Figures', pairs(figures)));
  const feet = feetFacts(entry);
  if (feet.length > 0) {
    const made = box('Feet', pairs(feet));
    made.classList.add('feet');
    holder.append(made);
  }
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
