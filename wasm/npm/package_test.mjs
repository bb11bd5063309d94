// Tests the npm package, installed from its archive: in Node and in a browser it writes the program's bytes, and its types compile.
//
//   node package_test.mjs PROGRAM CHROMIUM ARCHIVE TAKES       (the working folder holds playwright-core and typescript)
//
// NODE=path also runs the part for Node with another node, such as one of `npm install node@18`.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { extname, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [program, executablePath, archive, takes] = process.argv.slice(2).map((word) => resolve(word));
const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const folder = mkdtempSync(join(tmpdir(), 'kinemend_package_'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

writeFileSync(join(folder, 'package.json'), '{"private": true, "type": "module"}');
execFileSync('npm', ['install', '--offline', '--no-audit', '--no-fund', archive], { cwd: folder, stdio: 'ignore' });
const take = readFileSync(join(takes, 'noisy_walk.bvh'));
writeFileSync(join(folder, 'walk.bvh'), take);
const options = { method: 'butterworth', cutoff_hz: 6 };
execFileSync(program, ['clean', 'walk.bvh', '--method', 'butterworth', '--cutoff-hz', '6', '-o', 'wanted.bvh'], { cwd: folder, stdio: 'ignore' });
const wanted = readFileSync(join(folder, 'wanted.bvh'));
// Live streams arrive in pieces that end anywhere.
const marked = `MARKERS 100 A,B\n${Array.from({ length: 60 }, (_, f) => (f % 20 === 7 ? `${f},0,0,,,` : `${f + Math.sin(f * f)},0,0,5,${f},1`)).join('\n')}\n`;
writeFileSync(join(folder, 'markers.txt'), marked);
const streams = [['walk.bvh', {}], ['walk.bvh', { method: 'one-euro', min_cutoff_hz: 2, format: 'jsonl' }], ['walk.bvh', { method: 'gaussian', feet: true }],
  ['walk.bvh', { method: 'learned', strength: 0.5 }], ['markers.txt', { method: 'gaussian' }], ['markers.txt', { body_height: 1600, fps: 50 }]];
const flags = (asked) => Object.entries(asked).flatMap(([name, value]) => (value === false ? [] : value === true ? [`--${name}`] : [`--${name.replaceAll('_', '-')}`, String(value)]));
const streamed = streams.map(([input, asked]) => ({ input, asked, output: execFileSync(program, ['stream', ...flags(asked)],
  { cwd: folder, input: readFileSync(join(folder, input)), stdio: ['pipe', 'pipe', 'ignore'], maxBuffer: 2 ** 26 }).toString() }));
writeFileSync(join(folder, 'streamed.json'), JSON.stringify(streamed));

// Node runs in a separate process, which may be another version.
writeFileSync(join(folder, 'in_node.mjs'), `
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { load } from 'kinemend';

const kinemend = await load();
const take = readFileSync('walk.bvh'), wanted = readFileSync('wanted.bvh');
assert.ok(wanted.equals(kinemend.clean(take, 'walk.bvh', ${JSON.stringify(options)}).bytes));
assert.equal(JSON.parse(kinemend.check(take, 'walk.bvh').report).schema, 'kinemend.report/1');
assert.equal(JSON.parse(kinemend.info(take, 'walk.bvh').report).takes?.length ?? 1, 1);
assert.equal(kinemend.fill(take, 'walk.bvh').code, 0);
assert.equal(new TextDecoder().decode(kinemend.convert(take, 'walk.bvh', 'walk.glb').bytes.subarray(0, 4)), 'glTF');
const refused = kinemend.clean(take, 'walk.bvh', { method: 'none of these' });
assert.equal(refused.code, 2);
assert.match(refused.messages, /none of these/);
assert.notEqual(kinemend.clean(new Uint8Array([1, 2, 3]), 'noise.bvh').code, 0);
assert.throws(() => kinemend.readFile('missing.asf'));

for (const { input, asked, output } of JSON.parse(readFileSync('streamed.json', 'utf8'))) {
  const live = kinemend.stream(asked);
  const bytes = readFileSync(input);
  let text = '';
  for (let at = 0; at < bytes.length; at += 997) text += live.push(bytes.subarray(at, at + 997));
  const delay = live.delayFrames;
  text += live.finish();
  if (text !== output) {
    const [a, b] = [text.split('\\n'), output.split('\\n')];
    const unlike = a.findIndex((line, i) => line !== b[i]);
    assert.fail(input + ' ' + JSON.stringify(asked) + ': line ' + unlike + ' of ' + b.length + ': ' + a[unlike]?.slice(0, 200) + ' and ' + b[unlike]?.slice(0, 200));
  }
  assert.ok(delay >= 0 && live.messages.length > 0, live.messages.join());
  assert.throws(() => live.push('1 2 3\\n'), /closed/);
}
// Two streams at a time, with a kept skeleton; then refused input.
kinemend.putFile('suit.bvh', take);
const frames = take.toString().split('\\n').slice(-30).join('\\n');
const [one, other] = [kinemend.stream({ skeleton: 'suit.bvh' }), kinemend.stream({ skeleton: 'suit.bvh', method: 'kalman' })];
const first = one.push(frames);
assert.ok(other.push(frames).length > first.length && one.delayFrames > other.delayFrames);
assert.ok(one.finish().length > 0);
other.close();
assert.throws(() => other.finish(), /closed/);
assert.throws(() => kinemend.stream({ method: 'wiener' }), /whole take/);
assert.throws(() => kinemend.stream({ tcp: 7001 }), /tcp/);
assert.throws(() => kinemend.stream().finish(), /no header/);
`);
for (const node of new Set([process.execPath, ...(process.env.NODE ? [resolve(process.env.NODE)] : [])])) {
  execFileSync(node, ['in_node.mjs'], { cwd: folder, stdio: 'inherit' });
  console.log(`ok Node ${execFileSync(node, ['--version']).toString().trim()}`);
}

// Types.
writeFileSync(join(folder, 'use.mts'), "import {load, type Result} from 'kinemend';\nconst {clean} = await load();\nconst made: Result = clean(new Uint8Array(), 'a.bvh', {cutoff_hz: 6});\nconst bytes: Uint8Array = made.bytes;\nvoid bytes;\n"
  + "import type {Live} from 'kinemend';\nconst {stream} = await load();\nconst live: Live = stream({method: 'one-euro'});\nconst text: string = live.push('HIERARCHY') + live.push(bytes) + live.finish();\nvoid text;\n");
execFileSync('node', [join(process.cwd(), 'node_modules/typescript/bin/tsc'), '--noEmit', '--strict', '--skipLibCheck', '--target', 'es2022', '--module', 'nodenext', 'use.mts'],
  { cwd: folder, stdio: 'inherit' });
console.log('ok types');

// Tests in a browser, with a server that knows only file types.
const types = { '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };
writeFileSync(join(folder, 'index.html'), '<!doctype html><title>package</title>');
const server = createServer((request, reply) => {
  try {
    const path = join(folder, new URL(request.url, 'http://localhost').pathname);
    const content = readFileSync(path);
    reply.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' }).end(content);
  } catch {
    reply.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
try {
  const page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${server.address().port}/index.html`);
  const [text, live] = await page.evaluate(async (asked) => {
    const { load: start } = await import('/node_modules/kinemend/kinemend.mjs');
    const here = await start();
    const bytes = new Uint8Array(await (await fetch('/walk.bvh')).arrayBuffer());
    const live = here.stream();
    return [new TextDecoder().decode(here.clean(bytes, 'walk.bvh', asked).bytes), live.push(bytes) + live.finish()];
  }, options);
  assert.equal(text, wanted.toString());
  assert.equal(live, streamed[0].output);
  console.log('ok browser');
} finally {
  await browser.close();
  server.close();
}
