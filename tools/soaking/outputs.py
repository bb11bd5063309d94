"""Whether a file that the program wrote holds numbers that are not finite."""
import json
import re
import struct

NOT_FINITE = re.compile(rb"[-+]?(?:nan|inf|infinity)", re.I)
NUMBER = re.compile(rb"[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[-+]?\d+)?", re.I)


def not_finite_in(path):
    """A description of the first place, or an empty text. Formats are told apart by the extension."""
    check = CHECKS.get(path.suffix.lower())
    return check(path.read_bytes()) if check else ""


def _row(cells, number):
    """A row of numbers: at least one cell is a number, and none may be nan or inf."""
    cells = [cell.strip() for cell in cells]
    if any(NUMBER.fullmatch(cell) for cell in cells):
        for cell in cells:
            if NOT_FINITE.fullmatch(cell):
                return f"line {number} holds {cell.decode()}"
    return ""


def _lines(data):
    return enumerate(re.split(rb"\r\n|\r|\n", data), 1)


def _table(data):
    for number, line in _lines(data):
        # Marker names and headings are free text, so only rows that begin with a number are checked.
        cells = re.split(rb"[\t,;]", line)
        if NUMBER.fullmatch(cells[0].strip()) and (found := _row(cells, number)):
            return found
    return ""


def _bvh(data):
    begin = data.lower().find(b"frame time")
    if begin < 0:
        return ""
    before = data.count(b"\n", 0, begin)
    for number, line in _lines(data[begin:]):
        # A frame is a line of numbers only; text after the motion is kept unchanged.
        words = re.split(rb"[\s,]+", line.strip())
        if all(NUMBER.fullmatch(w) or NOT_FINITE.fullmatch(w) for w in words) and (found := _row(words, before + number)):
            return found
    return ""


def _amc(data):
    for number, line in _lines(data):
        words = line.split()
        if len(words) > 1 and not words[0].startswith((b"#", b":")) and (found := _row(words[1:], number)):
            return found
    return ""


def _refuse(constant):
    raise ValueError(f"holds {constant}")


def _json(data):
    try:
        for text in data.decode().splitlines() if data.startswith(b'{"') else [data.decode()]:
            if text.strip():
                json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        return f"is not JSON: {error}"
    return ""


def _glb(data):
    try:
        magic, _, length, json_length = struct.unpack_from("<4sIII", data)
        if magic != b"glTF" or length != len(data):
            return "is not a whole GLB file"
        document = json.loads(data[20:20 + json_length], parse_constant=_refuse)
    except (ValueError, struct.error) as error:
        return f"is not a GLB file: {error}"
    for node in document.get("nodes", []):
        for name in ("translation", "rotation", "scale"):
            if None in node.get(name, []):
                return f"node {node.get('name')} has null in its {name}"
    body = data[20 + json_length + 8:]
    sizes = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
    for index, accessor in enumerate(document.get("accessors", [])):
        if accessor.get("componentType") != 5126 or "bufferView" not in accessor:
            continue
        view = document["bufferViews"][accessor["bufferView"]]
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        count = accessor["count"] * sizes.get(accessor["type"], 1)
        if found := _floats(body, begin, count, "<", 1, 1):
            return f"accessor {index}: {found}"
    return ""


def _c3d(data):
    """Points of files of real numbers whose header fits their size; others cannot be read without the reader under test."""
    if len(data) < 1024 or data[1] != 0x50:
        return ""
    processor = data[512 * (data[0] - 1) + 3] if 0 < data[0] and 512 * data[0] <= len(data) else 0
    order = {84: "<", 86: ">"}.get(processor)
    if order is None:
        return ""
    points, analog, first, last = struct.unpack_from(order + "HHHH", data, 2)
    scale, block = struct.unpack_from(order + "fH", data, 12)
    begin, frames, size = 512 * (block - 1), last - first + 1, 4 * points + analog
    if not scale < 0 or points == 0 or frames < 1 or begin < 1024 or not 0 <= len(data) - begin - 4 * size * frames < 512:
        return ""
    for frame in range(frames):
        if found := _floats(data, begin + 4 * size * frame, 4 * points, order, 4, 3):
            return f"frame {frame}: {found}"
    return ""


def _floats(data, begin, count, order, stride, used):
    """The first `used` of every `stride` numbers."""
    if begin + 4 * count > len(data):
        return "numbers end beyond the file"
    for i, value in enumerate(struct.unpack_from(f"{order}{count}f", data, begin)):
        if i % stride < used and value - value != 0:
            return f"number {i} is {value}"
    return ""


CHECKS = {".bvh": _bvh, ".amc": _amc, ".csv": _table, ".trc": _table, ".tsv": _table, ".c3d": _c3d, ".glb": _glb,
          ".json": _json}
