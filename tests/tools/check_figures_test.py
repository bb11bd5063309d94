#!/usr/bin/python3
"""Tests that tools/check_figures finds each way in which a figure of a page can be wrong or get lost."""
import subprocess
import unittest

from figures_tree import GAPS, OUTLIERS, PAGE, SPEC, TOOLS, FiguresTree


class CheckFigures(FiguresTree):
    # The unchanged tree.

    def test_a_tree_whose_figures_agree_passes_and_is_not_changed_by_writing(self):
        before = {path: path.read_bytes() for path in self.root.rglob("*") if path.is_file()}
        self.assertEqual(self.page.read_text(), PAGE)
        self.assertIn("14 figures of pages and 2 pairs of orderings", self.assert_passes())
        self.assert_passes("--write")
        self.assertEqual(before, {path: path.read_bytes() for path in self.root.rglob("*") if path.is_file()})

    def test_writing_mends_a_table(self):
        self.replace(self.page, "| 2.5 (5.1) |", "| 9.5 (5.1) |")
        self.assert_fails("docs/wiener.md:19: table 'gaps' has", "| 9.5 (5.1) |", "| 2.5 (5.1) |")
        self.assertIn("wrote the tables of docs/wiener.md", self.assert_passes("--write"))
        self.assertEqual(self.page.read_text(), PAGE)

    def test_equal_figures_are_both_bold(self):
        self.replace(self.page, "| `kalman-learned` | **0.19** |", "| `kalman-learned` | 0.19 |")
        self.assert_fails("docs/wiener.md:10: table 'outliers'")

    def test_a_row_may_have_a_format_of_its_own(self):
        self.replace(self.spec, "{title = \"`wiener`\", ", "{title = \"`wiener`\", format = \"+.1f\", ")
        self.assert_passes("--write")
        self.assertIn("| `wiener` | +0.2 | **+1.1** |", self.page.read_text())

    def test_a_row_without_filter_is_the_line_that_its_title_names(self):
        self.spec.write_text(SPEC.replace("row_title = \"method\"", "row_title = \"method\"\nkey = \"method\"")
                              .replace("{title = \"`wiener`\", where = {method = \"wiener\"}}",
                                       "\"wiener\", {title = \"example\", format = \".0f\"}"))
        self.assert_passes("--write")
        self.assertIn("| wiener | **0.19** | **1.08** |\n| example | 0 | 2 |\n", self.page.read_text())

    def test_zero_has_no_minus(self):
        self.replace(self.figures / "gaps.csv", "22.96", "-0.2")
        self.assert_passes("--write")
        self.assertIn("| 2.5 (5.1) | 0 | |", self.page.read_text())

    def test_the_command_exits_with_the_status_of_the_check(self):
        def status(*words):
            return subprocess.run([TOOLS / "check_figures", *words], capture_output=True).returncode
        self.assertEqual(status("--root", self.root), 0)
        self.assertEqual(status("--store"), 2)
        self.page.write_text("")
        self.assertEqual(status("--root", self.root), 1)

    # Markers.

    def test_a_misspelt_marker_is_an_error(self):
        for misspelt in ("<!-- tabel: gaps -->", "<!-- table gaps -->", "<!--table: gaps -->", "<!-- table: gaps --> ",
                         "<!-- table: gaps --", "< !-- table: gaps -->", "<-- table: gaps -->", "  <!-- table: gaps -->",
                         "<!-- figures: gaps.csv -->", "table: gaps -->"):
            with self.subTest(misspelt):
                self.page.write_text(PAGE.replace("<!-- table: gaps -->", misspelt))
                self.assert_fails("docs/wiener.md:16: ", "is not a marker", "the page has no table 'gaps'")

    def test_a_comment_inside_a_sentence_is_an_error(self):
        self.replace(self.page, "less than", "0.74<!--= gaps.csv mean_mm --> less than")
        self.assert_fails("docs/wiener.md:3: ", "is not a marker")

    def test_a_table_without_end_is_an_error(self):
        for start, last in (("gaps", "| long |"), ("speeds", "| 2,500,000 | |")):
            with self.subTest(start):
                self.page.write_text(PAGE.replace(last + "\n<!-- end of table -->", last))
                self.assert_fails(f"table '{start}' has no line <!-- end of table -->")

    def test_an_end_without_start_is_an_error(self):
        self.replace(self.page, "Gaps:", "<!-- end of table -->")
        self.assert_fails("docs/wiener.md:14: the table that ends here has no line")

    def test_writing_never_replaces_prose_between_two_markers(self):
        self.replace(self.page, "| long |\n<!-- end of table -->\n", "| long |\n")
        self.replace(self.page, "<!-- table: speeds -->\n", "Speeds:\n")
        self.assert_fails("is a line that is not of a table", arguments=["--write"])
        self.assertIn("Speeds:", self.page.read_text())

    def test_a_table_that_stands_twice_is_an_error(self):
        self.page.write_text(PAGE + "\n<!-- table: gaps -->\n<!-- end of table -->\n")
        self.assert_fails("two tables 'gaps'")

    # Specifications.

    def test_a_specification_without_table_in_the_page_is_an_error(self):
        start, end = PAGE.index("<!-- table: gaps"), PAGE.index("<!-- table: speeds")
        self.page.write_text(PAGE[:start] + PAGE[end:])
        self.assert_fails("docs/wiener.figures.toml: the page has no table 'gaps'")

    def test_a_table_of_the_page_without_specification_is_an_error(self):
        self.replace(self.page, "<!-- table: gaps -->", "<!-- table: holes -->")
        self.assert_fails("docs/wiener.md:16: docs/wiener.figures.toml has no table 'holes'")

    def test_a_specification_without_page_is_an_error(self):
        self.page.rename(self.page.with_name("filter.md"))
        self.assert_fails("docs/wiener.figures.toml: there is no page of that name beside it")

    def test_an_unknown_key_is_an_error(self):
        for old, new in (("[[ordering]]", "[[ordring]]"), ("for_each", "foreach"), ("row_title = \"take\"", "rowtitle = \"take\""),
                         ("remark = \"long\"", "remarks = \"long\"")):
            with self.subTest(new):
                self.spec.write_text(SPEC.replace(old, new))
                self.assert_fails("docs/wiener.figures.toml: ")

    def test_a_column_that_the_file_lacks_is_an_error(self):
        for old, new in (("{mean_mm:.0f}", "{mean_cm:.0f}"), ("{method = \"spline\"}", "{methods = \"spline\"}")):
            with self.subTest(new):
                self.spec.write_text(SPEC.replace(old, new))
                self.assert_fails("gaps.csv has no column ")

    def test_a_cell_that_several_lines_fit_is_an_error(self):
        self.replace(self.spec, "{take = \"85_02\", frames = 30}", "{take = \"85_02\"}")
        self.assert_fails("2 lines of gaps.csv have take = '85_02', method = 'auto'")

    # Stored figures.

    def test_a_missing_file_is_an_error(self):
        (self.figures / "gaps.csv").unlink()
        self.assert_fails("there is no stored file lab/experiments/figures/gaps.csv",
                          "lab/experiments/figures/gaps.csv: 0 figures, fewer than the 15")

    def test_a_deleted_row_is_an_error_that_writing_does_not_settle(self):
        counts = (self.figures / "counts.csv").read_text()
        self.replace(self.figures / "gaps.csv", "85_02,4499,auto,5.8912,8.4\n", "")
        for arguments in ([], ["--write"]):
            self.assert_fails("no lines of gaps.csv have take = '85_02', frames = 4499, method = 'auto'",
                              "gaps.csv: 10 figures, fewer than the 15 of counts.csv", arguments=arguments)
        self.assertIn("counts.csv was not written", self.run_tool("--write")[1])
        self.assertEqual((self.figures / "counts.csv").read_text(), counts)

    def test_a_deleted_row_that_no_page_prints_is_an_error(self):
        (self.figures / "gaps.csv").write_text(GAPS + "85_12,120,auto,5.8,10.3\n")
        self.assert_passes("--write")
        (self.figures / "gaps.csv").write_text(GAPS)
        self.assert_fails("lab/experiments/figures/gaps.csv: 15 figures, fewer than the 20 of counts.csv")

    def test_an_emptied_cell_of_a_stored_file_is_an_error(self):
        self.replace(self.figures / "gaps.csv", "22.96", "")
        self.assert_fails("gaps.csv: mean_mm is empty in the line '85_02, 30, spline, 41.2'", "gaps.csv: 14 figures, fewer than the 15")

    def test_an_emptied_cell_of_a_table_is_an_error(self):
        self.replace(self.page, "| 23 | |", "| | |")
        self.assert_fails("docs/wiener.md:19: table 'gaps' has")

    def test_a_line_with_too_few_cells_is_an_error(self):
        self.replace(self.figures / "gaps.csv", "22.96,41.2", "22.96")
        self.assert_fails("gaps.csv:3: expected 5 cells, found 4")

    def test_fewer_figures_than_counted_are_an_error_until_they_are_written(self):
        start, end = PAGE.index("<!-- table: gaps"), PAGE.index("<!-- table: speeds")
        self.page.write_text(PAGE[:start] + PAGE[end:])
        start, end = SPEC.index("[[table]]\nname = \"gaps\""), SPEC.index("[[table]]\nname = \"speeds\"")
        self.spec.write_text(SPEC[:start] + SPEC[end:])
        self.assert_fails("docs/wiener.md: 9 figures, fewer than the 14 of counts.csv", "on no page and in no ordering: gaps.csv")
        self.assertIn("docs/wiener.md: 9 figures, fewer than the 14", self.assert_passes("--write"))
        self.assert_passes()

    def test_counts_that_are_missing_are_an_error(self):
        (self.figures / "counts.csv").unlink()
        self.assert_fails("counts.csv is missing")

    # Orderings.

    def add_ordering(self, says, lower, higher, more=""):
        self.page.write_text(self.page.read_text() + f"\n{says}\n")
        self.spec.write_text(self.spec.read_text() + f"""
[[ordering]]
says = "{says}"
file = "lou_outliers.csv"
value = "rms_deg"
lower = {lower}
higher = {higher}
{more}
""")

    def test_an_ordering_that_no_longer_holds_is_an_error(self):
        self.replace(self.figures / "lou_outliers.csv", "1.08", "2.45")
        self.assert_fails("does not hold: lou_outliers.csv, level = 20 %: method = wiener has 2.45, method = example has 2.32")

    def test_a_sentence_that_names_a_best_of_several_is_compared_with_each_in_every_column(self):
        self.add_ordering("Example is the best of the four in every column.", "{method = \"example\"}",
                          "[{method = \"kalman-learned\"}, {method = \"wiener\"}]", "for_each = [\"level\"]")
        self.assert_fails("level = 1 %: method = example has 0.20, method = kalman-learned has 0.19",
                          "level = 1 %: method = example has 0.20, method = wiener has 0.19",
                          "level = 20 %: method = example has 2.32, method = wiener has 1.08")

    def test_equal_figures_are_no_ordering_unless_ties_are_allowed(self):
        self.add_ordering("At one percent wiener is ahead.", "{method = \"wiener\"}", "{method = \"kalman-learned\"}",
                          "where = {level = \"1 %\"}")
        self.assert_fails("method = wiener has 0.19, method = kalman-learned has 0.19")
        self.spec.write_text(self.spec.read_text() + "ties = true\n")
        self.assertIn("3 pairs of orderings", self.assert_passes("--write"))

    def test_two_columns_of_a_file_are_compared(self):
        self.add_ordering("The mean is below the worst.", "{column = \"mean_mm\"}", "{column = \"worst_mm\"}",
                          "for_each = [\"take\", \"frames\", \"method\"]")
        self.spec.write_text(self.spec.read_text().replace("file = \"lou_outliers.csv\"\nvalue = \"rms_deg\"\nlower = {column",
                                                           "file = \"gaps.csv\"\nvalue = \"mean_mm\"\nlower = {column"))
        self.assertIn("5 pairs of orderings", self.assert_passes("--write"))
        self.replace(self.figures / "gaps.csv", "22.96,41.2", "22.96,12")
        self.assert_fails("take = 85_02, frames = 30, method = spline: mean_mm has 22.96, worst_mm has 12")

    def test_a_sentence_that_is_gone_is_an_error(self):
        self.replace(self.page, "every column below", "both columns below")
        self.assert_fails("docs/wiener.figures.toml: the page does not say '`wiener` leaves less than `example` in every column'")

    def test_text_of_a_table_is_no_sentence(self):
        self.spec.write_text(SPEC.replace("says = \"`wiener` leaves less than `example` in every column\"", "says = \"85_02, 30 frames\""))
        self.assert_fails("the page does not say '85_02, 30 frames'")

    def test_an_ordering_that_matches_no_line_is_an_error(self):
        self.add_ordering("Nothing is above all.", "{method = \"wiener\"}", "{method = \"best\"}", "for_each = [\"level\"]")
        self.assert_fails("lou_outliers.csv: no line has method = best")

    def test_a_pair_without_its_other_side_is_an_error(self):
        for line, side in (("example,1 %,0.20\n", "example"), ("wiener,1 %,0.19\n", "wiener")):
            (self.figures / "lou_outliers.csv").write_text(OUTLIERS.replace(line, ""))
            self.assert_fails(f"lou_outliers.csv: method = {side} has no line, level = 1 %")

    def test_a_side_of_several_lines_is_an_error(self):
        self.add_ordering("Without pairs.", "{method = \"wiener\"}", "{method = \"example\"}")
        self.assert_fails("several lines have method = wiener")

    # Prose.

    def test_prose_that_repeats_a_figure_of_a_table_is_an_error(self):
        self.replace(self.page, "Gaps:", "Gaps, with 2.32, a window of 0.20 s and `2.32`:")
        self.assert_fails("docs/wiener.md:14: the prose repeats 2.32 of a table")
        self.spec.write_text(SPEC.replace("title = \"`wiener`\"", "title = \"`wiener`, 2.32 s\""))
        self.assert_passes("--write")
        self.spec.write_text(SPEC + "\n[prose]\nmay_repeat = [\"2.32\"]\n")
        self.assert_passes("--write")
        self.page.write_text(PAGE)
        self.assert_fails("docs/wiener.figures.toml: may_repeat has '2.32', but the prose does not repeat it")

    # Claims of papers.

    CLAIM = """
[[claim]]
of = "lou"
place = "figure 7"
paper = "The example-based filter is first of the learned ones."
here = "{ours:.2f} beside {others[0]:.2f}"
holds = "all(ours <= other for other in others)"
why = "at 20 % it is not"
[claim.values]
ours = {file = "lou_outliers.csv", column = "rms_deg", where = {method = "example", level = "20 %"}}
others = {file = "lou_outliers.csv", column = "rms_deg", where = {level = "20 %", method = ["kalman-learned", "wiener"]}, take = "list"}

[[claim]]
of = "lou"
place = "section 5"
paper = "It takes under 5 s."
cannot = "the machine is another"
"""
    MARKERS = "\n<!-- table: claims_lou -->\n<!-- end of table -->\n"

    def with_claims(self, claim=CLAIM):
        self.spec.write_text(SPEC + claim)
        self.page.write_text(PAGE + self.MARKERS)

    def test_a_claim_has_the_verdict_that_the_stored_figures_give(self):
        self.with_claims()
        self.assert_fails("table 'claims_lou' has 0 lines")
        self.assert_passes("--write")
        self.assertIn("0 of 1 claims hold; 1 are not compared", self.page.read_text())
        self.assertIn("| figure 7 | The example-based filter is first of the learned ones. | 2.32 beside 4.14; at 20 % it is not | no |",
                      self.page.read_text())
        self.assertIn("| section 5 | It takes under 5 s. | the machine is another | not compared |", self.page.read_text())
        self.replace(self.figures / "lou_outliers.csv", "wiener,20 %,1.08", "wiener,20 %,2.40")
        self.assert_fails("table 'claims_lou'", "1 of 1 claims hold")

    def test_a_claim_without_its_figures_a_verdict_or_a_reason_is_an_error(self):
        for old, new, message in (("20 %\"}}\nothers", "30 %\"}}\nothers", "no lines of lou_outliers.csv"), ("take = \"list\"", "take = \"sum\"", "take is one of"),
                                  ("take = \"list\"", "where = 1", "figures.toml"), ("holds = \"all(ours <= other for other in others)\"", "holds = \"ours\"", "neither true nor false"),
                                  ("why = \"at 20 % it is not\"", "", "`why` is missing"), ("cannot = \"the machine is another\"", "", "one of holds and cannot"),
                                  ("{ours:.2f} beside", "{mine:.2f} beside", "the template"), ("in others", "in open", "open")):
            with self.subTest(new):
                self.with_claims(self.CLAIM.replace(old, new))
                self.assert_fails(message)

    def test_claims_without_their_place_in_the_page_are_an_error(self):
        self.spec.write_text(SPEC + self.CLAIM)
        self.assert_fails("the page has no table 'claims_lou'")

    def test_prose_that_compares_with_a_paper_is_an_error(self):
        for words in ("Unlike in the paper, it is first.", "It is first, as in the paper.", "It is faster than in the paper."):
            with self.subTest(words):
                self.page.write_text(PAGE + f"\n{words}\n")
                self.assert_fails("compares with a paper")
        self.page.write_text(PAGE + "\nIts windows are the paper's, unlike the paper's weights.\n")
        self.assert_passes()

    def test_numbers_of_prose_that_look_measured_are_listed(self):
        self.replace(self.page, "Gaps:", "Gaps of 2.5 mm, by `--window 2.6`:")
        self.assertEqual(self.assert_passes("--unpinned"), "docs/wiener.md:14: 2.5 mm: Gaps of 2.5 mm, by `--window 2.6`:\n")


if __name__ == "__main__":
    unittest.main()
