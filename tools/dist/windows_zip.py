"""Packs the program for Windows: python3 tools/dist/windows_zip.py build/windows FOLDER"""
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from dist.archives import write_zip  # noqa: E402
from dist.libraries import ROOT, licences_of, project_version  # noqa: E402


def main():
    build, folder = map(pathlib.Path, sys.argv[1:3])
    name = f"kinemend-{project_version()}-windows-x86_64"
    with tempfile.TemporaryDirectory() as work:
        program = pathlib.Path(work) / "kinemend.exe"
        subprocess.run(["x86_64-w64-mingw32-strip", "-o", program, build / "cli" / "kinemend.exe"], check=True)
        readme = (pathlib.Path(__file__).parent / "windows_readme.txt").read_text().replace("VERSION", project_version())
        members = [("kinemend.exe", program.read_bytes(), True), ("README.txt", readme.replace("\n", "\r\n"), False),
                   ("LICENCES.txt", licences_of("windows").replace("\n", "\r\n"), False)]
    members += [(f"presets/{preset.name}", preset.read_bytes(), False) for preset in sorted((ROOT / "presets").glob("*.toml"))]
    write_zip(folder / f"{name}.zip", [(f"{name}/{member}", content, runs) for member, content, runs in members])


if __name__ == "__main__":
    main()
