"""Writes a small figure as ASF and AMC, and where its bones begin and end:
tests/fixtures/asf/good/figure.asf, tests/fixtures/amc/good/figure.amc, tests/fixtures/amc/figure_positions.csv.

The recipe is that of the University of Wisconsin's page on ASF/AMC with 3 x 3 matrices: a bone turns by C M C^-1
within its parent, where C is its axis and M its motion; its direction is in the world; it begins at its parent's end.

Run from the repository's root: python3 tools/reference/acclaim_figure.py
The records of the table: frame, bone, x, y, z of its beginning, x, y, z of its end.
"""

import numpy as np

# name, parent, direction, length, axis angles, axis order, dofs
BONES = [
    ("hip", "root", (3, -4, 0), 2.5, (0, 0, 0), "XYZ", ""),
    ("thigh", "hip", (0.342, -0.94, 0), 7.25, (0, 0, 20), "XYZ", "rx ry rz"),
    ("shin", "thigh", (0.342, -0.94, 0), 7.5, (10, -15, 20), "ZYX", "rx"),
    ("foot", "shin", (0.08, -0.22, 0.97), 2.25, (-90, 7, 20), "YZX", "rx rz"),
    ("spine", "root", (0, 2, 0.1), 4, (5, 0, -3), "XZY", "rz ry rx"),
    ("arm", "spine", (1, 0, 0), 5, (180, 30, -90), "ZXY", "rz rx"),
    ("slider", "spine", (-1, 0, 0), 1.5, (20, -35, 50), "YXZ", "ty rx tx tz rz"),
    ("hand", "slider", (-1, -1, 0), 1, (0, 0, -45), "XYZ", "ry rz"),
    ("neck", "spine", (0, 1, 0), 0, (0, 0, 0), "XYZ", ""),
]
ROOT_ORDER = "tx rz tz ry ty rx"


def turn(axis, degrees):
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.array({
        "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
        "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }[axis])


def turns(sequence):
    """About fixed axes, the first of the sequence first."""
    product = np.eye(3)
    for axis, degrees in sequence:
        product = turn(axis, degrees) @ product
    return product


def axis_matrix(angles, order):
    return turns([(letter, angles["xyz".index(letter)]) for letter in order.lower()])


def shift_of(dofs, values):
    by_name = dict(zip(dofs.split(), values))
    return np.array([by_name.get(name, 0.0) for name in ("tx", "ty", "tz")])


def turn_of(dofs, values):
    return turns([(dof[1], value) for dof, value in zip(dofs.split(), values) if dof[0] == "r"])


def pose(frame):
    turned = {"root": turn_of(ROOT_ORDER, frame["root"])}
    end = {"root": shift_of(ROOT_ORDER, frame["root"])}
    begin = {"root": end["root"]}
    for name, parent, direction, length, angles, order, dofs in BONES:
        c = axis_matrix(angles, order)
        values = frame.get(name, [])
        turned[name] = turned[parent] @ c @ turn_of(dofs, values) @ np.linalg.inv(c)
        begin[name] = end[parent] + turned[parent] @ c @ shift_of(dofs, values)
        unit = np.array(direction) / np.linalg.norm(direction)
        end[name] = begin[name] + turned[name] @ (length * unit)
    return begin, end


def asf_text():
    lines = [
        "# A figure that has a bit of everything",
        ":version 1.10",
        ":name figure",
        ":units",
        "  mass 1.0",
        "  length 0.45",
        "  angle deg",
        ":documentation",
        "  bones (all of them), :nothing special",
        ":root",
        "  order " + ROOT_ORDER.upper(),
        "  axis XYZ",
        "  position 0 0 0",
        "  orientation 0 0 0",
        ":bonedata",
    ]
    for i, (name, _, direction, length, angles, order, dofs) in enumerate(BONES):
        lines += ["  begin", f"    id {i + 1}", f"    name {name}"]
        lines += ["    direction " + ", ".join(str(v) for v in direction), f"    length {length}"]
        lines += ["    axis " + " ".join(str(v) for v in angles) + f"  {order}"]
        if dofs:
            lines += ["    dof " + dofs]
        if name == "thigh":
            lines += ["    limits (-160.0 20.0)", "           (-70.0 70.0)", "           (-inf 65.5)"]
        lines += ["  end"]
    lines += [":hierarchy", "  begin", "    spine arm slider neck", "    thigh shin  # children may come first"]
    lines += ["    root hip spine", "    shin foot", "    slider hand", "    hip thigh", "  end"]
    return "\n".join(lines) + "\n"


random = np.random.default_rng(11)
frames = []
for _ in range(4):
    frame = {"root": np.round(random.uniform(-30, 30, 6), 4)}
    for name, *_, dofs in BONES:
        if dofs:
            frame[name] = np.round(random.uniform(-80, 80, len(dofs.split())), 4)
    frames.append(frame)

amc = "#!OML:ASF C:\\takes\\figure.ASF\n:FULLY-SPECIFIED\n:DEGREES\n"
records = []
for number, frame in enumerate(frames, 1):
    amc += f"{number}\n" + "".join(
        name + "".join(f" {value:g}" if value != round(value, 3) else f" {value:.6f}" for value in values) + "\n"
        for name, values in frame.items())
    begin, end = pose(frame)
    for name in begin:
        numbers = [*begin[name], *end[name]]
        records.append(f"{number - 1},{name}," + ",".join(repr(float(v)) for v in numbers))

open("tests/fixtures/asf/good/figure.asf", "w").write(asf_text())
open("tests/fixtures/amc/good/figure.amc", "w").write(amc)
open("tests/fixtures/amc/figure_positions.csv", "w").write("\n".join(records) + "\n")
