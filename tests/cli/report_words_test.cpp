// The text reports of `clean` and `convert` mention all that applies to a take, and nothing else.
#include <gmock/gmock.h>

#include <sstream>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using ReportWords = Program;

TEST_F(ReportWords, NameTheMethodThatDidTheWork) {
#if defined(KINEMEND_SANITIZED)
  GTEST_SKIP() << "learned methods take minutes";
#endif
  noisy("noisy.bvh", "3");
  const Ran ran = run({"clean", "noisy.bvh", "-m", "example", "-o", "e.bvh", "--report", "e.json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("; auto in place of example for "),
                             HasSubstr("  auto in place of example for 4 joints: the model does "
                                       "not know them (LeftHandIndex2, ")));
  const Json report = Json::parse(contents(folder / "e.json"));
  EXPECT_THAT(report.dump(), HasSubstr("\"fall_backs\":[{"));
  EXPECT_THAT(run({"clean", "noisy.bvh", "--dry-run"}).out, Not(HasSubstr("in place of")));
}

TEST_F(ReportWords, NoiseHasAColourAndCanBeToldFromAnotherTake) {
  synth("walk.bvh", "walk", "6");
  ASSERT_EQ(run({"corrupt", "walk.bvh", "-o", "slow.bvh", "--damage",
                 "ar1:std_deg=1.5,correlation=0.8", "--seed", "3"})
                .code,
            0);
  const Ran found = run({"clean", "slow.bvh", "-m", "auto", "-o", "a.bvh", "--report", "a.json"});
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(run({"clean", "slow.bvh", "--dry-run"}).out,
              HasSubstr(" deg per axis, slow, 90 % below "));
  EXPECT_THAT(found.out,
              AllOf(HasSubstr("  noise: 1."), HasSubstr(" deg per axis, slow, 90 % below ")));
  EXPECT_THAT(run({"check", "slow.bvh"}).out, HasSubstr(" deg per axis, slow, 90 % below "));
  const Ran told = run({"clean", "slow.bvh", "-o", "b.bvh", "--noise", "a.json"});
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_THAT(told.out,
              AllOf(HasSubstr("slow, 90 % below "),
                    HasSubstr("auto in place of learned for 31 joints: the noise is given")));
  EXPECT_THAT(run({"clean", "slow.bvh", "-o", "c.bvh", "--noise", "white"}).out,
              HasSubstr("the noise is given"));
  for (const char* none : {"walk.bvh", "none.json"}) {
    const Ran refused = run({"clean", "slow.bvh", "-o", "d.bvh", "--noise", none});
    EXPECT_NE(refused.code, 0);
    EXPECT_THAT(refused.err, HasSubstr(none));
  }
}

