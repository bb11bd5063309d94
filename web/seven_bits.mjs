// Writes bytes as text of seven bits a character, which takes an eighth less room in a page than base64; web/src/seven_bits.ts reads it.

// What a page does not keep within a script: NUL, a carriage return, and the sign that may end the script.
const kept = (value) => value !== 0 && value !== 13 && value !== 60;

/** The first bit of a byte comes first. A value that a page does not keep has 128 added, and so takes two bytes of UTF-8. */
export function sevenBitText(bytes) {
  const codes = Buffer.alloc(2 * Math.ceil(8 * bytes.length / 7));
  let codeCount = 0, held = 0, bits = 0;
  const put = (value) => { codes.writeUInt16LE(kept(value) ? value : value + 128, 2 * codeCount++); };
  for (const byte of bytes) {
    held = (held << 8) | byte;
    for (bits += 8; bits >= 7; bits -= 7) put((held >> (bits - 7)) & 127);
    held &= (1 << bits) - 1;
  }
  if (bits > 0) put((held << (7 - bits)) & 127);
  return codes.toString('utf16le', 0, 2 * codeCount);
}
