// Writes kinemend.html: the page, the worker and the module in one file.
//   node make_app.mjs ESBUILD PACKAGES MODULE OUTPUT      (PACKAGES: node_modules; MODULE: the folder of kinemend.mjs)
import {execFileSync} from 'node:child_process';
import {createHash} from 'node:crypto';
import {readFileSync, statSync, writeFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {deflateSync} from 'node:zlib';
import {sevenBitText} from './seven_bits.mjs';

const [esbuild, packages, moduleFolder, output] = process.argv.slice(2);
const module = resolve(moduleFolder);
const source = join(dirname(fileURLToPath(import.meta.url)), 'src');
const work = dirname(output);

function bundle(name) {
  const file = join(work, `${name}.js`);
  execFileSync(esbuild, [join(source, `${name}.ts`), '--bundle', '--minify', '--format=iife', '--target=es2021', '--charset=ascii', '--legal-comments=inline',
    '--log-level=error', '--define:import.meta.url="file:///"', '--external:fs', '--external:path', '--external:module', '--external:url', '--external:fs/promises',
    `--alias:kinemend=${join(module, 'kinemend.mjs')}`, `--outfile=${file}`], {env: {...process.env, NODE_PATH: packages}, stdio: 'inherit'});
  return readFileSync(file);
}

// The take of "Try it with an example".
const example = readFileSync(join(dirname(source), '..', 'examples', 'takes', 'sliding_walk.bvh'));
// As src/report/page/document.cpp writes data.
const data = (name, bytes) => `<script type="application/octet-stream" id="data-${name}">${deflateSync(bytes, {level: 9}).toString('base64')}</script>\n`;

// By xz, 13 % smaller (0.8 MB) than by deflate: web/src/lzma.ts unpacks it.
function packedModule() {
  const file = join(module, 'kinemend_module.wasm');
  const packed = execFileSync('xz', ['--format=lzma', '-9e', '--stdout', '--keep', file], {maxBuffer: 1 << 28});
  return `<script type="application/octet-stream" id="data-module" data-size="${statSync(file).size}">${sevenBitText(packed)}</script>\n`;
}

const licences = ['three', 'uplot'].map((name) => `/* ${name}:\n${readFileSync(join(packages, name, 'LICENSE'), 'utf8').replaceAll('*/', '* /')}*/\n`).join('');
const app = Buffer.concat([Buffer.from(licences), bundle('app')]);
const style = readFileSync(join(work, 'app.css'), 'utf8').replaceAll('</style', '<\\/style');
// Unpacks the program of the page and runs it; what it does is small enough to be read.
const boot = `(async()=>{const t=atob(document.getElementById('data-app').textContent),b=Uint8Array.from(t,c=>c.charCodeAt(0)),
r=new Response(new Blob([b]).stream().pipeThrough(new DecompressionStream('deflate'))),s=document.createElement('script');
s.src=URL.createObjectURL(new Blob([await r.arrayBuffer()],{type:'text/javascript'}));document.body.append(s)})()
.catch(e=>{document.getElementById('page').textContent='This page needs a browser of 2023 or later: '+e})`;
const hash = createHash('sha256').update(boot).digest('base64');
// Nothing can be fetched, sent or embedded.
const policy = `default-src 'none'; script-src 'sha256-${hash}' blob: 'wasm-unsafe-eval'; worker-src blob:; style-src 'unsafe-inline'; img-src data: blob:; `
  + "connect-src 'none'; form-action 'none'; base-uri 'none'";
writeFileSync(output, `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="referrer" content="no-referrer">
<link rel="icon" href="data:,">
<title>Kinemend</title>
<style>${style}</style>
</head>
<body>
<div id="bar"></div>
<main id="page"><p class="first">The page is being unpacked.</p><noscript><p>This page needs JavaScript.</p></noscript></main>
${data('app', app)}${data('worker', bundle('worker'))}${data('example', example)}${packedModule()}<script>${boot}</script>
</body>
</html>
`);
