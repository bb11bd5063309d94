// Tests of `kinemend fill`: gaps of a side file, refusals and limits, reports, streams, and gap
// plans, which a second run applies with bit-identical results.
#include <fmt/format.h>
#include <cmath>

#include "cli/plate.hpp"
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Fill = Program;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(Fill, FillsTheGapsOfASideFile) {
  synth("walk.bvh", "walk", "2");
  put(folder / "gaps.csv",
      "name,first_frame,last_frame\nLeftArm,20,26\n# the hips too\nHips,50,53\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "-o", "filled.bvh"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("walk.bvh: 3 gaps: 3 filled, 0 refused; written to filled.bvh\n"));
  EXPECT_THAT(ran.out, HasSubstr("LeftArm"));
  EXPECT_THAT(ran.out, HasSubstr("20-26"));
  EXPECT_THAT(ran.out, HasSubstr("Hips (position)"));
  const auto before = lines_of(contents(folder / "walk.bvh"));
  const auto after = lines_of(contents(folder / "filled.bvh"));
  ASSERT_EQ(before.size(), after.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) changed += before[i] != after[i] ? 1 : 0;
  EXPECT_EQ(changed, 11u);
}

TEST_F(Fill, FillsByTheNetworkThatShips) {
  synth("walk.bvh", "walk", "2");
  put(folder / "gaps.csv", "LeftArm,20,40\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "-m", "learned", "-o",
                       "filled.bvh", "--plan-out", "plan.csv"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("1 filled, 0 refused"));
  const Ran again =
      run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--plan", "plan.csv", "-o", "again.bvh"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(contents(folder / "again.bvh"), contents(folder / "filled.bvh"));
}

TEST_F(Fill, WritesTheSameBytesWhereThereIsNoGap) {
  put(folder / "hand.bvh", hand_take());
  const Ran ran = run({"fill", "hand.bvh", "-o", "same.bvh"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.out, "hand.bvh: no gaps; written to same.bvh\n");
  EXPECT_EQ(contents(folder / "same.bvh"), hand_take());
}

TEST_F(Fill, ListsWhatTheRulesRefuse) {
  synth("walk.bvh", "walk", "3");
  put(folder / "gaps.csv", "LeftArm,20,90\nRightArm,30,33\n");
  const std::vector<std::string> words = {"fill",     "walk.bvh", "--gaps", "gaps.csv",
                                          "--method", "spline",   "-o",     "filled.bvh"};
  const Ran ran = run(words);
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("2 gaps: 1 filled, 1 refused"));
  EXPECT_THAT(ran.out, HasSubstr("\n  1 refused:\n"));
  EXPECT_THAT(ran.out, HasSubstr("1.18 s is longer than the 0.25 s that spline may fill"));

  auto all = words;
  all.insert(all.end(), {"--fill-all", "--force"});
  EXPECT_THAT(run(all).out, HasSubstr("2 filled, 0 refused"));

  auto strict = words;
  strict.back() = "strict.bvh";
  strict.push_back("--strict");
  const Ran refused = run(strict);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("1 gap refused, which --strict does not allow"));
  EXPECT_FALSE(fs::exists(folder / "strict.bvh"));
}

TEST_F(Fill, TellsProgramsWhatWasDone) {
  synth("walk.bvh", "walk", "3");
  put(folder / "gaps.csv", "LeftArm,20,90\nHips,30,33\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--method", "spline", "-o",
                       "filled.bvh", "--json", "--report", "report.json"});
  EXPECT_EQ(ran.out, contents(folder / "report.json"));
  const Json report = Json::parse(ran.out)["takes"][0];
  EXPECT_EQ(report["figures"]["filled"], 2);
  EXPECT_EQ(report["figures"]["refused"], 1);
  EXPECT_EQ(report["output"], "filled.bvh");
  ASSERT_EQ(report["findings"].size(), 3u);
  for (const Json& gap : report["findings"]) {
    if (gap["track"] == "LeftArm") {
      EXPECT_EQ(gap["verdict"], "refused");
      EXPECT_EQ(gap["first_frame"], 20);
      EXPECT_EQ(gap["last_frame"], 90);
      EXPECT_EQ(gap["quantity"], "rotation");
      EXPECT_EQ(gap["unit"], "deg");
      EXPECT_THAT(gap["reason"], HasSubstr("is longer than"));
    } else {
      EXPECT_EQ(gap["verdict"], "filled");
      EXPECT_TRUE(gap["reason"].is_null());
    }
  }
}

