// Tests of `kinemend check`: findings, limits, and the gap file that it writes.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Check = Program;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST_F(Check, FindsNothingInACleanTake) {
  synth("walk.bvh", "walk", "3");
  const Ran ran = run({"check", "walk.bvh", "--max-spikes", "0", "--max-frozen", "0"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("walk.bvh: no fault found; slow errors (video, depth cameras, "
                                  "suits) cannot be seen in a take alone\n"));
}

TEST_F(Check, SaysInASentenceThatAFrameIsACalibrationPose) {
  ASSERT_EQ(run({"synth", "walk", "-o", "walk.bvh", "--t-pose-first"}).code, 0);
  EXPECT_THAT(run({"check", "walk.bvh"}).out,
              HasSubstr("frame 1 is a calibration pose, not part of the motion\n"));
}

TEST_F(Check, SaysWhatItLookedForWhereItFindsNothing) {
  synth("walk.bvh", "walk", "3");
  EXPECT_THAT(run({"check", "walk.bvh"}).out, HasSubstr("looked for"));
  noisy("noisy.bvh", "3");
  EXPECT_THAT(run({"check", "noisy.bvh"}).out, Not(HasSubstr("looked for")));
}

TEST_F(Check, CountsFramesFromOneInTextAndJson) {
  synth("walk.bvh", "walk", "3");
  // Frame 51 repeats frame 50.
  std::vector<std::string> lines = lines_of(contents(folder / "walk.bvh"));
  const auto motion = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
    return line.rfind("Frame Time", 0) == 0;
  });
  ASSERT_NE(motion, lines.end());
  *(motion + 51) = *(motion + 50);
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  put(folder / "walk.bvh", text);
  EXPECT_THAT(run({"check", "walk.bvh"}).out, HasSubstr("frame 51: the frame is equal to"));
  const Json take = Json::parse(run({"check", "walk.bvh", "--json"}).out)["takes"][0];
  ASSERT_EQ(take["findings"].size(), 1u);
  EXPECT_EQ(take["findings"][0]["kind"], "repeated_frames");
  EXPECT_EQ(take["findings"][0]["first_frame"], 51);
  EXPECT_EQ(take["findings"][0]["last_frame"], 51);
  EXPECT_TRUE(take["findings"][0]["track"].is_null());
}

TEST_F(Check, NamesTheWorstFindingOfALimitThatIsPassed) {
  noisy("walk.bvh", "3");
  const Ran ran = run({"check", "walk.bvh", "--max-noise", "0.5", "--max-gaps", "0"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_THAT(ran.err, HasSubstr("noise of the worst track"));
  EXPECT_THAT(ran.err, HasSubstr("is above the limit 0.50 deg; throughout: "));
  EXPECT_EQ(run({"check", "walk.bvh", "--max-noise", "5"}).code, 0);
}

TEST_F(Check, WritesStaleSpansAsASideFileOfGaps) {
  synth("truth.bvh", "walk", "6");
  ASSERT_EQ(run({"corrupt", "truth.bvh", "-o", "walk.bvh", "--damage",
                 "frozen:share=0.03,mean_length_s=0.3"})
                .code,
            0);
  ASSERT_EQ(run({"check", "walk.bvh", "--gaps-out", "gaps.csv"}).code, 0);
  const Json take = Json::parse(run({"check", "walk.bvh", "--json"}).out)["takes"][0];
  const std::size_t spans = take["figures"]["frozen"].get<std::size_t>();
  EXPECT_GT(spans, 5u);
  const std::vector<std::string> lines = lines_of(contents(folder / "gaps.csv"));
  EXPECT_GE(lines.size(), spans);
  EXPECT_LE(lines.size(), spans + 1) << "a heading, then a line a span";
  EXPECT_EQ(run({"check", "walk.bvh", "--gaps-out", "gaps.csv"}).code, 4) << "exists";
  EXPECT_EQ(run({"check", "walk.bvh", "--gaps-out", "gaps.csv", "--force"}).code, 0);
}

TEST_F(Check, GoesOnAfterAFileThatCannotBeRead) {
  synth("walk.bvh", "walk", "1");
  put(folder / "bad.bvh", "HIERARCHY\nROOT\n");
  const Ran ran = run({"check", "bad.bvh", "walk.bvh"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.out, HasSubstr("walk.bvh: no fault found"));
  EXPECT_EQ(run({"check", "bad.bvh", "walk.bvh", "--gaps-out", "g.csv"}).code, 2);
}

}  // namespace
}  // namespace kinemend::test
