"""Learn from one's own clean clips, and clean a noisy take with what was learned.

    python train_on_own_clips.py NOISY CLEAN... OUT.kmodel
"""

import sys

import kinemend

noisy, *clips, output = sys.argv[1:]
model = kinemend.train(
    "example",
    clips,
    title="My performer",
    data="my own clips",
    licence="private",
    progress=lambda stage, done: print(f"\r{stage} {done:4.0%}", end="", file=sys.stderr),
)
print(file=sys.stderr)
model.write(output, overwrite=True)
print(f"{len(model.names)} joints from {model.takes} takes, {model.seconds:.0f} s")

result = kinemend.clean(kinemend.read(noisy), kinemend.cleaners.example(model=output))
print(result.report.verdict)