TEST_F(Fill, ADryRunWritesNoTake) {
  synth("walk.bvh", "walk", "2");
  put(folder / "gaps.csv", "LeftArm,20,26\n");
  const auto before = files();
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--dry-run"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("1 gap: 1 filled, 0 refused; nothing written (dry run)"));
  EXPECT_EQ(files(), before);
}

TEST_F(Fill, StreamsTheTake) {
  put(folder / "gaps.csv", "LeftArm,4,5\n");
  const Ran ran = run({"fill", "-", "--gaps", "gaps.csv", "--method", "pchip", "-o", "-"},
                      {hand_take(), {}, {}});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, testing::StartsWith("HIERARCHY"));
  EXPECT_THAT(ran.err, HasSubstr("standard input: 1 gap: 1 filled"));
}

TEST_F(Fill, NamesWhatIsWrong) {
  put(folder / "hand.bvh", hand_take());
  put(folder / "bad.csv", "LeftArm,1,2\nLeftArm,7,3\n");
  put(folder / "unknown.csv", "Tail,1,2\n");
  const Ran bad = run({"fill", "hand.bvh", "--gaps", "bad.csv", "-o", "out.bvh"});
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("bad.csv:2: the last frame, 3, is before the first, 7"));
  const Ran unknown = run({"fill", "hand.bvh", "--gaps", "unknown.csv", "-o", "out.bvh"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("unknown.csv: gap of joint \"Tail\": the take has no such"));
  const Ran method = run({"fill", "hand.bvh", "-o", "out.bvh", "--method", "rigid-body"});
  EXPECT_EQ(method.code, 2);
  EXPECT_THAT(method.err, HasSubstr("expected a method for joints"));
  EXPECT_FALSE(fs::exists(folder / "out.bvh"));
  put(folder / "out.bvh", "mine");
  EXPECT_EQ(run({"fill", "hand.bvh", "-o", "out.bvh"}).code, 4);
  EXPECT_EQ(contents(folder / "out.bvh"), "mine");
}

TEST_F(Fill, TheHelpTellsOfEveryMethod) {
  const std::string list = run({"fill", "--help"}).out;
  for (const char* method : {"auto", "spline", "quintic", "pchip", "slerp", "squad", "hermite",
                             "pattern", "rigid-body", "pca", "local-regression", "cyclic"}) {
    EXPECT_THAT(list, HasSubstr(method));
    EXPECT_THAT(run({"help", method}).out,
                HasSubstr(std::string("kinemend fill --method ") + method));
  }
}

using FillLimits = Program;

TEST_F(FillLimits, AFillAboveTheLimitIsRefusedWithBothFiguresAndTheirUnit) {
  put(folder / "plate.trc", plate_take());
  const Ran ran = run({"fill", "plate.trc", "-o", "out.trc", "--max-error-mm", "0.001"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("1 gap: 0 filled, 1 refused"),
                             testing::ContainsRegex("the expected error of [a-z-]+, [0-9.]+ mm, is "
                                                    "above the limit of 0.001 mm")));
  EXPECT_THAT(run({"fill", "plate.trc", "--dry-run", "--max-error-mm", "500"}).out,
              HasSubstr("1 filled, 0 refused"));
}

