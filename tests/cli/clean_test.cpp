// Tests of `kinemend clean`: the changes to a take of joints or markers, and the report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>

#include "cli/plate.hpp"
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Clean = Program;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The words of the motion lines, frame by frame.
std::vector<std::vector<std::string>> motion_words(const std::string& bvh) {
  std::vector<std::vector<std::string>> frames;
  const auto lines = lines_of(bvh.substr(bvh.find("Frame Time")));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::istringstream words(lines[i]);
    frames.push_back({std::istream_iterator<std::string>(words), {}});
  }
  return frames;
}

double geodesic_rms_deg(const Ran& compared) {
  return Json::parse(compared.out)["takes"][0]["figures"]["geodesic_rms_deg"];
}

TEST_F(Clean, ANoisyTakeComesNearerToTheTruth) {
  noisy("walk.bvh");
  const Ran ran = run({"clean", "walk.bvh"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(lines_of(ran.out)[0],
              testing::MatchesRegex("walk.bvh: noisy: 1.[0-9]+ deg jitter on 31 joints, [0-9]+ "
                                    "spikes; written to walk.clean.bvh"));
  const double before = geodesic_rms_deg(run({"compare", "truth.bvh", "walk.bvh", "--json"}));
  const double after = geodesic_rms_deg(run({"compare", "truth.bvh", "walk.clean.bvh", "--json"}));
  EXPECT_LT(after, before / 2);
}

TEST_F(Clean, TheReportListsTheJointsThatChangedMost) {
  noisy("walk.bvh");
  const Ran short_one = run({"clean", "walk.bvh", "--dry-run"});
  EXPECT_THAT(short_one.out, HasSubstr("and 23 joints that changed less (--verbose lists them)"));
  const Ran long_one = run({"clean", "walk.bvh", "--dry-run", "--verbose"});
  EXPECT_THAT(long_one.out, testing::Not(HasSubstr("joints that changed less")));
  EXPECT_GT(lines_of(long_one.out).size(), 31u);
  EXPECT_EQ(run({"clean", "walk.bvh", "--dry-run", "--quiet"}).out, "");
}

TEST_F(Clean, JointsThatAreLeftOutKeepTheirBytes) {
  put(folder / "hand.bvh", hand_take());
  ASSERT_EQ(run({"clean", "hand.bvh", "-m", "weighted-mean", "--exclude", "*Finger?"}).code, 0);
  const std::string before = contents(folder / "hand.bvh");
  const std::string after = contents(folder / "hand.clean.bvh");
  EXPECT_EQ(before.substr(0, before.find("Frame Time")), after.substr(0, after.find("Frame Time")));
  const auto old_frames = motion_words(before);
  const auto new_frames = motion_words(after);
  ASSERT_EQ(new_frames.size(), 10u);
  bool arm_changed = false;
  for (std::size_t f = 0; f < 10; ++f) {
    for (std::size_t c = 9; c < 15; ++c) EXPECT_EQ(new_frames[f][c], old_frames[f][c]);
    arm_changed |= new_frames[f][6] != old_frames[f][6];
  }
  EXPECT_TRUE(arm_changed);
}

TEST_F(Clean, OnlyTheJointsNamedChange) {
  put(folder / "hand.bvh", hand_take());
  const Ran ran = run({"clean", "hand.bvh", "-m", "weighted-mean", "--joints", "Left*", "--exclude",
                       "LeftFinger1,LeftFinger2", "--no-root-position", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json take = Json::parse(ran.out)["takes"][0];
  EXPECT_EQ(take["figures"]["tracks_changed"], 1);
  EXPECT_EQ(take["figures"]["root_max_change"], 0);
  EXPECT_GT(take["tracks"][1]["rms_change"], 0);
}

TEST_F(Clean, OnlyTheFramesOfTheRangeChange) {
  noisy("walk.bvh");
  const auto before = motion_words(contents(folder / "walk.bvh"));
  ASSERT_EQ(before.size(), 120u);
  struct Range {
    const char* text;
    std::size_t first, last;  ///< counted from 0
  };
  for (const Range range :
       {Range{"31:60", 30, 59}, Range{"0.5s:0.99s", 30, 59}, Range{":60", 0, 59},
        Range{"1:60", 0, 59}, Range{"61:", 60, 119}, Range{"1s:2s", 60, 119}}) {
    ASSERT_EQ(run({"clean", "walk.bvh", "--force", "--range", range.text}).code, 0);
    const auto after = motion_words(contents(folder / "walk.clean.bvh"));
    std::vector<std::size_t> changed;
    for (std::size_t f = 0; f < 120; ++f) {
      if (before[f] != after[f]) changed.push_back(f);
    }
    ASSERT_FALSE(changed.empty());
    EXPECT_EQ(changed.front(), range.first) << range.text;
    EXPECT_EQ(changed.back(), range.last) << range.text;
  }
}

TEST_F(Clean, TheSameCommandGivesTheSameBytesWithAnyNumberOfThreads) {
  noisy("walk.bvh");
  ASSERT_EQ(run({"clean", "walk.bvh", "-o", "1.bvh", "--jobs", "1"}).code, 0);
  ASSERT_EQ(run({"clean", "walk.bvh", "-o", "2.bvh", "--jobs", "4"}).code, 0);
  ASSERT_EQ(run({"clean", "walk.bvh", "truth.bvh", "--output-dir", "many"}).code, 0);
  EXPECT_EQ(contents(folder / "1.bvh"), contents(folder / "2.bvh"));
  EXPECT_EQ(contents(folder / "1.bvh"), contents(folder / "many/walk.bvh"));
}

TEST_F(Clean, NoStrengthChangesNothing) {
  noisy("walk.bvh");
  const Ran ran = run({"clean", "walk.bvh", "--strength", "0"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("walk.bvh: nothing changed: --strength 0 keeps the input"));
  EXPECT_EQ(contents(folder / "walk.bvh"), contents(folder / "walk.clean.bvh"));
}

TEST_F(Clean, NoSampleTurnsFurtherThanAsked) {
  noisy("walk.bvh");
  const Ran ran = run({"clean", "walk.bvh", "--max-change-deg", "2", "--json"});
  ASSERT_EQ(ran.code, 0);
  double largest = 0;
  const Json report = Json::parse(ran.out);
  for (const Json& joint : report["takes"][0]["tracks"])
    largest = std::max<double>(largest, joint["max_change"]);
  EXPECT_NEAR(largest, 2, 1e-6);
}

TEST_F(Clean, TheJsonHoldsTheFiguresOfTheReport) {
  noisy("walk.bvh");
  put(folder / "bad.bvh", "HIERARCHY\n");
  const Ran ran = run({"clean", "walk.bvh", "bad.bvh", "--output-dir", "d", "--json"});
  EXPECT_EQ(ran.code, 3);
  const Json json = Json::parse(ran.out);
  ASSERT_EQ(json["takes"].size(), 2u);
  const Json& take = json["takes"][0];
  EXPECT_EQ(take["input"], "walk.bvh");
  EXPECT_EQ(take["output"], "d/walk.bvh");
  EXPECT_EQ(take["method"], "learned");
  EXPECT_EQ(take["frames"], 120);
  EXPECT_NEAR(take["frame_rate_hz"], 60, 1e-3);
  EXPECT_EQ(take["tracks"].size(), 31u);
  EXPECT_EQ(take["options"]["live"], false);
  EXPECT_TRUE(take["findings"].empty());
  EXPECT_EQ(json["takes"][1]["exit_code"], 3);
  EXPECT_THAT(json["takes"][1]["error"].get<std::string>(), testing::StartsWith("bad.bvh:"));
}

TEST_F(Clean, TheReportHoldsEverySpanWithFramesFromOne) {
  noisy("walk.bvh");
  ASSERT_EQ(run({"clean", "walk.bvh", "--report", "r.json"}).code, 0);
  const Json take = Json::parse(contents(folder / "r.json"))["takes"][0];
  std::vector<std::size_t> repaired_frames(121, 0);
  std::size_t spikes = 0;
  for (const Json& span : take["findings"]) {
    const std::size_t first = span["first_frame"], last = span["last_frame"];
    ASSERT_GE(first, 1u);
    ASSERT_LE(first, last);
    ASSERT_LE(last, 120u);
    EXPECT_NE(span["verdict"], "kept");
    if (span["verdict"] != "despiked") continue;
    ++spikes;
    EXPECT_GE(span["amount"], span["rms"]);
    for (std::size_t f = first; f <= last; ++f) repaired_frames[f] = 1;
  }
  EXPECT_GT(spikes, 3u);
  EXPECT_EQ(take["figures"]["spikes"], spikes);
  EXPECT_EQ(take["figures"]["frames_repaired"],
            std::count(repaired_frames.begin(), repaired_frames.end(), 1u));
}

TEST_F(Clean, StrictMakesARepairedInputFail) {
  std::string take = hand_take();
  take.replace(take.find("Frames: 10"), 10, "Frames: 12");
  put(folder / "odd.bvh", take);
  const Ran lenient = run({"clean", "odd.bvh"});
  EXPECT_EQ(lenient.code, 0);
  EXPECT_THAT(lenient.err, IsOneLine());
  EXPECT_THAT(lenient.err, testing::MatchesRegex("kinemend: warning: odd.bvh:[0-9]+: .*\n"));
  const Ran strict = run({"clean", "odd.bvh", "-o", "strict.bvh", "--strict"});
  EXPECT_EQ(strict.code, 1);
  EXPECT_THAT(strict.err, IsOneLine());
  EXPECT_FALSE(fs::exists(folder / "strict.bvh"));
  EXPECT_EQ(run({"info", "odd.bvh", "--strict"}).code, 1);
}

TEST_F(Clean, StrictMakesALostPeakFail) {
  synth("punch.bvh", "punch", "2");
  const std::vector<std::string> words = {"clean",       "punch.bvh", "-m",     "butterworth",
                                          "--cutoff-hz", "1",         "--force"};
  const Ran lenient = run(words);
  EXPECT_EQ(lenient.code, 0);
  EXPECT_THAT(lenient.err, HasSubstr("warning: punch.bvh: "));
  EXPECT_THAT(lenient.err, HasSubstr("peak speed"));
  fs::remove(folder / "punch.clean.bvh");
  std::vector<std::string> strict = words;
  strict.push_back("--strict");
  const Ran ran = run(strict);
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_FALSE(fs::exists(folder / "punch.clean.bvh"));
}

TEST_F(Clean, EveryMethodRunsAndKeepsTheTakeInShape) {
  noisy("walk.bvh", "1");
  const Json list = Json::parse(run({"methods", "--json"}).out)["methods"];
  ASSERT_GE(list.size(), 8u);
  EXPECT_EQ(list[0]["name"], "auto");
  for (const Json& method : list) {
    const std::string name = method["name"];
    std::vector<std::string> words = {"clean", "walk.bvh", "-m", name, "-o", name + ".bvh", "-q"};
    if (name == "kalman-learned") {  // ships without a model
      ASSERT_EQ(run({"train", name, "walk.bvh", "-o", "walk.kmodel", "-q"}).code, 0);
      words.insert(words.end(), {"--model", "walk.kmodel"});
    }
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << name << ": " << ran.err;
    EXPECT_EQ(run({"compare", "walk.bvh", name + ".bvh"}).code, 0) << name;
  }
}

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
