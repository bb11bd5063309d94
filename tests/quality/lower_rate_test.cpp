// Takes of a lower rate than their own: samples that were held or interpolated.
#include "quality/lower_rate.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinemend/experimental/synth.hpp"
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
  const Clip whole = synthesize({.motion = motion, .duration_s = 5});
  const Clip noisy = of_lower_rate(damaged(whole, 1.5, 0, 7), step, is_held);
  const Clip truth = slice(whole, 0, noisy.frame_count());
  const double ours = figures(truth, cleaned(noisy, "auto")).rms;
  for (const double width_s : {0.01, 0.02, 0.03, 0.045, 0.065, 0.09}) {
    EXPECT_LT(ours, figures(truth, cleaned(noisy, "gaussian", {{"width_s", width_s}})).rms)
        << width_s << " s";
  }
}

TEST_P(AutoOnALowerRate, LeavesACleanTakeAlone) {
  const auto [motion, step, is_held] = GetParam();
  const Clip truth = of_lower_rate(synthesize({.motion = motion, .duration_s = 5}), step, is_held);
  EXPECT_EQ(cleaned(truth, "auto").local_rotations, truth.local_rotations);
}

TEST_P(AutoOnALowerRate, RepairsSpikesThatWereJoinedLikeTheRest) {
  const auto [motion, step, is_held] = GetParam();
  const Clip whole = synthesize({.motion = motion, .duration_s = 5});
  const Clip spiked = of_lower_rate(damaged(whole, 1, 0.004, 7), step, is_held);
  const Clip truth = slice(whole, 0, spiked.frame_count());
  EXPECT_LT(figures(truth, cleaned(spiked, "auto")).rms, 0.5 * figures(truth, spiked).rms);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AutoOnALowerRate,
                         testing::Values(Joined{"walk", 2, true}, Joined{"walk", 4, false},
                                         Joined{"run", 2, true}, Joined{"punch", 4, false}),
                         [](const auto& kind) {
                           return std::string(kind.param.motion) +
                                  (kind.param.is_held ? "Held" : "Interpolated");
                         });

}  // namespace
}  // namespace kinemend::quality
