// Tests of feet held frame by frame: they stand still, no other joint moves, and no frame jumps.
#include "feet/live_feet.hpp"

#include <gmock/gmock.h>

#include "kinemend/lab/synth.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend::test {
namespace {

Take with_live_feet(Take take) {
  feet::LiveFeet feet(take);
  const auto joints = static_cast<std::ptrdiff_t>(take.joint_count());
  const auto points = static_cast<std::ptrdiff_t>(take.point_count());
  for (std::ptrdiff_t f = 0; f < static_cast<std::ptrdiff_t>(take.frame_count()); ++f) {
    const auto first = take.rotations.begin() + f * joints;
    const auto place = take.positions.begin() + f * points;
    std::vector<Quat> rotations(first, first + joints);
    feet.hold(rotations, {place, place + points});
    std::copy(rotations.begin(), rotations.end(), first);
  }
  return take;
}

Take sliding_walk() {
  SynthOptions options;
  options.motion = "walk";
  options.duration_s = 4;
  Take take = synthesize(options);
  const double height = body_height(take.skeleton);
  // The body and its feet move sideways by 3 % of its height per second.
  for (std::size_t f = 0; f < take.frame_count(); ++f)
    take.root_position(f).x += 0.03 * height * static_cast<double>(f) / take.frame_rate_hz;
  return take;
}

TEST(LiveFeet, SlideLess) {
  SynthOptions options;
  options.motion = "walk";
  options.duration_s = 4;
  const std::vector<FootContact> contacts = find_contacts(synthesize(options));
  ASSERT_GT(contacts.size(), 4);
  const Take take = sliding_walk();
  const double before = feet_figures(take, contacts).slide;
  EXPECT_LT(feet_figures(with_live_feet(take), contacts).slide, 0.7 * before);
}

TEST(LiveFeet, ChangeNothingButLegs) {
  const Take take = sliding_walk();
  const Take held = with_live_feet(take);
  std::vector<std::uint8_t> of_legs(take.joint_count(), 0);
  for (const Leg& leg : find_legs(take.skeleton)) {
    for (const std::int32_t joint : {leg.hip, leg.knee, leg.ankle})
      of_legs[static_cast<std::size_t>(joint)] = 1;
  }
  bool any = false;
  for (std::size_t f = 0; f < take.frame_count(); ++f) {
    for (std::size_t j = 0; j < take.joint_count(); ++j) {
      const double change = angle_between(take.rotation(f, j), held.rotation(f, j));
      any = any || change > 0.01;
      if (of_legs[j] == 0) {
        ASSERT_EQ(change, 0) << f << ' ' << j;
      }
    }
  }
  EXPECT_TRUE(any);
  EXPECT_EQ(held.positions, take.positions);
}

TEST(LiveFeet, MakeNoJump) {
  const Take take = sliding_walk();
  const Take held = with_live_feet(take);
  for (std::size_t f = 1; f < take.frame_count(); ++f) {
    for (std::size_t j = 0; j < take.joint_count(); ++j) {
      const double before = angle_between(take.rotation(f - 1, j), take.rotation(f, j));
      ASSERT_LT(angle_between(held.rotation(f - 1, j), held.rotation(f, j)), 2 * before + 0.05)
          << f << ' ' << j;
    }
  }
}

TEST(LiveFeet, LeaveASkeletonWithoutLegsAlone) {
  Take take;
  take.frame_rate_hz = 60;
  const RotationOrder order{{Axis::z, Axis::x, Axis::y}, 3};
  take.skeleton.add_joint("Arm", -1, {}, make_channels(true, order));
  take.rotations.assign(3, Quat{});
  take.positions.assign(3, Vec3{1, 2, 3});
  const Take held = with_live_feet(take);
  EXPECT_EQ(held.rotations, take.rotations);
  EXPECT_EQ(feet::LiveFeet(take).feet(), 0);
}

}  // namespace
}  // namespace kinemend::test
