"""Damage to bytes, each drawn from a seeded generator."""
import re
import struct

NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")
COUNT = re.compile(rb"(?<![\w.])\d+(?![\w.])")
ODD_NUMBERS = [b"nan", b"-nan", b"inf", b"-inf", b"Infinity", b"1e999", b"-1e999", b"1e308", b"-1e308", b"1e-320", b"0",
               b"-0", b"-1", b"0.0-7.5", b"2147483648", b"4294967296", b"18446744073709551615", b"99999999999999999999",
               b"1000000000", b"0x10", b"1,5", b"", b"--5", b"1e", b".", "\u0663".encode(), b"1" * 400, b"1.7976931348623157e308"]
ODD_WORDS = [0x0000, 0xFFFF, 0x7FFF, 0x8000, 0x0100]
ODD_FLOATS = [float("nan"), float("inf"), -float("inf"), 1e38, -0.0, 1e-40]
ODD_TEXTS = [b"\x00", b"\x1b[31m", b"\x07", b"\xff\xfe", b"\xef\xbb\xbf", "\u202e".encode(), "\u0085".encode(), b"%s%n", b"\r",
             b'"', b",", b"#", b"\\", b"../../x", b"A" * 5000, b"word " * 3000]


def _place(rng, data):
    return rng.randrange(len(data) + 1)


def _span(rng, data, most=64):
    begin = rng.randrange(len(data))
    return begin, min(len(data), begin + rng.randint(1, most))


def flip_bits(rng, data, _):
    changed = bytearray(data)
    for _ in range(rng.randint(1, 8)):
        changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def set_bytes(rng, data, _):
    begin, end = _span(rng, data, 8)
    return data[:begin] + rng.randbytes(end - begin) + data[end:]


def truncate(rng, data, _):
    return data[:rng.randrange(len(data))]


def remove_piece(rng, data, _):
    begin, end = _span(rng, data, 400)
    return data[:begin] + data[end:]


def repeat_piece(rng, data, _):
    begin, end = _span(rng, data, 400)
    return data[:end] + data[begin:end] * rng.randint(1, 20) + data[end:]


def splice(rng, data, other):
    return data[:_place(rng, data)] + other[_place(rng, other):]


def insert_text(rng, data, _):
    at = _place(rng, data)
    return data[:at] + rng.choice(ODD_TEXTS) + data[at:]


def _swap(rng, data, pattern, choices):
    found = list(pattern.finditer(data))
    if not found:
        return data
    match = rng.choice(found)
    return data[:match.start()] + rng.choice(choices) + data[match.end():]


def swap_number(rng, data, _):
    return _swap(rng, data, NUMBER, ODD_NUMBERS)


def swap_early_count(rng, data, _):
    head = data[:2000]
    return _swap(rng, head, COUNT, ODD_NUMBERS) + data[2000:]


def swap_many_numbers(rng, data, _):
    share, odd = rng.choice([0.01, 0.1, 1]), rng.choice(ODD_NUMBERS)
    begin = _place(rng, data)
    return data[:begin] + NUMBER.sub(lambda m: odd if rng.random() < share else m.group(), data[begin:])


def change_lines(rng, data, _):
    lines = data.splitlines(keepends=True) or [b""]
    at, action = rng.randrange(len(lines)), rng.randrange(4)
    if action == 0:
        del lines[at]
    elif action == 1:
        lines.insert(at, lines[at])
    elif action == 2:
        lines.insert(rng.randrange(len(lines)), lines.pop(at))
    else:
        lines[at] = lines[at].rstrip(b"\r\n")
    return b"".join(lines)


def other_encoding(rng, data, _):
    text = data.decode("latin-1")
    return text.encode(rng.choice(["utf-16", "utf-16-le", "utf-16-be", "utf-32"]))


def other_line_ends(rng, data, _):
    return data.replace(b"\n", rng.choice([b"\r", b"\r\n", b"\n\n", b"\x00", b" "]))


def add_nul(rng, data, _):
    at = _place(rng, data)
    return data[:at] + b"\x00" * rng.choice([1, 1, 512]) + data[at:]


def nest_deeply(rng, data, _):
    """Opens an array or an object very often where a value begins."""
    at = _place(rng, data)
    opening = rng.choice([b"[", b'{"a":'])
    begins = [m.end() for m in re.finditer(rb":", data)] or [at]
    at = rng.choice(begins)
    return data[:at] + opening * rng.choice([300, 200_000]) + data[at:]


def nothing_left(rng, data, _):
    return rng.choice([b"", b"\n", b" ", b"\x00"])


def set_word(rng, data, _):
    """A number of two or four bytes of a binary file."""
    if len(data) < 8:
        return data
    at = rng.choice([2 * rng.randrange(min(len(data), 64) // 2), rng.randrange(0, len(data) - 3)])
    new = rng.choice([struct.pack("<H", rng.choice(ODD_WORDS)), struct.pack(rng.choice("<>") + "f", rng.choice(ODD_FLOATS))])
    return data[:at] + new + data[at + len(new):]


def set_floats(rng, data, _):
    """Numbers of four bytes at the end of a binary file, where samples are."""
    changed = bytearray(data)
    new = struct.pack("<f", rng.choice(ODD_FLOATS))
    for _ in range(rng.randint(1, 6)):
        at = len(data) // 8 * 4 + 4 * rng.randrange(max(1, len(data) // 8))
        changed[at:at + 4] = new
    return bytes(changed[:len(data)])


TEXT = [flip_bits, set_bytes, truncate, remove_piece, repeat_piece, splice, insert_text, swap_number, swap_number,
        swap_early_count, swap_many_numbers, change_lines, change_lines, other_encoding, other_line_ends, add_nul, nothing_left]
BINARY = [flip_bits, set_bytes, truncate, remove_piece, repeat_piece, splice, set_word, set_word, set_floats, set_floats, add_nul,
          nothing_left]
JSON = TEXT + [nest_deeply, nest_deeply]


def mutate(rng, data, other, name):
    """One to three changes in a row, by the kind of file."""
    kinds = BINARY if name.endswith((".c3d", ".kmodel")) else JSON if name.endswith(".json") else TEXT
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        if data:
            data = rng.choice(kinds)(rng, data, other)
    return data
