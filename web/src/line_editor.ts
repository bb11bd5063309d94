// An editor of the lines of a side file: contacts, or missing samples.

import type { Answer } from './view_transport';
import { button, element } from './dom';
import type { Player } from './player';
import type { Take } from './take';

/** The content now shown; null before there is any. */
export interface Sight {
  take: Take;
  player: Player;
}

export interface LineForm {
  /** Pattern of a whole line that is not a comment. */
  line: RegExp;
  /** Message for a line of another form. */
  expected: string;
  /** Label of the text field. */
  label: string;
  /** The groups of `line` that are the first and the last frame. */
  first: number;
  last: number;
  /** Makes a line from its parts, the groups of `line`. */
  joined: (parts: string[]) => string;
}

export class LineEditor {
  readonly element = element('div');
  /** True if runs use these lines. */
  edited = false;
  protected readonly area: HTMLTextAreaElement;
  protected readonly words = element('p', { class: 'status', role: 'status' });
  protected readonly head = element('div', { class: 'head' });

  constructor(private readonly form: LineForm, protected readonly sight: () => Sight | null, private readonly again: () => void) {
    this.area = element('textarea', { rows: '6', spellcheck: 'false', 'aria-label': form.label });
    let timer = 0;
    this.area.addEventListener('input', () => {
      window.clearTimeout(timer);
      timer = window.setTimeout(() => this.changed(), 300);
    });
    this.element.append(this.head, this.area);
  }

  text(): string { return this.area.value.endsWith('\n') || this.area.value === '' ? this.area.value : `${this.area.value}\n`; }

  protected changed(): void {
    const lines = this.area.value.split('\n');
    const wrong = lines.findIndex((line) => !/^\s*(#|$)/.test(line) && !this.form.line.test(line));
    this.words.textContent = wrong < 0 ? '' : `line ${wrong + 1}: expected ${this.form.expected}`;
    if (wrong >= 0) return;
    this.edited = true;
    this.again();
  }

  /** Replaces the text with fetched lines. */
  protected async load(fetched: Promise<Answer>): Promise<void> {
    try {
      const reply = await fetched;
      if (!reply.ok) {
        this.words.textContent = (await reply.json()).error;
        return;
      }
      this.area.disabled = false;
      this.area.value = await reply.text();
      this.changed();
    } catch {
      this.words.textContent = 'kinemend view has ended';
    }
  }

  protected dropButton(title: string): HTMLButtonElement {
    return button('Clear', title, () => {
      this.edited = false;
      this.area.value = '';
      this.words.textContent = '';
      this.again();
    });
  }
  protected endButton(title: string): HTMLButtonElement {
    return button('End here', title, () => this.put(this.form.last));
  }

  /** Writes the current frame into the line with the cursor. */
  protected put(place: number): void {
    const sight = this.sight();
    if (sight === null) return;
    const before = this.area.value.slice(0, this.area.selectionStart).split('\n').length - 1;
    const lines = this.area.value.split('\n');
    const parts = this.form.line.exec(lines[before] ?? '');
    if (parts === null) {
      this.words.textContent = 'place the text cursor in the line to change';
      return;
    }
    parts[place] = String(sight.take.number(sight.player.shown));
    lines[before] = this.form.joined(parts.slice(1));
    this.area.value = lines.join('\n');
    this.cursorTo(before);
    this.changed();
  }

  protected cursorTo(line: number): void {
    const before = this.area.value.split('\n').slice(0, line).join('\n');
    const at = before.length + (line > 0 ? 1 : 0);
    this.area.setSelectionRange(at, at);
  }
}
