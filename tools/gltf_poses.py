#!/usr/bin/env python3
"""Compares the joint positions that Kinemend reads from glTF files with those of Blender's importer.

    tools/gltf_poses.py build/release/cli/kinemend FILE.glb FILE.gltf...

For each file it prints one row of a Markdown table: joints that both have, frames, and the largest distance between the
two positions of a joint as a share of the body's height. Nodes are matched by name, ignoring case, because Blender calls
nodes without a name Node_3. A joint that becomes Blender's armature object has no bone and is left out.
Needs blender on the path (Debian's 3.4.1).
"""
import json
import math
import os
import struct
import subprocess
import sys
import tempfile


def read_trc(path):
    """Names, rate in hertz, and rows of positions in metres."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    head = dict(zip(lines[1].split("\t"), lines[2].split("\t")))
    metres = {"mm": 0.001, "cm": 0.01, "m": 1.0}.get(head["Units"], 1.0)
    names = [name for name in lines[3].rstrip("\t\r").split("\t")[2:] if name]
    rows = []
    for line in lines[5:]:
        cells = line.rstrip("\r").split("\t")
        if len(cells) >= 2 + 3 * len(names):
            values = [float(cell) * metres if cell else math.nan for cell in cells[2:2 + 3 * len(names)]]
            rows.append([values[i:i + 3] for i in range(0, len(values), 3)])
    return names, float(head["DataRate"]), rows


def first_key_s(path):
    """The time of the first key that turns or moves a node in the first animation."""
    with open(path, "rb") as file:
        data = file.read()
    text = data[20:20 + struct.unpack("<I", data[12:16])[0]] if data[:4] == b"glTF" else data
    scene = json.loads(text)
    animation = scene["animations"][0]
    inputs = [animation["samplers"][c["sampler"]]["input"] for c in animation["channels"]
              if c["target"]["path"] in ("translation", "rotation")]
    return min(scene["accessors"][i]["min"][0] for i in inputs)


def inside_blender(arguments):
    """Runs within Blender: writes positions in metres, Y up, of each frame as JSON."""
    import bpy
    import numpy
    numpy.bool = bool  # Blender 3.4's importer uses a name that NumPy 1.24 no longer has
    path, out, rate, start, count = arguments[0], arguments[1], float(arguments[2]), float(arguments[3]), int(arguments[4])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = max(1, round(rate))
    bpy.ops.import_scene.gltf(filepath=path)
    frames = []
    for i in range(count):
        at = (start + i / rate) * scene.render.fps
        whole = math.floor(at + 1e-6)
        scene.frame_set(whole, subframe=min(0.999999, max(0.0, at - whole)))
        places = {}
        for thing in bpy.data.objects:
            if thing.type == "ARMATURE":
                for bone in thing.pose.bones:
                    places[bone.name.lower()] = (thing.matrix_world @ bone.matrix).to_translation()
            else:
                places.setdefault(thing.name.lower(), thing.matrix_world.to_translation())
        frames.append({name: [p.x, p.z, -p.y] for name, p in places.items()})
    with open(out, "w", encoding="utf-8") as file:
        json.dump(frames, file)


def compare(program, path, folder):
    trc, out = os.path.join(folder, "joints.trc"), os.path.join(folder, "blender.json")
    subprocess.run([program, "convert", path, trc, "--force"], check=True, capture_output=True)
    names, rate, rows = read_trc(trc)
    ran = subprocess.run(["blender", "-b", "--python-exit-code", "1", "--python", os.path.abspath(__file__), "--", path, out,
                          str(rate), str(first_key_s(path)), str(len(rows))], capture_output=True, text=True,
                         env={**os.environ, "PATH": "/usr/bin:/bin"})  # its own Python, with NumPy
    if ran.returncode != 0:
        sys.exit(f"{path}: Blender failed:\n{ran.stdout[-1000:]}{ran.stderr[-1000:]}")
    with open(out, encoding="utf-8") as file:
        frames = json.load(file)
    common = [(i, name.lower()) for i, name in enumerate(names) if name.lower() in frames[0]]
    worst = max(math.dist(row[i], frame[name]) for row, frame in zip(rows, frames) for i, name in common)
    spans = [[p[axis] for p in rows[0]] for axis in range(3)]
    height = max(max(span) - min(span) for span in spans) or 1.0
    return f"| {os.path.basename(path)} | {len(common)} of {len(names)} | {len(rows)} | {worst / height:.1e} |"


def main():
    if "--" in sys.argv:
        return inside_blender(sys.argv[sys.argv.index("--") + 1:])
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    print("| file | joints | frames | largest distance / height |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for path in sys.argv[2:]:
            print(compare(sys.argv[1], path, folder), flush=True)


main()
