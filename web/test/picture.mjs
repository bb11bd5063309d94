// Takes a screenshot of a page.
//
//   node picture.mjs CHROMIUM PAGE.html PICTURE.png [light|dark] [KEY...]       (the working folder holds playwright-core)
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

// A page is a file or an address. A KEY with a = sets a control of `kinemend view`, `gap=N` compares the curves of a gap, and one with a ? opens the
// details of that name. `hide=before` hides one of the two bodies, and `part=body` captures only that section.

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [executablePath, html, picture, colorScheme = 'light', ...keys] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
const page = await browser.newPage({ viewport: { width: 1080, height: 830 }, colorScheme });
await page.goto(/^http:/.test(html) ? html : pathToFileURL(resolve(html)).href);
await page.waitForSelector('#page[data-ready="true"]');
let part = page;
for (const key of keys) {
  const [, flag, value] = /^(\w+)=(.*)$/.exec(key) ?? [];
  if (flag === 'gap') {
    await page.locator('[data-gap=curves]').nth(Number(value)).click();
    await page.waitForSelector('.gap-plots canvas');
  } else if (flag === 'hide') {
    await page.click(`[data-option=${value}]`);
  } else if (flag === 'part') {
    part = page.locator(`section.${value}`);
  } else if (flag) {
    const before = await page.getAttribute('#page', 'data-runs');
    const control = page.locator(`[data-flag=${flag}]:visible`);
    if ((await control.evaluate((one) => one.tagName)) === 'SELECT') await control.selectOption(value);
    else await control.fill(value);
    await page.waitForSelector(`#page[data-runs]:not([data-runs="${before}"])`);
  } else if (key.endsWith('?')) {
    await page.click(`summary:has-text("${key.slice(0, -1)}")`);
  } else {
    await page.keyboard.press(key);
  }
}
await page.waitForTimeout(300);
await part.screenshot({ path: picture });
await browser.close();
