// One tab stop for all the controls of a table or a list; arrow keys move between them.

const controls = 'button, select, input, a[href]';
const page = 10;

/** `rows` is the tag of a row, "tr" or "li". Keys without a target are left to the page. */
export function oneTabStop(holder: HTMLElement, rows: 'tr' | 'li'): void {
  let current: HTMLElement | null = null;

  const inRow = (row: Element): HTMLElement[] => [...row.querySelectorAll<HTMLElement>(controls)].filter((one) => !one.matches(':disabled'));
  const all = (): HTMLElement[][] => [...holder.querySelectorAll<HTMLElement>(rows)].filter((row) => !row.hidden).map(inRow).filter((row) => row.length > 0);

  const settle = (): void => {
    const shown = all();
    if (current === null || !shown.some((row) => row.includes(current as HTMLElement))) current = (shown.find((row) => row[0].closest('thead') === null) ?? shown[0])?.[0] ?? null;
    for (const one of holder.querySelectorAll<HTMLElement>(controls)) {
      const stop = one === current ? 0 : -1;
      if (one.tabIndex !== stop) one.tabIndex = stop;
    }
  };

  const cellOf = (one: HTMLElement): number => one.closest<HTMLTableCellElement>('td, th')?.cellIndex ?? 0;

  /** The control that a key leads to; null if there is none. */
  const target = (from: HTMLElement, event: KeyboardEvent): HTMLElement | null => {
    const shown = all();
    const y = shown.findIndex((row) => row.includes(from));
    if (y < 0) return null;
    const row = shown[y];
    const x = row.indexOf(from);
    const far = event.ctrlKey;
    const vertical: Record<string, number> = { ArrowUp: y - 1, ArrowDown: y + 1, PageUp: Math.max(0, y - page), PageDown: Math.min(shown.length - 1, y + page), Home: 0, End: shown.length - 1 };
    if (event.key in vertical && (far || !/^(Home|End)$/.test(event.key))) {
      // A closed list of choices changes with these keys; with Ctrl they move.
      if (/^Arrow/.test(event.key) && from.tagName === 'SELECT' && !far) return null;
      const next = shown[vertical[event.key]];
      return next?.find((one) => cellOf(one) === cellOf(from)) ?? next?.[0] ?? null;
    }
    const horizontal: Record<string, number> = { ArrowLeft: x - 1, ArrowRight: x + 1, Home: 0, End: row.length - 1 };
    return event.key in horizontal && row.length > 1 ? row[horizontal[event.key]] ?? from : null;
  };

  holder.addEventListener('focusin', (event) => {
    const focused = (event.target as HTMLElement).closest<HTMLElement>(controls);
    if (focused === null) return;
    current = focused;
    settle();
  });
  holder.addEventListener('keydown', (event) => {
    if (event.altKey || event.metaKey || event.shiftKey) return;
    const from = (event.target as HTMLElement).closest<HTMLElement>(controls);
    const to = from === null ? null : target(from, event);
    if (to === null) return;
    event.preventDefault();
    event.stopPropagation();
    to.focus();
  });
  new MutationObserver(settle).observe(holder, { childList: true, subtree: true, attributes: true, attributeFilter: ['hidden', 'disabled'] });
  settle();
}
