#!/usr/bin/python3
"""Tests that tools/check_figures compares results with the stored ones, and stores none that moved without a reason."""
import csv
import unittest

from figures_tree import SPEEDS, FiguresTree


class StoreFigures(FiguresTree):
    def results_with(self, old, new):
        for path in self.figures.glob("*.csv"):
            if path.name not in ("tolerances.csv", "counts.csv", "reasons.csv"):
                (self.results / path.name).write_text(path.read_text())
        self.replace(self.results / "lou_outliers.csv", old, new)

    def test_results_within_the_noise_pass_and_others_are_named(self):
        self.results_with("2.32", "2.33")
        self.assertIn("measured figures compared", self.assert_passes(self.results))
        self.results_with("1.08", "2.45")
        self.assert_fails("lou_outliers.csv: wiener, 20 %: rms_deg 1.08 -> 2.45", arguments=[self.results])
        (self.results / "gaps.csv").unlink()
        self.assert_fails("gaps.csv: not among the results", arguments=[self.results])

    def test_a_result_with_other_lines_is_named(self):
        self.results_with("wiener,20 %,1.08\n", "wiener,30 %,1.08\n")
        self.assert_fails("wiener, 20 %: the line is gone", "wiener, 30 %: the line is new", arguments=[self.results])

    def test_a_speed_may_be_three_times_as_large(self):
        self.results_with("2.32", "2.32")
        self.replace(self.results / "speeds.csv", "12.34", "36")
        self.assert_passes(self.results, "--speeds")
        self.replace(self.results / "speeds.csv", ",36,", ",40,")
        self.assert_fails("speeds.csv: io read 1: 40 ms, stored 12.34", arguments=[self.results, "--speeds"])

    def test_storing_a_figure_that_moved_needs_a_reason(self):
        self.results_with("1.08", "2.45")
        before = (self.figures / "lou_outliers.csv").read_text()
        for reason in ([], ["--reason", " "]):
            self.assert_fails("lou_outliers.csv: wiener, 20 %: rms_deg 1.08 -> 2.45", "--reason",
                              arguments=[self.results, "--store", *reason])
        self.assertEqual((self.figures / "lou_outliers.csv").read_text(), before)
        self.assertFalse((self.figures / "reasons.csv").exists())

    def test_a_stored_speed_moves_where_it_is_three_times_as_large_or_as_small(self):
        for old, new, moves in (("12.34", "36", False), ("12.34", "38", True), ("2.5", "0.9", False), ("2.5", "0.8", True)):
            with self.subTest(new):
                self.results_with("2.32", "2.32")
                self.replace(self.results / "speeds.csv", old, new)
                status, output = self.run_tool(self.results, "--store")
                self.assertEqual((status, f"{old} -> {new}" in output), (int(moves), moves), output)
                (self.figures / "speeds.csv").write_text(SPEEDS)

    def test_storing_keeps_the_reason_and_the_largest_move(self):
        self.results_with("1.08", "2.45")
        self.replace(self.results / "lou_outliers.csv", "2.32", "2.42")
        self.assertIn("stored lab/experiments/figures/lou_outliers.csv",
                      self.assert_passes(self.results, "--store", "--reason", "The hold, which outliers release, is gone"))
        self.assertIn("2.45", (self.figures / "lou_outliers.csv").read_text())
        with open(self.figures / "reasons.csv", newline="") as file:
            [line] = csv.DictReader(file)
        self.assertRegex(line["date"], r"^\d{4}-\d\d-\d\d$")
        self.assertEqual((line["file"], line["moved"]), ("lou_outliers.csv", "2"))
        self.assertEqual(line["largest"], "wiener, 20 %: rms_deg 1.08 -> 2.45")
        self.assertEqual(line["reason"], "The hold, which outliers release, is gone")
        # The results now contradict the ordering that the page states.
        self.assert_fails("does not hold", arguments=["--write"])

    def test_figures_within_the_noise_and_new_files_are_stored_without_reason(self):
        self.results_with("2.32", "2.33")
        (self.results / "new.csv").write_text("what,value\none,1\n")
        self.assert_passes(self.results, "--store", "new.csv")
        self.assertTrue((self.figures / "new.csv").is_file())
        self.assertIn("2.33", (self.figures / "lou_outliers.csv").read_text())
        self.assertFalse((self.figures / "reasons.csv").exists())

    def test_quick_results_have_a_folder_of_their_own(self):
        self.results_with("1.08", "2.45")
        self.assert_passes(self.results, "--quick", "--store", "lou_outliers.csv")
        self.assertIn("1.08", (self.figures / "lou_outliers.csv").read_text())
        self.assertIn("2.45", (self.figures / "quick/lou_outliers.csv").read_text())
        self.assert_passes("--write")
        self.assert_passes(self.results, "--quick")


if __name__ == "__main__":
    unittest.main()
