// The methods `auto` and `learned` on markers of synthetic bodies.
#include <gtest/gtest.h>

#include "kinemend/lab/corrupt.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/metrics.hpp"
#include "quality/marker_quality.hpp"

namespace kinemend::quality {
namespace {

using test::marker_take;
using test::max_distance;
using test::rms_distance;

class AutoOnMarkers : public testing::TestWithParam<const char*> {};

TEST_P(AutoOnMarkers, BeatsEveryOtherMethodAtItsDefaults) {
  const Take truth = marker_take(GetParam(), 5);
  for (const double noise_mm : {2.0, 5.0, 10.0}) {
    const Take noisy = damaged_markers(truth, noise_mm, 3);
    const double ours = rms_distance(cleaned_markers(noisy, "auto"), truth);
    EXPECT_LT(ours, 0.5 * rms_distance(noisy, truth)) << noise_mm;
    for (const std::string& method : other_methods()) {
      EXPECT_LT(ours, rms_distance(cleaned_markers(noisy, method), truth))
          << method << " at " << noise_mm << " mm";
    }
  }
}

TEST_P(AutoOnMarkers, LeavesACleanTakeAlone) {
  const Take truth = marker_take(GetParam(), 5);
  EXPECT_LT(rms_distance(cleaned_markers(truth, "auto"), truth), 0.05);
}

TEST_P(AutoOnMarkers, LeavesOpticalNoiseAndImpactsAlone) {
  const Take truth = marker_take(GetParam(), 5);
  const Take optical = test::damaged(truth, 0.1, 0, 0, 5);
  const Take result = cleaned_markers(optical, "auto");
  EXPECT_LT(rms_distance(result, optical), 0.2);
  EXPECT_LT(max_distance(result, truth), 2);
}

class LearnedOnMarkers : public testing::TestWithParam<const char*> {};

TEST_P(LearnedOnMarkers, TakesNoiseOutAboutAsWellAsAuto) {
  const Take truth = marker_take(GetParam(), 5);
  for (const double noise_mm : {3.0, 15.0}) {
    const Take noisy = test::damaged(truth, noise_mm, 0, 0, 3);
    const double ours = rms_distance(cleaned_markers(noisy, "learned"), truth);
    EXPECT_LT(ours, 1.25 * rms_distance(cleaned_markers(noisy, "auto"), truth)) << noise_mm;
  }
}

TEST_P(LearnedOnMarkers, LeavesACleanTakeAlone) {
  const Take truth = marker_take(GetParam(), 5);
  EXPECT_LT(rms_distance(cleaned_markers(truth, "learned"), truth), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Motions, LearnedOnMarkers, testing::Values("walk", "run", "jump", "wave"),
                         [](const auto& motion) { return std::string(motion.param); });

INSTANTIATE_TEST_SUITE_P(Motions, AutoOnMarkers,
                         testing::Values("walk", "run", "jump", "landing", "wave", "punch"),
                         [](const auto& motion) { return std::string(motion.param); });

TEST(AutoOnMarkers, HoldsWithGapsInEveryMarker) {
  const Take truth = marker_take("walk", 5);
  Take noisy = damaged_markers(truth, 3, 7);
  const double whole = rms_distance(cleaned_markers(noisy, "auto"), truth);
  for (std::size_t m = 0; m < noisy.marker_count(); ++m) {
    test::lose(noisy, m, 20 + 7 * m, 25 + 7 * m);
    test::lose(noisy, m, 300 + 3 * m, 380 + 3 * m);
  }
  EXPECT_LT(rms_distance(cleaned_markers(noisy, "auto"), truth), 1.2 * whole);
}

// Video has a floor of fast noise that a model of slow noise does not cover.
TEST(AutoOnMarkers, LeaveNoTremblingOfVideo) {
  for (const char* motion : {"walk", "wave"}) {
    const Take truth = marker_take(motion, 20, 60);
    Take noisy = truth;
    Random random(1);
    apply_damage(noisy, "system", {{"kind", std::string("video")}}, random);
    const MarkerErrors before = compare_markers(truth, noisy).all,
                       after = compare_markers(truth, cleaned_markers(noisy, "auto")).all;
    EXPECT_LT(*after.above_6_hz, 0.1 * *before.above_6_hz) << motion;
    EXPECT_LT(after.velocity_rms, 0.4 * before.velocity_rms) << motion;
    EXPECT_LT(after.rms_distance, before.rms_distance) << motion;
  }
}

TEST(AutoOnMarkers, FindsTheSpikesAndReportsThem) {
  const Take truth = marker_take("walk", 5);
  const CleanResult result =
      clean_take(test::damaged(truth, 2, 0.005, 100, 9), *make_cleaner("auto"));
  std::size_t spikes = 0;
  for (const ReportSpan& span : result.report.spans)
    spikes += span.action == Action::despiked ? span.last_frame - span.first_frame + 1 : 0;
  const double damaged = 0.005 * static_cast<double>(truth.positions.size());
  EXPECT_GT(static_cast<double>(spikes), 0.75 * damaged);
  EXPECT_LT(static_cast<double>(spikes), 1.15 * damaged);
  for (const TrackSummary& marker : result.report.tracks) EXPECT_NEAR(marker.noise, 2, 0.5);
}

}  // namespace
}  // namespace kinemend::quality
