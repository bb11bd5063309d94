// kinemend clean on files of markers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/plate.hpp"
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class CleanMarkers : public Program {
 protected:
  CleanMarkers() { put(folder / "plate.trc", plate_take()); }
};

TEST_F(CleanMarkers, WritesTheTakeInItsOwnFormatAndTellsInItsUnit) {
  const Ran ran = run({"clean", "plate.trc"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("plate.trc: noisy: "));
  EXPECT_THAT(
      ran.out,
      HasSubstr(" mm jitter on 3 markers, 1 spike, 1 gap left; written to plate.clean.trc"));
  EXPECT_THAT(ran.out, HasSubstr("change rms mm"));
  EXPECT_THAT(contents(folder / "plate.clean.trc"), StartsWith("PathFileType\t4\t(X/Y/Z)"));
}

TEST_F(CleanMarkers, LeavesGapsUnlessTheyAreToBeFilled) {
  ASSERT_EQ(run({"clean", "plate.trc", "-o", "left.trc"}).code, 0);
  EXPECT_THAT(contents(folder / "left.trc"), HasSubstr("\t\t\t"));
  const Ran ran = run({"clean", "plate.trc", "-o", "filled.trc", "--fill", "auto"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("1 of 1 gap filled: 1 by "));
  EXPECT_THAT(ran.out, Not(HasSubstr("gap left")));
  const std::vector<std::string> lines = lines_of(contents(folder / "filled.trc"));
  EXPECT_THAT(lines[6 + 42], Not(HasSubstr("\t\t")));
}

TEST_F(CleanMarkers, MarksTheGapsOfASideFile) {
  put(folder / "gaps.csv", "name,first_frame,last_frame\nD,100,103\n");
  const Ran ran = run({"clean", "plate.trc", "--gaps", "gaps.csv", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("\"gaps_left\": 2"));
  put(folder / "gaps.csv", "D,100\n");
  const Ran wrong = run({"clean", "plate.trc", "--gaps", "gaps.csv", "--dry-run"});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("gaps.csv:1: "));
}

TEST_F(CleanMarkers, ReportsInFileUnitsAsJson) {
  const Ran ran = run({"clean", "plate.trc", "--report", "report.json", "--fill", "auto"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string report = contents(folder / "report.json");
  for (const char* key : {"\"tracks_changed\": 4", "\"unit\": \"mm\"", "\"track\": \"C\"",
                          "\"verdict\": \"despiked\"", "\"verdict\": \"filled\"",
                          "\"gaps_left\": 0", "\"rms_change\": ", "\"gaps_refused\": 0"}) {
    EXPECT_THAT(report, HasSubstr(key));
  }
  EXPECT_THAT(report, Not(HasSubstr("_deg\":")));
}

TEST_F(CleanMarkers, KnowsMarkersByName) {
  ASSERT_EQ(run({"clean", "plate.trc", "--markers", "C", "--method", "median", "-o", "c.trc"}).code,
            0);
  const std::vector<std::string> before = lines_of(plate_take()),
                                 after = lines_of(contents(folder / "c.trc"));
  ASSERT_EQ(before.size(), after.size());
  const auto cells_of_a = [](const std::string& line) {
    return line.substr(0, line.find('\t', 20));
  };
  EXPECT_EQ(cells_of_a(before[100]), cells_of_a(after[100]));
  EXPECT_NE(before[6 + 79], after[6 + 79]);
  const Ran wrong = run({"clean", "plate.trc", "--markers", "E", "--dry-run"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err,
              HasSubstr("plate.trc: no marker matches \"E\" (the markers are A, B, C, D)"));
}

TEST_F(CleanMarkers, BoundsTheWayOfEveryMarker) {
  const Ran ran = run({"clean", "plate.trc", "--max-change", "2", "--json", "--dry-run"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("\"max_change\": 2.0"));
}

TEST_F(CleanMarkers, WritesTheFormatOfTheOutputsName) {
  ASSERT_EQ(run({"clean", "plate.trc", "-o", "plate.c3d"}).code, 0);
  const Ran ran = run({"info", "plate.c3d"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("C3D"));
}

TEST_F(CleanMarkers, TakesPresetsAndConfigurationFiles) {
  put(folder / "lab.toml",
      "method = \"butterworth\"\nfill = \"auto\"\nmax_change = 50.0\n[butterworth]\ncutoff_hz = "
      "6.0\n");
  const Ran ran = run({"clean", "plate.trc", "--config", "lab.toml", "--fix-swaps"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("method butterworth"));
  EXPECT_THAT(ran.out, HasSubstr("1 of 1 gap filled"));
  EXPECT_EQ(run({"clean", "plate.trc", "--preset", "biomech", "--dry-run"}).code, 0);
}

}  // namespace
}  // namespace kinemend::test
