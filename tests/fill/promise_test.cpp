// Compares the errors that the report expects with the real errors of fillings.
#include <gtest/gtest.h>

#include <numeric>

#include "fill/made_gaps.hpp"
#include "fill/marker_takes.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend::fill {
namespace {

void add(std::vector<Kept>& all, const Take& truth, std::size_t tracks, std::uint64_t seed) {
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
      Take truth = marker_take(motion, 4, 0.5);
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
      Take truth = synthesize({.motion = motion, .duration_s = 4});
      Random random(seed);
      for (Quat& q : truth.rotations) {
        const double x = random.normal(), y = random.normal(), z = random.normal();
        q = q * exp(0.05 * radians_per_degree * Vec3{x, y, z});
      }
      add(all, truth, 22, seed);
    }
  }
  expect_kept(figures_of(all, 0.1));
}

}  // namespace
}  // namespace kinemend::fill
