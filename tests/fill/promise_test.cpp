// What the report promises of a filling, against what it becomes.
#include <gtest/gtest.h>

#include <numeric>

#include "fill/made_gaps.hpp"
#include "fill/marker_takes.hpp"
#include "kinemend/synth.hpp"

namespace kinemend::fill {
namespace {

template <class AnyClip>
void add(std::vector<Kept>& all, const AnyClip& truth, std::size_t tracks, std::uint64_t seed) {
  std::vector<std::size_t> every(tracks);
  std::iota(every.begin(), every.end(), std::size_t{0});
  for (const Kept& kept : make_and_fill(truth, every, 8, seed)) all.push_back(kept);
}

void expect_kept(const Figures& figures) {
  EXPECT_GE(figures.gaps, 60U);
  EXPECT_GE(figures.share_within_twice(), 0.9);
  EXPECT_EQ(figures.above_ten, 0U);
  EXPECT_GE(figures.short_gaps, 25U);
  EXPECT_EQ(figures.worse_than_spline, 0U);
}

TEST(Promise, HoldsForMarkers) {
  std::vector<Kept> all;
  for (const char* motion : {"walk", "stroll", "punch", "turn"}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      MarkerClip truth = marker_take(motion, 4, 0.5);
      Random random(seed);
      for (Vec3& p : truth.positions) {
        const double x = random.normal(), y = random.normal(), z = random.normal();
        p += 0.02 * Vec3{x, y, z};
      }
      add(all, truth, truth.marker_count(), seed);
    }
  }
  expect_kept(figures_of(all, 0.05));  // half a millimetre
}

TEST(Promise, HoldsForJoints) {
  std::vector<Kept> all;
  for (const char* motion : {"walk", "stroll", "punch", "turn"}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      Clip truth = synthesize({.motion = motion, .duration_s = 4});
      Random random(seed);
      for (Quat& q : truth.local_rotations) {
        const double x = random.normal(), y = random.normal(), z = random.normal();
        q = q * exp(0.05 * radians_per_degree * Vec3{x, y, z});
      }
      add(all, truth, 22, seed);
    }
  }
  expect_kept(figures_of(all, 0.1));
}

// The sample next to a gap has no neighbour on its other side that would show it for a spike.
TEST(SpikeBesideAGap, DoesNotBendTheFillingOfAMarker) {
  const MarkerClip truth = marker_take("walk", 4, 0.5);
  for (const char* method : {"auto", "spline", "local-regression", "pca"}) {
    for (const std::size_t length : {3U, 8U, 12U, 40U}) {
      for (const bool before : {true, false}) {
        MarkerClip clip = truth;
        hide(clip, "LeftLeg_b", 200, 199 + length);
        MarkerClip spiked = clip;
        const auto marker = static_cast<std::size_t>(clip.find("LeftLeg_b"));
        spiked.position(before ? 199 : 200 + length, marker) += Vec3{15, 5, 0};
        FillSettings settings;
        settings.method = method;
        settings.fill_all = true;
        fill_gaps(clip, settings);
        const GapOutcome outcome = fill_gaps(spiked, settings).gaps[0];
        const double error = rms_error(truth, spiked, outcome.gap);
        EXPECT_LT(error, 3 * rms_error(truth, clip, outcome.gap) + 1)
            << method << ", " << length << " frames, " << (before ? "before" : "behind");
      }
    }
  }
}

TEST(SpikeBesideAGap, DoesNotBendTheFillingOfAJoint) {
  const Clip truth = synthesize({.motion = "walk", .duration_s = 4});
  for (const char* method : {"auto", "spline", "pchip", "pca"}) {
    for (const std::size_t length : {3U, 8U, 12U, 25U}) {
      for (const bool before : {true, false}) {
        Clip clip = truth;
        const NamedGap gap{truth.skeleton.names[3], 200, 199 + length};
        mark_gaps(clip, {&gap, 1});
        Clip spiked = clip;
        Quat& spike = spiked.rotation(before ? 199 : 200 + length, 3);
        spike = spike * exp(Vec3{0.8, 0.3, 0});
        FillSettings settings;
        settings.method = method;
        settings.fill_all = true;
        fill_gaps(clip, settings);
        const GapOutcome outcome = fill_gaps(spiked, settings).gaps[0];
        const double error = rms_error(truth, spiked, outcome.gap);
        EXPECT_LT(error, 3 * rms_error(truth, clip, outcome.gap) + 2)
            << method << ", " << length << " frames, " << (before ? "before" : "behind");
      }
    }
  }
}

}  // namespace
}  // namespace kinemend::fill