TEST_F(ReportWords, MarkersAreComparedToo) {
  synth("walk.bvh", "walk", "4");
  ASSERT_EQ(run({"convert", "walk.bvh", "-o", "walk.trc"}).code, 0);
  ASSERT_EQ(run({"corrupt", "walk.trc", "-o", "noisy.trc", "--damage",
                 "system:kind=optical,strength=20", "--seed", "1"})
                .code,
            0);
  const Ran ran = run({"compare", "walk.trc", "noisy.trc", "--fit", "gain-offset", "--per-joint"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out,
              AllOf(HasSubstr("each channel with its own gain and offset"),
                    HasSubstr("velocity_rms"), HasSubstr("jitter"), HasSubstr("LeftHand")));
  EXPECT_EQ(run({"compare", "walk.trc", "noisy.trc", "--max-rms-axis", "100"}).code, 0);
  const Ran passed = run({"compare", "walk.trc", "noisy.trc", "--max-rms-axis", "1"});
  EXPECT_EQ(passed.code, 1);
  EXPECT_THAT(passed.err, HasSubstr("rms_axis"));
  EXPECT_THAT(run({"compare", "walk.trc", "noisy.trc", "--max-rms-deg", "1"}).err,
              HasSubstr("rms_deg is a figure of joints"));
  EXPECT_THAT(run({"compare", "walk.bvh", "noisy.trc"}).err,
              HasSubstr("walk.bvh: holds joints, and the other take markers"));
  EXPECT_THAT(run({"compare", "walk.bvh", "walk.bvh", "--fit", "rigid"}).err,
              HasSubstr("--fit is for takes of markers"));
}

TEST_F(ReportWords, FrozenSpansAreNotNothing) {
  synth("walk.bvh", "walk", "6");
  ASSERT_EQ(run({"corrupt", "walk.bvh", "-o", "frozen.bvh", "--damage",
                 "frozen:share=0.1,joints=LeftArm", "--seed", "3"})
                .code,
            0);
  const Ran ran = run({"clean", "frozen.bvh"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out,
              AllOf(HasSubstr("frozen or bridged span"), Not(HasSubstr("clean: nothing changed")),
                    HasSubstr("kinemend check frozen.bvh --gaps-out gaps.csv; kinemend clean "
                              "frozen.bvh --gaps gaps.csv --fill auto")));
  // The suggested commands repair the take.
  ASSERT_EQ(run({"check", "frozen.bvh", "--gaps-out", "gaps.csv"}).code, 0);
  const Ran mended =
      run({"clean", "frozen.bvh", "--gaps", "gaps.csv", "--fill", "auto", "-o", "mended.bvh"});
  ASSERT_EQ(mended.code, 0) << mended.err;
  EXPECT_THAT(mended.out, AllOf(HasSubstr("filled"), Not(HasSubstr("frozen or bridged"))));
  EXPECT_THAT(run({"clean", "walk.bvh"}).out, HasSubstr("clean: nothing changed"));
}

// Swaps the labels of two markers in frames `first` to `last`, counted from 1.
std::string with_swap(const std::string& trc, std::size_t a, std::size_t b, int first, int last) {
  std::istringstream lines(trc);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const int frame = std::atoi(line.c_str());
    if (frame >= first && frame <= last) {
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, '\t');) cells.push_back(cell);
      for (std::size_t i = 0; i < 3; ++i) std::swap(cells[2 + 3 * a + i], cells[2 + 3 * b + i]);
      line = cells[0];
      for (std::size_t i = 1; i < cells.size(); ++i) line += "\t" + cells[i];
    }
    result += line + "\n";
  }
  return result;
}

TEST_F(ReportWords, SwapsThatAreUndoneAreAChangeAndOthersAreLeftOver) {
  synth("walk.bvh", "walk", "6");
  ASSERT_EQ(run({"convert", "walk.bvh", "-o", "walk.trc"}).code, 0);
  put(folder / "swapped.trc", with_swap(contents(folder / "walk.trc"), 3, 8, 120, 180));
  const Ran left = run({"clean", "swapped.trc", "-o", "left.trc"});
  ASSERT_EQ(left.code, 0) << left.err;
  EXPECT_THAT(left.out, HasSubstr("1 swap of markers left"));
  EXPECT_THAT(left.out, HasSubstr("1 swap of markers left (--fix-swaps undoes them)"));
  const std::string twice = with_swap(contents(folder / "swapped.trc"), 3, 8, 240, 280);
  put(folder / "twice.trc", twice);
  EXPECT_THAT(run({"clean", "twice.trc", "--dry-run"}).out, HasSubstr("2 swaps of markers left"));
  const Ran undone = run({"clean", "swapped.trc", "--fix-swaps", "-o", "undone.trc"});
  ASSERT_EQ(undone.code, 0) << undone.err;
  EXPECT_THAT(undone.out,
              AllOf(HasSubstr("1 swap of markers undone"), Not(HasSubstr("nothing changed"))));
}

// Smoothing or filling with the wrong label would make the take differ from one without swaps.
TEST_F(ReportWords, SwapsAreUndoneBeforeNoiseIsSmoothedAndGapsAreFilled) {
  synth("walk.bvh", "walk", "6");
  ASSERT_EQ(run({"convert", "walk.bvh", "-o", "walk.trc"}).code, 0);
  const std::string right = contents(folder / "walk.trc");
  put(folder / "swapped.trc", with_swap(right, 3, 8, 120, 180));
  const std::string names = lines_of(right)[3];
  std::istringstream cells(names);
  std::string marker;
  for (std::size_t i = 0; i < 3 + 3 * 3; ++i) std::getline(cells, marker, '\t');
  put(folder / "gaps.csv", marker + ",184,190\n");
  for (const char* const take : {"walk.trc", "swapped.trc"}) {
    const Ran ran = run({"clean", take, "--fix-swaps", "--fill", "auto", "--gaps", "gaps.csv", "-m",
                         "gaussian", "-o", std::string("done_") + take});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("1 of 1 gap filled")) << take;
  }
  EXPECT_EQ(contents(folder / "done_swapped.trc"), contents(folder / "done_walk.trc"));
  EXPECT_NE(contents(folder / "done_walk.trc"), right);
}