TEST_F(FillLimits, ALimitInDegreesHoldsForRotations) {
  synth("walk.bvh", "walk", "3");
  put(folder / "gaps.csv", "LeftArm,60,80\n");
  const std::vector<std::string> words = {"fill",     "walk.bvh",  "--gaps",
                                          "gaps.csv", "--dry-run", "--max-error-deg"};
  auto strict = words, wide = words;
  strict.emplace_back("0.0001");
  wide.emplace_back("90");
  EXPECT_THAT(run(strict).out, AllOf(HasSubstr("0 filled, 1 refused"), HasSubstr(" deg, is above "
                                                                                 "the limit of")));
  EXPECT_THAT(run(wide).out, HasSubstr("1 filled, 0 refused"));
  auto all = wide;
  all.emplace_back("--fill-all");
  const Ran both = run(all);
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("--fill-all fills every gap"));
}

TEST_F(FillLimits, AMethodThatCannotTellItsErrorIsRefusedUnderALimit) {
  put(folder / "plate.trc", plate_take());
  EXPECT_THAT(run({"fill", "plate.trc", "--dry-run", "-m", "spline", "--max-error-mm", "500"}).out,
              HasSubstr("spline cannot tell its error, and the limit is 500 mm"));
}

TEST_F(FillLimits, ALimitOfDegreesMeansNothingForMarkers) {
  put(folder / "plate.trc", plate_take());
  const Ran ran = run({"fill", "plate.trc", "--dry-run", "--max-error-deg", "5"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("--max-error-deg has no effect on markers"));
  EXPECT_EQ(run({"fill", "plate.trc", "--dry-run", "--max-error-deg", "5", "--strict"}).code, 1);
}

/// Renames marker B of the plate to a typical name of an unlabelled point.
std::string with_name(std::string trc, const std::string& name) {
  trc.replace(trc.find("\tB\t"), 3, "\t" + name + "\t");
  return trc;
}

TEST_F(FillLimits, UnlabelledPointsAreLeftAloneUnlessAskedFor) {
  for (const char* name : {"*52", "U_12", "Unlabeled 1234"}) {
    put(folder / "take.trc", with_name(plate_take(), name));
    const Ran left = run({"fill", "take.trc", "--dry-run", "--json"});
    ASSERT_EQ(left.code, 0) << left.err;
    const Json figures = Json::parse(left.out)["takes"][0]["figures"];
    EXPECT_EQ(figures["filled"], 0) << name;
    EXPECT_EQ(figures["unlabelled"], 1) << name;
    EXPECT_THAT(run({"fill", "take.trc", "--dry-run"}).out,
                HasSubstr("1 gap of unlabelled points left alone (--unlabelled fills them)"));
    EXPECT_THAT(run({"fill", "take.trc", "--dry-run", "--unlabelled"}).out,
                HasSubstr("1 gap: 1 filled, 0 refused"));
    EXPECT_THAT(run({"clean", "take.trc", "--dry-run", "--fill", "auto"}).out,
                AllOf(HasSubstr("1 gap left"), HasSubstr("1 gap of unlabelled points left alone")));
    EXPECT_THAT(run({"clean", "take.trc", "--dry-run", "--fill", "auto", "--unlabelled"}).out,
                Not(HasSubstr("gap left")));
  }
}

TEST_F(FillLimits, ErrorsOfATakeInMetresAreShownInMillimetres) {
  put(folder / "plate.trc", plate_take());
  ASSERT_EQ(run({"convert", "plate.trc", "-o", "metres.trc", "--unit", "m"}).code, 0);
  const Ran filled = run({"fill", "metres.trc", "--dry-run", "--max-error-mm", "0.001"});
  EXPECT_THAT(filled.out, AllOf(HasSubstr(" mm, is above the limit of 0.001 mm"),
                                Not(HasSubstr(" m,")), Not(HasSubstr("e-0"))));
  const Ran cleaned = run({"clean", "metres.trc", "--dry-run"});
  EXPECT_THAT(cleaned.out, AllOf(HasSubstr(" mm jitter on "), HasSubstr("noise mm"),
                                 HasSubstr("peak m/s before"), HasSubstr(" mm per axis")));
  EXPECT_THAT(run({"check", "metres.trc"}).out, HasSubstr(" mm)"));
}

class FillReport : public Program {
 protected:
  /// Makes `count` gaps of four frames, and `count` gaps too long for a spline.
  void make_gaps(int count) {
    synth("walk.bvh", "walk", "12");
    const char* joints[] = {"LeftArm", "RightArm", "LeftForeArm", "RightForeArm", "LeftHand"};
    std::string text;
    for (int i = 0; i < count; ++i) {
      const int first = 20 + 90 * (i / 5);
      text += std::string(joints[i % 5]) + "," + std::to_string(first) + "," +
              std::to_string(first + 3 + i / 5) + "\n";
      text += std::string(joints[i % 5]) + "," + std::to_string(first + 20) + "," +
              std::to_string(first + 60) + "\n";
    }
    put(folder / "gaps.csv", text);
  }
};

TEST_F(FillReport, IsThirtyLinesAtMostWithRefusalsApart) {
  make_gaps(35);
  const std::vector<std::string> words = {"fill",     "walk.bvh", "--gaps", "gaps.csv",
                                          "--method", "spline",   "-o",     "out.bvh"};
  const Ran ran = run(words);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_LE(lines_of(ran.out).size(), 30u) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr("70 gaps: 35 filled, 35 refused; written to out.bvh\n"));
  EXPECT_THAT(ran.out, HasSubstr("35 by spline\n"));
  EXPECT_THAT(ran.out, HasSubstr("  and 25 shorter ones (--verbose lists them)\n"));
  EXPECT_THAT(ran.out, HasSubstr("    and 27 more (--verbose lists them)\n"));
  const std::size_t refused = ran.out.find("\n  35 refused:\n");
  ASSERT_NE(refused, std::string::npos);
  EXPECT_THAT(ran.out.substr(0, refused), Not(HasSubstr("longer than")));
  EXPECT_THAT(ran.out.substr(refused), HasSubstr("longer than"));

  auto verbose = words;
  verbose.insert(verbose.end(), {"--force", "-v"});
  EXPECT_GE(lines_of(run(verbose).out).size(), 70u);
  auto quiet = words;
  quiet.insert(quiet.end(), {"--force", "-q"});
  const Ran still = run(quiet);
  EXPECT_EQ(still.code, 0);
  EXPECT_EQ(still.out + still.err, "");
}

