// Tests the report page in a browser: opens, plays, scrubs, searches and zooms as a user would. Screenshots of every state are left in the output
// folder for inspection.
//
//   node page_test.mjs PROGRAM CHROMIUM OUTPUT TAKES       (NODE_PATH or the working folder holds playwright-core)
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { arm as makeArm, faintTexts, fourMarkers, launchArgs, manyJoints, markers, strange } from './support.mjs';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [program, executablePath, output, takes] = process.argv.slice(2);
mkdirSync(output, { recursive: true });

function kinemend(...words) {
  execFileSync(program, words, { cwd: output, stdio: 'ignore' });
}

const arm = (name, frames, options) => makeArm(join(output, name), frames, options);

const names = { J1: 'RightHandThumbProximal', J2: 'RightHandMiddThumbProximal', J3: 'RightHandTinyThumbProximal' };

function makePages() {
  const walk = join(takes, 'walk.bvh');
  const noisy = join(takes, 'noisy_walk.bvh');
  kinemend('clean', noisy, '-o', 'clean.bvh', '--feet', 'auto', '--report', 'clean.html', '--force');
  kinemend('compare', walk, noisy, '--report', 'compare.html', '--force');
  kinemend('check', walk, '--report', 'walk_check.html', '--force');
  arm('arm.bvh', 21);
  kinemend('check', 'arm.bvh', '--report', 'arm.html', '--force');
  arm('one.bvh', 1);
  kinemend('check', 'one.bvh', '--report', 'one.html', '--force');
  arm('none.bvh', 0);
  kinemend('check', 'none.bvh', '--report', 'none.html', '--force');
  mkdirSync(join(output, 'raw'), { recursive: true });
  arm('raw/arm.bvh', 21);
  arm('raw/one <b>.bvh', 1);
  writeFileSync(join(output, 'raw', 'bad.bvh'), 'bad');
  try {
    kinemend('batch', 'raw', '-o', 'cleaned', '--report', 'index.html', '--quiet', '--force');
  } catch (error) {
    assert.equal(error.status, 3);
  }
  // Markers with a filled gap and a refused one.
  fourMarkers(join(output, 'markers.trc'));
  // Nothing is visible in the first five frames.
  writeFileSync(join(output, 'late.trc'), readFileSync(join(output, 'markers.trc'), 'utf8').split('\n')
    .map((line) => (/^[1-5]\t/.test(line) ? line.split('\t').map((cell, i) => (i < 2 ? cell : '')).join('\t') : line)).join('\n'));
  kinemend('check', 'late.trc', '--report', 'late.html', '--force');
  kinemend('fill', 'markers.trc', '-o', 'filled.trc', '--report', 'fill.html', '--force');
  markers(join(output, 'unseen.trc'), ['A', 'B'], 20, () => null);
  kinemend('check', 'unseen.trc', '--report', 'unseen.html', '--force');
  // A rod of three markers that rotates, and a fourth marker that comes and goes.
  markers(join(output, 'rod.trc'), ['Hip', 'Knee', 'Ankle', 'Far'], 120, (f, m) => (m === 3 ? [5 * f, 900, 3000 - 20 * f] : [300 * m * Math.cos(f / 20), 900 + 300 * m * Math.sin(f / 20), 0]));
  kinemend('check', 'rod.trc', '--report', 'rod.html', '--force');
  manyJoints(join(output, 'many.bvh'), 400, 120);
  kinemend('clean', 'many.bvh', '-o', 'many.clean.bvh', '--report', 'many.html', '--force');
  // Names with a common beginning, and two that would be shortened to the same.
  writeFileSync(join(output, 'prefix.bvh'), readFileSync(join(output, 'many.bvh'), 'utf8').replaceAll(/(ROOT|JOINT) (\w+)/g, (_all, kind, name) => `${kind} mixamorig:${names[name] ?? name}`));
  kinemend('clean', 'prefix.bvh', '-o', 'prefix.clean.bvh', '--report', 'prefix.html', '--force');
  // A runner with both arms stretched, and two people three metres apart.
  kinemend('corrupt', join(takes, 'walk.bvh'), '-o', 'wide.bvh', '--damage', 'bias:bias_deg=60', '--seed', '2', '--force');
  kinemend('clean', 'wide.bvh', '-o', 'wide.clean.bvh', '--method', 'gaussian', '--report', 'wide.html', '--force');
  markers(join(output, 'two.trc'), ['A:Head', 'A:Hip', 'A:Foot', 'B:Head', 'B:Hip', 'B:Foot'], 200, (f, m) => [3000 * Math.floor(m / 3) * Math.cos(f / 40) + 40 * f + 200 * Math.sin(2.1 * f + m), 1700 - 800 * (m % 3), 3000 * Math.floor(m / 3) * Math.sin(f / 40)]);
  kinemend('compare', 'two.trc', 'two.trc', '--report', 'markers_compared.html', '--force');
  kinemend('clean', 'two.trc', '-o', 'two.clean.trc', '--method', 'gaussian', '--report', 'two.html', '--force');
  // An hour, of which every eighth frame is loaded first.
  arm('hour.bvh', 432000, { rate: 120, turn: 0.01 });
  kinemend('clean', 'hour.bvh', '--dry-run', '--method', 'gaussian', '--report', 'hour.html', '--force');
}

