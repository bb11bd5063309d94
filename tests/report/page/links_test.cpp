// Tests of the lines that a page draws between markers.
#include "report/page/document.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kinemend/extend/random.hpp"

namespace kinemend::page {
namespace {

using Links = std::vector<std::array<std::size_t, 2>>;

// Two rods of three markers each, 100 apart along a rod. The second swings about the end of the
// first; marker 3 stays 20 from marker 2.
Take two_rods(std::size_t frames = 200) {
  Take clip = make_marker_take({"A1", "A2", "A3", "B1", "B2", "B3"}, frames, 100);
  clip.observed.assign(frames * 6, 1);
  for (std::size_t f = 0; f < frames; ++f) {
    const double angle = 0.8 * std::sin(0.1 * static_cast<double>(f));
    const double x = 3.0 * static_cast<double>(f);
    for (std::size_t m = 0; m < 3; ++m) {
      const double along = 100.0 * static_cast<double>(m);
      clip.position(f, m) = {x + along, 0, 0};
      const double out = 20 + along;
      clip.position(f, 3 + m) = {x + 200 + out * std::cos(angle), out * std::sin(angle), 0};
    }
  }
  return clip;
}

const Links rods = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}};

Links sorted(Links links) {
  std::sort(links.begin(), links.end());
  return links;
}

TEST(MarkerLinks, JoinNeighboursOnABoneAndAcrossAJoint) {
  EXPECT_EQ(sorted(marker_links(two_rods(), 500)), rods);
}

TEST(MarkerLinks, StayTheSameUnderNoiseGapsAndASwap) {
  Take clip = two_rods();
  Random random(5);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t m = 0; m < 6; ++m)
      clip.position(f, m) = clip.position(f, m) + Vec3{random.normal(), random.normal(), 0};
  }
  for (std::size_t f = 20; f < 60; ++f) clip.observed[f * 6 + 1] = 0;
  for (std::size_t f = 100; f < 108; ++f) std::swap(clip.position(f, 0), clip.position(f, 5));
  EXPECT_EQ(sorted(marker_links(clip, 500)), rods);
  EXPECT_EQ(marker_links(clip, 500), marker_links(clip, 500));
}

TEST(MarkerLinks, LeaveOutWhatIsFarDriftsOrHasNoName) {
  Take clip = two_rods();
  clip.names[5] = "*52";
  Links expected = rods;
  expected.pop_back();
  EXPECT_EQ(sorted(marker_links(clip, 500)), expected);
  // The second rod walks away from the first.
  clip = two_rods();
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t m = 3; m < 6; ++m) clip.position(f, m).z += 2.0 * static_cast<double>(f);
  }
  EXPECT_EQ(sorted(marker_links(clip, 500)), (Links{{0, 1}, {1, 2}, {3, 4}, {4, 5}}));
  // For this body height, a line of 100 is too long.
  EXPECT_EQ(sorted(marker_links(two_rods(), 200)), (Links{{2, 3}}));
}

TEST(MarkerLinks, OfMarkersThatAreNeverSeenTogetherAreNone) {
  Take clip = make_marker_take({"A", "B"}, 100, 100);
  clip.observed.assign(200, 1);
  for (std::size_t f = 0; f < 100; ++f) {
    clip.position(f, 1) = {10, 0, 0};
    clip.observed[f * 2 + (f < 50 ? 0 : 1)] = 0;
  }
  EXPECT_TRUE(marker_links(clip, 100).empty());
  EXPECT_TRUE(marker_links(make_marker_take({}, 0, 100), 100).empty());
  EXPECT_TRUE(marker_links(make_marker_take({"A", "B"}, 0, 100), 100).empty());
}

}  // namespace
}  // namespace kinemend::page
