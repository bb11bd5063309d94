// Shared by the browser tests: the browser, synthetic takes, and contrast.
import { writeFileSync } from 'node:fs';

export const launchArgs = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];

export const strange = '"\'<script>window.broken=1</script>&\u202e\u00e9\u{1f600}';

/** Two joints in closed form: a forearm that rotates about Z by 9 degrees per frame at the end of an arm of 30. */
export function arm(path, frames, { rate = 100, turn = 9 } = {}) {
  const rows = Array.from({ length: frames }, (_, f) => `1 2 3 0 0 0 ${turn * f} 0 0`);
  writeFileSync(path, `HIERARCHY\nROOT ${strange}\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n`
    + '  JOINT Elbow\n  {\n    OFFSET 30 0 0\n    CHANNELS 3 Zrotation Xrotation Yrotation\n    End Site\n    {\n      OFFSET 20 0 0\n    }\n  }\n}\n'
    + `MOTION\nFrames: ${frames}\nFrame Time: ${1 / rate}\n${rows.join('\n')}\n`);
}

/** `count` joints, in chains of twenty around the root. */
export function manyJoints(path, count, frames) {
  const lines = ['HIERARCHY', 'ROOT Root', '{', 'OFFSET 0 0 0', 'CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation'];
  for (let made = 1; made < count;) {
    const length = Math.min(20, count - made);
    for (let k = 0; k < length; ++k, ++made) {
      const angle = (2 * Math.PI * made) / count;
      lines.push(`JOINT J${made}`, '{', `OFFSET ${(k === 0 ? 30 * Math.cos(angle) : 0).toFixed(3)} 5 ${(k === 0 ? 30 * Math.sin(angle) : 0).toFixed(3)}`, 'CHANNELS 3 Zrotation Xrotation Yrotation');
    }
    lines.push('End Site', '{', 'OFFSET 0 2 0', '}', ...Array(length).fill('}'));
  }
  const row = (f) => [f, 90, 0, ...Array.from({ length: 3 * count }, (_, c) => (3 * Math.sin(f / 20 + c)).toFixed(3))].join(' ');
  writeFileSync(path, `${lines.join('\n')}\n}\nMOTION\nFrames: ${frames}\nFrame Time: 0.0083333\n${Array.from({ length: frames }, (_, f) => row(f)).join('\n')}\n`);
}

/** A TRC file; `at(frame, marker)` returns x, y and z, or null for a missing sample. */
export function markers(path, names, frames, at) {
  const rows = Array.from({ length: frames }, (_, f) => {
    const cells = names.map((_name, m) => at(f, m)?.map((value) => value.toFixed(3)).join('\t') ?? '\t\t');
    return `${f + 1}\t${(f / 100).toFixed(3)}\t${cells.join('\t')}`;
  });
  writeFileSync(path, `PathFileType\t4\t(X/Y/Z)\tmade.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n`
    + `100\t100\t${frames}\t${names.length}\tmm\t100\t1\t${frames}\nFrame#\tTime\t${names.join('\t\t\t')}\t\t\n\t\t${names.map((_, m) => `X${m + 1}\tY${m + 1}\tZ${m + 1}`).join('\t')}\n\n${rows.join('\n')}\n`);
}

/** Four markers on a wavy path: the second is missing for eight frames, the third for 220. */
export function fourMarkers(path) {
  markers(path, ['<b>A</b>', 'B', 'C', 'D'], 300, (f, m) => ((m === 1 && f >= 100 && f < 108) || (m === 2 && f >= 40 && f < 260) ? null : [100 * Math.sin(f / 30 + m), 900 + 100 * m, 3 * f]));
}

/** Visible texts with less contrast than WCAG 2 (AA) requires, with their contrast. */
export function faintTexts(page) {
  return page.evaluate(() => {
    const parts = (text) => {
      const numbers = text.match(/[\d.]+/g).map(Number);
      return text.startsWith('color(') ? [...numbers.slice(0, 3).map((c) => 255 * c), numbers[3] ?? 1] : [numbers[0], numbers[1], numbers[2], numbers[3] ?? 1];
    };
    const over = (front, back) => front.slice(0, 3).map((c, i) => c * front[3] + back[i] * (1 - front[3]));
    const behind = (node) => {
      if (node === null) return [255, 255, 255];
      const colour = parts(getComputedStyle(node).backgroundColor);
      return colour[3] === 1 ? colour.slice(0, 3) : over(colour, behind(node.parentElement));
    };
    const light = (colour) => {
      const [r, g, b] = colour.map((c) => c / 255).map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const faint = [];
    for (const node of document.body.querySelectorAll('*')) {
      const own = [...node.childNodes].some((child) => child.nodeType === 3 && child.textContent.trim() !== '');
      const typed = /^(INPUT|SELECT|TEXTAREA)$/.test(node.tagName);
      if ((!own && !typed) || /^(SCRIPT|STYLE|OPTION|NOSCRIPT)$/.test(node.tagName) || node.matches(':disabled') || !node.checkVisibility()) continue;
      const back = behind(node);
      const styles = [getComputedStyle(node)];
      if (node.placeholder) styles.push(getComputedStyle(node, '::placeholder'));
      for (const style of styles) {
        const text = node.ownerSVGElement ? style.fill : style.color;
        const [x, y] = [light(over(parts(text), back)), light(back)].sort((a, b) => b - a);
        const contrast = (x + 0.05) / (y + 0.05);
        const size = parseFloat(style.fontSize);
        const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
        if (contrast < (large ? 3 : 4.5)) faint.push(`${node.tagName}.${node.className} "${(node.textContent || node.placeholder || '').slice(0, 30)}": ${contrast.toFixed(2)}`);
      }
    }
    return faint;
  });
}

/**
 * Runs in a page before all other scripts. window.watched returns the longest time that the page's thread was busy without a break, ms, and when
 * the page was ready, ms after it was opened or a file was last chosen.
 */
export function watchStalls() {
  const watched = { ready: [], drawn: 0, last: performance.now(), most: 0, from: 0 };
  const { port1, port2 } = new MessageChannel();
  const beat = () => {
    const now = performance.now();
    watched.most = Math.max(watched.most, now - watched.last);
    watched.last = now;
    setTimeout(() => port2.postMessage(null), 2);
  };
  port1.onmessage = beat;
  beat();
  watched.longest = () => Math.max(watched.most, performance.now() - watched.last);
  watched.quiet = () => watched.ended ?? 0;
  watched.reset = () => Object.assign(watched, { ready: [], drawn: 0, most: 0, last: performance.now(), from: performance.now() });
  addEventListener('change', (event) => { if (event.target.type === 'file') watched.from = performance.now(); }, true);
  new MutationObserver((changes) => {
    const page = document.getElementById('page');
    if (changes.some(({ attributeName, target }) => attributeName === 'data-ready' && target === page)) {
      const at = performance.now() - watched.from;
      watched.ready.push([page.dataset.ready, at]);
      if (page.dataset.ready === 'true') requestAnimationFrame(() => setTimeout(() => { watched.drawn = performance.now() - watched.from; }, 0));
    }
    if (document.querySelector('#bar .status')?.textContent === '') watched.ended ??= performance.now();
  }).observe(document, { subtree: true, childList: true, attributes: true, attributeFilter: ['data-ready'], characterData: true });
  window.watched = watched;
}
