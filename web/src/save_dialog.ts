// Asks where to save, and confirms before an existing file is replaced.

import { button, element } from './dom';
import type { ViewTransport } from './view_transport';

/** The server's answer to a save request. */
export interface Saved {
  written?: string[];
  command_line?: string;
  error?: string;
  /** Existing files, which are replaced only after confirmation. */
  existing?: string[];
}

export class SaveDialog {
  readonly element = element('dialog', { class: 'save', 'aria-labelledby': 'save-title' });
  private readonly name = element('input', { type: 'text', name: 'file', required: true, spellcheck: 'false', autocomplete: 'off', 'aria-label': 'file name' });
  private readonly place = element('p', { class: 'empty' });
  private readonly words = element('p', { class: 'problem', role: 'alert' });
  private readonly accept = element('button', { type: 'submit', 'data-action': 'accept' }, 'Save');
  private mayReplace = false;

  /** `ask` sends the request and returns the answer; `done` is called on success; `transport` states where files go. */
  constructor(private readonly ask: (file: string, replace: boolean) => Promise<Saved>, private readonly done: (saved: Saved) => void,
    private readonly transport: ViewTransport) {
    const form = element('form', {}, element('h2', { id: 'save-title' }, 'Save as'),
      element('label', { class: 'field' }, element('span', {}, 'file name'), this.name), this.place, this.words,
      element('div', { class: 'controls' }, this.accept, button('Cancel', 'save nothing', () => this.element.close())));
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      void this.save();
    });
    this.name.addEventListener('input', () => this.forget());
    this.element.append(form);
  }

  /** `proposed` is a path whose folder is kept. */
  open(proposed: string): void {
    const [, folder, file] = /^(.*[\\/])?([^\\/]*)$/.exec(proposed) ?? [];
    this.place.textContent = this.transport.placeOf(folder);
    this.name.value = file ?? '';
    this.forget();
    this.element.showModal();
    // Typing replaces the name but keeps its extension.
    this.name.setSelectionRange(0, Math.max(0, this.name.value.lastIndexOf('.')));
  }

  /** A new name needs a new confirmation. */
  private forget(): void {
    this.mayReplace = false;
    this.words.textContent = '';
    this.accept.textContent = 'Save';
  }

  private async save(): Promise<void> {
    this.accept.disabled = true;
    try {
      const saved = await this.ask(this.name.value.trim(), this.mayReplace);
      if (saved.existing !== undefined) {
        this.mayReplace = true;
        this.words.textContent = `${saved.existing.join(', ')}: exists already. Replace ${saved.existing.length > 1 ? 'these files' : 'it'}, or choose another name.`;
        this.accept.textContent = 'Replace';
      } else if (saved.error !== undefined) {
        this.words.textContent = saved.error;
      } else {
        this.element.close();
        this.done(saved);
      }
    } catch (error) {
      this.words.textContent = this.transport.inWords(error);
    } finally {
      this.accept.disabled = false;
    }
  }
}
