// Measures the speed of kinemend.html: until it is shown and its module runs, from a drop to the drawn result, and the longest time that its own
// thread is busy without a break. Prints medians; the takes are made in FOLDER.
//
//   node app_speed.mjs PROGRAM CHROMIUM APP FOLDER [TRIES]       (the working folder holds playwright-core)
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launchArgs, watchStalls } from './support.mjs';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [program, executablePath, app, folder, tries = '5'] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const kinemend = (...words) => execFileSync(program, words, { cwd: folder, stdio: 'ignore' });

function take(name, seconds) {
  if (existsSync(join(folder, name))) return;
  kinemend('synth', 'walk', '-o', `clean_${name}`, '--duration-s', String(seconds), '--frame-rate-hz', '120', '--force');
  kinemend('corrupt', `clean_${name}`, '-o', name, '--damage', 'gaussian:std_deg=1.5', '--damage', 'outliers:share=0.004,std_deg=25', '--force');
}

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const browser = await chromium.launch({ executablePath, args: launchArgs });

async function until(page, test, argument) {
  for (const end = performance.now() + 600_000; !(await page.evaluate(test, argument));) {
    if (performance.now() > end) throw new Error(`waited for ${test}`);
    await new Promise((done) => { setTimeout(done, 20); });
  }
}

/** Times of one opened page, ms: until it is shown, until the module runs, and for each take. The first take is dropped after `pause` ms. */
async function measured(names, pause) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  await page.addInitScript(watchStalls);
  await page.goto(pathToFileURL(app).href);
  await until(page, () => window.watched.ready.some(([state]) => state === 'waiting'));
  await until(page, () => document.querySelector('#bar .status')?.textContent === '');
  const times = await page.evaluate(() => ({ shown: window.watched.ready[0][1], begun: window.watched.quiet(), stall: window.watched.longest() }));
  times.takes = [];
  await new Promise((done) => { setTimeout(done, pause); });
  for (const name of names) {
    await page.evaluate(() => window.watched.reset());
    await page.setInputFiles('#bar input[type=file]', join(folder, name));
    await until(page, () => window.watched.drawn > 0 || window.watched.ready.some(([state]) => state === 'error'));
    await page.evaluate(() => new Promise((done) => { setTimeout(done, 300); }));
    times.takes.push(await page.evaluate(() => ({ told: document.querySelector('.view-controls .status')?.title, drawn: window.watched.drawn, stall: window.watched.longest() })));
  }
  await page.close();
  return times;
}

take('ten_seconds.bvh', 10);
const all = [];
const hurried = [];
for (let i = 0; i < Number(tries); ++i) {
  all.push(await measured(['ten_seconds.bvh', 'ten_seconds.bvh'], 2000));
  hurried.push(await measured(['ten_seconds.bvh'], 0));
}
const of = (get, from = all) => Math.round(median(from.map(get)));
console.log(`start: shown after ${of(({ shown }) => shown)} ms, module ready after ${of(({ begun }) => begun)} ms, longest stall ${of(({ stall }) => stall)} ms`);
console.log(`10 s, dropped as soon as the module is ready: drawn ${of(({ takes }) => takes[0].drawn, hurried)} ms after the drop`);
['dropped 2 s later', 'next take'].forEach((label, i) =>
  console.log(`10 s, ${label}: drawn ${of(({ takes }) => takes[i].drawn)} ms after the drop, longest stall ${of(({ takes }) => takes[i].stall)} ms`));
if (process.env.DETAILS) console.log(JSON.stringify(all, null, 1));

take('ten_minutes.bvh', 600);
const long = (await measured(['ten_minutes.bvh'], 2000)).takes[0];
console.log(`${(statSync(join(folder, 'ten_minutes.bvh')).size / 1e6).toFixed(1)} MB: drawn ${(long.drawn / 1000).toFixed(1)} s after the drop, longest stall ${Math.round(long.stall)} ms`);
console.log(long.told);
await browser.close();
