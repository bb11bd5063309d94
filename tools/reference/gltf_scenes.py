"""Writes small glTF scenes, and where their nodes are in each frame:
tests/fixtures/glb/{good,bad}/*.glb, tests/fixtures/gltf/{good,bad}/*.gltf, tests/fixtures/gltf/beside/*,
tests/fixtures/gltf/positions/NAME.csv.

Positions come from products of 4 x 4 matrices, with keys interpolated as the glTF 2.0 specification (appendix C) says.
The file's own float32 numbers are used. Run from the repository's root: python3 tools/reference/gltf_scenes.py
The first line of a table: rate in hertz, frames. Then one line a node and frame: frame, node, x, y, z.
"""

import base64
import json
import os
import struct

import numpy as np

FIXTURES = "tests/fixtures"
COMPONENTS = {5120: ("b", 127.0), 5121: ("B", 255.0), 5122: ("<i2", 32767.0), 5123: ("<u2", 65535.0), 5125: ("<u4", 1.0),
              5126: ("<f4", 1.0)}
WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Scene:
    """A scene under construction: JSON and one binary buffer."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0", "generator": "gltf_scenes.py"}, "scene": 0, "scenes": [{"nodes": [0]}],
                     "nodes": [], "bufferViews": [], "accessors": [], "animations": []}
        self.binary = b""

    def view(self, data, stride=None):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if stride:
            view["byteStride"] = stride
        self.binary += data
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, values, kind, component=5126, ranged=False, **more):
        values = np.atleast_2d(np.asarray(values, float))
        if WIDTHS[kind] == 1:
            values = values.reshape(-1, 1)
        dtype, unit = COMPONENTS[component]
        stored = values if component == 5126 else np.round(values * unit)
        stored = stored.astype(dtype)
        entry = {"bufferView": self.view(stored.tobytes()), "componentType": component, "count": len(values), "type": kind}
        if component != 5126:
            entry["normalized"] = True
        if ranged:
            entry["min"] = [float(v) for v in stored.min(axis=0)]
            entry["max"] = [float(v) for v in stored.max(axis=0)]
        entry.update(more)
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def animate(self, animation, node, path, times, values, interpolation="LINEAR", component=5126, ranged=False):
        kind = "VEC4" if path == "rotation" else "VEC3"
        input_ = times if isinstance(times, int) else self.accessor(times, "SCALAR", ranged=True)
        output = values if isinstance(values, int) else self.accessor(values, kind, component, ranged)
        animation["samplers"].append({"input": input_, "output": output, "interpolation": interpolation})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": {"node": node, "path": path}})
        return output

    def animation(self, name=None):
        animation = {"samplers": [], "channels": []}
        if name is not None:
            animation["name"] = name
        self.json["animations"].append(animation)
        return animation

    def finished(self):
        text = {key: value for key, value in self.json.items() if value != []}
        if self.binary:
            text["buffers"] = [{"byteLength": len(self.binary)}]
        return text

    def glb(self, chunks=b""):
        text = json.dumps(self.finished(), separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        binary = self.binary + b"\0" * (-len(self.binary) % 4)
        body = struct.pack("<I4s", len(text), b"JSON") + text
        if binary:
            body += struct.pack("<I4s", len(binary), b"BIN\0") + binary
        body += chunks
        return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body

    def gltf(self, uri=None, indent=2):
        text = self.finished()
        text["buffers"][0]["uri"] = uri or "data:application/octet-stream;base64," + base64.b64encode(self.binary).decode()
        return json.dumps(text, indent=indent).encode()


# Decoding of accessors.

def numbers(scene, index):
    a = scene.json["accessors"][index]
    dtype, unit = COMPONENTS[a["componentType"]]
    width = WIDTHS[a["type"]]
    size = np.dtype(dtype).itemsize

    def read(view, offset, count, dtype, width, stride=None):
        v = scene.json["bufferViews"][view]
        step = v.get("byteStride") or np.dtype(dtype).itemsize * width
        begin = v["byteOffset"] + offset
        return np.array([np.frombuffer(scene.binary, dtype, width, begin + i * (stride or step)) for i in range(count)])

    values = np.zeros((a["count"], width))
    if "bufferView" in a:
        values = read(a["bufferView"], a.get("byteOffset", 0), a["count"], dtype, width).astype(float)
    if "sparse" in a:
        s = a["sparse"]
        where = read(s["indices"]["bufferView"], 0, s["count"], COMPONENTS[s["indices"]["componentType"]][0], 1)[:, 0]
        values[where] = read(s["values"]["bufferView"], 0, s["count"], dtype, width, size * width)
    return np.maximum(values / unit, -1) if a.get("normalized") else values


def matrix_of_quaternion(q):
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def slerp(a, b, t):
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    b = -b if a @ b < 0 else b
    angle = np.arccos(min(1.0, a @ b))
    if angle < 1e-6:
        return a + t * (b - a)
    return (np.sin((1 - t) * angle) * a + np.sin(t * angle) * b) / np.sin(angle)


def sample(times, values, interpolation, t, turns):
    count = len(times)
    if interpolation == "CUBICSPLINE":
        values = values.reshape(count, 3, -1)
    value = (lambda i: values[i, 1]) if interpolation == "CUBICSPLINE" else (lambda i: values[i])
    if t <= times[0] or count == 1:
        return value(0)
    if t >= times[-1] - 1e-6:
        return value(count - 1)
    # A frame that equals a key up to rounding uses the key.
    i = int(np.searchsorted(times, t + 1e-6, side="right") - 1)
    length = times[i + 1] - times[i]
    s = max(0.0, (t - times[i]) / length)
    if interpolation == "STEP" or s < 1e-6:
        return value(i)
    if interpolation == "LINEAR":
        return slerp(values[i], values[i + 1], s) if turns else (1 - s) * values[i] + s * values[i + 1]
    a, b = values[i], values[i + 1]
    return ((2 * s**3 - 3 * s**2 + 1) * a[1] + length * (s**3 - 2 * s**2 + s) * a[2] + (3 * s**2 - 2 * s**3) * b[1] +
            length * (s**3 - s**2) * b[0])


def world_positions(scene, rate, frames, animation=0):
    nodes = scene.json["nodes"]
    parents = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}
    chosen = scene.json["animations"][animation]
    curves = {}
    for channel in chosen["channels"]:
        sampler = chosen["samplers"][channel["sampler"]]
        curves[channel["target"]["node"], channel["target"]["path"]] = (
            numbers(scene, sampler["input"])[:, 0], numbers(scene, sampler["output"]), sampler["interpolation"])
    start = min(c[0][0] for key, c in curves.items() if key[1] != "scale")

    def local(i, t):
        node = nodes[i]
        if "matrix" in node:
            return np.array(node["matrix"]).reshape(4, 4).T
        parts = {"translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]}
        for path in parts:
            parts[path] = np.array(node.get(path, parts[path]), float)
            if (i, path) in curves:
                parts[path] = sample(*curves[i, path], t, path == "rotation")
        m = np.eye(4)
        m[:3, :3] = matrix_of_quaternion(parts["rotation"]) * parts["scale"]
        m[:3, 3] = parts["translation"]
        return m

    def world(i, t):
        return world(parents[i], t) @ local(i, t) if i in parents else local(i, t)

    return [[world(i, start + f / rate)[:3, 3] for i in range(len(nodes))] for f in range(frames)]


# The scenes.

def quaternions(rng, count, spread=0.6):
    """A smooth turn, x y z w; some of it on the other hemisphere."""
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    angles = spread * np.sin(np.linspace(0, 2.5, count) + rng.uniform(0, 3)) + rng.uniform(-1, 1)
    turned = np.concatenate([axis * np.sin(angles / 2)[:, None], np.cos(angles / 2)[:, None]], axis=1)
    return turned if rng.uniform() < 0.5 else -turned


def figure(skin=True, mesh=True):
    """Armature, hips, spine, head, leg, the end of the head, and a mesh."""
    scene = Scene()
    scene.json["nodes"] = [
        {"name": "Armature", "children": [1]},
        {"name": "Hips", "translation": [0.1, 0.9, -0.2], "rotation": [0, 0.38268343, 0, 0.92387953], "children": [2, 4]},
        {"name": "Spine", "translation": [0, 0.3, 0.02], "children": [3], "extras": {"twist": [1, 2, 3]}},
        {"name": "Head", "translation": [0, 0.4, 0], "rotation": [0.1, 0, 0, 0.99498744], "children": [5]},
        {"name": "Leg", "translation": [0.12, -0.05, 0.01], "rotation": [0.70710678, 0, 0, 0.70710678]},
        {"name": "Head_end", "translation": [0, 0.2, 0.05]},
    ]
    if skin:
        scene.json["skins"] = [{"joints": [1, 2, 3, 4]}]
    if mesh:
        corners = scene.accessor([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "VEC3", ranged=True)
        scene.json["meshes"] = [{"name": "body", "primitives": [{"attributes": {"POSITION": corners}}],
                                 "extras": {"kept": "as it is"}}]
        scene.json["nodes"].append({"name": "Body", "mesh": 0, "skin": 0} if skin else {"name": "Body", "mesh": 0})
        scene.json["scenes"][0]["nodes"].append(6)
    return scene


def times(count, rate, start=0.0):
    return start + np.arange(count) / rate


def walk(scene, rng, count=6, rate=30.0, start=0.0, name="walk", component=5126, ranged=False):
    animation = scene.animation(name)
    clock = scene.accessor(times(count, rate, start), "SCALAR", ranged=True)
    path = np.array([0.1, 0.9, -0.2]) + np.cumsum(rng.normal(size=(count, 3)) * 0.02, axis=0)
    scene.animate(animation, 1, "translation", clock, path, ranged=ranged)
    for node in (1, 2, 3, 4):
        scene.animate(animation, node, "rotation", clock, quaternions(rng, count), component=component, ranged=ranged)
    return animation


def good_scenes(rng):
    """Name: scene, rate, frames, chunks after the others."""
    scenes = {}

    def add(name, scene, rate=30.0, frames=6, chunks=b""):
        scenes[name] = (scene, rate, frames, chunks)

    scene = figure()
    walk(scene, rng, ranged=True)
    add("plain", scene)

    scene = figure()
    walk(scene, rng, start=1 / 30)
    walk(scene, rng, name="run")
    add("two_animations", scene)

    for name, component in (("shorts", 5122), ("bytes", 5120)):
        scene = figure(mesh=False)
        walk(scene, rng, component=component, ranged=True)
        add(name, scene)

    scene = figure()
    animation = scene.animation()
    rows = b"".join(struct.pack("<7f", *np.append(rng.normal(size=3) * 0.1 + [0, 0.9, 0], q)) for q in quaternions(rng, 6))
    view = scene.view(rows, 28)
    for offset, kind in ((0, "VEC3"), (12, "VEC4")):
        scene.json["accessors"].append({"bufferView": view, "byteOffset": offset, "componentType": 5126, "count": 6, "type": kind})
    clock = scene.accessor(times(6, 120), "SCALAR", ranged=True)
    scene.animate(animation, 1, "translation", clock, clock - 2)
    scene.animate(animation, 1, "rotation", clock, clock - 1)
    scene.animate(animation, 2, "rotation", clock, quaternions(rng, 6))
    add("interleaved", scene, 120.0)

    scene = figure()
    animation = walk(scene, rng)
    base = scene.json["accessors"][animation["samplers"][2]["output"]]
    base["sparse"] = {"count": 2, "indices": {"bufferView": scene.view(struct.pack("<2H", 1, 4)), "componentType": 5123},
                      "values": {"bufferView": scene.view(quaternions(rng, 2).astype("<f4").tobytes())}}
    zeros = scene.json["accessors"][animation["samplers"][0]["output"]]
    del zeros["bufferView"]
    zeros["sparse"] = {"count": 3, "indices": {"bufferView": scene.view(bytes([0, 2, 3])), "componentType": 5121},
                       "values": {"bufferView": scene.view(rng.normal(size=(3, 3)).astype("<f4").tobytes())}}
    add("sparse", scene)

    scene = figure()
    animation = scene.animation("spline")
    clock = scene.accessor(times(6, 24), "SCALAR", ranged=True)
    for node in (1, 3):
        turns = quaternions(rng, 6)
        keys = np.stack([rng.normal(size=(6, 4)), turns, rng.normal(size=(6, 4))], axis=1)
        scene.animate(animation, node, "rotation", clock, keys.reshape(-1, 4), "CUBICSPLINE", ranged=True)
    keys = rng.normal(size=(18, 3)) * 0.1
    scene.animate(animation, 1, "translation", clock, keys, "CUBICSPLINE")
    scene.animate(animation, 4, "rotation", clock, quaternions(rng, 6), "STEP")
    add("spline", scene, 24.0)

    # Frames 0 to 12 at 30 Hz; each channel has keys in some of them.
    scene = figure()
    animation = scene.animation("posed")
    scene.animate(animation, 1, "translation", [0, 0.1, 0.4], rng.normal(size=(3, 3)))
    scene.animate(animation, 2, "rotation", [0, 2 / 30, 7 / 30, 0.4], quaternions(rng, 4))
    scene.animate(animation, 3, "rotation", [1 / 30, 5 / 30], quaternions(rng, 2), "STEP")
    spline = np.stack([rng.normal(size=(3, 4)), quaternions(rng, 3), rng.normal(size=(3, 4))], axis=1).reshape(-1, 4)
    scene.animate(animation, 4, "rotation", [0, 4 / 30, 11 / 30], spline, "CUBICSPLINE")
    add("posed", scene, 30.0, 13)

    # Keys between frames.
    scene = figure(skin=False)
    animation = scene.animation("by hand")
    scene.animate(animation, 1, "rotation", [0, 0.1234, 0.3217], quaternions(rng, 3))
    scene.animate(animation, 2, "rotation", [0.0519, 0.2781], quaternions(rng, 2))
    add("by_hand", scene, 30.0, 11)

    scene = figure()
    animation = scene.animation("shared")
    clock = scene.accessor(times(6, 60), "SCALAR", ranged=True)
    both = scene.animate(animation, 1, "rotation", clock, quaternions(rng, 6))
    scene.animate(animation, 2, "rotation", clock, both)
    animation["channels"].append({"sampler": 1, "target": {"node": 3, "path": "rotation"}})
    scene.animate(animation, 4, "rotation", clock, quaternions(rng, 6))
    add("shared", scene, 60.0)

    # As Blender's and COLLADA's exports: an armature in centimetres and a matrix that turns Z up.
    scene = figure()
    scene.json["nodes"][0].update({"matrix": [0.01, 0, 0, 0, 0, 0, -0.01, 0, 0, 0.01, 0, 0, 0.5, 0.1, -0.3, 1]})
    walk(scene, rng)
    scene.animate(scene.json["animations"][0], 2, "scale", times(6, 30), np.linspace(1, 2, 6)[:, None] * np.ones(3))
    scene.json["nodes"][1]["scale"] = [1.5, 1.5, 1.5]
    add("scaled", scene)

    # Different scales above joints that do not turn: still exact.
    scene = figure()
    scene.json["nodes"][0]["scale"] = [1, 2, 3]
    del scene.json["nodes"][1]["rotation"]
    animation = scene.animation("stretched")
    scene.animate(animation, 1, "translation", times(6, 30), rng.normal(size=(6, 3)))
    add("stretched", scene)

    scene = figure()
    walk(scene, rng)
    scene.json["extensionsUsed"] = ["VRM", "KHR_draco_mesh_compression"]
    scene.json["extensions"] = {"VRM": {"humanoid": {"humanBones": [{"bone": "hips", "node": 1}]}}}
    scene.json["meshes"][0]["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}}
    add("avatar", scene)

    scene = figure()
    walk(scene, rng)
    add("unknown_chunk", scene, chunks=struct.pack("<I4s", 8, b"MINE") + b"whatever")

    return scenes


def write(path, data):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(data)


def write_positions(name, scene, rate, frames):
    lines = [f"{rate},{frames}"]
    for f, row in enumerate(world_positions(scene, rate, frames)):
        for node, p in enumerate(row):
            title = scene.json["nodes"][node].get("name", f"node_{node}")
            lines.append(f"{f},{title},{p[0]:.9g},{p[1]:.9g},{p[2]:.9g}")
    write(f"{FIXTURES}/gltf/positions/{name}.csv", ("\n".join(lines) + "\n").encode())


def without_text(scene, old, new):
    data = scene.gltf(indent=None)
    assert old in data
    return data.replace(old, new)


def bad_scenes(rng):
    scene = figure()
    walk(scene, rng)
    plain = scene.glb()
    bad = {"version_1.glb": plain[:4] + struct.pack("<I", 1) + plain[8:], "longer_than_the_file.glb": plain[:-8]}
    coded = figure()
    walk(coded, rng)
    for view in coded.json["bufferViews"]:
        view["extensions"] = {"EXT_meshopt_compression": {"buffer": 0, "byteLength": 4, "byteStride": 4, "count": 1}}
    bad["meshopt.glb"] = coded.glb()
    bad["two_parents.gltf"] = without_text(scene, b'"children": [3]', b'"children": [3, 4]')
    bad["cycle.gltf"] = without_text(scene, b'"name": "Head_end"', b'"children": [2]').replace(b'"children": [2, 4]', b'"children": [4]')
    bad["beyond_the_view.gltf"] = without_text(scene, b'"count": 6, "type": "VEC4"', b'"count": 7, "type": "VEC4"')
    bad["parent_folder.gltf"] = scene.gltf("../secret.bin")
    bad["absolute.gltf"] = scene.gltf("/etc/hostname")
    bad["elsewhere.gltf"] = scene.gltf("https://example.org/walk.bin")
    bad["not_there.gltf"] = scene.gltf("nowhere.bin")
    bad["no_base64.gltf"] = scene.gltf("data:application/octet-stream;base64,!!!!")
    bad["no_motion.gltf"] = b'{"asset":{"version":"2.0"},"nodes":[{"name":"alone"}]}'
    return bad


def main():
    rng = np.random.default_rng(20)
    scenes = good_scenes(rng)
    for name, (scene, rate, frames, chunks) in scenes.items():
        write(f"{FIXTURES}/glb/good/{name}.glb", scene.glb(chunks))
        write_positions(name, scene, rate, frames)
        if name in ("plain", "posed", "shared", "sparse"):
            write(f"{FIXTURES}/gltf/good/{name}.gltf", scene.gltf(indent=None if name == "posed" else 1))
    static = figure()
    write(f"{FIXTURES}/glb/good/static.glb", static.glb())
    broken = figure()
    animation = walk(broken, rng)
    at = broken.json["bufferViews"][broken.json["accessors"][animation["samplers"][3]["output"]]["bufferView"]]["byteOffset"]
    broken.binary = broken.binary[:at + 32] + struct.pack("<4f", *[float("nan")] * 4) + broken.binary[at + 48:]
    write(f"{FIXTURES}/glb/good/not_finite.glb", broken.glb())
    beside, rate, frames, _ = scenes["plain"]
    write(f"{FIXTURES}/gltf/beside/walk cycle.gltf", beside.gltf("walk%20cycle.bin"))
    write(f"{FIXTURES}/gltf/beside/walk cycle.bin", beside.binary)
    for name, data in bad_scenes(rng).items():
        write(f"{FIXTURES}/{name.split('.')[-1]}/bad/{name}", data)


main()
