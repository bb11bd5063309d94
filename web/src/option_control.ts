// A control for one option, with its error beside it.

import { choice, element, toggle } from './dom';

export type Value = string | number | boolean;

export interface Option {
  name: string;
  kind: 'switch' | 'choice' | 'whole' | 'number';
  help: string;
  default: string | number | boolean;
  unit?: string;
  choices?: string[];
  minimum?: number;
  maximum?: number;
}

/** A label, a control, and its error. */
export function field(label: string, title: string, control: HTMLElement): HTMLElement {
  return element('label', { class: 'field', title }, element('span', {}, label), control, element('span', { class: 'problem', role: 'alert' }));
}

/** Shows beside a control why its value is not used; an empty text removes the message. Returns false if there is no place for it. */
export function showProblem(control: HTMLElement, text: string): boolean {
  const words = control.closest('.field')?.querySelector('.problem');
  if (!words) return false;
  words.textContent = text;
  if (text === '') control.removeAttribute('aria-invalid');
  else control.setAttribute('aria-invalid', 'true');
  return true;
}

/** "0 to 1", "0 or more Hz". */
export function rangeOf({ minimum, maximum, unit, kind }: Option): string {
  const range = minimum !== undefined && maximum !== undefined ? `${minimum} to ${maximum}` : minimum !== undefined ? `${minimum} or more` : maximum !== undefined ? `${maximum} or less` : 'a number';
  return `${kind === 'whole' ? 'whole numbers, ' : ''}${range}${unit ? ` ${unit}` : ''}`;
}

/** "cutoff (Hz)" for `cutoff_hz`. */
export function labelOf({ name, unit }: Option): string {
  const words = (unit ? name.replace(/_(hz|s|deg)$/, '') : name).replace(/_/g, ' ');
  return unit ? `${words} (${unit})` : words;
}

export interface OptionActs {
  /** The value; undefined for the default. */
  change: (value: Value | undefined) => void;
  /** Called with the label of a control whose value is invalid; null: it is valid again. */
  refuse: (label: string | null) => void;
}

/** `given` is the current value. */
export function optionControl(option: Option, given: Value | undefined, { change, refuse }: OptionActs, label = ''): HTMLElement {
  const told = label || labelOf(option);
  const now = given ?? option.default;
  if (option.kind === 'switch') {
    const made = toggle(told, option.help, now === true, (on) => change(on === option.default ? undefined : on));
    made.dataset.flag = option.name;
    return made;
  }
  if (option.choices) {
    const made = choice(told, option.choices.map((one) => [one, one]), String(now), (value) => change(value === option.default ? undefined : value));
    made.dataset.flag = option.name;
    return field(told, option.help, made);
  }
  const made = element('input', { type: 'number', class: 'number', value: String(now), min: option.minimum, max: option.maximum, step: option.kind === 'whole' ? 1 : 'any', placeholder: String(option.default), 'aria-label': told });
  made.dataset.flag = option.name;
  made.addEventListener('input', () => {
    if (!made.checkValidity()) {
      showProblem(made, `${made.validity.badInput ? 'This is not a number' : made.value} \u2013 not used. Allowed: ${rangeOf(option)}.`);
      return refuse(told);
    }
    showProblem(made, '');
    refuse(null);
    change(made.value === '' || Number(made.value) === option.default ? undefined : Number(made.value));
  });
  return field(told, option.help, made);
}
