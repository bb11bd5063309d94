"""Which takes of the CMU library the network of the method learned learns from, and the words of their cards."""
import csv
import os
import pathlib

# Takes with frames of zeros, repeated frames, or turns by 360 degrees.
DEFECTS = {"07_12", "09_10", "06_02", "01_07", "03_02", "35_22", "05_16"}
MEASURED_ON = {"02_09", "05_08", "06_06", "131_02", "16_11", "27_01", "35_33", "49_14", "135_05"}
KEPT_FOR_THE_PAGE = {"01_13", "02_05", "02_10", "05_14", "06_11", "08_08", "09_03", "131_07", "135_09", "16_24", "35_01", "35_14", "49_17"}
DATA_WORDS = ("CMU Graphics Lab Motion Capture Database, {clips} clips of {subjects} subjects. The data used in this project was "
              "obtained from mocap.cs.cmu.edu. The database was created with funding from NSF EIA-0196217.")
LICENCE = ("CMU: This data is free for use in research projects. You may include this data in commercially-sold products, "
           "but you may not resell this data directly, even in converted form. The model is under the licence of this "
           "project.")


class Clips:
    """Learned from, and measured on as a training goes on."""

    def __init__(self, data: pathlib.Path):
        cmu = data / "cmu"
        with open(cmu / "recurrent-100.csv", newline="") as file:
            held_out = {row["clip"] for row in csv.DictReader(file) if row["holdout"]}
        clips = [path for folder in ("bvh", "bvh-rotations") for path in sorted((cmu / folder).glob("*.bvh"))]
        self.measured = [path for path in clips if path.stem in MEASURED_ON - held_out]
        self.learned = [path for path in clips if path.stem not in held_out | DEFECTS | MEASURED_ON | KEPT_FOR_THE_PAGE]

    def words(self) -> str:
        subjects = {path.stem.split("_")[0] for path in self.learned}
        return DATA_WORDS.format(clips=len(self.learned), subjects=len(subjects))


def write_list(path: pathlib.Path, lines) -> pathlib.Path:
    path.write_text("".join(f"{line}\n" for line in lines))
    return path


def fast_kernels() -> dict:
    """Of the environment of a training. Older versions of OpenBLAS take processors that they do not know for the simplest; their kernels are then
    named here, which makes trainings more than twice as fast."""
    flags = pathlib.Path("/proc/cpuinfo").read_text() if pathlib.Path("/proc/cpuinfo").is_file() else ""
    kernels = "SkylakeX" if " avx512vl " in flags else "Haswell" if " avx2 " in flags else ""
    return {**({"OPENBLAS_CORETYPE": kernels} if kernels else {}), **os.environ}


def one_core() -> dict:
    """The environment of a training on one core."""
    return {**fast_kernels(), "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
