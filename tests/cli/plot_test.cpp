// Tests of `kinemend plot`: each kind of picture, for one take and for two.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class Plot : public Program {};

TEST_F(Plot, DrawsEveryKindOfOneTakeAndOfTwo) {
  noisy("noisy.bvh", "1");
  for (const char* what : {"curves", "strip", "spectrum"}) {
    const Ran two = run({"plot", "truth.bvh", "noisy.bvh", "--what", what, "-o", "-"});
    EXPECT_EQ(two.code, 0) << two.err;
    EXPECT_THAT(two.out, StartsWith("<svg ")) << what;
    const Ran one = run({"plot", "noisy.bvh", "--what", what, "-o", std::string(what) + ".svg"});
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_THAT(contents(folder / (std::string(what) + ".svg")), StartsWith("<svg "));
  }
  const std::string markers = c3d_fixture("intel_real");
  EXPECT_THAT(run({"plot", markers, "--what", "strip", "-o", "-"}).out, StartsWith("<svg "));
}

TEST_F(Plot, TakesTheTrackAndTheRangeThatAreAskedFor) {
  synth("walk.bvh");
  EXPECT_THAT(run({"plot", "walk.bvh", "-o", "-", "--track", "LeftHand"}).out,
              HasSubstr(">LeftHand, deg<"));
  EXPECT_THAT(run({"plot", "walk.bvh", "-o", "-", "--root-position"}).out, HasSubstr(">Hips"));
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "-", "--range", "5:10"}).code, 0);
  const Ran nobody = run({"plot", "walk.bvh", "-o", "-", "--track", "Nobody"});
  EXPECT_EQ(nobody.code, 2);
  EXPECT_THAT(nobody.err, AllOf(IsOneLine(), HasSubstr("Nobody")));
}

TEST_F(Plot, RefusesWhatDoesNotFit) {
  synth("walk.bvh");
  synth("longer.bvh", "walk", "1");
  const std::string markers = c3d_fixture("intel_real");
  EXPECT_EQ(run({"plot", "walk.bvh"}).code, 2);
  EXPECT_EQ(run({"plot", "walk.bvh", "longer.bvh", "-o", "x.svg"}).code, 2);
  EXPECT_EQ(run({"plot", "walk.bvh", markers, "-o", "x.svg"}).code, 2);
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "walk.bvh", "--force"}).code, 2);
  put(folder / "x.svg", "mine");
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "x.svg"}).code, 4);
  EXPECT_EQ(contents(folder / "x.svg"), "mine");
}

}  // namespace
}  // namespace kinemend::test