makePages();
const only = process.env.STEPS ? new RegExp(process.env.STEPS) : /./;
const browser = await chromium.launch({ executablePath, args: launchArgs });
const steps = [];
const pages = [];
const step = (name, run) => steps.push([name, run]);

async function open(name, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1100, height: 800 }, ...options });
  pages.push(page);
  page.on('pageerror', (error) => assert.fail(`${name}: ${error}`));
  page.on('console', (message) => assert.notEqual(message.type(), 'error', `${name}: ${message.text()}`));
  page.on('request', (request) => assert.ok(/^(file|data|blob):/.test(request.url()), `${name} fetches ${request.url()}`));
  await page.goto(pathToFileURL(join(output, name)).href);
  await page.waitForSelector('#page[data-ready]', { timeout: 120000 });
  assert.equal(await page.getAttribute('#page', 'data-ready'), 'true', await page.textContent('#page'));
  assert.equal(await page.evaluate(() => window.broken), undefined);
  return page;
}
/** Takes a screenshot for inspection; drawing a whole page takes seconds, so it does nothing unless SCREENSHOTS is set. */
const shot = async (page, name) => {
  if (!process.env.SCREENSHOTS) return;
  await page.waitForTimeout(150);
  await page.screenshot({ path: join(output, `${name}.png`), fullPage: true, timeout: 120000 });
};
const frame = (page) => page.evaluate(() => window.kinemend.player.shown);
const wide = (page) => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
const inView = (page) => page.evaluate(() => {
  const { take, body } = window.kinemend;
  const all = Array.from({ length: take.points }, (_, p) => body.seen(p)).filter((at) => at !== null);
  return all.filter(([x, y]) => Math.abs(x) < 1 && Math.abs(y) < 1).length / all.length;
});

step('the motion is what the closed form says', async () => {
  const page = await open('arm.html');
  for (const f of [0, 5, 20]) {
    const pose = await page.evaluate((at) => [...window.kinemend.take.pose(at, 'before')], f);
    const angle = (9 * f * Math.PI) / 180;
    const expected = [1, 2, 3, 31, 2, 3, 31 + 20 * Math.cos(angle), 2 + 20 * Math.sin(angle), 3];
    pose.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < 0.02, `frame ${f}, ${i}: ${value} and ${expected[i]}`));
  }
});

step('play, pause, scrub and jump', async () => {
  const page = await open('clean.html');
  await shot(page, 'clean');
  assert.ok((await inView(page)) > 0.99, 'the body is out of view');
  await page.keyboard.press('Home');
  await page.click('text=Play');
  while ((await frame(page)) <= 20) await page.waitForTimeout(20);
  await page.click('text=Pause');
  const stopped = await frame(page);
  await page.waitForTimeout(80);
  assert.equal(await frame(page), stopped);
  await page.fill('.transport input[type=range]', '500');
  assert.equal(await frame(page), 500);
  assert.equal(await page.inputValue('.transport .number'), '501');
  assert.ok((await inView(page)) > 0.99, 'the camera does not follow');
  await page.click('button:has-text("Follow")');
  await page.fill('.transport input[type=range]', '900');
  assert.ok(Math.abs(await page.evaluate(() => window.kinemend.body.seen(0)[1])) > 0.3, 'the camera follows unasked');
  await page.click('button:has-text("Follow")');
  assert.ok((await inView(page)) > 0.99, 'the camera does not go to the body');

  // The first spike: a click on its bar goes there and shows its track.
  const spike = await page.evaluate(() => {
    const { timeline, player, take } = window.kinemend;
    player.zoom(0, take.told - 1);
    const at = timeline.shown.find((one) => one.kind === 'spike');
    return { first: at.first_frame, track: at.track, frames: take.told };
  });
  const box = await page.locator('.timeline canvas').boundingBox();
  await page.mouse.click(box.x + (box.width * (spike.first - 1 + 0.2)) / (spike.frames - 1), box.y + 9);
  assert.equal(await frame(page), spike.first - 1);
  assert.ok((await page.textContent('.selected')).includes(spike.track));
  assert.equal(await page.textContent('tr.chosen th'), spike.track);
});

