"""A small tree with a page and stored figures, for tests of tools/check_figures."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))

from figures import command  # noqa: E402

TOLERANCES = """file,absolute,relative,why
*,0.005,0.02,rounding
speeds.csv,0,3,other machines
"""
OUTLIERS = """method,level,rms_deg
example,1 %,0.20
example,20 %,2.32
kalman-learned,1 %,0.19
kalman-learned,20 %,4.14
wiener,1 %,0.19
wiener,20 %,1.08
"""
GAPS = """take,frames,method,mean_mm,worst_mm
85_02,30,auto,2.5208,5.1236
85_02,30,spline,22.96,41.2
85_02,4499,auto,5.8912,8.4
"""
SPEEDS = """program,job,case,ms,million_per_s
io,read,1,12.34,
io,read,2,56.78,2.5
"""
PAGE = """# wiener

`wiener` leaves less than `example` in
every column below.

<!-- table: outliers -->
| method | 1 % | 20 % |
|---|---|---|
| `example` | 0.20 | 2.32 |
| `kalman-learned` | **0.19** | 4.14 |
| `wiener` | **0.19** | **1.08** |
<!-- end of table -->

Gaps:

<!-- table: gaps -->
| take | `auto` | spline | remark |
|---|---|---|---|
| 85_02, 30 frames | 2.5 (5.1) | 23 | |
| 85_02, 4,499 frames | 5.9 (8.4) | | long |
<!-- end of table -->

<!-- table: speeds -->
| | time | paper |
|---|---|---|
| reading, once / twice | 12.3 / 56.8 ms | 300 ms |
| frames per second | 2,500,000 | |
<!-- end of table -->

```
<!-- tabel: code is not looked at -->
```
"""
SPEC = """
[[table]]
name = "outliers"
file = "lou_outliers.csv"
row_title = "method"
bold = "lowest in column"
columns = [
  {title = "1 %", print = "{rms_deg:.2f}", where = {level = "1 %"}},
  {title = "20 %", print = "{rms_deg:.2f}", where = {level = "20 %"}},
]
rows = [
  {title = "`example`", where = {method = "example"}},
  {title = "`kalman-learned`", where = {method = "kalman-learned"}},
  {title = "`wiener`", where = {method = "wiener"}},
]

[[table]]
name = "gaps"
file = "gaps.csv"
row_title = "take"
columns = [
  {title = "`auto`", print = "{mean_mm:.1f} ({worst_mm:.1f})", where = {method = "auto"}},
  {title = "spline", print = "{mean_mm:.0f}", where = {method = "spline"}},
  {title = "remark"},
]
rows = [
  {title = "85_02, 30 frames", where = {take = "85_02", frames = 30}},
  {title = "85_02, 4,499 frames", where = {take = "85_02", frames = 4499}, cells = {spline = "", remark = "long"}},
]

[[table]]
name = "speeds"
file = "speeds.csv"
columns = [{title = "time"}, {title = "paper"}]
rows = [
  {title = "reading, once / twice", cells = {paper = "300 ms", time = [
    {print = "{ms:.1f} / ", where = {case = "1"}},
    {print = "{ms:.1f} ms", where = {case = "2"}},
  ]}},
  {title = "frames per second", cells = {time = {print = "{million_per_s*1e6:,.0f}", where = {case = "2"}}}},
]

[[ordering]]
says = "`wiener` leaves less than `example` in every column"
file = "lou_outliers.csv"
value = "rms_deg"
lower = {method = "wiener"}
higher = {method = "example"}
for_each = ["level"]
"""


class FiguresTree(unittest.TestCase):
    """Has a folder with a page, its specification and stored figures, in which everything agrees."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.figures = self.root / "lab/experiments/figures"
        self.results = self.root / "build/papers"
        (self.root / "docs").mkdir()
        self.figures.mkdir(parents=True)
        self.results.mkdir(parents=True)
        self.page, self.spec = self.root / "docs/wiener.md", self.root / "docs/wiener.figures.toml"
        self.page.write_text(PAGE)
        self.spec.write_text(SPEC)
        for name, text in (("tolerances.csv", TOLERANCES), ("lou_outliers.csv", OUTLIERS), ("gaps.csv", GAPS), ("speeds.csv", SPEEDS)):
            (self.figures / name).write_text(text)
        self.assert_passes("--write")

    def run_tool(self, *arguments):
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            status = command.main([*map(str, arguments), "--root", str(self.root)])
        return status, output.getvalue()

    def assert_passes(self, *arguments):
        status, output = self.run_tool(*arguments)
        self.assertEqual(status, 0, output)
        return output

    def assert_fails(self, *expected, arguments=()):
        status, output = self.run_tool(*arguments)
        self.assertEqual(status, 1, output)
        for text in expected:
            self.assertIn(text, output)
        return output

    def replace(self, path, old, new):
        text = path.read_text()
        self.assertEqual(text.count(old), 1, old)
        path.write_text(text.replace(old, new))
