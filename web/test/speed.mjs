// Measures the speed of pages: opened, played, and in `kinemend view` after a change of method. Prints a table with the best of several tries,
// because other work on the machine makes them slower and never faster.
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
const take = (name, seconds) => {
  kinemend('synth', 'walk', '-o', `clean_${name}`, '--duration-s', String(seconds), '--force');
  kinemend('corrupt', `clean_${name}`, '-o', name, '--damage', 'gaussian:std_deg=1.5', '--damage', 'outliers:share=0.004,std_deg=25', '--force');
};

const browser = await chromium.launch({ executablePath, args: launchArgs });

/** Processor time of the page's own thread, s; excludes other load. */
async function meter(page) {
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  return async () => (await session.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value;
}

/** Seconds until the body is visible and until all frames are loaded, processor time in seconds, and time per frame in ms. */
async function opened(name) {
  const page = await browser.newPage({ viewport: { width: 1100, height: 900 } });
  const taken = await meter(page);
  const begun = Date.now();
  await page.goto(pathToFileURL(join(folder, name)).href);
  await page.waitForSelector('.tracks tbody tr', { timeout: 60000 });
  const first = (Date.now() - begun) / 1000;
  await page.waitForSelector('#page[data-ready="true"]', { timeout: 60000 });
  const whole = (Date.now() - begun) / 1000;
  const processor = await taken();
  const frame = await frameOf(page);
  await page.close();
  return [first, whole, processor, frame];
}

/** The page's own time per played frame, ms: pose, body, trails and cursors. The time of the screen is additional. */
function frameOf(page) {
  return page.evaluate(async () => {
    const { player } = window.kinemend;
    const all = [];
    player.playing = true;
    for (let frame = 0; frame < 100; ++frame) {
      const begun = performance.now();
      player.seek(frame);
      all.push(performance.now() - begun);
      if (frame % 10 === 0) await new Promise((resolve) => requestAnimationFrame(resolve));
    }
    return all.sort((a, b) => a - b)[50];
  });
}

for (const [name, seconds] of [['minute', 60], ['ten', 600]]) {
  take(`${name}.bvh`, seconds);
  kinemend('clean', `${name}.bvh`, '--dry-run', '--report', `${name}.html`, '--force');
  const tries = [];
  for (let i = 0; i < 3; ++i) tries.push(await opened(`${name}.html`));
  const [first, whole, processor, frame] = [0, 1, 2, 3].map((k) => Math.min(...tries.map((one) => one[k])));
  console.log(`${seconds / 60} min: ${(statSync(join(folder, `${name}.html`)).size / 1e6).toFixed(2)} MB, seen after ${first.toFixed(2)} s, whole after ${whole.toFixed(2)} s (${processor.toFixed(2)} s of processor time), ${frame.toFixed(1)} ms a frame`);
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
/** Time until the program answers this script, s. */
async function answered(flags) {
  const begun = performance.now();
  const reply = await fetch(`${address}run`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ command: 'clean', flags }) });
  await reply.text();
  return (performance.now() - begun) / 1000;
}
const page = await browser.newPage({ viewport: { width: 1100, height: 900 } });
const taken = await meter(page);
await page.goto(address);
await page.waitForSelector('#page[data-ready="true"]', { timeout: 60000 });
for (const method of ['gaussian', 'median', 'nonlocal', 'auto', 'wiener']) {
  const tries = [];
  for (let i = 0; i < 3; ++i) {
    const runs = await page.getAttribute('#page', 'data-runs');
    const page_s = await taken();
    if (i === 0) await page.selectOption('[data-flag=method]:visible', method);
    else await page.fill('[data-flag=strength]:visible', String(1 - i / 10));
    await page.waitForSelector(`#page[data-runs]:not([data-runs="${runs}"]):not([data-ready="running"])`, { timeout: 60000 });
    const whole = Number((await page.getAttribute('.view-controls .status', 'title')).match(/[\d.]+/)[0]);
    tries.push([whole, (await taken()) - page_s]);
  }
  const [whole, page_s] = [0, 1].map((k) => Math.min(...tries.map((one) => one[k])));
  const answers = [];
  for (let i = 0; i < 8; ++i) answers.push(await answered({ method }));
  console.log(`10 s by ${method}: answered after ${Math.min(...answers).toFixed(2)} s, ${page_s.toFixed(2)} s of processor time to show it; in the browser here after ${whole.toFixed(2)} s`);
}
server.kill('SIGINT');
await browser.close();