step('the page opens at the worst finding, which is marked, in the frame where the most was changed', async () => {
  const page = await open('clean.html');
  const told = await page.evaluate(() => {
    const { timeline, player, take } = window.kinemend;
    const spikes = timeline.shown.filter((one) => one.kind === 'spike');
    const worst = spikes.reduce((a, b) => (b.amount > a.amount ? b : a));
    return { frame: take.number(player.shown), first: worst.first_frame, last: worst.last_frame, isChosen: timeline.shown[timeline.selected] === worst, track: worst.track };
  });
  assert.ok(told.frame >= told.first && told.frame <= told.last && told.frame > 1, JSON.stringify(told));
  assert.ok(told.isChosen);
  assert.equal(await page.textContent('tr.chosen th'), told.track);
  assert.match(await page.textContent('.tally'), /\d+ findings/);
  await page.click('summary');
  assert.match(await page.textContent('.findings [aria-current]'), /spike/);
  const row = await page.locator('tr.chosen').boundingBox(), table = await page.locator('.tracks .scroll').boundingBox();
  assert.ok(row.y >= table.y && row.y + row.height <= table.y + table.height + 1, 'the chosen row is out of sight');
  // Smoothing lasts the whole take, so the frame with the largest change is used.
  const smoothed = await open('wide.html');
  const ways = await smoothed.evaluate(() => {
    const { take, player } = window.kinemend;
    return { here: take.distance(player.shown), all: Array.from({ length: take.told }, (_, f) => take.distance(f)) };
  });
  assert.ok(ways.here > 0.9 * Math.max(...ways.all), `${ways.here} of ${Math.max(...ways.all)}`);
});

step('stands are drawn by foot and part, the surer the stronger, and a click goes there', async () => {
  for (const file of ['clean.html', 'walk_check.html']) {
    const page = await open(file);
    assert.deepEqual(await page.locator('.stand-lanes .lane span:first-child').allTextContents(), ['left heel', 'left toe', 'right heel', 'right toe']);
    const told = await page.evaluate(() => {
      const { player, take } = window.kinemend;
      player.zoom(0, take.told - 1);
      const own = take.data.stage.contacts.filter(({ foot }) => foot === 'left toe');
      return { own, frames: take.told, all: take.data.stage.contacts.every(({ confidence }) => confidence > 0 && confidence <= 1) };
    });
    assert.ok(told.all && told.own.length > 1, 'stands of the left toe with a confidence');
    const stand = told.own[1];
    await page.locator('.stand-lanes canvas').scrollIntoViewIfNeeded();
    const box = await page.locator('.stand-lanes canvas').boundingBox();
    const at = (frame) => box.x + (box.width * frame) / (told.frames - 1);
    const middle = Math.round((stand.first + stand.last) / 2);
    await page.mouse.click(at(middle), box.y + 16 + 8);
    assert.equal(await frame(page), middle);
    assert.match(await page.getAttribute('.stand-lanes canvas', 'title'), new RegExp(`left toe stands in frames ${stand.first + 1} to ${stand.last + 1}, confidence`));
    const paint = await page.evaluate(([x, y]) => {
      const canvas = document.querySelector('.stand-lanes canvas');
      const scale = canvas.width / canvas.clientWidth;
      return [...canvas.getContext('2d').getImageData(x * scale, y * scale, 1, 1).data];
    }, [at(middle) - box.x, 24]);
    const air = await page.evaluate(([x, y]) => {
      const canvas = document.querySelector('.stand-lanes canvas');
      const scale = canvas.width / canvas.clientWidth;
      return canvas.getContext('2d').getImageData(x * scale, y * scale, 1, 1).data[3];
    }, [at((told.own[0].last + stand.first) / 2) - box.x, 24]);
    assert.ok(paint[3] > 128, `a sure stand is painted: ${paint}`);
    assert.equal(air, 0, 'nothing is painted between two stands');
  }
  assert.equal(await (await open('fill.html')).locator('.stand-lanes').count(), 0, 'markers without feet have no lanes');
});

