// Tests of the method `recurrent` on takes, with the shipped model.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "papers/mall2017_recurrent/filter_support.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

Take walk_at(double rate_hz, double duration_s = 1.5) {
  SynthOptions options{.motion = "walk", .duration_s = duration_s, .frame_rate_hz = rate_hz};
  return synthesize(options);
}

Take damaged_by(Take clip, const std::string& damage, const OptionValues& options) {
  Random random(5);
  apply_damage(clip, damage, options, random);
  return clip;
}

const Cleaner& cleaner() {
  static const std::unique_ptr<Cleaner> made = make_recurrent();
  return *made;
}

TEST(Recurrent, TakesNoiseAwayAtAnyRate) {
  for (const double rate_hz : {30.0, 120.0, 240.0}) {
    const Take truth = walk_at(rate_hz);
    const Take noisy = damaged_by(truth, "gaussian", {{"std_deg", 3.0}});
    const Take cleaned = clean_take(noisy, cleaner()).take;
    EXPECT_LT(rms_deg(truth, cleaned), 0.7 * rms_deg(truth, noisy)) << rate_hz << " Hz";
  }
}

TEST(Recurrent, LeavesToAutoATakeAtAnotherRateAndSaysSo) {
  const Take noisy = damaged_by(walk_at(60), "gaussian", {{"std_deg", 3.0}});
  const CleanResult result = clean_take(noisy, cleaner());
  EXPECT_LT(rms_deg(clean_take(noisy, *make_auto()).take, result.take), 1e-6);
  ASSERT_FALSE(result.report.fall_backs.empty());
  EXPECT_EQ(result.report.fall_backs.front().reason,
            "the network filters takes of 120 Hz only, and this one has 60");
}

TEST(Recurrent, LeavesACleanTakeAsItIs) {
  for (const double rate_hz : {60.0, 120.0}) {
    const Take truth = walk_at(rate_hz);
    EXPECT_EQ(clean_take(truth, cleaner()).take.rotations, truth.rotations);
  }
}

TEST(Recurrent, RefusesATakeOfMarkersAndSaysWhy) {
  const Take markers = joint_markers(walk_at(120));
  try {
    clean_take(markers, cleaner());
    FAIL() << "was cleaned";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("joints"));
  }
}

TEST(Recurrent, RefusesAModelOfAnotherMethodAndOneThatLacksALayer) {
  EXPECT_THROW(make_recurrent({}, shipped_model("wiener")), Error);
  Model model = *shipped_model("recurrent");
  model.tensors.erase("decoder0.weight");
  EXPECT_THROW(make_recurrent({}, std::make_shared<const Model>(model)), Error);
}

TEST(Recurrent, FillsGapsOrLeavesThemBridged) {
  Take clip = damaged_by(walk_at(120), "gaussian", {{"std_deg", 2.0}});
  const auto knee = static_cast<std::size_t>(clip.skeleton.find("LeftLeg"));
  clip.observed.assign(clip.frame_count() * clip.joint_count(), 1);
  for (std::size_t f = 60; f < 90; ++f) clip.observed[f * clip.joint_count() + knee] = 0;
  const Take filled = clean_take(clip, cleaner()).take;
  const Take truth = walk_at(120);
  for (std::size_t f = 60; f < 90; ++f)
    EXPECT_LT(angle_between(filled.rotation(f, knee), truth.rotation(f, knee)), 0.8) << f;
}

TEST(Recurrent, IsTheSameForAnyNumberOfRuns) {
  const Take noisy = damaged_by(walk_at(120), "gaussian", {{"std_deg", 2.0}});
  EXPECT_EQ(clean_take(noisy, cleaner()).take.rotations,
            clean_take(noisy, *make_recurrent()).take.rotations);
}

// A network of the paper whose Gaussians all are three frames wide.
std::shared_ptr<const Model> constant_filter(const Take& clip, FilterHead head,
                                             FilterInputs inputs = {}) {
  BodyLayoutBuilder builder;
  builder.add(clip);
  return std::make_shared<const Model>(
      constant_filter_model(builder.finish(), head, std::log(3.0), inputs));
}

TEST(Recurrent, CleansJointsWithTheFiltersThatANetworkOfThePaperPredicts) {
  const Take truth = walk_at(120, 3);
  const Take noisy = damaged_by(truth, "gaussian", {{"std_deg", 4.0}});
  const auto cleaner = make_recurrent({}, constant_filter(truth, FilterHead::gaussian));
  const Take cleaned = clean_take(noisy, *cleaner).take;
  const Take gaussian = clean_take(noisy, *make_cleaner("gaussian", {{"width_s", 0.025}})).take;
  EXPECT_NEAR(rms_deg(truth, cleaned) / rms_deg(truth, gaussian), 1, 0.1);
  // The results agree except for joints unknown to the model and samples that `auto` takes for
  // spikes.
  EXPECT_LT(rms_deg(cleaned, gaussian), 0.6 * rms_deg(truth, gaussian));
  const Take automatic = clean_take(noisy, *make_auto()).take;
  for (std::size_t f = 0; f < truth.frame_count(); ++f)
    EXPECT_LT(angle_between(cleaned.rotation(f, 0), automatic.rotation(f, 0)), 1e-6);
}

TEST(Recurrent, RefusesANetworkThatFillsGaps) {
  const Take clip = walk_at(120);
  EXPECT_THROW(make_recurrent({}, constant_filter(clip, FilterHead::residual, {false, true})),
               Error);
}

}  // namespace
}  // namespace kinemend::test
