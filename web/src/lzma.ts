// Unpacks files of `xz --format=lzma`, which are 13 % smaller than what browsers unpack by themselves. Names follow the decoder section of Igor
// Pavlov's LZMA specification.

const bitsOfModel = 11;
const half = 1 << (bitsOfModel - 1);
const moveBits = 5;
const leastRange = 2 ** 24;
const states = 12;
const positionStates = 16;
const firstModelledSlot = 4;
const endOfModelledSlots = 14;
const alignBits = 4;
const leastMatch = 2;
const headBytes = 13;

function models(count: number): Uint16Array { return new Uint16Array(count).fill(half); }

/** The arithmetic decoder. */
class Range {
  private range = 0xffffffff;
  private code = 0;
  private at = headBytes;

  constructor(private readonly bytes: Uint8Array) {
    for (let i = 0; i < 5; ++i) this.code = ((this.code << 8) | this.bytes[this.at++]) >>> 0;
  }

  bit(probabilities: Uint16Array, index: number): number {
    const chance = probabilities[index];
    const bound = (this.range >>> bitsOfModel) * chance;
    let result = 0;
    if (this.code < bound) {
      this.range = bound;
      probabilities[index] = chance + (((1 << bitsOfModel) - chance) >> moveBits);
    } else {
      this.range -= bound;
      this.code -= bound;
      probabilities[index] = chance - (chance >> moveBits);
      result = 1;
    }
    this.normalize();
    return result;
  }

  /** Reads bits of equal probability, highest first. */
  direct(count: number): number {
    let result = 0;
    for (let i = 0; i < count; ++i) {
      this.range = this.range >>> 1;
      const isOne = this.code >= this.range;
      if (isOne) this.code -= this.range;
      result = (result << 1) | (isOne ? 1 : 0);
      this.normalize();
    }
    return result;
  }

  tree(probabilities: Uint16Array, from: number, bits: number): number {
    let node = 1;
    for (let i = 0; i < bits; ++i) node = (node << 1) | this.bit(probabilities, from + node);
    return node - (1 << bits);
  }

  /** Reads bits, lowest first. */
  reverseTree(probabilities: Uint16Array, from: number, bits: number): number {
    let node = 1;
    let result = 0;
    for (let i = 0; i < bits; ++i) {
      const bit = this.bit(probabilities, from + node);
      node = (node << 1) | bit;
      result |= bit << i;
    }
    return result;
  }

  private normalize(): void {
    if (this.range >= leastRange) return;
    if (this.at >= this.bytes.length) throw new Error('packed bytes end early');
    this.range = (this.range << 8) >>> 0;
    this.code = ((this.code << 8) | this.bytes[this.at++]) >>> 0;
  }
}

class Lengths {
  private readonly choices = models(2);
  private readonly low = models(positionStates << 3);
  private readonly middle = models(positionStates << 3);
  private readonly high = models(256);

  next(range: Range, position: number): number {
    if (range.bit(this.choices, 0) === 0) return leastMatch + range.tree(this.low, position << 3, 3);
    if (range.bit(this.choices, 1) === 0) return leastMatch + 8 + range.tree(this.middle, position << 3, 3);
    return leastMatch + 16 + range.tree(this.high, 0, 8);
  }
}

class Distances {
  private readonly slots = models(4 << 6);
  private readonly special = models(1 + 128 - endOfModelledSlots);
  private readonly align = models(1 << alignBits);

  next(range: Range, length: number): number {
    const slot = range.tree(this.slots, Math.min(length - leastMatch, 3) << 6, 6);
    if (slot < firstModelledSlot) return slot;
    const bits = (slot >> 1) - 1;
    const base = (2 | (slot & 1)) * 2 ** bits;
    if (slot < endOfModelledSlots) return base + range.reverseTree(this.special, base - slot, bits);
    const high = range.direct(bits - alignBits) >>> 0;
    return base + high * 2 ** alignBits + range.reverseTree(this.align, 0, alignBits);
  }
}

/** Returns the `size` unpacked bytes. Throws if `packed` is damaged. */
export function unpackedLzma(packed: Uint8Array, size: number): Uint8Array {
  const properties = packed[0];
  if (packed.length < headBytes + 5 || properties >= 225) throw new Error('packed bytes have no LZMA header');
  const literalContext = properties % 9;
  const literalPosition = (1 << (Math.floor(properties / 9) % 5)) - 1;
  const positionMask = (1 << Math.floor(properties / 45)) - 1;
  const range = new Range(packed);
  const literals = models(0x300 << (literalContext + (Math.floor(properties / 9) % 5)));
  const isMatch = models(states * positionStates), isLongRepeat = models(states * positionStates);
  const isRepeat = models(states), isNotFirst = models(states), isNotSecond = models(states), isNotThird = models(states);
  const lengths = new Lengths(), repeatLengths = new Lengths(), distances = new Distances();
  const out = new Uint8Array(size);
  let at = 0, state = 0;
  let repeats = [0, 0, 0, 0];

  const literal = (): void => {
    const before = at > 0 ? out[at - 1] : 0;
    const from = 0x300 * (((at & literalPosition) << literalContext) + (before >> (8 - literalContext)));
    let symbol = 1;
    if (state >= 7) {
      let match = out[at - repeats[0] - 1];
      while (symbol < 0x100) {
        const expected = (match >> 7) & 1;
        match <<= 1;
        const bit = range.bit(literals, from + ((1 + expected) << 8) + symbol);
        symbol = (symbol << 1) | bit;
        if (bit !== expected) break;
      }
    }
    while (symbol < 0x100) symbol = (symbol << 1) | range.bit(literals, from + symbol);
    out[at++] = symbol & 0xff;
    state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
  };

  /** Uses an earlier distance again; returns false if only one byte was copied. */
  const repeated = (position: number): boolean => {
    if (range.bit(isNotFirst, state) === 0) {
      if (range.bit(isLongRepeat, state * positionStates + position) !== 0) return true;
      state = state < 7 ? 9 : 11;
      out[at] = out[at - repeats[0] - 1];
      ++at;
      return false;
    }
    const which = range.bit(isNotSecond, state) === 0 ? 1 : range.bit(isNotThird, state) === 0 ? 2 : 3;
    repeats = [repeats[which], ...repeats.filter((_distance, i) => i !== which)];
    return true;
  };

  while (at < size) {
    const position = at & positionMask;
    if (range.bit(isMatch, state * positionStates + position) === 0) {
      literal();
      continue;
    }
    let length = 0;
    if (range.bit(isRepeat, state) !== 0) {
      if (!repeated(position)) continue;
      length = repeatLengths.next(range, position);
      state = state < 7 ? 8 : 11;
    } else {
      length = lengths.next(range, position);
      state = state < 7 ? 7 : 10;
      repeats = [distances.next(range, length), repeats[0], repeats[1], repeats[2]];
    }
    const distance = repeats[0] + 1;
    if (distance > at || at + length > size) throw new Error('packed bytes are damaged');
    for (let i = 0; i < length; ++i, ++at) out[at] = out[at - distance];
  }
  return out;
}
