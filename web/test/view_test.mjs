// `kinemend view` in a browser: a method is changed, contacts and gaps are edited, the take is saved, and what was saved is compared with
// what the command line makes.
//
//   node view_test.mjs PROGRAM CHROMIUM OUTPUT TAKES       (the working folder holds playwright-core)
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { request as ask } from 'node:http';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [program, executablePath, screenshots, takes] = process.argv.slice(2);
const output = join(screenshots, 'view');
rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });

const kinemend = (...words) => execFileSync(program, words, { cwd: output, stdio: ['ignore', 'pipe', 'ignore'] }).toString();
const bytes = (name) => readFileSync(join(output, name));
writeFileSync(join(output, 'walk.bvh'), readFileSync(join(takes, 'noisy_walk.bvh')));

/** Markers with a gap of eight frames and a long one. */
function markers(name, count, shown) {
  const rows = Array.from({ length: count }, (_, f) => {
    const cells = shown.map((m) => ((m === 1 && f >= 100 && f < 108) || (m === 2 && f >= 40 && f < 260) ? '\t\t' : `${(100 * Math.sin(f / 30 + m)).toFixed(3)}\t${900 + 100 * m}\t${(3 * f).toFixed(3)}`));
    return `${f + 1}\t${(f / 100).toFixed(3)}\t${cells.join('\t')}`;
  });
  writeFileSync(join(output, name), `PathFileType\t4\t(X/Y/Z)\t${name}\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n`
    + `100\t100\t${count}\t4\tmm\t100\t1\t${count}\nFrame#\tTime\t<b>A</b>\t\t\tB\t\t\tC\t\t\tD\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\tX4\tY4\tZ4\n\n${rows.join('\n')}\n`);
}
markers('markers.trc', 300, [0, 1, 2, 3]);

const servers = [];
/** Starts the program; its address. */
async function serve(...words) {
  const child = spawn(program, ['view', '--no-open', ...words], { cwd: output });
  servers.push(child);
  let told = '', errors = '';
  child.stderr.on('data', (text) => { errors += text; });
  return new Promise((resolve, reject) => {
    child.stdout.on('data', (text) => {
      told += text;
      const address = /http:\S+/.exec(told);
      if (address && told.includes('\nCtrl-C')) resolve({ address: address[0], child });
    });
    child.on('exit', (code) => reject(new Error(`view ended with ${code}: ${errors}`)));
  });
}

/** Status of a request that is no page's. */
function status(address, { path, method = 'GET', headers = {}, body } = {}) {
  const url = new URL(address);
  return new Promise((resolve, reject) => {
    const sent = ask({ host: '127.0.0.1', port: url.port, path: path ?? url.pathname, method, headers }, (reply) => {
      reply.resume();
      reply.on('end', () => resolve(reply.statusCode));
    });
    sent.on('error', reject);
    sent.end(body);
  });
}

