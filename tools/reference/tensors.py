#!/usr/bin/env python3
"""Files of tensors (safetensors), models and halves, by Python's json and struct.

Writes tests/fixtures/tensors/good and bad (files; what is wrong is their name), and halves.csv: number, bits of the
nearest half (IEEE 754 binary16, ties to even), or "overflow". Writes tests/fixtures/models/good: models in the layout
of docs/models.md.
"""
import json
import pathlib
import random
import struct

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "tests/fixtures/tensors"
CODES = {"F64": "d", "F32": "f", "F16": "e", "I32": "i", "I8": "b", "U8": "B"}

# name, type, shape, values
TENSORS = [
    ("a.half", "F16", [2, 3], [0.0, -1.5, 65504.0, 2.0**-24, 2.0**-14, -0.333251953125]),
    ("b.bytes", "U8", [4], [0, 1, 128, 255]),
    ("c.small", "I8", [3], [-128, 0, 127]),
    ("d.single", "F32", [2, 1, 2], [1.0, -2.5, 3.4028234663852886e38, 1e-45]),
    ("e.whole", "I32", [2], [-2147483648, 2147483647]),
    ("f.double", "F64", [2], [3.141592653589793, -1e300]),
    ("g.number", "F64", [], [42.0]),
    ("h.nothing", "F32", [0, 5], []),
    ("ä \"quoted\"", "U8", [1], [7]),
]
METADATA = {"kind": "fixture", "text": "äöü \"x\"\n\t\\", "zero": ""}


def packed(kind, values):
    return b"".join(struct.pack("<" + CODES[kind], value) for value in values)


def file_of(header, data, pad=8):
    text = header if isinstance(header, bytes) else header.encode()
    text += b" " * (-len(text) % pad)
    return struct.pack("<Q", len(text)) + text + data


def compact(value):
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False)


def in_order(tensors):
    header, data = {}, b""
    for name, kind, shape, values in tensors:
        chunk = packed(kind, values)
        header[name] = {"dtype": kind, "shape": shape, "data_offsets": [len(data), len(data) + len(chunk)]}
        data += chunk
    return header, data


def good():
    header, data = in_order(TENSORS)
    yield "as_written", file_of(compact({"__metadata__": METADATA, **header}), data)
    # Other writers: data by falling width, the header in any order, with blanks, without padding.
    header, data = in_order(sorted(TENSORS, key=lambda t: -struct.calcsize(CODES[t[1]])))
    shuffled = dict(reversed(header.items()))
    yield "other_writer", file_of(json.dumps({**shuffled, "__metadata__": METADATA}, indent=2), data, 1)
    yield "empty", file_of("{}", b"")
    yield "metadata_only", file_of(compact({"__metadata__": METADATA}), b"")


def entry(kind="F32", shape=(1,), offsets=(0, 4), **more):
    return {"dtype": kind, "shape": list(shape), "data_offsets": list(offsets), **more}