TEST_F(ReportWords, StrictPassesNoGreatChangeUnnoticed) {
  synth("walk.bvh", "walk", "4");
  ASSERT_EQ(run({"corrupt", "walk.bvh", "-o", "spiky.bvh", "--damage",
                 "outliers:share=0.02,std_deg=40,joints=LeftForeArm", "--seed", "3"})
                .code,
            0);
  const Ran ran = run({"clean", "spiky.bvh", "-m", "gaussian", "--joints", "LeftForeArm",
                       "--strict", "-o", "g.bvh"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("LeftForeArm: smoothing changes it by "));
  EXPECT_FALSE(fs::exists(folder / "g.bvh"));
  EXPECT_EQ(run({"clean", "spiky.bvh", "--strict", "-o", "a.bvh"}).code, 0);  // repairs are fine
}

TEST_F(ReportWords, PointsThatAreNoPositionsBecomeMarkersOnlyWhereAskedFor) {
  const std::string take = c3d_fixture("laboratory");
  const Ran ran = run({"convert", take, "-o", "markers.trc"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("a point that is not a position"));
  const Ran all = run({"convert", take, "-o", "all.trc", "--all-points"});
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.err, Not(HasSubstr("no position")));
  const auto count = [&](const char* name) {
    return Json::parse(run({"info", name, "--json"}).out).dump();
  };
  EXPECT_NE(count("markers.trc"), count("all.trc"));
  EXPECT_GT(contents(folder / "all.trc").size(), contents(folder / "markers.trc").size());
}

TEST_F(ReportWords, NumbersInAnotherEncodingAreNamedAndNoLoss) {
  const std::string take = c3d_fixture("laboratory_integer");
  const Ran ran = run({"convert", take, "-o", "new.c3d", "--plain", "--strict"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("are saved as Intel floats"));
  EXPECT_EQ(run({"convert", take, "-o", "same.c3d"}).err, "");
}

TEST_F(ReportWords, AJointThatWasOnlyFilledHasNoJitter) {
  synth("walk.bvh", "walk", "4");
  put(folder / "gaps.csv", "LeftArm,101,106\n");
  const Ran ran = run({"clean", "walk.bvh", "--gaps", "gaps.csv", "--fill", "auto"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("1 gap"), Not(HasSubstr("jitter"))));
}

TEST_F(ReportWords, GapsAreCountedInOneWay) {
  synth("walk.bvh", "walk", "4");
  std::istringstream lines(contents(folder / "walk.bvh"));
  std::string text;
  int frame = -1;
  for (std::string line; std::getline(lines, line);) {
    if (frame >= 0 && ++frame > 60 && frame <= 66) {
      for (int i = 0; i < 6; ++i) line = line.substr(line.find(' ') + 1);
      line = "nan nan nan nan nan nan " + line;  // the root, including its position
    }
    if (line.rfind("Frame Time:", 0) == 0) frame = 0;
    text += line + "\n";
  }
  put(folder / "gap.bvh", text);
  const auto count = [&](const std::vector<std::string>& words, const char* key) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    const Json take = Json::parse(ran.out)["takes"][0];
    const Json& value = take.contains("figures") ? take["figures"][key] : take[key];
    return value.is_array() ? value.size() : value.get<std::size_t>();
  };
  EXPECT_EQ(count({"info", "gap.bvh", "--json"}, "gaps"), 1u);
  EXPECT_EQ(count({"check", "gap.bvh", "--json"}, "gaps"), 1u);
  EXPECT_EQ(count({"clean", "gap.bvh", "--json", "--dry-run"}, "gaps"), 1u);
  EXPECT_EQ(count({"fill", "gap.bvh", "--json", "--dry-run"}, "gaps"), 1u);
}

}  // namespace
}  // namespace kinemend::test
