// Tests of the networks of Mall et al. on the command line: filling gaps and cleaning streams.
#include <cmath>

#include "cli/program.hpp"
#include "kinemend/lab/synth.hpp"
#include "papers/mall2017_recurrent/filter_support.hpp"
#include "papers/mall2017_recurrent/random_filter_model.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class RecurrentCommands : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    ASSERT_EQ(
        run({"synth", "walk", "-o", "walk.bvh", "--duration-s", "2", "--frame-rate-hz", "120"})
            .code,
        0);
    const Take clip = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 120});
    BodyLayoutBuilder builder;
    builder.add(clip);
    layout_ = builder.finish();
    put(folder / "gaps.csv", "LeftLeg,60,119\nHips,30,40\n");
    put(folder / "ebd.kmodel",
        write_model(constant_filter_model(layout_, FilterHead::residual, 5, {false, true})));
    put(folder / "ebf.kmodel",
        write_model(random_filter_model({.layers = 2, .has_roughness = true}, &layout_)));
  }

  BodyLayout layout_;
};

TEST_F(RecurrentCommands, FillGapsAndSayWhatAutoFilled) {
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "-o", "filled.bvh", "--method",
                       "recurrent", "--model", "ebd.kmodel", "--plan-out", "plan.csv"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("1 by recurrent"));
  EXPECT_THAT(ran.err, HasSubstr("1 gap left to auto (Hips): the network sees how the root turns"));
  EXPECT_THAT(ran.err, HasSubstr("the model fills no positions"));

  const Ran again = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "-o", "again.bvh", "--plan",
                         "plan.csv", "--model", "ebd.kmodel"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(contents(folder / "again.bvh"), contents(folder / "filled.bvh"));

  const Ran without =
      run({"fill", "walk.bvh", "--gaps", "gaps.csv", "-o", "no.bvh", "--plan", "plan.csv"});
  EXPECT_EQ(without.code, 2);
  EXPECT_THAT(without.err, HasSubstr("the method recurrent needs a model"));
  EXPECT_FALSE(fs::exists(folder / "no.bvh"));
}

TEST_F(RecurrentCommands, StandInPreviewsOfAPlan) {
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--dry-run", "--plan-out",
                       "plan.csv", "--preview", "--model", "ebd.kmodel"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(contents(folder / "plan.csv"), HasSubstr("recurrent"));
  ASSERT_EQ(run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--dry-run", "--plan-out", "plain.csv",
                 "--preview"})
                .code,
            0);
  EXPECT_THAT(contents(folder / "plain.csv"), Not(HasSubstr("recurrent")));
}

TEST_F(RecurrentCommands, SayWhichModelFillsGaps) {
  const std::vector<std::string> words = {"fill", "walk.bvh", "--gaps", "gaps.csv",
                                          "-o",   "no.bvh",   "-m",     "recurrent"};
  const Ran none = run(words);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("kinemend-train paper --network ebd"));
  auto other = words;
  other.insert(other.end(), {"--model", "ebf.kmodel"});
  const Ran filter = run(other);
  EXPECT_EQ(filter.code, 2);
  EXPECT_THAT(filter.err, HasSubstr("cleans and fills no gaps"));
  const Ran idle = run({"fill", "walk.bvh", "-o", "no.bvh", "--model", "ebd.kmodel"});
  EXPECT_EQ(idle.code, 2);
  EXPECT_THAT(idle.err, HasSubstr("--model is used by --method recurrent"));
  EXPECT_FALSE(fs::exists(folder / "no.bvh"));
}

TEST_F(RecurrentCommands, StreamWhatTheLiveFormMakesOfTheFile) {
  ASSERT_EQ(run({"corrupt", "walk.bvh", "-o", "noisy.bvh", "--damage", "gaussian:std_deg=2"}).code,
            0);
  Setting fed;
  fed.in = contents(folder / "noisy.bvh");
  const Ran live = run({"stream", "-m", "recurrent", "--model", "ebf.kmodel"}, fed);
  ASSERT_EQ(live.code, 0) << live.err;
  EXPECT_THAT(live.err, HasSubstr("plus 125 ms of delay"));
  put(folder / "live.bvh", live.out);
  const Ran cleaned = run({"clean", "noisy.bvh", "-o", "clean.bvh", "-m", "recurrent", "--model",
                           "ebf.kmodel", "--live"});
  ASSERT_EQ(cleaned.code, 0) << cleaned.err;
  const Ran compared = run({"compare", "clean.bvh", "live.bvh", "--max-geodesic-rms-deg", "1e-4"});
  EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
  EXPECT_NE(run({"compare", "noisy.bvh", "live.bvh", "--max-geodesic-rms-deg", "0.1"}).code, 0);
}

TEST_F(RecurrentCommands, StreamWithTheModelThatShipsAndWithNoneThatFills) {
  Setting fed;
  fed.in = contents(folder / "walk.bvh");
  const Ran shipped = run({"stream", "-m", "recurrent"}, fed);
  EXPECT_EQ(shipped.code, 0) << shipped.err;
  EXPECT_THAT(shipped.err, HasSubstr("plus 125 ms of delay"));
  const Ran filling = run({"stream", "-m", "recurrent", "--model", "ebd.kmodel"}, fed);
  EXPECT_EQ(filling.code, 2);
  EXPECT_THAT(filling.err, HasSubstr("fills gaps and filters nothing"));
}

}  // namespace
}  // namespace kinemend::test