def bad():
    four = b"\0" * 4
    one = compact({"a": entry()})
    yield "nothing", b""
    yield "seven_bytes", b"\0" * 7
    yield "no_header", struct.pack("<Q", 0)
    yield "header_beyond_end", struct.pack("<Q", 1000) + one.encode()
    yield "header_of_all_memory", struct.pack("<Q", 2**64 - 1) + one.encode()
    yield "header_length_wraps", struct.pack("<Q", 2**64 - 8) + one.encode()
    yield "array_header", file_of("[1]", b"")
    yield "blank_before_header", file_of(" " + one, four)
    yield "cut_json", file_of(one[:-1], four)
    yield "text_after_json", file_of(one + "x", four)
    yield "zero_after_json", file_of(one.encode() + b"\0", four)
    yield "latin1_name", file_of('{"ä":{}}'.encode("latin-1"), b"")
    yield "entry_is_number", file_of('{"a":1}', b"")
    yield "entry_is_array", file_of('{"a":[]}', b"")
    yield "metadata_number", file_of('{"__metadata__":{"a":1}}', b"")
    yield "metadata_text", file_of('{"__metadata__":"a"}', b"")
    yield "metadata_object", file_of('{"__metadata__":{"a":{}}}', b"")
    yield "metadata_twice", file_of('{"__metadata__":{},"__metadata__":{}}', b"")
    yield "metadata_key_twice", file_of('{"__metadata__":{"a":"","a":""}}', b"")
    yield "name_twice", file_of('{%s,%s}' % (one[1:-1], one[1:-1]), four)
    yield "dtype_twice", file_of(one.replace('"shape"', '"dtype":"F32","shape"'), four)
    yield "shape_twice", file_of(one.replace('"data', '"shape":[1],"data'), four)
    yield "offsets_twice", file_of(one.replace('"shape"', '"data_offsets":[0,4],"shape"'), four)
    yield "unknown_field", file_of(compact({"a": entry(more=1)}), four)
    for missing in ("dtype", "shape", "data_offsets"):
        part = {k: v for k, v in entry().items() if k != missing}
        yield "no_" + missing, file_of(compact({"a": part}), four)
    yield "unknown_type", file_of(compact({"a": entry("BF16", [2])}), four)
    yield "type_is_number", file_of(one.replace('"F32"', "32"), four)
    yield "negative_offset", file_of(compact({"a": entry(offsets=[-4, 0])}), four)
    yield "negative_length", file_of(compact({"a": entry(shape=[-1])}), four)
    yield "fraction", file_of(compact({"a": entry(shape=[1.0])}), four)
    yield "huge_number", file_of(one.replace("[1]", "[100000000000000000000]"), four)
    yield "three_offsets", file_of(compact({"a": entry(offsets=[0, 4, 4])}), four)
    yield "one_offset", file_of(compact({"a": entry(offsets=[0])}), four)
    yield "offsets_backward", file_of(compact({"a": entry(offsets=[4, 0])}), four)
    yield "offsets_beyond_end", file_of(compact({"a": entry(offsets=[0, 8], shape=[2])}), four)
    yield "offsets_of_all_memory", file_of(compact({"a": entry(offsets=[0, 2**64 - 1])}), four)
    yield "shape_overflows", file_of(compact({"a": entry(shape=[2**32, 2**32, 2**32])}), four)
    yield "shape_overflows_to_one", file_of(compact({"a": entry(shape=[2**63 + 1, 2**63 + 1])}), four)
    yield "shape_bytes_overflow", file_of(compact({"a": entry("F64", [2**61], [0, 0])}), b"")
    yield "shape_too_large", file_of(compact({"a": entry(shape=[2])}), four)
    yield "many_dimensions", file_of(compact({"a": entry(shape=[1] * 33)}), four)
    yield "nested_shape", file_of(one.replace("[1]", "[[1]]"), four)
    yield "deep", file_of('{"a":' + "[" * 5000, b"")
    yield "deep_objects", file_of('{"a":' * 5000, b"")
    yield "hole", file_of(compact({"a": entry(), "b": entry(offsets=[8, 12])}), four * 3)
    yield "hole_at_start", file_of(compact({"a": entry(offsets=[4, 8])}), four * 2)
    yield "data_after_last", file_of(one, four * 2)
    yield "data_missing", file_of(one, four[:3])
    yield "overlap", file_of(compact({"a": entry(shape=[2], offsets=[0, 8]), "b": entry(offsets=[4, 8])}), four * 2)
    yield "shared", file_of(compact({"a": entry(), "b": entry()}), four)
    for kind, bits in (("F16", "e"), ("F32", "f"), ("F64", "d")):
        for what, value in (("nan", float("nan")), ("infinity", float("inf"))):
            chunk = struct.pack("<" + bits, value)
            yield f"{what}_{kind.lower()}", file_of(compact({"a": entry(kind, offsets=[0, len(chunk)])}), chunk)


