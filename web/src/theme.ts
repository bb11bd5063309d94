// Light and dark: the system's setting, until the user chooses.

import { button } from './dom';

const dark = matchMedia('(prefers-color-scheme: dark)');

export function isDark(): boolean {
  const chosen = document.documentElement.dataset.theme;
  return chosen === undefined ? dark.matches : chosen === 'dark';
}

/** Aborting `signal` ends it. */
export function themeButton(onChange: () => void, signal?: AbortSignal): HTMLButtonElement {
  const made: HTMLButtonElement = button('', 'switch between light and dark', () => {
    document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
    update();
    onChange();
  });
  const update = (): void => { made.textContent = isDark() ? 'Light' : 'Dark'; };
  dark.addEventListener('change', () => {
    update();
    onChange();
  }, { signal });
  update();
  return made;
}
