// Tests how the network of `learned` sees the joints that its model knows.
#include "methods/learned/motion_channels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinemend/lab/synth.hpp"
#include "kinemend/take.hpp"
#include "methods/learned/turned_rig.hpp"

namespace kinemend::test {
namespace {

BodyLayout layout_of(const Take& take) {
  BodyLayoutBuilder builder;
  builder.add(take);
  return builder.finish();
}

BodyReading reading_of(const Take& take, const BodyLayout& layout, float deviation_deg) {
  const TakeView view = view_of(take);
  const std::vector<float> deviation(layout.channel_count(), deviation_deg);
  return read_body(layout, deviation, {}, view, motion_tracks_of(view, changeable_tracks(view)));
}

std::optional<KnownBody> body_of(const Take& take, const BodyLayout& layout) {
  return reading_of(take, layout, 20).body;
}

// Makes a joint turn continuously, beyond the range of a rotation vector.
Take with_wheel(Take take, std::size_t joint) {
  for (std::size_t f = 0; f < take.frame_count(); ++f)
    take.rotation(f, joint) = exp(Vec3{0.2 * static_cast<double>(f), 0, 0});
  return take;
}

TEST(KnownBody, IsTheSameOnARigWhoseBonesHaveOtherAxes) {
  const Take walk = synthesize({.motion = "walk", .duration_s = 4, .frame_rate_hz = 60});
  const BodyLayout layout = layout_of(walk);
  const std::optional<KnownBody> own = body_of(walk, layout);
  const std::optional<KnownBody> turned =
      body_of(with_turned_axes(walk, rig_turns(walk, 0.7)), layout);
  ASSERT_TRUE(own && turned);
  const PoseMatrix &expected = own->channels.poses, &found = turned->channels.poses;
  double largest = 0;
  for (std::size_t i = 0; i < expected.values.size(); ++i)
    largest = std::max(largest, std::abs(expected.values[i] - found.values[i]));
  EXPECT_LT(largest, 1e-5) << "degrees";
}

TEST(KnownBody, IsNoneWhereItMovesWiderThanAllThatTheNetworkHasLearnedFrom) {
  const Take walk = synthesize({.motion = "walk", .duration_s = 4, .frame_rate_hz = 60});
  const BodyLayout layout = layout_of(walk);
  const BodyReading fits = reading_of(walk, layout, 5), strange = reading_of(walk, layout, 0.5F);
  EXPECT_TRUE(fits.body.has_value());
  EXPECT_LT(fits.spread, most_spread);
  EXPECT_FALSE(strange.body.has_value());
  EXPECT_NEAR(strange.spread, 10 * fits.spread, 1e-9);
}

TEST(KnownBody, LeavesOutTheOneJointThatTurnsRoundAndRound) {
  const Take walk = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 60});
  const BodyLayout layout = layout_of(walk);
  const auto hand = static_cast<std::size_t>(walk.skeleton.find("LeftForeArm"));
  const std::optional<KnownBody> body = body_of(with_wheel(walk, hand), layout);
  ASSERT_TRUE(body.has_value());
  for (std::size_t part = 0; part < layout.track_count(); ++part)
    EXPECT_EQ(body->track_of[part] < 0, body->match.tracks[part] == static_cast<std::int32_t>(hand))
        << layout.names[part];
}

TEST(KnownBody, IsNoneWhereManyJointsTurnRoundAndRound) {
  Take walk = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 60});
  const BodyLayout layout = layout_of(walk);
  for (std::size_t j = 1; j < walk.joint_count(); ++j) walk = with_wheel(std::move(walk), j);
  EXPECT_FALSE(body_of(walk, layout).has_value());
}

TEST(KnownBody, SeesABridgeOverAGapAndNotTheSampleBeforeIt) {
  constexpr std::size_t length = 24;
  const Take truth = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 120});
  const auto knee = static_cast<std::size_t>(truth.skeleton.find("LeftLeg"));
  // The gap lies where its ends are farthest apart.
  std::size_t first = 20;
  const auto way = [&](std::size_t f) {
    return angle_between(truth.rotation(f - 1, knee), truth.rotation(f + length, knee));
  };
  for (std::size_t f = 20; f < 200; ++f)
    if (way(f) > way(first)) first = f;
  const std::size_t last = first + length - 1;
  const BodyLayout layout = layout_of(truth);
  Take clip = truth;
  const NamedGap gap{"LeftLeg", first, last};
  mark_gaps(clip, {&gap, 1});
  const TakeView view = view_of(clip);
  const MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
  const std::vector<float> deviation(layout.channel_count(), 20);
  const std::optional<KnownBody> body = read_body(layout, deviation, {}, view, tracks).body;
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