const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
const pages = [];
async function open(address, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1100, height: 900 }, ...options });
  pages.push(page);
  page.on('pageerror', (error) => assert.fail(String(error)));
  await page.goto(address);
  await ready(page);
  return page;
}
async function ready(page) {
  await page.waitForSelector('#page[data-ready="true"], #page[data-ready="error"]', { timeout: 30000 });
}
/** Waits for the run that a change starts. */
async function after(page, change) {
  const before = await page.getAttribute('#page', 'data-runs');
  await change();
  // The page's own rules forbid what waitForFunction needs.
  await page.waitForSelector(`#page[data-runs]:not([data-runs="${before}"]):not([data-ready="running"])`, { timeout: 60000 });
  assert.equal(await page.getAttribute('#page', 'data-ready'), 'true', await page.textContent('.view-controls .status'));
}
const shot = async (page, name) => {
  await page.waitForTimeout(200);
  await page.screenshot({ path: join(screenshots, `view_${name}.png`), fullPage: true });
};
/** The words of the command line that the page shows. */
const words = (line) => [...line.matchAll(/'((?:[^']|'\\'')*)'|(\S+)/g)].map((match) => match[2] ?? match[1].replace(/'\\''/g, "'")).slice(1);
/** The page's own command line, into another file. */
function runShown(line, from, to) {
  kinemend(...words(line).map((word) => (word === `--output=${from}` ? `--output=${to}` : word)));
}

const steps = [];
const step = (name, run) => steps.push([name, run]);

step('a method is changed, and what is saved has the bytes of the command line', async () => {
  const { address } = await serve('walk.bvh');
  const page = await open(address);
  await shot(page, 'first');
  const first = await page.textContent('.verdict');
  await page.click('button:has-text("Play")');
  await page.click('button:has-text("Pause")');
  await page.fill('.number', '200');
  await page.keyboard.press('Tab');
  const frame = await page.evaluate(() => window.kinemend.player.shown);
  await after(page, () => page.selectOption('[data-flag=method]:visible', 'butterworth'));
  assert.notEqual(await page.textContent('.verdict'), first);
  assert.equal(await page.evaluate(() => window.kinemend.player.shown), frame, 'the time is lost');
  await after(page, () => page.fill('[data-flag=cutoff_hz]:visible', '7'));
  await after(page, () => page.fill('[data-flag=strength]:visible', '0.8'));
  await after(page, () => page.fill('[data-flag=joints]:visible', 'Left*'));
  await after(page, () => page.fill('[data-flag=range]:visible', '100:400'));
  const told = `${await page.textContent('.view-controls .status')}, ${await page.getAttribute('.view-controls .status', 'title')}`;
  console.log(`  a run of ${await page.evaluate(() => window.kinemend.take.told / window.kinemend.take.rate)} s of motion: ${told}`);
  await page.click('[data-action=save]');
  await page.waitForSelector('.saved:has-text("saved walk.clean.bvh")');
  kinemend('clean', 'walk.bvh', '--method', 'butterworth', '--cutoff-hz', '7', '--strength', '0.8', '--joints', 'Left*', '--range', '100:400', '-o', 'cli.bvh');
  assert.deepEqual(bytes('walk.clean.bvh'), bytes('cli.bvh'));
  runShown(await page.textContent('.line'), 'walk.clean.bvh', 'shown.bvh');
  assert.deepEqual(bytes('shown.bvh'), bytes('cli.bvh'));
  await shot(page, 'butterworth');
  // What this page has saved it may replace.
  await page.click('[data-action=save]');
  await page.waitForSelector('.saved:has-text("saved walk.clean.bvh")');
});

step('a file that was there before is not replaced', async () => {
  const { address } = await serve('walk.bvh');
  const page = await open(address);
  const before = bytes('walk.clean.bvh');
  await page.click('[data-action=save]');
  await page.waitForSelector('.saved.error:has-text("exists already")');
  assert.deepEqual(bytes('walk.clean.bvh'), before);
});

step('an option out of range is said, and the page goes on', async () => {
  const { address } = await serve('walk.bvh', '-o', 'range.bvh');
  const page = await open(address);
  await page.fill('[data-flag=range]:visible', '9999:');
  await page.waitForSelector('#page[data-ready="error"]');
  assert.match(await page.textContent('.view-controls .status'), /walk\.bvh: .*9999/);
  await shot(page, 'error');
  await after(page, () => page.fill('[data-flag=range]:visible', ''));
});

step('runs that are overtaken leave the last', async () => {
  const { address } = await serve('walk.bvh', '-o', 'last.bvh');
  const page = await open(address);
  // Faster than the page waits before it runs: several requests at once.
  const replies = await page.evaluate(async () => Promise.all(['gaussian', 'median', 'auto', 'butterworth'].map(async (method) => {
    const reply = await fetch('run', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ command: 'clean', flags: { method } }) });
    return reply.status;
  })));
  assert.ok(replies.includes(200) && replies.includes(409), replies.join(' '));
});

step('contacts are edited, used and saved as the file that clean reads', async () => {
  const { address } = await serve('walk.bvh', '-o', 'held.bvh', '--contacts', 'walk.contacts');
  const page = await open(address);
  await page.click('summary:has-text("Contacts")');
  await after(page, () => page.click('[data-action=contacts]'));
  const found = await page.inputValue('textarea');
  assert.match(found, /left heel \d+ \d+/);
  const lines = found.split('\n').filter((line) => /^(left|right)/.test(line));
  await after(page, () => page.fill('textarea', `${lines.slice(1).join('\n')}\n`));
  await shot(page, 'contacts');
  await page.click('[data-action=save]');
  await page.waitForSelector('.saved:has-text("walk.contacts")');
  assert.equal(bytes('walk.contacts').toString(), `${lines.slice(1).join('\n')}\n`);
  kinemend('clean', 'walk.bvh', '--contacts', 'walk.contacts', '-o', 'cli_held.bvh');
  assert.deepEqual(bytes('held.bvh'), bytes('cli_held.bvh'));
});

