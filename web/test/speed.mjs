// How fast pages are: opened, played, and in `kinemend view` after a change of method. Prints a table; the best of several tries, as a
// machine that does other things too makes them slower and never faster.
//
//   node speed.mjs PROGRAM CHROMIUM FOLDER       (the working folder holds playwright-core; takes and pages are made in FOLDER)
import { execFileSync, spawn } from 'node:child_process';
import { mkdirSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launchArgs } from './support.mjs';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [program, executablePath, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const kinemend = (...words) => execFileSync(program, words, { cwd: folder, stdio: 'ignore' });
const best = async (tries, measure) => {
  const all = [];
  for (let i = 0; i < tries; ++i) all.push(await measure());
  return Math.min(...all);
};
const take = (name, seconds) => {
  kinemend('synth', 'walk', '-o', `clean_${name}`, '--duration-s', String(seconds), '--force');
  kinemend('corrupt', `clean_${name}`, '-o', name, '--damage', 'gaussian:std_deg=1.5', '--damage', 'outliers:share=0.004,std_deg=25', '--force');
};

const browser = await chromium.launch({ executablePath, args: launchArgs });

/** Until the first picture is there, and until all frames are; ms. */
async function opened(name) {
  const page = await browser.newPage({ viewport: { width: 1100, height: 900 } });
  const begun = Date.now();
  await page.goto(pathToFileURL(join(folder, name)).href);
  await page.waitForSelector('.tracks tbody tr', { timeout: 60000 });
  const first = Date.now() - begun;
  await page.waitForSelector('#page[data-ready="true"]', { timeout: 60000 });
  const whole = Date.now() - begun;
  await page.close();
  return [first, whole];
}

/** What the page itself does for a frame while it plays: pose, body, curves, time line; ms. The screen comes on top. */
async function frameOf(name) {
  const page = await browser.newPage({ viewport: { width: 1100, height: 900 } });
  await page.goto(pathToFileURL(join(folder, name)).href);
  await page.waitForSelector('#page[data-ready="true"]', { timeout: 60000 });
  const times = await page.evaluate(async () => {
    const { player } = window.kinemend;
    const all = [];
    for (let frame = 0; frame < 150; ++frame) {
      await new Promise((resolve) => requestAnimationFrame(resolve));
      const begun = performance.now();
      player.seek(frame);
      all.push(performance.now() - begun);
    }
    return all.sort((a, b) => a - b);
  });
  await page.close();
  return times[Math.floor(times.length / 2)];
}

for (const [name, seconds] of [['minute', 60], ['ten', 600]]) {
  take(`${name}.bvh`, seconds);
  kinemend('clean', `${name}.bvh`, '--dry-run', '--report', `${name}.html`, '--force');
  const tries = [];
  for (let i = 0; i < 4; ++i) tries.push(await opened(`${name}.html`));
  const [first, whole] = [0, 1].map((k) => Math.min(...tries.map((one) => one[k])));
  console.log(`${seconds / 60} min: ${(statSync(join(folder, `${name}.html`)).size / 1e6).toFixed(2)} MB, seen after ${first} ms, whole after ${whole} ms, ${(await best(3, () => frameOf(`${name}.html`))).toFixed(1)} ms a frame`);
}

take('short.bvh', 10);
const server = spawn(program, ['view', '--no-open', 'short.bvh'], { cwd: folder });
const address = await new Promise((resolve) => {
  let told = '';
  server.stdout.on('data', (text) => {
    told += text;
    if (told.includes('\nCtrl-C')) resolve(told.split('\n')[0]);
  });
});
const page = await browser.newPage({ viewport: { width: 1100, height: 900 } });
await page.goto(address);
await page.waitForSelector('#page[data-ready="true"]', { timeout: 60000 });
for (const method of ['gaussian', 'butterworth', 'median', 'bilateral', 'nonlocal', 'wavelet', 'kalman', 'auto', 'example', 'wiener']) {
  let fastest = Infinity;
  let answer = Infinity;
  for (let i = 0; i < 3; ++i) {
    const runs = await page.getAttribute('#page', 'data-runs');
    await page.selectOption('[data-flag=method]:visible', method === (await page.inputValue('[data-flag=method]:visible')) ? 'hampel' : method);
    await page.waitForSelector(`#page[data-runs]:not([data-runs="${runs}"]):not([data-ready="running"])`, { timeout: 60000 });
    if ((await page.inputValue('[data-flag=method]:visible')) !== method) {
      --i;
      continue;
    }
    const [whole, answered] = (await page.getAttribute('.view-controls .status', 'title')).match(/[\d.]+/g).map(Number);
    fastest = Math.min(fastest, whole);
    answer = Math.min(answer, answered);
  }
  console.log(`10 s by ${method}: ${fastest.toFixed(2)} s, of which ${answer.toFixed(2)} s until the answer is there`);
}
server.kill('SIGINT');
await browser.close();
