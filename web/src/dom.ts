// Makes elements. Text from a file is inserted as text, never as markup.

type Attributes = Record<string, string | number | boolean | undefined>;

/** A name among other words, isolated so that a right-to-left name does not reverse them. */
export function isolated(name: string): string {
  return `\u2068${name}\u2069`;
}

export function element<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    made.setAttribute(key, value === true ? '' : String(value));
  }
  made.append(...children);
  return made;
}

export function button(label: string, title: string, act: () => void, pressed?: boolean): HTMLButtonElement {
  const made = element('button', { type: 'button', title, 'aria-pressed': pressed === undefined ? undefined : String(pressed) }, label);
  made.addEventListener('click', act);
  return made;
}

/** A toggle button. */
export function toggle(label: string, title: string, on: boolean, act: (on: boolean) => void): HTMLButtonElement {
  const made: HTMLButtonElement = button(label, title, () => {
    const now = made.getAttribute('aria-pressed') !== 'true';
    made.setAttribute('aria-pressed', String(now));
    act(now);
  }, on);
  return made;
}

export function choice(label: string, options: [string, string][], value: string, act: (value: string) => void): HTMLSelectElement {
  const made = element('select', { 'aria-label': label, title: label });
  for (const [key, text] of options) made.append(element('option', { value: key, selected: key === value }, text));
  made.addEventListener('change', () => act(made.value));
  return made;
}

/** Headings of columns with tooltips. */
export function headings(columns: [text: string, meaning: string][]): HTMLTableCellElement[] {
  return columns.map(([text, title]) => element('th', { scope: 'col', title }, text));
}

/** Describes a canvas to screen readers. */
export function describeCanvas(canvas: HTMLCanvasElement | null, text: string): void {
  canvas?.setAttribute('role', 'img');
  canvas?.setAttribute('aria-label', text);
}

/** Fits a canvas to its element and the pixels of the screen; null while it is not shown. Lengths are those of the page. */
export function fittedContext(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const { clientWidth, clientHeight } = canvas;
  if (clientWidth === 0) return null;
  const scale = devicePixelRatio;
  canvas.width = clientWidth * scale;
  canvas.height = clientHeight * scale;
  const context = canvas.getContext('2d');
  context?.scale(scale, scale);
  return context;
}

/** Puts the line of the current time over a field of this width; it is hidden outside of it. */
export function placeCursor(cursor: HTMLElement, x: number, width: number): void {
  cursor.hidden = !(x >= 0 && x <= width);
  if (!cursor.hidden) cursor.style.transform = `translateX(${x}px)`;
}

/** A colour of the style sheet in the current theme. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** Three significant digits, as the program prints figures. */
export function figure(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '\u2013';
  if (Number.isInteger(value)) return grouped(value);
  const size = Math.abs(value);
  if (size < 1e-4) return value.toExponential(1);
  const digits = size >= 100 ? 0 : Math.min(6, 2 - Math.floor(Math.log10(size || 1)));
  return value.toFixed(digits);
}

export function grouped(count: number): string {
  return count.toLocaleString('en-US');
}

export function counted(count: number, noun: string): string {
  return `${grouped(count)} ${noun}${count === 1 ? '' : 's'}`;
}

export function words(name: string): string {
  return name.replace(/_/g, ' ');
}
