// Tests of joint gaps that `fill_gaps` fills with the network of `learned`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "methods/learned/motion_support.hpp"

namespace kinemend::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

Take walk_with_gap(double duration_s, double rate_hz, std::size_t first, std::size_t last) {
  Take clip = synthesize({.motion = "walk", .duration_s = duration_s, .frame_rate_hz = rate_hz});
  const NamedGap gap{"LeftLeg", first, last};
  mark_gaps(clip, {&gap, 1});
  return clip;
}

FillReport filled(Take& clip, const LearnedFill& model) {
  FillSettings settings;
  settings.method = "learned";
  settings.models.learned = model;
  return fill_gaps(clip, settings);
}

// A network that returns its input.
LearnedFill content() {
  return make_learned_fill({}, std::make_shared<const Model>(one_smoother_model(0)));
}

double largest_distance_deg(const Take& a, const Take& b, std::size_t first, std::size_t last) {
  const auto knee = static_cast<std::size_t>(a.skeleton.find("LeftLeg"));
  double largest = 0;
  for (std::size_t f = first; f <= last; ++f)
    largest = std::max(largest, angle_between(a.rotation(f, knee), b.rotation(f, knee)));
  return degrees_per_radian * largest;
}

TEST(LearnedFill, LeavesTheBridgeWhereTheNetworkIsContent) {
  Take clip = walk_with_gap(2, 120, 60, 99), straight = clip;
  const Take damaged = clip;
  const FillReport report = filled(clip, content());
  ASSERT_EQ(report.filled(), 1u);
  EXPECT_EQ(report.gaps[0].method, "learned");
  FillSettings slerp;
  slerp.method = "slerp";
  slerp.longest_gap_s = 1;
  fill_gaps(straight, slerp);
  EXPECT_LT(largest_distance_deg(clip, straight, 60, 99), 0.01);
  for (std::size_t i = 0; i < damaged.observed.size(); ++i) {
    if (damaged.observed[i] != 0) {
      EXPECT_EQ(clip.rotations[i], damaged.rotations[i]) << i;
    }
  }
}

TEST(LearnedFill, ChangesTheBridgeWhereTheNetworkSmooths) {
  Take clip = walk_with_gap(2, 120, 60, 99), straight = clip;
  filled(clip, make_learned_fill({}, std::make_shared<const Model>(one_smoother_model(8))));
  filled(straight, content());
  EXPECT_GT(largest_distance_deg(clip, straight, 60, 99), 0.1);
  EXPECT_LT(largest_distance_deg(clip, straight, 60, 60), 1);
}

TEST(LearnedFill, LeavesShortAndSlowTakesToAutoAndSaysSo) {
  const auto expect_auto = [](Take clip, const char* reason) {
    Take automatic = clip;
    EXPECT_THAT(filled(clip, content()).warnings, Contains(HasSubstr(reason)));
    fill_gaps(automatic);
    EXPECT_EQ(clip.rotations, automatic.rotations);
  };
  expect_auto(walk_with_gap(0.4, 120, 20, 24), "the take is shorter than half a second");
  expect_auto(walk_with_gap(4, 15, 20, 22), "the frame rate is below 20 Hz");
}

TEST(LearnedFill, LeavesPositionsToAuto) {
  Take clip = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 120});
  const NamedGap gap{"Hips", 60, 65};
  mark_gaps(clip, {&gap, 1});
  const FillReport report = filled(clip, content());
  EXPECT_THAT(report.warnings, Contains(HasSubstr("(Hips): the model fills no positions")));
  ASSERT_EQ(report.gaps.size(), 2u);
  EXPECT_EQ(report.gaps[0].method, "learned");
  EXPECT_NE(report.gaps[1].method, "learned");
}

}  // namespace
}  // namespace kinemend::test
