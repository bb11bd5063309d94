// Tests that standing feet improve the whole leg after cleaning.
#include <gtest/gtest.h>

#include <cmath>

#include "feet/support.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::quality {
namespace {

// Figures of a noisy walk cleaned by `auto`, against the ground truth.
struct Outcome {
  double slide = 0, legs_deg = 0, position = 0;

  Outcome(const Take& truth, const Take& clip, const std::vector<FootContact>& contacts) {
    slide = feet_figures(clip, contacts).slide;
    position = mpjpe(truth, clip);
    const std::vector<double> joints = geodesic_rms_deg_per_joint(truth, clip);
    for (const Leg& leg : find_legs(truth.skeleton)) {
      for (const std::int32_t joint : {leg.hip, leg.knee, leg.ankle})
        legs_deg += std::pow(joints[static_cast<std::size_t>(joint)], 2);
    }
    legs_deg = std::sqrt(legs_deg);
  }
};

// A standing foot is a measurement that brings the whole leg nearer to the truth.
TEST(FeetOfNoisyTakes, SlideLessAndLegsAreNoWorse) {
  for (const char* motion : {"walk", "stroll"}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Take truth = test::synthetic_clip(motion, 6, 120, seed);
      const std::vector<FootContact> contacts = find_contacts(truth);
      const Take noisy = test::with_noise(truth, 1, seed + 10);
      CleanSettings settings;
      const auto cleaner = make_auto();
      const Outcome off(truth, clean_take(noisy, *cleaner, settings).take, contacts);
      settings.feet.emplace();
      const Outcome on(truth, clean_take(noisy, *cleaner, settings).take, contacts);
      EXPECT_LT(on.slide, 0.5 * off.slide) << motion << seed;
      EXPECT_LE(on.legs_deg, off.legs_deg) << motion << seed;
      EXPECT_LE(on.position, off.position) << motion << seed;
    }
  }
}

}  // namespace
}  // namespace kinemend::quality
