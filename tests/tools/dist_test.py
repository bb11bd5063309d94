"""The list of what is inside the downloads is complete, and zip archives depend on their content alone."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from dist.archives import write_zip  # noqa: E402
from dist.libraries import LIBRARIES, PARTS, licences_of, project_version  # noqa: E402
from dist.spdx import document, part_of  # noqa: E402

VERSION = project_version()
DOWNLOADS = {f"kinemend_{VERSION}_amd64.deb": "kinemend", f"libkinemend-dev_{VERSION}_amd64.deb": "libkinemend-dev",
             f"kinemend-{VERSION}-cp311-cp311-manylinux_2_36_x86_64.whl": "wheel", f"kinemend-{VERSION}-windows-x86_64.zip": "windows",
             "kinemend.html": "html", f"kinemend-npm-{VERSION}.tgz": "npm", f"kinemend_blender-{VERSION}.zip": "blender",
             f"kinemend-{VERSION}-source.tar.gz": "source"}


class Contents(unittest.TestCase):
    def test_every_download_is_a_part_with_a_name_of_its_own(self):
        self.assertEqual({name: part_of(name) for name in DOWNLOADS}, DOWNLOADS)
        with self.assertRaises(LookupError):
            part_of("other.zip")

    def test_the_install_page_names_every_download(self):
        page = (ROOT / "docs" / "install.md").read_text()
        for name in DOWNLOADS:
            self.assertIn(name, page)

    def test_the_list_says_what_each_download_contains(self):
        made = document({name: "0" * 64 for name in DOWNLOADS}, VERSION, 0)
        self.assertEqual((made["spdxVersion"], made["creationInfo"]["created"]), ("SPDX-2.3", "1970-01-01T00:00:00Z"))
        ids = [package["SPDXID"] for package in made["packages"]]
        self.assertEqual(len(ids), len(set(ids)))
        for identifier in ids:
            self.assertRegex(identifier, r"^SPDXRef-[A-Za-z0-9.-]+$")
        for relation in made["relationships"]:
            self.assertIn(relation["relatedSpdxElement"], ids)
            self.assertIn(relation["spdxElementId"], [*ids, "SPDXRef-DOCUMENT"])
        wheel = f"SPDXRef-kinemend-{VERSION}-cp311-cp311-manylinux-2-36-x86-64.whl"
        held = {row["relatedSpdxElement"] for row in made["relationships"] if row["spdxElementId"] == wheel and row["relationshipType"] == "CONTAINS"}
        self.assertLessEqual({"SPDXRef-Kinemend", "SPDXRef-fmt", "SPDXRef-pybind11", "SPDXRef-libstdc-and-libgcc"}, held)

    def test_every_package_that_is_compiled_in_is_in_the_table(self):
        listed = (ROOT / "packages.txt").read_text().split("# test:")[0]
        compiled = {name for name in re.findall(r"^(\S+-dev)$", listed, re.M)}
        self.assertEqual(compiled - {library.debian for library in LIBRARIES.values()}, set())

    def test_the_licences_of_a_part_name_each_library_in_it(self):
        for part, content in PARTS.items():
            text = licences_of(part)
            self.assertIn("Apache License", text)
            for name in content["holds"]:
                self.assertIn(f"{name} ({LIBRARIES[name].licence})", text)


class Archives(unittest.TestCase):
    def test_the_same_members_give_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            first, second = pathlib.Path(folder, "a.zip"), pathlib.Path(folder, "b.zip")
            for path in (first, second):
                write_zip(path, [("x/program", b"1" * 100, True), ("x/text", "text", False)])
            self.assertEqual(first.read_bytes(), second.read_bytes())
            members = zipfile.ZipFile(first).infolist()
            self.assertEqual([member.external_attr >> 16 for member in members], [0o755, 0o644])


class Wheel(unittest.TestCase):
    def test_an_option_is_answered_by_the_usage_and_no_argument_is_needed(self):
        ran = subprocess.run([ROOT / "tools" / "make_wheel", "--help"], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 2)
        self.assertIn("tools/make_wheel [BUILD [FOLDER]]", ran.stderr)


if __name__ == "__main__":
    unittest.main()
