// A second run applies the gap plan of the first one with bit-identical results.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using GapPlan = Program;
using testing::HasSubstr;

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
