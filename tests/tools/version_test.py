"""Every file that names the version of the project names the same one as CMakeLists.txt."""
import json
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(kinemend VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def text(name):
    return (ROOT / name).read_text()


class Version(unittest.TestCase):
    def test_the_files_that_state_the_version_agree(self):
        self.assertEqual(json.loads(text("wasm/npm/package.json"))["version"], VERSION)
        self.assertIn(f'\nversion = "{VERSION}"\n', text("blender/kinemend_blender/blender_manifest.toml"))
        self.assertIn(f'"version": ({VERSION.replace(".", ", ")})', text("blender/kinemend_blender/__init__.py"))
        self.assertIn(f"\nversion: {VERSION}\n", text("CITATION.cff"))
        self.assertIn(f'name="kinemend" version="{VERSION}.0"', text("cli/platform/kinemend.manifest"))

    def test_names_of_downloads_in_pages_and_the_makefile_have_the_version(self):
        pages = subprocess.run(["git", "ls-files", "*.md", "Makefile"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
        for page in filter(None, pages):
            for name, version in re.findall(r"((?:lib)?kinemend(?:-dev|-npm|_blender)?[-_](\d+\.\d+\.\d+))", text(page)):
                self.assertEqual(version, VERSION, f"{page}: {name}")
        self.assertIn(f'"kinemend": "{VERSION}"', text("docs/report.md"))

    def test_the_changelog_begins_with_the_version(self):
        first = re.search(r"^## (\S+)", text("CHANGELOG.md"), re.M)[1]
        self.assertEqual(first, VERSION)


if __name__ == "__main__":
    unittest.main()
