// Samples that count as missing: the lines of a side file of gaps.

import { button } from './dom';
import { LineEditor, type Sight } from './line_editor';

/** `LeftArm,12,40`; a name with a comma or a quote is quoted. */
const form = {
  line: /^\s*("(?:[^"]|"")*"|[^",]+)\s*,\s*(-?\d+)\s*,\s*(-?\d+)\s*(?:#.*)?$/,
  expected: 'NAME,FIRST,LAST',
  label: 'missing samples: name, first and last frame, one a line',
  first: 2,
  last: 3,
  joined: (parts: string[]) => `${parts[0]},${parts[1]},${parts[2]}`,
};

function quoted(name: string): string {
  return /[",#\n]|^\s|\s$/.test(name) ? `"${name.replace(/"/g, '""')}"` : name;
}

export class MissingEditor extends LineEditor {
  constructor(sight: () => Sight | null, read: () => Promise<Response>, again: () => void, noun: string) {
    super(form, sight, again);
    const found = button('Read the file', 'the gaps that are saved already', () => void this.load(read()));
    const begin = button('Begins here', `what is chosen of the ${noun}s is missing from the frame that is shown on`, () => this.begin(noun));
    begin.dataset.action = 'missing';
    this.head.append(begin, this.endButton('the gap of the line that the cursor is in ends at the frame that is shown'), found,
      this.dropButton('what is marked here is missing no longer'), this.words);
  }

  /** The lines that runs go by already. */
  async start(fetched: Promise<Response>): Promise<void> {
    try {
      const reply = await fetched;
      if (reply.ok && this.area.value === '') this.area.value = await reply.text();
    } catch {
      // The run that is under way says it.
    }
  }

  /** A line more for each track that is chosen. */
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
