#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <cstring>
#include <numeric>
#include <string>

#include "fill/marker_takes.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/gaps.hpp"

// What holds for every method of filling gaps of markers.
namespace kinemend::fill {
namespace {

// Markers that sway, so that no guess is right by itself.
MarkerClip swaying_take() { return marker_take("walk", 5, 0.8); }

// Two gaps of half a second and less in the same shank, one elsewhere at the same time.
MarkerClip damaged_take() {
  MarkerClip clip = swaying_take();
  hide(clip, "LeftLeg_b", 200, 223);
  hide(clip, "LeftLeg_b", 400, 459);
  hide(clip, "LeftLeg_c", 430, 470);
  hide(clip, "Head_a", 210, 240);
  return clip;
}

FillReport fill_with(MarkerClip& clip, const std::string& method) {
  FillSettings settings;
  settings.method = method;
  settings.fill_all = true;
  if (method == "pattern") settings.donor = "LeftLeg_a";
  return fill_gaps(clip, settings);
}

class MarkerLaws : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Methods, MarkerLaws,
                         ::testing::Values("auto", "spline", "quintic", "pchip", "hermite",
                                           "pattern", "rigid-body", "pca", "local-regression",
                                           "cyclic"),
                         [](const auto& method) {
                           std::string name = method.param;
                           std::erase(name, '-');
                           return name;
                         });

Vec3 second_difference(const MarkerClip& clip, std::size_t frame, std::size_t marker) {
  return clip.position(frame - 1, marker) - 2 * clip.position(frame, marker) +
         clip.position(frame + 1, marker);
}

TEST_P(MarkerLaws, FilledSpanMeetsItsEndsInValueAndVelocity) {
  const MarkerClip truth = swaying_take();
  MarkerClip clip = damaged_take();
  const FillReport report = fill_with(clip, GetParam());
  for (const GapOutcome& outcome : report.gaps) {
    ASSERT_TRUE(outcome.filled) << outcome.reason;
    const auto& [marker, first, last] = outcome.gap;
    // A jump of value or velocity is a second difference that the motion itself never shows.
    double largest = 0;
    for (std::size_t f = 1; f + 1 < truth.frame_count(); ++f) {
      largest = std::max(largest, norm(second_difference(truth, f, marker)));
    }
    for (const std::size_t f : {first - 1, first, last, last + 1}) {
      EXPECT_LT(norm(second_difference(clip, f, marker)), 4 * largest + 0.05)
          << "marker " << marker << ", gap " << first << " to " << last << ", frame " << f;
    }
  }
}

TEST_P(MarkerLaws, ObservedSamplesStayToTheBit) {
  const MarkerClip before = damaged_take();
  MarkerClip clip = before;
  const FillReport report = fill_with(clip, GetParam());
  EXPECT_EQ(report.filled(), report.gaps.size());
  for (std::size_t i = 0; i < before.positions.size(); ++i) {
    if (before.observed[i]) {
      ASSERT_EQ(std::memcmp(&clip.positions[i], &before.positions[i], sizeof(Vec3)), 0);
      ASSERT_EQ(clip.residuals[i], before.residuals[i]);
    } else {
      ASSERT_EQ(clip.observed[i], 1);
      ASSERT_EQ(clip.residuals[i], 0);
    }
  }
}

TEST_P(MarkerLaws, ResultMovesTurnsAndGrowsWithTheTake) {
  const Quat turn = exp(Vec3{0.4, -1.1, 0.7});
  const auto moved = [&](Vec3 p) { return 10.0 * rotate(turn, p) + Vec3{3000, -500, 70}; };
  MarkerClip clip = damaged_take();
  MarkerClip other = clip;
  for (std::size_t i = 0; i < other.positions.size(); ++i) {
    if (other.observed[i]) other.positions[i] = moved(other.positions[i]);
  }
  const FillReport report = fill_with(clip, GetParam());
  const FillReport other_report = fill_with(other, GetParam());
  double largest = 0;
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    largest = std::max(largest, norm(other.positions[i] - moved(clip.positions[i])));
  }
  // PCHIP keeps the shape of each channel by itself; end velocities are made robust likewise.
  const std::string method = GetParam();
  const bool robust = method == "hermite" || method == "pattern" || method == "cyclic";
  EXPECT_LT(largest, method == "pchip" ? 20.0 : robust ? 0.2 : 1e-4);
  for (std::size_t g = 0; g < report.gaps.size(); ++g) {
    EXPECT_NEAR(other_report.gaps[g].expected_error, 10 * report.gaps[g].expected_error, 1e-4);
  }
}

TEST_P(MarkerLaws, OrderOfMarkersDoesNotMatter) {
  MarkerClip clip = damaged_take();
  const std::size_t markers = clip.marker_count();
  std::vector<std::size_t> order(markers);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::rotate(order.begin(), order.begin() + 17, order.end());
  std::swap(order[3], order[30]);
  MarkerClip other = clip;
  for (std::size_t m = 0; m < markers; ++m) {
    other.names[m] = clip.names[order[m]];
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      other.position(f, m) = clip.position(f, order[m]);
      other.observed[f * markers + m] = clip.observed[f * markers + order[m]];
    }
  }
  fill_with(clip, GetParam());
  fill_with(other, GetParam());
  double largest = 0;
  for (std::size_t m = 0; m < markers; ++m) {
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      largest = std::max(largest, norm(other.position(f, m) - clip.position(f, order[m])));
    }
  }
  EXPECT_LT(largest, 1e-5);
}

TEST_P(MarkerLaws, ResultDoesNotDependOnTheNumberOfThreads) {
  MarkerClip clip = damaged_take();
  MarkerClip other = clip;
  fill_with(clip, GetParam());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  fill_with(other, GetParam());
  EXPECT_EQ(clip.positions, other.positions);
}

}  // namespace
}  // namespace kinemend::fill
