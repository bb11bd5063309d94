// Tests of takes whose samples are held or interpolated from a lower rate.
#include "quality/lower_rate.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "quality/quality.hpp"

namespace kinemend::quality {
namespace {

struct Joined {
  const char* motion;
  std::size_t step;
  bool is_held;
};

class AutoOnALowerRate : public testing::TestWithParam<Joined> {};

TEST_P(AutoOnALowerRate, BeatsGaussiansOfAnyWidth) {
  const auto [motion, step, is_held] = GetParam();
  const Take whole = synthesize({.motion = motion, .duration_s = 5});
  const Take noisy = of_lower_rate(damaged(whole, 1.5, 0, 7), step, is_held);
  const Take truth = slice(whole, 0, noisy.frame_count());
  const double ours = figures(truth, cleaned(noisy, "auto")).rms;
  for (const double width_s : {0.01, 0.02, 0.03, 0.045, 0.065, 0.09}) {
    EXPECT_LT(ours, figures(truth, cleaned(noisy, "gaussian", {{"width_s", width_s}})).rms)
        << width_s << " s";
  }
}

TEST_P(AutoOnALowerRate, LeavesACleanTakeAlone) {
  const auto [motion, step, is_held] = GetParam();
  const Take truth = of_lower_rate(synthesize({.motion = motion, .duration_s = 5}), step, is_held);
  EXPECT_EQ(cleaned(truth, "auto").rotations, truth.rotations);
}

TEST_P(AutoOnALowerRate, RepairsSpikesThatWereJoinedLikeTheRest) {
  const auto [motion, step, is_held] = GetParam();
  const Take whole = synthesize({.motion = motion, .duration_s = 5});
  const Take spiked = of_lower_rate(damaged(whole, 1, 0.004, 7), step, is_held);
  const Take truth = slice(whole, 0, spiked.frame_count());
  EXPECT_LT(figures(truth, cleaned(spiked, "auto")).rms, 0.5 * figures(truth, spiked).rms);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AutoOnALowerRate,
                         testing::Values(Joined{"walk", 2, true}, Joined{"walk", 4, false},
                                         Joined{"run", 2, true}, Joined{"punch", 4, false}),
                         [](const auto& kind) {
                           return std::string(kind.param.motion) +
                                  (kind.param.is_held ? "Held" : "Interpolated");
                         });

// Each frame of `whole` shows the last sample of a take of a lower rate.
Take shown_in(Take whole, const Take& low) {
  for (std::size_t f = 0; f < whole.frame_count(); ++f) {
    const double time_s = static_cast<double>(f) / whole.frame_rate_hz;
    const auto sample = std::min(static_cast<std::size_t>(time_s * low.frame_rate_hz + 1e-6),
                                 low.frame_count() - 1);
    for (std::size_t j = 0; j < whole.joint_count(); ++j)
      whole.rotation(f, j) = low.rotation(sample, j);
    whole.root_position(f) = low.root_position(sample);
  }
  return whole;
}

TEST(AutoOnABrokenRate, BeatsGaussiansOfAnyWidthAndSaysSo) {
  struct Rates {
    double low_hz, shown_hz;
  };
  for (const Rates rates : {Rates{50, 120}, Rates{25, 60}, Rates{100, 120}}) {
    for (const char* motion : {"walk", "stroll"}) {
      const Take truth =
          synthesize({.motion = motion, .duration_s = 5, .frame_rate_hz = rates.shown_hz});
      const Take low =
          damaged(synthesize({.motion = motion, .duration_s = 5, .frame_rate_hz = rates.low_hz}),
                  1.5, 0, 7);
      const Take noisy = shown_in(truth, low);
      const CleanResult result = clean_take(noisy, *make_cleaner("auto"));
      ASSERT_FALSE(result.report.noise.empty()) << motion;
      EXPECT_NEAR(result.report.noise[0].frames_per_sample, rates.shown_hz / rates.low_hz, 0.02);
      const double ours = figures(truth, result.take).rms;
      for (const double width_s : {0.01, 0.02, 0.03, 0.045, 0.065, 0.09}) {
        EXPECT_LT(ours, figures(truth, cleaned(noisy, "gaussian", {{"width_s", width_s}})).rms)
            << motion << " " << rates.low_hz << " Hz, " << width_s << " s";
      }
    }
  }
}

}  // namespace
}  // namespace kinemend::quality