step('figures of feet are shown, before and after', async () => {
  const page = await open('clean.html');
  const text = await page.textContent('.feet');
  assert.match(text, /held\d+ contacts, [\d.]+ s/);
  assert.match(text, /slide a frame[\d.]+ \u2192 [\d.]+ cm/);
  assert.match(text, /slide at most/);
  const checked = await open('walk_check.html');
  assert.match(await checked.textContent('.feet'), /slide of a standing foot[\d.]+ cm/);
});

step('names are short, whole on hover, and never alike', async () => {
  const page = await open('prefix.html');
  const shown = await page.$$eval('.tracks tbody th button', (all) => all.map((one) => [one.textContent, one.title]));
  assert.equal(shown.length, 400);
  assert.equal(new Set(shown.map(([text]) => text)).size, 400, 'two names are shown alike');
  assert.ok(shown.every(([text, title]) => !text.includes('mixamorig') && title.startsWith('mixamorig:')));
  assert.ok(shown.some(([text]) => text === 'RightHandMiddThumbProximal'), 'names that would be alike are whole');
  await shot(page, 'names');
});

step('every heading of a column says on hover what it means', async () => {
  for (const name of ['clean.html', 'compare.html', 'walk_check.html', 'fill.html', 'two.html', 'markers_compared.html', 'index.html']) {
    const page = await open(name);
    const titles = await page.$$eval('thead th', (all) => all.map((one) => [one.textContent, (one.querySelector('button') ?? one).title]));
    assert.ok(titles.length >= 5, name);
    for (const [text, title] of titles) assert.ok(title.replace('Click to sort by this column.', '').length > 15, `${name}: ${text}: ${title}`);
  }
});

step('side by side, bodies never overlap, whichever way they are seen', async () => {
  for (const name of ['clean.html', 'wide.html', 'two.html']) {
    const page = await open(name);
    await page.click('[data-option=apart]');
    for (const key of ['1', '2', '3', '4']) {
      await page.keyboard.press(key);
      const overlaps = await page.evaluate(() => {
        const { take, player, body } = window.kinemend;
        const result = [];
        for (let f = 0; f < take.told; f += Math.ceil(take.told / 60)) {
          player.seek(f);
          const ends = body.figures.map((figure) => {
            const x = Array.from({ length: take.points }, (_, p) => body.seen(p, figure)?.[0]).filter((one) => one !== undefined);
            return [Math.min(...x), Math.max(...x)];
          });
          if (ends[0][1] >= ends[1][0]) result.push([f, ...ends]);
        }
        return result;
      });
      assert.deepEqual(overlaps, [], `${name}, view ${key}`);
    }
    assert.ok((await inView(page)) > 0.99, `${name}: out of view`);
    await shot(page, `apart_${name.replace('.html', '')}`);
  }
});

