// Reads bytes from text with seven bits per character, as web/seven_bits.mjs writes them.

export function sevenBitBytes(text: string): Uint8Array {
  const bytes = new Uint8Array(Math.floor((7 * text.length) / 8));
  let held = 0, bits = 0;
  for (let i = 0, at = 0; i < text.length; ++i) {
    held = (held << 7) | (text.charCodeAt(i) & 127);
    bits += 7;
    if (bits < 8) continue;
    bits -= 8;
    bytes[at++] = held >> bits;
    held &= (1 << bits) - 1;
  }
  return bytes;
}