step('gaps are looked at, refused and given another method, and the plan is saved', async () => {
  const { address } = await serve('markers.trc', '-o', 'filled.trc', '--plan', 'plan.csv');
  const page = await open(address);
  await after(page, () => page.selectOption('[data-flag=command]:visible', 'fill'));
  await page.click('summary:has-text("Gap plan")');
  assert.equal(await page.locator('.editor tbody tr').count(), 2);
  await after(page, () => page.click('[data-action=preview]'));
  assert.match(await page.textContent('[data-gap=method]'), /off\)/);
  await shot(page, 'gaps');
  await after(page, () => page.locator('[data-gap=method]').nth(0).selectOption('pchip'));
  await after(page, () => page.locator('[data-gap=verdict]').nth(1).selectOption('force'));
  assert.match(await page.textContent('.verdict'), /2 filled, 0 refused/);
  await page.click('[data-action=save]');
  await page.waitForSelector('.saved:has-text("saved plan.csv, filled.trc")');
  kinemend('fill', 'markers.trc', '--plan', 'plan.csv', '-o', 'cli_filled.trc');
  assert.deepEqual(bytes('filled.trc'), bytes('cli_filled.trc'));
  assert.match(bytes('plan.csv').toString(), /\nB,position,101,108,8,0.08,fill,pchip,/);
  await after(page, () => page.locator('[data-gap=verdict]').nth(0).selectOption('refuse'));
  assert.match(await page.textContent('.verdict'), /1 filled, 1 refused/);
});

step('requests of others are refused', async () => {
  const { address } = await serve('walk.bvh', '-o', 'other.bvh');
  const url = new URL(address);
  const json = { 'Content-Type': 'application/json', Host: url.host };
  const body = JSON.stringify({ command: 'clean', flags: {} });
  const run = `${url.pathname}run`;
  assert.equal(await status(address, { path: '/' }), 403);
  assert.equal(await status(address, { path: '/run', method: 'POST', headers: json, body }), 403);
  assert.equal(await status(address, { headers: { Host: `localhost:${url.port}` } }), 403);
  assert.equal(await status(address, { headers: { Host: 'evil.example' } }), 403);
  assert.equal(await status(address, { path: run, method: 'POST', headers: { ...json, Origin: 'http://evil.example' }, body }), 403);
  assert.equal(await status(address, { path: run, method: 'POST', headers: { Host: url.host, 'Content-Type': 'text/plain' }, body }), 415);
  assert.equal(await status(address, { path: `${url.pathname}../../etc/passwd` }), 404);
  assert.equal(await status(address, { path: `${url.pathname}walk.bvh` }), 404);
  for (const flags of [{ output: '/tmp/x.bvh' }, { config: '/etc/passwd' }, { method: 'sparse', model: '/etc/passwd' }, { gaps: 'x' }, { 'joints=a --output': 'y' }])
    assert.equal(await status(address, { path: run, method: 'POST', headers: json, body: JSON.stringify({ command: 'clean', flags }) }), 400, JSON.stringify(flags));
  assert.equal(await status(address, { path: run, method: 'POST', headers: json, body: 'x' }), 400);
  assert.equal(await status(address, { path: run, method: 'POST', headers: json, body }), 200);
  assert.equal(existsSync(join(output, 'other.bvh')), false);
});

step('two takes are compared', async () => {
  const { address } = await serve('walk.bvh', 'walk.clean.bvh');
  const page = await open(address);
  assert.match(await page.textContent('.body .head'), /reference.*other/);
  assert.equal(await page.locator('.view-controls').count(), 0);
});

step('the keyboard alone, dark, narrow', async () => {
  const { address } = await serve('walk.bvh', '-o', 'keys.bvh');
  const page = await open(address, { colorScheme: 'dark', viewport: { width: 380, height: 800 } });
  await shot(page, 'narrow');
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  assert.ok(wide <= 0, `${wide} pixels too wide`);
  await page.focus('[data-flag=method]:visible');
  await after(page, () => page.keyboard.type('median'));
  assert.equal(await page.evaluate(() => document.activeElement?.dataset.flag), 'method', 'the focus is lost');
  while ((await page.evaluate(() => document.activeElement?.dataset.action)) !== 'save') await page.keyboard.press('Shift+Tab');
  await page.keyboard.press('Enter');
  await page.waitForSelector('.saved:has-text("saved keys.bvh")');
});

step('Ctrl-C ends it, and the page says so', async () => {
  const { address, child } = await serve('walk.bvh', '-o', 'ended.bvh');
  const page = await open(address);
  const code = new Promise((resolve) => child.on('exit', resolve));
  child.removeAllListeners('exit');
  const ended = new Promise((resolve) => child.on('exit', resolve));
  child.kill('SIGINT');
  assert.equal(await Promise.race([ended, code, new Promise((resolve) => setTimeout(resolve, 5000, 'still there'))]), 0);
  await page.fill('[data-flag=strength]:visible', '0.5');
  await page.waitForSelector('.view-controls .error:has-text("has ended")');
});

let failed = 0;
for (const [name, run] of steps) {
  const begun = Date.now();
  try {
    await run();
    console.log(`passed: ${name} (${Date.now() - begun} ms)`);
  } catch (error) {
    failed += 1;
    console.error(`FAILED: ${name}\n${error.stack}`);
  }
  for (const page of pages.splice(0)) await page.close();
  for (const child of servers.splice(0)) {
    child.removeAllListeners('exit');
    child.kill('SIGINT');
  }
}
await browser.close();
process.exit(failed > 0 ? 1 : 0);
