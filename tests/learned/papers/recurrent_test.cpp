// What the method `recurrent` promises on takes, with the model that ships.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/corrupt.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/synth.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/metrics.hpp"
#include "learned/papers/filter_support.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

Clip walk_at(double rate_hz, double duration_s = 1.5) {
  SynthOptions options{.motion = "walk", .duration_s = duration_s, .frame_rate_hz = rate_hz};
  return synthesize(options);
}

Clip damaged_by(Clip clip, const std::string& damage, const OptionValues& options) {
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
    const Clip truth = walk_at(rate_hz);
    const Clip noisy = damaged_by(truth, "gaussian", {{"std_deg", 3.0}});
    const Clip cleaned = clean_clip(noisy, cleaner()).clip;
    EXPECT_LT(rms_deg(truth, cleaned), 0.7 * rms_deg(truth, noisy)) << rate_hz << " Hz";
  }
}

TEST(Recurrent, LeavesToAutoATakeAtAnotherRateAndSaysSo) {
  const Clip noisy = damaged_by(walk_at(60), "gaussian", {{"std_deg", 3.0}});
  const CleanResult result = clean_clip(noisy, cleaner());
  EXPECT_LT(rms_deg(clean_clip(noisy, *make_auto()).clip, result.clip), 1e-6);
  ASSERT_FALSE(result.report.fall_backs.empty());
  EXPECT_EQ(result.report.fall_backs.front().reason,
            "the network filters takes of 120 Hz only, and this one has 60");
}

TEST(Recurrent, LeavesACleanTakeAsItIs) {
  for (const double rate_hz : {60.0, 120.0}) {
    const Clip truth = walk_at(rate_hz);
    EXPECT_EQ(clean_clip(truth, cleaner()).clip.rotations, truth.rotations);
  }
}

TEST(Recurrent, RefusesATakeOfMarkersAndSaysWhy) {
  const MarkerClip markers = joint_markers(walk_at(120));
  try {
    clean_markers(markers, cleaner());
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
  Clip clip = damaged_by(walk_at(120), "gaussian", {{"std_deg", 2.0}});
  const auto knee = static_cast<std::size_t>(clip.skeleton.find("LeftLeg"));
  clip.observed.assign(clip.frame_count() * clip.joint_count(), 1);
  for (std::size_t f = 60; f < 90; ++f) clip.observed[f * clip.joint_count() + knee] = 0;
  const Clip filled = clean_clip(clip, cleaner()).clip;
  const Clip truth = walk_at(120);
  for (std::size_t f = 60; f < 90; ++f)
    EXPECT_LT(angle_between(filled.rotation(f, knee), truth.rotation(f, knee)), 0.8) << f;
}

TEST(Recurrent, IsTheSameForAnyNumberOfRuns) {
  const Clip noisy = damaged_by(walk_at(120), "gaussian", {{"std_deg", 2.0}});
  EXPECT_EQ(clean_clip(noisy, cleaner()).clip.rotations,
            clean_clip(noisy, *make_recurrent()).clip.rotations);
}

// A network of the paper whose Gaussians are all three frames wide.
std::shared_ptr<const Model> constant_filter(const Clip& clip, FilterHead head,
                                             FilterInputs inputs = {}) {
  BodyLayoutBuilder builder;
  builder.add(clip);
  return std::make_shared<const Model>(
      constant_filter_model(builder.finish(), head, std::log(3.0), inputs));
}

TEST(Recurrent, CleansJointsWithTheFiltersThatANetworkOfThePaperPredicts) {
  const Clip truth = walk_at(120, 3);
  const Clip noisy = damaged_by(truth, "gaussian", {{"std_deg", 4.0}});
  const auto cleaner = make_recurrent({}, constant_filter(truth, FilterHead::gaussian));
  const Clip cleaned = clean_clip(noisy, *cleaner).clip;
  const Clip gaussian = clean_clip(noisy, *make_cleaner("gaussian", {{"width_s", 0.025}})).clip;
  EXPECT_NEAR(rms_deg(truth, cleaned) / rms_deg(truth, gaussian), 1, 0.1);
  // Alike, but for joints that the model does not know and samples that are spikes to `auto`.
  EXPECT_LT(rms_deg(cleaned, gaussian), 0.6 * rms_deg(truth, gaussian));
  const Clip automatic = clean_clip(noisy, *make_auto()).clip;
  for (std::size_t f = 0; f < truth.frame_count(); ++f)
    EXPECT_LT(angle_between(cleaned.rotation(f, 0), automatic.rotation(f, 0)), 1e-6);
}

TEST(Recurrent, RefusesANetworkThatFillsGaps) {
  const Clip clip = walk_at(120);
  EXPECT_THROW(make_recurrent({}, constant_filter(clip, FilterHead::residual, {false, true})),
               Error);
}

}  // namespace
}  // namespace kinemend::test
