// The npm package, installed from its archive: in Node and in a browser it makes the bytes of the program, and its types compile.
//
//   node package_test.mjs PROGRAM CHROMIUM ARCHIVE TAKES       (the working folder holds playwright-core and typescript)
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

// Node.
const { load } = await import(pathToFileURL(createRequire(join(folder, 'package.json')).resolve('kinemend')));
const kinemend = await load();
assert.ok(wanted.equals(kinemend.clean(take, 'walk.bvh', options).bytes));
assert.equal(JSON.parse(kinemend.check(take, 'walk.bvh').report).schema, 'kinemend.report/1');
assert.equal(JSON.parse(kinemend.info(take, 'walk.bvh').report).takes?.length ?? 1, 1);
assert.equal(kinemend.fill(take, 'walk.bvh').code, 0);
assert.equal(kinemend.convert(take, 'walk.bvh', 'walk.glb').bytes.subarray(0, 4).toString(), new TextEncoder().encode('glTF').toString());
const refused = kinemend.clean(take, 'walk.bvh', { method: 'none of these' });
assert.equal(refused.code, 2);
assert.match(refused.messages, /none of these/);
assert.notEqual(kinemend.clean(new Uint8Array([1, 2, 3]), 'noise.bvh').code, 0);
assert.throws(() => kinemend.readFile('missing.asf'));
console.log('ok Node');

// Types.
writeFileSync(join(folder, 'use.mts'), "import {load, type Result} from 'kinemend';\nconst {clean} = await load();\nconst made: Result = clean(new Uint8Array(), 'a.bvh', {cutoff_hz: 6});\nconst bytes: Uint8Array = made.bytes;\nvoid bytes;\n");
execFileSync('node', [join(process.cwd(), 'node_modules/typescript/bin/tsc'), '--noEmit', '--strict', '--skipLibCheck', '--target', 'es2022', '--module', 'nodenext', 'use.mts'],
  { cwd: folder, stdio: 'inherit' });
console.log('ok types');

// A browser, from a server that knows types of files and nothing else.
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
  const text = await page.evaluate(async (asked) => {
    const { load: start } = await import('/node_modules/kinemend/kinemend.mjs');
    const here = await start();
    const bytes = new Uint8Array(await (await fetch('/walk.bvh')).arrayBuffer());
    return new TextDecoder().decode(here.clean(bytes, 'walk.bvh', asked).bytes);
  }, options);
  assert.equal(text, wanted.toString());
  console.log('ok browser');
} finally {
  await browser.close();
  server.close();
}
