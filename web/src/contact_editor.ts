// When feet stand: the lines of a contacts file, to be edited.

import { button, element } from './dom';
import type { Player } from './player';
import type { Take } from './take';

/** `left heel 12 40`, as `kinemend contacts` writes it. */
const form = /^\s*(\S+)\s+(\S+)\s+(-?\d+)\s+(-?\d+)\s*(#.*)?$/;

export class ContactEditor {
  readonly element = element('div');
  /** Whether feet are held by these contacts. */
  edited = false;
  private readonly area = element('textarea', { rows: '8', spellcheck: 'false', 'aria-label': 'contacts: side, part, first and last frame, one a line', disabled: true });
  private readonly words = element('p', { class: 'status', role: 'status' });

  constructor(private readonly take: () => Take | null, private readonly player: () => Player | null, private readonly find: () => Promise<Response>, private readonly again: () => void) {
    const found = button('Find contacts', 'those that the file holds, or that are found in the take', () => void this.load());
    found.dataset.action = 'contacts';
    const drop = button('Leave out', 'feet are held no longer by these contacts', () => {
      this.edited = false;
      this.area.value = '';
      this.area.disabled = true;
      this.words.textContent = '';
      again();
    });
    this.element.append(element('div', { class: 'head' }, found,
      button('Begins here', 'the contact of the line that the cursor is in begins at the frame that is shown', () => this.put(3)),
      button('Ends here', 'the contact of the line that the cursor is in ends at the frame that is shown', () => this.put(4)), drop, this.words), this.area);
    let timer = 0;
    this.area.addEventListener('input', () => {
      window.clearTimeout(timer);
      timer = window.setTimeout(() => this.changed(), 300);
    });
  }

  text(): string { return this.area.value.endsWith('\n') || this.area.value === '' ? this.area.value : `${this.area.value}\n`; }

  private changed(): void {
    const lines = this.area.value.split('\n');
    const wrong = lines.findIndex((line) => !/^\s*(#|$)/.test(line) && !form.test(line));
    this.words.textContent = wrong < 0 ? '' : `line ${wrong + 1}: expected SIDE PART FIRST LAST`;
    if (wrong >= 0) return;
    this.edited = true;
    this.again();
  }

  private async load(): Promise<void> {
    const reply = await this.find();
    if (!reply.ok) {
      this.words.textContent = (await reply.json()).error;
      return;
    }
    this.area.disabled = false;
    this.area.value = await reply.text();
    this.changed();
  }

  /** The frame that is shown, into a place of the line with the cursor. */
  private put(place: 3 | 4): void {
    const player = this.player();
    const take = this.take();
    if (player === null || take === null) return;
    const before = this.area.value.slice(0, this.area.selectionStart).split('\n').length - 1;
    const lines = this.area.value.split('\n');
    const parts = form.exec(lines[before] ?? '');
    if (parts === null) {
      this.words.textContent = 'put the cursor into the line of a contact';
      return;
    }
    parts[place] = String(take.number(player.shown));
    lines[before] = parts.slice(1, 5).join(' ');
    this.area.value = lines.join('\n');
    const at = lines.slice(0, before).join('\n').length + (before > 0 ? 1 : 0);
    this.area.setSelectionRange(at, at);
    this.changed();
  }
}
