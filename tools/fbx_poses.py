#!/usr/bin/env python3
"""Compares the joint positions that Kinemend reads from FBX files with those of Blender's importer.

    tools/fbx_poses.py build/release/cli/kinemend FILE.fbx...

For each file it prints one row of a Markdown table: joints that both have, frames, and the largest distance
between the two positions of a joint as a share of the body's height. Blender interpolates keys on straight
lines and ignores layers, inherit types and pivots of bones, so takes with such things differ.
Needs blender on the path (Debian's 3.4.1).
"""
import json
import math
import os
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


def difference(names, rows, frames):
    """The largest distance as a share of the height, where it is, and how many joints both have."""
    shared = [(j, name) for j, name in enumerate(names) if all(name in frame for frame in frames)]
    sizes = [max(values) - min(values) for values in zip(*rows[0])]
    moves = [max(row[j][a] for row in rows for j, _ in shared) - min(row[j][a] for row in rows for j, _ in shared)
             for a in range(3)] if shared else [1]
    height = max(sizes) or max(moves) or 1
    worst, where = 0.0, ""
    for f, (row, frame) in enumerate(zip(rows, frames)):
        for j, name in shared:
            distance = math.dist(row[j], frame[name])
            if distance > worst:
                worst, where = distance, f"{name}, frame {f + 1}"
    return worst / height, where, len(shared)


def compare(kinemend, path):
    with tempfile.TemporaryDirectory() as folder:
        trc, poses = os.path.join(folder, "take.trc"), os.path.join(folder, "poses.json")
        done = subprocess.run([kinemend, "convert", path, trc], capture_output=True, text=True)
        if done.returncode != 0:
            return f"| {os.path.basename(path)} | refused: {done.stderr.strip().split(': ', 1)[-1]} | | | |"
        names, rate, rows = read_trc(trc)
        subprocess.run(["blender", "-b", "--factory-startup", "--python", os.path.abspath(__file__), "--",
                        path, poses, str(rate), str(len(rows))], capture_output=True, text=True)
        if not os.path.exists(poses):
            return f"| {os.path.basename(path)} | {len(names)} | {len(rows)} | Blender cannot read it | |"
        tries = json.load(open(poses))
    best = min((difference(names, rows, frames) for frames in tries), key=lambda found: found[0])
    worst, where, shared = best
    return (f"| {os.path.basename(path)} | {shared} of {len(names)} | {len(rows)} | "
            f"{worst:.1e} | {where} |")


def main():
    if "--" in sys.argv and "bpy" in sys.modules:
        inside_blender(sys.argv[sys.argv.index("--") + 1:])
        return
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    print("| file | joints | frames | largest difference, of the height | where |\n|---|---|---|---|---|")
    for path in sys.argv[2:]:
        print(compare(sys.argv[1], path), flush=True)


main()
