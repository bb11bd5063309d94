// Tests of the method `kalman-learned` and its training, on synthetic walks.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/lab/train.hpp"

namespace kinemend::test {
namespace {

Take slow_walk(std::uint64_t seed, double rate_hz = 30) {
  SynthOptions options{.motion = "walk", .duration_s = 4, .frame_rate_hz = rate_hz};
  options.seed = seed;
  return synthesize(options);
}

std::shared_ptr<const Model> learned(const OptionValues& options = {}) {
  static const std::vector<Take> clips = {slow_walk(1, 120), slow_walk(2, 120), slow_walk(3, 120)};
  return std::make_shared<const Model>(train_model(
      "kalman-learned", {clips.size(), [](std::size_t i) { return Take(clips[i]); }}, options));
}

Take noisy(Take clip, double std_deg) {
  Random random(7);
  apply_damage(clip, "gaussian", {{"std_deg", std_deg}}, random);
  return clip;
}

Take cleaned(const Cleaner& cleaner, Take clip) {
  clean_in_place(cleaner, clip);
  return clip;
}

TEST(KalmanLearned, BringsANoisyWalkNearerToTheTruthThanAutoDoes) {
  const Take truth = slow_walk(4), input = noisy(truth, 3);
  const double before = rms_deg(truth, input);
  const double by_auto = rms_deg(truth, cleaned(*make_auto(), input));
  const double smoothed = rms_deg(truth, cleaned(*make_kalman_learned({}, learned()), input));
  KalmanLearnedOptions past;
  past.smoother = false;
  const double filtered = rms_deg(truth, cleaned(*make_kalman_learned(past, learned()), input));
  EXPECT_LT(filtered, 0.5 * before);
  EXPECT_LT(smoothed, filtered);
  EXPECT_LT(smoothed, by_auto);
}

TEST(KalmanLearned, KeepsTheRateOfTheTake) {
  for (const double rate_hz : {120.0, 60.0, 25.0}) {
    for (const std::int64_t order : {1, 2}) {
      const Take truth = slow_walk(4, rate_hz), input = noisy(truth, 3);
      const Take result = cleaned(*make_kalman_learned({}, learned({{"order", order}})), input);
      EXPECT_EQ(result.frame_count(), truth.frame_count());
      EXPECT_LT(rms_deg(truth, result), 0.5 * rms_deg(truth, input)) << rate_hz << " " << order;
    }
  }
}

TEST(KalmanLearned, WorksInASubspace) {
  const Take truth = slow_walk(4), input = noisy(truth, 3);
  const auto cleaner = make_kalman_learned({}, learned({{"directions", std::int64_t{15}}}));
  EXPECT_LT(rms_deg(truth, cleaned(*cleaner, input)), 0.5 * rms_deg(truth, input));
}

TEST(KalmanLearned, LeavesACleanWalkAlone) {
  const Take truth = slow_walk(4);
  EXPECT_LT(rms_deg(truth, cleaned(*make_kalman_learned({}, learned()), truth)), 0.2);
}

TEST(KalmanLearned, FillsAnArmThatIsMissingThroughout) {
  const Take truth = slow_walk(4);
  Take input = truth;
  input.observed.assign(truth.rotations.size(), 1);
  const auto arm = static_cast<std::size_t>(truth.skeleton.find("LeftArm"));
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    input.observed[f * truth.joint_count() + arm] = 0;
    input.rotation(f, arm) = {};
  }
  const Take result = cleaned(*make_kalman_learned({}, learned()), input);
  EXPECT_LT(geodesic_rms_deg_per_joint(truth, result)[arm], 8);
}

TEST(KalmanLearned, NeedsAModelOfItsOwn) {
  EXPECT_THROW(make_kalman_learned(), Error);
  Model other = *learned();
  other.tensors.erase("transition");
  EXPECT_THROW(make_kalman_learned({}, std::make_shared<const Model>(other)), Error);
  KalmanLearnedOptions options;
  options.noise_deg = -1;
  EXPECT_THROW(make_kalman_learned(options, learned()), Error);
}

TEST(TrainingKalmanLearned, RefusesOptionsThatMakeNoSense) {
  EXPECT_THROW(learned({{"order", std::int64_t{3}}}), Error);
  EXPECT_THROW(learned({{"rate_hz", 0.0}}), Error);
}

}  // namespace
}  // namespace kinemend::test
