// Tests that the text that holds the module decodes to the same bytes, and the app's unpacker against xz: texts, noise, empty files and long repeats
// are restored; for damaged bytes it throws or ends.
//
//   node lzma_test.mjs ESBUILD FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { sevenBitText } from '../seven_bits.mjs';

const [esbuild, folder] = process.argv.slice(2);
async function compiled(name) {
  const bundle = join(folder, `${name}.mjs`);
  execFileSync(esbuild, [fileURLToPath(new URL(`../src/${name}.ts`, import.meta.url)), '--format=esm', '--log-level=error', `--outfile=${bundle}`]);
  return import(pathToFileURL(bundle));
}
const { unpackedLzma } = await compiled('lzma');
const { sevenBitBytes } = await compiled('seven_bits');
const packed = (bytes, ...more) => execFileSync('xz', ['--format=lzma', '-9e', '--stdout', ...more], { input: bytes, maxBuffer: 1 << 28 });

let seed = 12345;
const random = () => { seed = (Math.imul(seed, 1103515245) + 12345) >>> 0; return seed >>> 8; };
const noise = Buffer.from(Array.from({ length: 20000 }, () => random() & 255));
const text = Buffer.from('frame 12.5 -3.25 0.0625\n'.repeat(5000) + noise.toString('hex'));
const cases = [Buffer.alloc(0), Buffer.from('a'), Buffer.alloc(100000, 7), noise, text, Buffer.concat([noise, text, noise, Buffer.alloc(3000), text])];
for (const bytes of cases) {
  for (const more of [[], ['--lzma1=lc=0,lp=2,pb=0'], ['--lzma1=lc=4,lp=0,pb=4'], ['--lzma1=lc=1,lp=3,pb=1,mode=fast']])
    assert.ok(bytes.equals(unpackedLzma(packed(bytes, ...more), bytes.length)), `${bytes.length} bytes ${more}`);
}

const whole = packed(text);
for (const length of [0, 5, 17, 18, 100, whole.length / 2 | 0]) assert.throws(() => unpackedLzma(whole.subarray(0, length), text.length), /packed bytes/);
for (let i = 0; i < 300; ++i) {
  const damaged = Buffer.from(whole);
  damaged[13 + random() % (damaged.length - 13)] ^= 1 + random() % 255;
  try {
    assert.equal(unpackedLzma(damaged, text.length).length, text.length);
  } catch (error) {
    assert.match(error.message, /packed bytes/);
  }
}
for (const bytes of [...cases, ...Array.from({ length: 9 }, (_, length) => noise.subarray(0, length))]) {
  const characters = sevenBitText(bytes);
  assert.ok(bytes.equals(sevenBitBytes(characters)), `${bytes.length} bytes as text`);
  assert.doesNotMatch(characters, /[\0\r<]/);
  assert.ok(Buffer.from(Buffer.from(characters, 'utf8').toString('utf8')).equals(Buffer.from(characters)));
}
console.log('ok');
