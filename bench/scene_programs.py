"""How long Kinemend, assimp and Blender take to read the same FBX and glTF files, each on one core.

  /usr/bin/python3 bench/scene_programs.py [--quick] [--out FILE] [--program build/release/cli/kinemend]
The take is a minute of 38 joints at 120 Hz that the program makes. Times of assimp and Kinemend are those of the whole
command; Blender's is that of the import alone. A program that is not installed is left out. FILE gets the times as
JSON, in the form of Google Benchmark.
"""

import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

QUICK = "--quick" in sys.argv
DURATION_S = "6" if QUICK else "60"
# Runs inside Blender: prints the processor time of the import.
IMPORT = """
import bpy, sys, time
path = sys.argv[-1]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="io_scene_fbx")
bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
try:
    import numpy
    numpy.bool = bool  # the importer of Blender 3.4 uses the name that NumPy 1.24 took away
except ImportError:
    pass
start = time.process_time()
(bpy.ops.import_scene.fbx if path.endswith(".fbx") else bpy.ops.import_scene.gltf)(filepath=path)
print("IMPORT", time.process_time() - start)
"""
measured = []


def option(name, default):
    return sys.argv[sys.argv.index(name) + 1] if name in sys.argv else default


def note(job, program, seconds, size):
    print(f"{job + '/' + program:<24}{1e3 * seconds:10.1f} ms{size / seconds / 1e6:10.1f} MB/s", flush=True)
    measured.append({"name": f"{job}/{program}", "cpu_time": 1e3 * seconds, "time_unit": "ms", "bytes_per_second": size / seconds})


def on_one_core():
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def command_seconds(command):
    """Processor time of a command, the least of five runs."""
    times = []
    for _ in range(1 if QUICK else 5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=on_one_core)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(times)


def blender_seconds(script, path):
    """Processor time of the import, or None where Blender cannot import the file."""
    command = ["blender", "--background", "--factory-startup", "--python", script, "--", path]
    out = subprocess.run(command, capture_output=True, text=True, preexec_fn=on_one_core).stdout
    return next((float(line.split()[1]) for line in out.split("\n") if line.startswith("IMPORT")), None)


def main():
    program = option("--program", "build/release/cli/kinemend")
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "import.py"
        script.write_text(IMPORT)
        walk = Path(folder) / "walk.bvh"
        subprocess.run([program, "synth", "stroll", "--duration-s", DURATION_S, "-o", walk], check=True, stderr=subprocess.DEVNULL)
        for kind in ("fbx", "glb"):
            path = walk.with_suffix(f".{kind}")
            subprocess.run([program, "convert", walk, path], check=True, stderr=subprocess.DEVNULL)
            size = path.stat().st_size
            note(f"read_{kind}", "kinemend", command_seconds([program, "info", path]), size)
            if shutil.which("assimp"):
                note(f"read_{kind}", "assimp", command_seconds(["assimp", "info", path]), size)
            if shutil.which("blender") and not QUICK:
                seconds = blender_seconds(script, path)
                if seconds is None:
                    print(f"read_{kind}/blender: cannot import {path.name}")
                else:
                    note(f"read_{kind}", "blender", seconds, size)
    if "--out" in sys.argv:
        Path(option("--out", "")).write_text(json.dumps({"benchmarks": measured}))


if __name__ == "__main__":
    main()
