// What the network of `learned` sees of joints that its model knows.
#include "learned/corrector/learned_body.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinemend/experimental/synth.hpp"
#include "kinemend/gaps.hpp"

namespace kinemend::test {
namespace {

// A network that has learned poses about those of the layout's reference, `deviation_deg` away.
MotionNetwork network_of(const BodyLayout& layout, float deviation_deg) {
  MotionNetwork network;
  network.slots = layout.channel_count();
  network.mean.assign(network.slots, 0.0F);
  network.deviation.assign(network.slots, deviation_deg);
  return network;
}

BodyLayout layout_of(const Take& take) {
  BodyLayoutBuilder builder;
  builder.add(take);
  return builder.finish();
}

BodyReading reading_of(const Take& take, const BodyLayout& layout, const MotionNetwork& network) {
  const TakeView view = view_of(take);
  return read_body(layout, network, {}, view, motion_tracks_of(view, changeable_tracks(view)));
}

// The same motion on a rig whose joints rest turned by `angle` about their bones' frames.
Take on_turned_rig(Take take, const std::vector<std::size_t>& joints, double angle) {
  for (std::size_t f = 0; f < take.frame_count(); ++f)
    for (const std::size_t joint : joints)
      take.rotation(f, joint) = exp(Vec3{0, 0, angle}) * take.rotation(f, joint);
  return take;
}

TEST(KnownBody, HasPosesOfTheKindThatTheNetworkHasLearned) {
  const Take walk = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 60});
  const BodyLayout layout = layout_of(walk);
  const BodyReading reading = reading_of(walk, layout, network_of(layout, 20));
  ASSERT_TRUE(reading.body.has_value());
  EXPECT_LT(reading.distance, 1);
  EXPECT_TRUE(reading.strange.empty());
}

TEST(KnownBody, IsNoneWhereTheSameNamesHaveTheRestPoseOfAnotherRig) {
  const Take walk = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 60});
  const BodyLayout layout = layout_of(walk);
  std::vector<std::size_t> all;
  for (std::size_t j = 1; j < walk.joint_count(); ++j) all.push_back(j);
  const BodyReading reading =
      reading_of(on_turned_rig(walk, all, 1.2), layout, network_of(layout, 20));
  EXPECT_FALSE(reading.body.has_value());
  EXPECT_GT(reading.distance, most_pose_distance);
}

TEST(KnownBody, LeavesOutTheOneJointWhosePosesDoNotFit) {
  const Take walk = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 60});
  const BodyLayout layout = layout_of(walk);
  const auto hand = static_cast<std::size_t>(walk.skeleton.find("LeftForeArm"));
  const BodyReading reading =
      reading_of(on_turned_rig(walk, {hand}, 2.4), layout, network_of(layout, 18));
  ASSERT_TRUE(reading.body.has_value());
  ASSERT_EQ(reading.strange, std::vector<std::size_t>{hand});
  for (std::size_t part = 0; part < layout.track_count(); ++part)
    EXPECT_EQ(reading.body->track_of[part] < 0,
              reading.body->match.tracks[part] == static_cast<std::int32_t>(hand))
        << layout.names[part];
}

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
  const BodyLayout layout = layout_of(truth);
  const MotionNetwork network = network_of(layout, 1000);
  Take clip = truth;
  const NamedGap gap{"LeftLeg", first, last};
  mark_gaps(clip, {&gap, 1});
  const TakeView view = view_of(clip);
  const MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
  const std::optional<KnownBody> body = read_body(layout, network, {}, view, tracks).body;
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
