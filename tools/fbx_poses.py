#!/usr/bin/env python3
"""Compares the joint positions that Kinemend reads from FBX files with those of Blender and assimp.

    tools/fbx_poses.py build/release/cli/kinemend FILE.fbx...

For each file it prints one row of a Markdown table: frames, and for either program the joints that both have
and the largest distance between the two positions of a joint, as a share of the body's height. Both programs
interpolate keys on straight lines and ignore layers and inherit types, so takes with such things differ.
Lengths of assimp are compared up to a factor, because its glTF says nothing of units. Needs Debian's packages
blender (3.4.1) and assimp-utils (5.2.5).
"""
import bisect
import json
import math
import os
import struct
import subprocess
import sys
import tempfile


def read_trc(path):
    """Names, rate in hertz, and rows of positions in metres (None where missing)."""
    lines = open(path, encoding="utf-8").read().split("\n")
    head = dict(zip(lines[1].split("\t"), lines[2].split("\t")))
    metres = {"mm": 0.001, "cm": 0.01, "m": 1.0}.get(head["Units"], 1.0)
    names = [name for name in lines[3].rstrip("\t\r").split("\t")[2:] if name]
    rows = []
    for line in lines[5:]:
        cells = line.rstrip("\r").split("\t")
        if len(cells) < 3:
            continue
        values = [float(cell) * metres if cell else math.nan for cell in cells[2:2 + 3 * len(names)]]
        rows.append([values[i:i + 3] for i in range(0, len(values), 3)])
    return names, float(head["DataRate"]), rows


def inside_blender(arguments):
    """Runs within Blender: writes positions in metres, in the file's axes, of each frame as JSON."""
    import bpy
    from io_scene_fbx import import_fbx
    path, out, rate, count = arguments[0], arguments[1], float(arguments[2]), int(arguments[3])
    captured = []
    settings_type = import_fbx.FBXImportSettings

    def capture(*args, **kwargs):
        settings = settings_type(*args, **kwargs)
        captured.append(settings.global_matrix.copy())
        return settings

    import_fbx.FBXImportSettings = capture
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="io_scene_fbx")
    bpy.ops.import_scene.fbx(filepath=path, use_anim=True, ignore_leaf_bones=False)
    # Blender's metres in the file's axes: the global matrix scales to metres and turns.
    to_file = captured[0].to_quaternion().to_matrix().inverted()
    scene = bpy.context.scene
    fps = scene.render.fps / scene.render.fps_base
    tries = [pose_frames(bpy, to_file, start * fps + 1, rate, count, fps) for start in starts_of(path)]
    json.dump(tries, open(out, "w"))


def starts_of(path):
    """The moments, in seconds, at which curves of the file begin to have keys that differ."""
    import array
    from io_scene_fbx import parse_fbx
    found = set()
    for top in parse_fbx.parse(path)[0].elems:
        for record in top.elems if top.id == b"Objects" else []:
            parts = {part.id: part.props[0] for part in record.elems if part.props}
            if record.id != b"AnimationCurve" or not isinstance(parts.get(b"KeyTime"), array.array):
                continue
            values = parts[b"KeyValueFloat"]
            if len(values) > 1 and max(values) > min(values):
                found.add(parts[b"KeyTime"][0] / 46186158000)
    return sorted(found)[:6] or [0.0]


def pose_frames(bpy, to_file, first, rate, count, fps):
    scene = bpy.context.scene
    frames = []
    for f in range(count):
        at = first + f / rate * fps
        scene.frame_set(math.floor(at + 1e-9), subframe=max(0.0, at - math.floor(at + 1e-9)))
        graph = bpy.context.evaluated_depsgraph_get()
        places = {}
        for thing in bpy.data.objects:
            shown = thing.evaluated_get(graph)
            places[thing.name] = list(to_file @ shown.matrix_world.translation)
            if thing.type == "ARMATURE":
                for bone in shown.pose.bones:
                    places[bone.name] = list(to_file @ (shown.matrix_world @ bone.head))
        frames.append(places)
    return frames


def difference(names, rows, frames, any_unit=False):
    """The largest distance as a share of the height, where it is, and how many joints both have."""
    shared = [(j, name) for j, name in enumerate(names) if all(name in frame for frame in frames)]
    if not shared:
        return math.inf, "", 0
    sizes = [max(values) - min(values) for values in zip(*rows[0])]
    moves = [max(row[j][a] for row in rows for j, _ in shared) - min(row[j][a] for row in rows for j, _ in shared)
             for a in range(3)]
    height = max(sizes) or max(moves) or 1
    factor = 1.0
    if any_unit:
        spread = [max(frames[0][n][a] for _, n in shared) - min(frames[0][n][a] for _, n in shared) for a in range(3)]
        own = [max(rows[0][j][a] for j, _ in shared) - min(rows[0][j][a] for j, _ in shared) for a in range(3)]
        factor = max(own) / max(spread) if max(spread) > 0 and max(own) > 0 else 0.01
    worst, where = 0.0, ""
    for f, (row, frame) in enumerate(zip(rows, frames)):
        for j, name in shared:
            distance = math.dist(row[j], [factor * x for x in frame[name]])
            if distance > worst:
                worst, where = distance, f"{name}, frame {f + 1}"
    return worst / height, where, len(shared)


def blender_tries(path, folder, rate, count):
    poses = os.path.join(folder, "poses.json")
    subprocess.run(["blender", "-b", "--factory-startup", "--python", os.path.abspath(__file__), "--",
                    path, poses, str(rate), str(count)], capture_output=True, text=True)
    return json.load(open(poses)) if os.path.exists(poses) else []