step('curves zoom and pan with the time line', async () => {
  const page = await open('clean.html');
  await page.locator('.u-over').first().scrollIntoViewIfNeeded();
  const over = await page.locator('.u-over').first().boundingBox();
  await page.mouse.move(over.x + over.width * 0.25, over.y + 40);
  await page.mouse.down();
  await page.mouse.move(over.x + over.width * 0.5, over.y + 40, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(60);
  const view = await page.evaluate(() => ({ from: window.kinemend.player.from, to: window.kinemend.player.to, scales: window.kinemend.curves.plots.map((plot) => [plot.scales.x.min, plot.scales.x.max]) }));
  assert.ok(Math.abs(view.from - 240) < 8 && Math.abs(view.to - 480) < 8, JSON.stringify(view));
  for (const [min, max] of view.scales) assert.ok(Math.abs(min - view.from - 1) < 1 && Math.abs(max - view.to - 1) < 1, JSON.stringify(view));
  for (const kind of ['Speed', 'Acceleration', 'Spectrum']) await page.click(`.curves button:has-text("${kind}")`);
  await page.click('.tracks tbody tr:nth-child(3) button');
  assert.equal(await page.locator('.panel').count(), 10);
  await shot(page, 'curves');
  await page.keyboard.press('0');
  assert.equal(await page.evaluate(() => window.kinemend.player.to), 959);
  await page.selectOption('.curves select', 'position');
  await shot(page, 'positions');
});

step('the table is sorted and searched', async () => {
  const page = await open('clean.html');
  await page.click('thead button:has-text("noise")');
  const column = await page.$$eval('.tracks tbody td:first-of-type', (cells) => cells.map((cell) => Number(cell.textContent)));
  assert.deepEqual(column, [...column].sort((a, b) => b - a));
  await page.fill('input[type=search]', 'thumb');
  const thumbs = await page.$$eval('.tracks tbody tr', (rows) => rows.filter((row) => !row.hidden).map((row) => row.cells[0].textContent));
  assert.ok(thumbs.length > 0 && thumbs.every((name) => /thumb/i.test(name)), thumbs.join(' '));
});

step('the keyboard alone does it all', async () => {
  const page = await open('clean.html');
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Shift+ArrowRight');
  assert.equal(await frame(page), 11);
  await page.keyboard.press('End');
  assert.equal(await frame(page), 959);
  await page.keyboard.press('Home');
  await page.keyboard.press('.');
  const first = await page.textContent('.selected');
  await page.keyboard.press('.');
  assert.notEqual(await page.textContent('.selected'), first);
  await page.keyboard.press(' ');
  assert.equal(await page.evaluate(() => window.kinemend.player.playing), true);
  await page.keyboard.press(' ');
  await page.keyboard.press('3');
  assert.ok((await inView(page)) > 0.99, 'the top view shows no body');
  // The Tab key reaches every control.
  await page.evaluate(() => document.activeElement?.blur());
  const reached = new Set();
  for (let i = 0; i < 25; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => `${document.activeElement.getAttribute('aria-label') ?? ''} ${document.activeElement.textContent.trim()}`));
  }
  for (const name of ['Front', 'Follow', 'Play', 'frame', 'speed']) assert.ok([...reached].some((one) => one.includes(name)), `${name} is not reached`);
});

step('strange names are text', async () => {
  const page = await open('arm.html');
  const names = await page.$$eval('.tracks tbody th', (cells) => cells.map((cell) => cell.textContent));
  assert.ok(names.some((name) => name.startsWith(strange.slice(0, 6))), names.join(' '));
  const titles = await page.$$eval('.tracks tbody th button', (all) => all.map((one) => one.title));
  assert.ok(titles.some((title) => title.startsWith(strange)), titles.join(' '));
  await shot(page, 'strange');
  const markers = await open('fill.html');
  assert.ok((await markers.$$eval('.tracks tbody th', (cells) => cells.map((cell) => cell.textContent))).includes('<b>A</b>'));
  assert.equal(await markers.locator('tbody b').count(), 0);
});

step('a click on the legend after choosing a joint hides a curve', async () => {
  const page = await open('clean.html');
  await page.click('.tracks tbody tr:nth-child(3) button');
  const label = page.locator('.u-legend .u-series th').nth(1);
  const shown = () => page.evaluate(() => window.kinemend.curves.plots[0].series[1].show);
  assert.equal(await shown(), true);
  await label.click();
  assert.equal(await shown(), false);
  await page.click('.tracks tbody tr:nth-child(5) button');
  await page.locator('.u-legend .u-series th').nth(2).click();
  await page.click('.curves button:has-text("Spectrum")');
  await page.locator('[data-spectrum] .u-legend .u-series th').nth(1).click();
  await page.mouse.move(400, 500);
  await page.waitForTimeout(100);
});

step('markers that keep their distance are linked, and named where the mouse is', async () => {
  const page = await open('rod.html');
  assert.deepEqual(await page.evaluate(() => window.kinemend.take.data.links.map((link) => [...link].sort().join()).sort()), ['0,1', '1,2']);
  await page.keyboard.press('1');
  for (const [point, name] of [[0, 'Hip'], [2, 'Ankle']]) {
    const [x, y] = await page.evaluate((p) => window.kinemend.body.seen(p), point);
    const box = await page.locator('.view').boundingBox();
    await page.mouse.move(box.x + ((x + 1) / 2) * box.width + 3, box.y + ((1 - y) / 2) * box.height);
    assert.equal(await page.isVisible('.tip'), true, name);
    assert.equal(await page.textContent('.tip'), name);
  }
  await shot(page, 'linked');
  await page.mouse.move(2, 2);
  assert.equal(await page.isVisible('.tip'), false);
  // Markup in a name is shown as text.
  const strangeOne = await open('fill.html');
  const at = await strangeOne.evaluate(() => window.kinemend.body.seen(0));
  const view = await strangeOne.locator('.view').boundingBox();
  await strangeOne.mouse.move(view.x + ((at[0] + 1) / 2) * view.width, view.y + ((1 - at[1]) / 2) * view.height);
  assert.equal(await strangeOne.textContent('.tip'), '<b>A</b>');
});

