// When feet stand: the lines of a contacts file.

import { button } from './dom';
import { LineEditor, type Sight } from './line_editor';

/** `left heel 12 40`, as `kinemend contacts` writes it. */
const form = {
  line: /^\s*(\S+)\s+(\S+)\s+(-?\d+)\s+(-?\d+)\s*(?:#.*)?$/,
  expected: 'SIDE PART FIRST LAST',
  label: 'contacts: side, part, first and last frame, one a line',
  first: 3,
  last: 4,
  joined: (parts: string[]) => parts.slice(0, 4).join(' '),
};

export class ContactEditor extends LineEditor {
  constructor(sight: () => Sight | null, find: () => Promise<Response>, again: () => void) {
    super(form, sight, again);
    const found = button('Find contacts', 'those that the file holds, or that are found in the take', () => void this.load(find()));
    found.dataset.action = 'contacts';
    this.area.disabled = true;
    this.head.append(found,
      button('Begins here', 'the contact of the line that the cursor is in begins at the frame that is shown', () => this.put(form.first)),
      this.endButton('the contact of the line that the cursor is in ends at the frame that is shown'),
      this.dropButton('feet are held no longer by these contacts'), this.words);
  }
}