TEST_F(FillReport, GoesBesideTheTakeWhereNoOutputIsNamed) {
  fs::create_directory(folder / "deep");
  synth("deep/walk.bvh", "walk", "2");
  put(folder / "gaps.csv", "LeftArm,20,26\n");
  const Ran ran = run({"fill", "deep/walk.bvh", "--gaps", "gaps.csv"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("written to deep/walk.filled.bvh"));
  EXPECT_TRUE(fs::exists(folder / "deep/walk.filled.bvh"));
  EXPECT_EQ(run({"fill", "deep/walk.bvh", "--gaps", "gaps.csv"}).code, 4) << "exists";
  const Ran stream = run({"fill", "-"}, {hand_take(), {}, {}});
  EXPECT_EQ(stream.code, 0) << stream.err;
  EXPECT_EQ(stream.out, hand_take());
}

TEST_F(FillReport, OnlyGapsWithinTheRangeAreFilled) {
  synth("walk.bvh", "walk", "4");
  put(folder / "gaps.csv", "LeftArm,20,24\nRightArm,58,63\nLeftArm,100,104\nLeftHand,150,154\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--range", "60:120", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json report = Json::parse(ran.out)["takes"][0];
  ASSERT_EQ(report["findings"].size(), 1u);
  EXPECT_EQ(report["findings"][0]["first_frame"], 100);
  EXPECT_EQ(report["figures"]["not_within_range"], 3);
  const auto before = lines_of(contents(folder / "walk.bvh"));
  const auto after = lines_of(contents(folder / "walk.filled.bvh"));
  ASSERT_EQ(before.size(), after.size());
  const std::size_t frames = before.size() - 240;
  for (std::size_t f = 1; f <= 240; ++f) {
    EXPECT_EQ(before[frames + f - 1] != after[frames + f - 1], f >= 100 && f <= 104) << f;
  }
  const Ran text = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--range", "1s:2s", "--dry-run"});
  EXPECT_THAT(text.out, HasSubstr("1 gap: 1 filled, 0 refused; 3 gaps not within --range left"));
  EXPECT_EQ(run({"fill", "walk.bvh", "--range", "7:5", "--dry-run"}).code, 2);
  EXPECT_EQ(run({"fill", "walk.bvh", "--range", "7:500", "--dry-run"}).code, 2);
}

using GapPlan = Program;

TEST_F(GapPlan, UneditedGivesTheBytesOfFill) {
  synth("walk.bvh", "walk", "3");
  put(folder / "gaps.csv", "LeftArm,20,90\nHips,30,33\nRightArm,100,104\n");
  for (const char* plan : {"plan.csv", "plan.json"}) {
    const Ran first = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "-o", "filled.bvh", "--force",
                           "--plan-out", plan});
    ASSERT_EQ(first.code, 0) << first.err;
    const Ran second = run(
        {"fill", "walk.bvh", "--gaps", "gaps.csv", "-o", "planned.bvh", "--force", "--plan", plan});
    ASSERT_EQ(second.code, 0) << second.err;
    EXPECT_EQ(contents(folder / "planned.bvh"), contents(folder / "filled.bvh"));
  }
}