step('the spectrum of a marker on a straight line is drawn', async () => {
  const page = await open('rod.html');
  await page.evaluate(() => window.kinemend.player.choose([3]));
  await page.click('.curves button:has-text("Spectrum")');
  assert.equal(await page.locator('[data-spectrum] canvas').count(), 1);
});

step('each canvas says what it shows', async () => {
  for (const name of ['clean.html', 'fill.html']) {
    const page = await open(name);
    await page.click('.curves button:has-text("Spectrum")');
    const canvases = await page.$$eval('canvas', (all) => all.map((one) => [one.getAttribute('role'), one.getAttribute('aria-label')]));
    assert.ok(canvases.length >= 4);
    for (const [role, label] of canvases) assert.ok(/^(img|slider)$/.test(role ?? '') && (label ?? '').length > 10, `${role}: ${label}`);
    const labels = canvases.map(([, label]) => label).join('\n');
    assert.match(labels, /The body in 3D, \d+ (joints|markers): before and after/);
    // The marker at which the page of fills opens is missing too often to have a spectrum.
    if (name === 'clean.html') assert.match(labels, /spectrum in/);
  }
});

step('a table is one stop of the tabulator, and arrow keys lead through it', async () => {
  const page = await open('clean.html');
  const stops = (where) => page.$$eval(`${where} button, ${where} a, ${where} [tabindex]`, (all) => all.filter((one) => one.tabIndex >= 0).length);
  assert.equal(await stops('.tracks table'), 1);
  assert.equal(await page.getAttribute('.tracks .scroll', 'tabindex'), null);
  await page.focus('.tracks tbody tr:first-child button');
  const focused = () => page.evaluate(() => document.activeElement.textContent);
  const names = await page.$$eval('.tracks tbody th', (cells) => cells.map((cell) => cell.textContent));
  await page.keyboard.press('ArrowDown');
  assert.equal(await focused(), names[1]);
  await page.keyboard.press('Control+End');
  assert.equal(await focused(), names[names.length - 1]);
  await page.keyboard.press('Control+Home');
  assert.equal(await focused(), 'joint');
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await focused(), 'joint');
  // Enter sorts, the focus stays, and the rows are still one stop.
  await page.keyboard.press('Enter');
  assert.equal(await stops('.tracks table'), 1);
  await page.keyboard.press('ArrowDown');
  const chosen = await focused();
  await page.keyboard.press('Enter');
  assert.ok((await page.$$eval('tr.chosen th', (cells) => cells.map((cell) => cell.textContent))).includes(chosen));
  // The row has no control to the right, so the arrow key steps through frames.
  const before = await frame(page);
  await page.keyboard.press('ArrowRight');
  assert.equal(await frame(page), before + 1);
  await page.fill('input[type=search]', 'thumb');
  assert.equal(await stops('.tracks table'), 1);
  await page.click('summary');
  assert.equal(await stops('.findings'), 1);
  const index = await open('index.html');
  assert.equal(await index.$$eval('table a', (all) => all.filter((one) => one.tabIndex >= 0).length), 1);
});

step('filled and refused gaps are told apart', async () => {
  const page = await open('fill.html');
  await page.click('summary');
  const list = await page.textContent('.findings');
  assert.match(list, /gap filled . .B. . frames 101 to 108 . by/);
  assert.match(list, /gap refused . .C. . frames 41 to 260/);
  await page.click('.findings button >> nth=0');
  await shot(page, 'fill');
});

step('a frame in which nothing is seen says so', async () => {
  const page = await open('late.html');
  assert.ok((await frame(page)) >= 5);
  assert.ok((await inView(page)) > 0.99);
  assert.equal(await page.isVisible('.unseen'), false);
  await page.keyboard.press('Home');
  assert.equal(await page.isVisible('.unseen'), true);
});

