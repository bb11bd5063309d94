#!/usr/bin/python3
"""Tests that tools/check_includes.py finds headers, functions and names that only some systems have."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
import check_includes  # noqa: E402


class Systems(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def problems(self, name, text):
        path = self.write(name, text)
        found = check_includes.check_systems(self.root)
        path.unlink()
        return found

    def test_the_tool_fails_where_one_is_found(self):
        run = [sys.executable, str(TOOLS / "check_includes.py"), self.folder.name]
        self.write("src/base/file.cpp", "#include <vector>\n")
        self.assertEqual(subprocess.run(run, capture_output=True, check=False).returncode, 0)
        self.write("src/base/file.cpp", "#include <unistd.h>\n")
        done = subprocess.run(run, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("src/base/file.cpp: <unistd.h> is not on every system", done.stdout)

    def test_headers_of_one_system_are_found(self):
        for header in ("unistd.h", "fcntl.h", "sys/stat.h", "linux/limits.h", "poll.h", "sys/epoll.h", "malloc.h", "pthread.h", "windows.h",
                       "bits/stdc++.h", "ext/stdio_filebuf.h", "tbb/parallel_for.h", "emmintrin.h"):
            for name in ("src/io/file.cpp", "cli/view.cpp", "include/kinemend/extend/text.hpp", "examples/a.cpp"):
                found = self.problems(name, f"// A file.\n#  include <{header}>\n")
                self.assertEqual(len(found), 1, (header, name))
                self.assertTrue(found[0].startswith(f"{name}: <{header}>"), found)

    def test_functions_and_names_of_one_system_are_found(self):
        for line in ("char* a = ::secure_getenv(name);", "setenv(name, value, 1);", "if (fileno(stdin) == 0) {}", "return asprintf(&a, b);",
                     "ssize_t count = 0;", "double a = M_PI;", "#ifdef __linux__\n#endif", 'open_it("/proc/self/exe");',
                     "int n = __builtin_popcount(b);", "__gnu_cxx::stdio_filebuf<char> a;"):
            self.assertEqual(len(self.problems("src/io/file.cpp", line + "\n")), 1, line)

    def test_what_every_system_has_is_not(self):
        for line in ("#include <vector>", "#include <fmt/format.h>", "#include <Eigen/Core>", "std::getline(file, line);",
                     "random.popen(1); to->fileno(2);", "// setenv() is of POSIX", "/* __linux__\n */", "x = __builtin_bit_cast(int, y);"):
            self.assertEqual(self.problems("src/io/file.cpp", line + "\n"), [], line)

    def test_folders_for_systems_may_hold_them(self):
        for name in ("src/base/platform/files_posix.cpp", "cli/platform/network.hpp"):
            self.assertEqual(self.problems(name, "#include <unistd.h>\nssize_t a;\n"), [], name)
        self.assertEqual(self.problems("src/base/parallel.cpp", "#include <tbb/parallel_for.h>\n"), [])
        self.assertEqual(len(self.problems("src/base/parallel.cpp", "#include <unistd.h>\n")), 1)

    def test_functions_of_mathematics_that_differ_by_system_are_found(self):
        self.write("src/body/file.cpp", "double a = std::exp(1) + std::sqrt(2) + portable::sin(3) + std::atan2(4, 5);\n")
        self.assertEqual(check_includes.check_maths(self.root), [f"src/body/file.cpp: std::{name} differs by system; use portable::{name}"
                                                                 for name in ("atan2", "exp")])


if __name__ == "__main__":
    unittest.main()
