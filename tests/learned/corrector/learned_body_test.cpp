// What the network of `learned` sees of joints that its model knows.
#include "learned/corrector/learned_body.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "kinemend/experimental/synth.hpp"
#include "kinemend/gaps.hpp"

namespace kinemend::test {
namespace {

TEST(KnownBody, SeesABridgeOverAGapAndNotTheSampleBeforeIt) {
  constexpr std::size_t length = 24;
  const Take truth = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 120});
  const auto knee = static_cast<std::size_t>(truth.skeleton.find("LeftLeg"));
  // Where the ends of the gap are farthest apart.
  std::size_t first = 20;
  const auto way = [&](std::size_t f) {
    return angle_between(truth.rotation(f - 1, knee), truth.rotation(f + length, knee));
  };
  for (std::size_t f = 20; f < 200; ++f)
    if (way(f) > way(first)) first = f;
  const std::size_t last = first + length - 1;
  BodyLayoutBuilder builder;
  builder.add(truth);
  const BodyLayout layout = builder.finish();
  Take clip = truth;
  const NamedGap gap{"LeftLeg", first, last};
  mark_gaps(clip, {&gap, 1});
  const TakeView view = view_of(clip);
  const MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
  const auto body = read_body(layout, network, {}, view, tracks).body;
  ASSERT_TRUE(body.has_value());
  std::size_t part = 0;
  while (body->match.tracks[part] != static_cast<std::int32_t>(knee)) ++part;
  const auto value = [&](std::size_t frame) {
    const PoseMatrix& poses = body->channels.poses;
    return Vec3{poses(frame, 3 * part), poses(frame, 3 * part + 1), poses(frame, 3 * part + 2)};
  };
  const Vec3 before = value(first - 1), behind = value(last + 1);
  ASSERT_GT(norm(behind - before), 10);
  EXPECT_LT(norm(value((first + last) / 2) - 0.5 * (before + behind)), 3);
  EXPECT_LT(norm(value(last) - behind), 4);
}

}  // namespace
}  // namespace kinemend::test