step('dark, narrow, and with enough contrast', async () => {
  for (const scheme of ['light', 'dark']) {
    const page = await open('clean.html', { colorScheme: scheme });
    for (const kind of ['Speed', 'Acceleration', 'Spectrum']) await page.click(`.curves button:has-text("${kind}")`);
    await page.click('summary');
    await page.keyboard.press('.');
    assert.deepEqual(await faintTexts(page), [], scheme);
    if (scheme === 'dark') await shot(page, 'dark');
  }
  const page = await open('clean.html', { viewport: { width: 360, height: 740 } });
  assert.ok((await wide(page)) <= 0, `${await wide(page)} pixels too wide`);
  assert.ok((await inView(page)) > 0.99, 'the body is out of view');
  await shot(page, 'narrow');
});

step('empty takes say so', async () => {
  const none = await open('none.html');
  assert.match(await none.textContent('.view'), /no frames/);
  await shot(none, 'no_frames');
  const one = await open('one.html');
  assert.ok((await inView(one)) > 0.99);
  await shot(one, 'one_frame');
  const unseen = await open('unseen.html');
  assert.match(await unseen.textContent('.view'), /Every marker is missing/);
  assert.match(await unseen.textContent('.curves'), /missing in every frame/);
  await shot(unseen, 'unseen');
});

step('four hundred joints are all there', async () => {
  const page = await open('many.html');
  assert.equal(await page.locator('.tracks tbody tr').count(), 400);
  assert.ok((await inView(page)) > 0.9, 'the body is out of view');
  await page.keyboard.press('End');
  assert.equal(await frame(page), 119);
  await shot(page, 'many');
});

step('an hour is there, coarse at first, then to the last frame', async () => {
  const begun = Date.now();
  const page = await open('hour.html');
  console.log(`  an hour of two joints is open in ${Date.now() - begun} ms`);
  assert.equal(await page.evaluate(() => window.kinemend.take.data.stride), 8);
  for (const f of [3, 200001, 431999]) {
    const angle = await page.evaluate((at) => window.kinemend.take.angle(1, 0, at, 'before'), f);
    assert.ok(Math.abs(angle - 0.01 * f) < 0.05, `frame ${f}: ${angle}`);
  }
  await page.keyboard.press('End');
  assert.equal(await frame(page), 431999);
  await shot(page, 'hour');
});

step('a comparison calls its takes by their names', async () => {
  const page = await open('compare.html');
  assert.match(await page.textContent('.body .head'), /reference.*other/);
  await page.click('button:has-text("Apart")');
  await page.click('button:has-text("Front")');
  assert.ok((await inView(page)) > 0.99);
  await shot(page, 'compare');
});

step('the index of a batch has the worst first, filters and links', async () => {
  const page = await open('index.html');
  const names = await page.$$eval('tbody th', (cells) => cells.map((cell) => cell.textContent));
  assert.deepEqual(names, ['bad.bvh', 'arm.bvh', 'one <b>.bvh']);
  await shot(page, 'batch');
  await page.selectOption('select', 'failed');
  assert.equal(await page.locator('tbody tr').count(), 1);
  await page.selectOption('select', 'all');
  await page.fill('input[type=search]', 'one');
  await page.click('tbody a');
  await page.waitForSelector('#page[data-ready="true"]');
  assert.equal(await page.textContent('h1'), 'one <b>.bvh');
});

step('a damaged file says so', async () => {
  const whole = readFileSync(join(output, 'arm.html'), 'utf8');
  writeFileSync(join(output, 'damaged.html'), whole.replace(/(id="data-take">.{20})./, '$1!'));
  const page = await browser.newPage();
  pages.push(page);
  await page.goto(pathToFileURL(join(output, 'damaged.html')).href);
  await page.waitForSelector('#page[data-ready="failed"]');
  assert.match(await page.textContent('h1'), /cannot be shown/);
});

let failed = 0;
for (const [name, run] of steps.filter(([one]) => only.test(one))) {
  const begun = Date.now();
  try {
    await run();
    console.log(`passed: ${name} (${Date.now() - begun} ms)`);
  } catch (error) {
    failed += 1;
    console.error(`FAILED: ${name}\n${error.stack}`);
  }
  for (const page of pages.splice(0)) await page.close();
}
await browser.close();
process.exit(failed > 0 ? 1 : 0);