IDENTITY = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]


class Animated:
    """The nodes of a glTF file, at any time."""

    def __init__(self, path, take):
        self.scene = json.load(open(path, encoding="utf-8"))
        self.folder = os.path.dirname(path)
        self.buffers = [open(os.path.join(self.folder, b["uri"]), "rb").read() for b in self.scene["buffers"]]
        self.tracks = {}
        for animation in self.scene.get("animations", [])[take:take + 1]:
            for channel in animation["channels"]:
                sampler = animation["samplers"][channel["sampler"]]
                target = channel["target"]
                times = [t[0] for t in self.values(sampler["input"])]
                self.tracks[target["node"], target["path"]] = (times, self.values(sampler["output"]))

        # assimp keeps a model's helper nodes at rest beside a track with the whole transform.
        moved = {self.scene["nodes"][node].get("name", "") for node, _ in self.tracks}
        self.void = {node for node, entry in enumerate(self.scene["nodes"])
                     if "_$AssimpFbx$_" in entry.get("name", "") and entry["name"].split("_$AssimpFbx$_")[0] in moved}

    def values(self, index):
        accessor = self.scene["accessors"][index]
        view = self.scene["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        flat = struct.unpack_from(f"<{width * accessor['count']}f", self.buffers[view["buffer"]], begin)
        return [flat[i:i + width] for i in range(0, len(flat), width)]

    def at(self, node, path, time, otherwise):
        if (node, path) not in self.tracks:
            return self.scene["nodes"][node].get(path, otherwise)
        times, values = self.tracks[node, path]
        k = bisect.bisect_right(times, time + 1e-6)
        if k == 0 or k == len(times):
            return values[min(k, len(times) - 1)] if k == 0 else values[-1]
        share = min(max((time - times[k - 1]) / (times[k] - times[k - 1]), 0.0), 1.0)
        sign = -1 if len(values[0]) == 4 and sum(a * b for a, b in zip(values[k - 1], values[k])) < 0 else 1
        mixed = [a + share * (sign * b - a) for a, b in zip(values[k - 1], values[k])]
        length = math.sqrt(sum(x * x for x in mixed)) if len(mixed) == 4 else 1
        return [x / length for x in mixed]

    def places(self, time):
        found = {}
        open_nodes = [(node, None) for node in self.scene["scenes"][0]["nodes"]]
        while open_nodes:
            node, above = open_nodes.pop()
            world = product(above, IDENTITY if node in self.void else self.local(node, time))
            found[self.scene["nodes"][node].get("name", "")] = [world[r][3] for r in range(3)]
            open_nodes += [(child, world) for child in self.scene["nodes"][node].get("children", [])]
        return found

    def local(self, node, time):
        if "matrix" in self.scene["nodes"][node] and not any((node, p) in self.tracks for p in
                                                            ("translation", "rotation", "scale")):
            flat = self.scene["nodes"][node]["matrix"]
            return [[flat[4 * c + r] for c in range(4)] for r in range(3)]
        t = self.at(node, "translation", time, [0, 0, 0])
        x, y, z, w = self.at(node, "rotation", time, [0, 0, 0, 1])
        s = self.at(node, "scale", time, [1, 1, 1])
        turn = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
        return [[turn[r][c] * s[c] for c in range(3)] + [t[r]] for r in range(3)]


def product(a, b):
    if a is None:
        return b
    return [[sum(a[r][k] * b[k][c] for k in range(3)) + (a[r][3] if c == 3 else 0) for c in range(4)] for r in range(3)]


def assimp_tries(path, folder, rate, count):
    out = os.path.join(folder, "scene.gltf")
    subprocess.run(["assimp", "export", path, out, "-fgltf2"], capture_output=True, text=True)
    if not os.path.exists(out):
        return []
    tries = []
    for take in range(max(1, len(Animated(out, 0).scene.get("animations", [])))):
        scene = Animated(out, take)
        starts = sorted({times[0] for times, values in scene.tracks.values() if len(times) > 1})[:6] or [0.0]
        tries += [[scene.places(start + f / rate) for f in range(count)] for start in starts]
    return tries


def compare(kinemend, path):
    name = os.path.basename(path)
    with tempfile.TemporaryDirectory() as folder:
        trc = os.path.join(folder, "take.trc")
        done = subprocess.run([kinemend, "convert", path, trc], capture_output=True, text=True)
        if done.returncode != 0:
            return f"| {name} | refused: {done.stderr.strip().split(': ', 1)[-1]} | | |"
        names, rate, rows = read_trc(trc)
        cells = []
        for tries, any_unit in ((blender_tries, False), (assimp_tries, True)):
            found = [difference(names, rows, frames, any_unit) for frames in tries(path, folder, rate, len(rows))]
            worst, where, shared = min(found, default=(math.inf, "", 0), key=lambda each: each[0])
            cells.append("cannot read it" if shared == 0 else f"{worst:.1e} ({shared} joints; {where})")
    return f"| {name} | {len(rows)} | {cells[0]} | {cells[1]} |"


def main():
    if "--" in sys.argv and "bpy" in sys.modules:
        inside_blender(sys.argv[sys.argv.index("--") + 1:])
        return
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    print("| file | frames | Blender | assimp |\n|---|---|---|---|")
    for path in sys.argv[2:]:
        print(compare(sys.argv[1], path), flush=True)


main()
