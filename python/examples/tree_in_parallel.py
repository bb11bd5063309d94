"""Clean every take of a folder, several at a time: cleaning releases the GIL, so threads suffice.

    python tree_in_parallel.py IN OUT
"""

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import kinemend

source, target = Path(sys.argv[1]), Path(sys.argv[2])
endings = {ending for kind in kinemend.formats() for ending in kind.extensions if kind.reads}
cleaner = kinemend.cleaners.auto()


def clean(path: Path) -> str:
    output = target / path.relative_to(source)
    try:
        result = kinemend.clean(kinemend.read(path), cleaner, threads=1)
        output.parent.mkdir(parents=True, exist_ok=True)
        kinemend.write(result.take, output, overwrite=True)
    except kinemend.Error as error:
        return f"failed: {error}"
    return f"{path.name}: {result.report.verdict}"


paths = sorted(path for path in source.rglob("*") if path.suffix.lower() in endings)
with ThreadPoolExecutor() as pool:
    for line in pool.map(clean, paths):
        print(line)