TEST_F(GapPlan, IsWrittenWithoutATakeByADryRun) {
  synth("walk.bvh", "walk", "3");
  put(folder / "gaps.csv", "LeftArm,20,90\nHips,30,33\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--dry-run", "--plan-out",
                       "plan.csv", "--preview"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_FALSE(fs::exists(folder / "walk.filled.bvh"));
  const auto lines = lines_of(contents(folder / "plan.csv"));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_THAT(lines[0], HasSubstr("name,quantity,first_frame,last_frame,length_frames,length_s,"
                                  "verdict,method,donor,longest_gap_s,filled_by,evidence,"
                                  "expected_error,unit,reason,preview_auto,"));
  EXPECT_THAT(lines[1], testing::StartsWith("Hips,rotation,30,33,4,"));
  EXPECT_THAT(lines[2], testing::StartsWith("Hips,position,30,33,4,"));
}

TEST_F(GapPlan, RefusesWhatItWouldReplaceOrContradict) {
  synth("walk.bvh", "walk", "1");
  put(folder / "plan.csv", "name,first_frame,last_frame\n");
  const Ran both = run({"fill", "walk.bvh", "--plan", "plan.csv", "--method", "spline"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("--method cannot be combined with --plan"));
  const Ran same =
      run({"fill", "walk.bvh", "--plan", "plan.csv", "--plan-out", "plan.csv", "--force"});
  EXPECT_EQ(same.code, 2);
  EXPECT_EQ(contents(folder / "plan.csv"), "name,first_frame,last_frame\n");
  EXPECT_EQ(run({"fill", "walk.bvh", "--preview"}).code, 2);
  EXPECT_EQ(run({"fill", "walk.bvh", "--plan-out", "walk.bvh", "--force"}).code, 2);
  put(folder / "bad.csv", "name,first_frame,last_frame\nNose,1,2\n");
  const Ran bad = run({"fill", "walk.bvh", "--plan", "bad.csv"});
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("bad.csv:2: the take has no joint \"Nose\""));
}

}  // namespace
}  // namespace kinemend::test
