// Samples to treat as missing: the lines of a side file of gaps.

import type { Answer } from './view_transport';
import { button } from './dom';
import { LineEditor, type Sight } from './line_editor';

/** `LeftArm,12,40`; a name with a comma or a quote is quoted. */
const form = {
  line: /^\s*("(?:[^"]|"")*"|[^",]+)\s*,\s*(-?\d+)\s*,\s*(-?\d+)\s*(?:#.*)?$/,
  expected: 'NAME,FIRST,LAST',
  label: 'missing samples, one per line: name, first and last frame',
  first: 2,
  last: 3,
  joined: (parts: string[]) => `${parts[0]},${parts[1]},${parts[2]}`,
};

function quoted(name: string): string {
  return /[",#\n]|^\s|\s$/.test(name) ? `"${name.replace(/"/g, '""')}"` : name;
}

export class MissingEditor extends LineEditor {
  constructor(sight: () => Sight | null, read: () => Promise<Answer>, again: () => void, noun: string) {
    super(form, sight, again);
    const found = button('Load the file', 'load the gaps that were saved before', () => void this.load(read()));
    const begin = button('Begin here', `add a line for each chosen ${noun}: missing from the current frame on`, () => this.begin(noun));
    begin.dataset.action = 'missing';
    this.head.append(begin, this.endButton('set the last frame of the line with the text cursor to the current frame'), found,
      this.dropButton('remove all lines; these samples are used again'), this.words);
  }

  /** Loads the lines that runs use from the start. */
  async start(fetched: Promise<Answer>): Promise<void> {
    try {
      const reply = await fetched;
      if (reply.ok && this.area.value === '') this.area.value = await reply.text();
    } catch {
      // The run reports this error.
    }
  }

  /** Adds a line for each chosen track. */
  private begin(noun: string): void {
    const sight = this.sight();
    const chosen = sight?.player.chosen ?? [];
    if (sight === null || chosen.length === 0) {
      this.words.textContent = `choose a ${noun} in the table first`;
      return;
    }
    const frame = sight.take.number(sight.player.shown);
    const lines = this.area.value.split('\n').filter((line) => line.trim() !== '');
    lines.push(...chosen.map((track) => `${quoted(sight.take.data.names[track])},${frame},${frame}`));
    this.area.value = `${lines.join('\n')}\n`;
    this.cursorTo(lines.length - 1);
    this.changed();
  }
}
