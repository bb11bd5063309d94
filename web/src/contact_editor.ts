// The lines of a contacts file: when each foot is in ground contact.

import type { Answer } from './view_transport';
import { button } from './dom';
import { LineEditor, type Sight } from './line_editor';

/** `left heel 12 40`, as `kinemend contacts` writes it. */
const form = {
  line: /^\s*(\S+)\s+(\S+)\s+(-?\d+)\s+(-?\d+)\s*(?:#.*)?$/,
  expected: 'SIDE PART FIRST LAST',
  label: 'contacts, one per line: side, part, first and last frame',
  first: 3,
  last: 4,
  joined: (parts: string[]) => parts.slice(0, 4).join(' '),
};

export class ContactEditor extends LineEditor {
  constructor(sight: () => Sight | null, find: () => Promise<Answer>, again: () => void) {
    super(form, sight, again);
    const found = button('Find contacts', 'load the contacts file, or find contacts in the take', () => void this.load(find()));
    found.dataset.action = 'contacts';
    this.area.disabled = true;
    this.head.append(found,
      button('Begin here', 'set the first frame of the line with the text cursor to the current frame', () => this.put(form.first)),
      this.endButton('set the last frame of the line with the text cursor to the current frame'),
      this.dropButton('remove all lines; feet are no longer held by them'), this.words);
  }
}