CARD = {"title": 'A "walk"', "data": "two clips\nof one person", "licence": "CC0, ü", "command": "kinemend train",
        "figures": "0.7"}
OF_METHOD = [("kind", "U8", [0], []), ("mean", "F32", [2, 2], [1.0, 2.0, 3.0, 4.5])]
JOINTS = ({"kind": "joints", "names": ["Hips", "Spine", 'Left "Arm"'], "trend_s": 0.4, "parents": [-1, 0, 1],
           "with_place": True},
          [("layout.bones", "F64", [3, 3], [0, 1, 0, 0.6, 0.8, 0, 0, 0, 0]),
           ("layout.place", "F64", [1, 3], [0.1, 0.55, -0.3]),
           ("layout.references", "F64", [3, 4], [1, 0, 0, 0, 0.6, 0, 0.8, 0, 0.5, -0.5, 0.5, -0.5])])
MARKERS = ({"kind": "markers", "names": ["LASI", "RASI", "SACR", "LHEE"], "trend_s": 0.5},
           [("layout.anchors", "U8", [4], [1, 1, 1, 0]),
            ("layout.means", "F64", [4, 3], [0.1, 0.6, 0, -0.1, 0.6, 0, 0, 0.6, -0.1, 0.1, 0.05, 0]),
            ("layout.shape", "F64", [4, 3], [0.1, 0.02, 0, -0.1, 0.02, 0, 0, 0, -0.1, 0.1, -0.5, 0])])


def model(layout, tensors):
    metadata = {"kinemend.model": "1", "method": "wiener", "version": "1", "rate_hz": "60.5", "takes": "3",
                "seconds": "12.25", "layout": compact(layout), "numbers": compact({"a": 1 / 3, "b": -1e300, "c": 0.0}),
                **CARD}
    header, data = in_order(sorted(tensors + OF_METHOD))
    return file_of(compact({"__metadata__": dict(sorted(metadata.items())), **header}), data)


def half_bits(value):
    try:
        return "%04x" % struct.unpack("<H", struct.pack("<e", value))[0]
    except OverflowError:
        return "overflow"


def halves():
    exact = [struct.unpack("<e", struct.pack("<H", bits))[0] for bits in range(0, 0x7C00, 43)]
    middles = []
    for bits in (0, 1, 2, 3, 0x3FE, 0x3FF, 0x400, 0x401, 0x3BFF, 0x3C00, 0x3C01, 0x7BFE):
        low, high = (struct.unpack("<e", struct.pack("<H", b))[0] for b in (bits, bits + 1))
        middle = (low + high) / 2
        middles += [middle, middle * (1 + 2.0**-52), middle * (1 - 2.0**-53)]
    edges = [65504.0, 65519.999999999993, 65520.0, 65536.0, 1e300, 2.0**-25, 2.0**-26, 5e-324, 0.1, 1 / 3, 3.14159]
    source = random.Random(1)
    spread = [source.uniform(1, 2) * 2.0 ** source.randint(-26, 16) for _ in range(300)]
    values = exact + middles + edges + spread
    return [(v, half_bits(v)) for x in values for v in (x, -x)]


def main():
    for kind, files in (("good", good()), ("bad", bad())):
        (FOLDER / kind).mkdir(parents=True, exist_ok=True)
        for name, content in files:
            (FOLDER / kind / f"{name}.safetensors").write_bytes(content)
    models = FOLDER.parent / "models/good"
    models.mkdir(parents=True, exist_ok=True)
    (models / "joints.kmodel").write_bytes(model(*JOINTS))
    (models / "markers.kmodel").write_bytes(model(*MARKERS))
    lines = ["# number,bits of the nearest half"] + [f"{value!r},{bits}" for value, bits in halves()]
    (FOLDER / "halves.csv").write_text("\n".join(lines) + "\n")


main()
