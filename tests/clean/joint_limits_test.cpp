#include "clean/joint_limits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinemend/error.hpp"
#include "kinemend/random.hpp"
#include "kinemend/synth.hpp"

namespace kinemend::test {
namespace {

Quat random_rotation(Random& random) {
  return exp({random.normal(), random.normal(), random.normal()});
}

EulerLimits box(const char* order, std::array<ChannelLimit, 3> angles, Random& random) {
  EulerLimits limits;
  limits.order = parse_rotation_order(order);
  limits.angles = angles;
  limits.before = random_rotation(random);
  limits.after = random_rotation(random);
  return limits;
}

// The channels of a local rotation: before Exp(v) after.
Vec3 channels_of(Quat local, const EulerLimits& limits) {
  return degrees_per_radian *
         log(normalized(conjugate(limits.before) * local * conjugate(limits.after)));
}
Quat local_of(Vec3 channels, const EulerLimits& limits) {
  return limits.before * exp(radians_per_degree * channels) * limits.after;
}

PoseMatrix one_pose(Vec3 v) {
  PoseMatrix poses(1, 3);
  poses(0, 0) = v.x, poses(0, 1) = v.y, poses(0, 2) = v.z;
  return poses;
}
Vec3 vector_of(const PoseMatrix& poses) { return {poses(0, 0), poses(0, 1), poses(0, 2)}; }

Vec3 projected(Vec3 v, const EulerLimits& limits) {
  JointLimits all;
  all.joints = {limits};
  PoseMatrix nearest;
  project_to_limits(all, one_pose(v), nearest);
  return vector_of(nearest);
}

double random_within(Random& random, const ChannelLimit& limit) {
  return radians_per_degree * random.uniform(limit.minimum, limit.maximum);
}

constexpr std::array<ChannelLimit, 3> shoulder = {{{-70, 40}, {-50, 60}, {-20, 90}}};

TEST(JointLimits, LeaveAloneWhatIsWithinThem) {
  Random random(1);
  for (const char* order : {"ZXY", "XYZ", "X", "ZX", "ZYX"}) {
    const EulerLimits limits = box(order, shoulder, random);
    for (int i = 0; i < 200; ++i) {
      const std::array<double, 3> angles = {random_within(random, shoulder[0]),
                                            random_within(random, shoulder[1]),
                                            random_within(random, shoulder[2])};
      const Vec3 v = channels_of(from_euler(angles, limits.order), limits);
      EXPECT_EQ(projected(v, limits), v) << order;
    }
  }
}

TEST(JointLimits, AreKeptByWhatWasBeyondThemOnceAndForAll) {
  Random random(2);
  for (const char* order : {"ZXY", "XYZ", "X", "ZX"}) {
    const EulerLimits limits = box(order, shoulder, random);
    for (int i = 0; i < 200; ++i) {
      const Vec3 v = channels_of(random_rotation(random), limits);
      const Vec3 once = projected(v, limits);
      const auto angles = to_euler(local_of(once, limits), limits.order);
      for (std::size_t a = 0; a < limits.order.count; ++a) {
        EXPECT_GE(angles[a] * degrees_per_radian, shoulder[a].minimum - 1e-6) << order;
        EXPECT_LE(angles[a] * degrees_per_radian, shoulder[a].maximum + 1e-6) << order;
      }
      EXPECT_EQ(projected(once, limits), once) << order;
    }
  }
}

// Against the nearest of a fine grid of what the box holds. Clamped angles are not quite the
// nearest rotation, as the axes of three turns are not at right angles.
TEST(JointLimits, MoveAPoseLittleFurtherThanNeeded) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    std::array<ChannelLimit, 3> angles;
    for (ChannelLimit& limit : angles) {
      limit.minimum = random.uniform(-40, 10);
      limit.maximum = limit.minimum + random.uniform(5, 30);
    }
    const EulerLimits limits = box("ZXY", angles, random);
    std::array<double, 3> thrown{};
    for (std::size_t a = 0; a < 3; ++a)
      thrown[a] = random_within(random, angles[a]) + 0.3 * random.normal();
    const Quat local = from_euler(thrown, limits.order);
    double least = pi;
    constexpr int steps = 24;
    for (int i = 0; i < steps * steps * steps; ++i) {
      std::array<double, 3> at{};
      int index = i;
      for (std::size_t a = 0; a < 3; ++a, index /= steps) {
        at[a] = radians_per_degree * (angles[a].minimum + (angles[a].maximum - angles[a].minimum) *
                                                              (index % steps) / (steps - 1));
      }
      least = std::min(least, angle_between(local, from_euler(at, limits.order)));
    }
    const Quat moved = local_of(projected(channels_of(local, limits), limits), limits);
    EXPECT_LE(angle_between(local, moved), 1.25 * least + 0.005) << trial;
  }
}

TEST(JointLimits, OfAKneeLetItTurnAboutItsAxisOnly) {
  Random random(4);
  const EulerLimits knee = box("X", {{{-10, 170}}}, random);
  const Quat bent = from_euler({200 * radians_per_degree, 0, 0}, knee.order);
  const Quat backwards = from_euler({-25 * radians_per_degree, 0, 0}, knee.order);
  const Quat twisted = from_euler({0.5, 0, 0}, knee.order) * exp({0, 0.1, 0.05});
  const auto angle_of = [&](Quat local) {
    return to_euler(local_of(projected(channels_of(local, knee), knee), knee), knee.order)[0] *
           degrees_per_radian;
  };
  EXPECT_NEAR(angle_of(bent), 170, 1e-6);
  EXPECT_NEAR(angle_of(backwards), -10, 1e-6);
  EXPECT_NEAR(angle_of(twisted), 0.5 * degrees_per_radian, 0.5);
  const Quat straightened = local_of(projected(channels_of(twisted, knee), knee), knee);
  EXPECT_LT(angle_between(straightened, from_euler(to_euler(straightened, knee.order), knee.order)),
            1e-8);
}

TEST(JointLimits, OpenToOneSideHoldOnTheOther) {
  Random random(5);
  const EulerLimits limits = box("X", {{{0, std::numeric_limits<double>::infinity()}}}, random);
  const auto at = [&](double degrees) {
    const Quat local = from_euler({degrees * radians_per_degree, 0, 0}, limits.order);
    const Vec3 v = projected(channels_of(local, limits), limits);
    return to_euler(local_of(v, limits), limits.order)[0] * degrees_per_radian;
  };
  EXPECT_NEAR(at(120), 120, 1e-6);
  EXPECT_NEAR(at(-30), 0, 1e-6);
}

TEST(JointLimits, MoveOutToWhatTheTakeDoesTimeAndAgainOrGo) {
  Random random(6);
  JointLimits limits;
  limits.joints = {box("X", {{{-10, 60}}}, random)};
  limits.joints[0].name = "knee";
  PoseMatrix poses(1000, 3);
  for (std::size_t f = 0; f < poses.frames; ++f) {
    double angle = 40 + 40 * std::sin(0.05 * static_cast<double>(f));
    if (f % 400 == 7) angle = -60;  // noise now and then
    const Quat local = from_euler({angle * radians_per_degree, 0, 0}, limits.joints[0].order);
    const Vec3 v = channels_of(local, limits.joints[0]);
    poses(f, 0) = v.x, poses(f, 1) = v.y, poses(f, 2) = v.z;
  }
  const std::vector<std::string> moved = widen_joint_limits(limits, poses);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0], "knee by 20 degrees");
  EXPECT_NEAR(limits.joints[0].angles[0].maximum, 80, 0.2);
  EXPECT_EQ(limits.joints[0].angles[0].minimum, -10);
  EXPECT_TRUE(widen_joint_limits(limits, poses).empty());

  limits.joints[0].angles[0].maximum = 50;
  EXPECT_EQ(widen_joint_limits(limits, poses), std::vector<std::string>{"knee by 30 degrees"});
  EXPECT_TRUE(limits.empty());
}

TEST(JointLimits, LearnedOnesClampEachChannel) {
  Model model;
  model.layout.names = {"a"};
  model.layout.with_place = false;
  EXPECT_TRUE(learned_joint_limits(model).empty());
  model.tensors["limits"] = {TensorType::f32, {3, 2}, {-1, 1, 0, 5, -3, -2}};
  const JointLimits limits = learned_joint_limits(model);
  PoseMatrix nearest;
  project_to_limits(limits, one_pose({2, 3, -7}), nearest);
  EXPECT_EQ(vector_of(nearest), (Vec3{1, 3, -3}));
  // The take's own range: 99 of 100 frames are at most at 8.
  PoseMatrix poses(200, 3, 2.0);
  for (std::size_t f = 0; f < poses.frames; ++f) poses(f, 1) = f < 2 ? 30.0 : 8.0;
  JointLimits wide = limits;
  EXPECT_TRUE(widen_joint_limits(wide, poses).empty());
  EXPECT_EQ(wide.channels[1].maximum, 8);
  EXPECT_EQ(wide.channels[1].minimum, 0);
  model.tensors["limits"] = {TensorType::f32, {3, 2}, {1, -1, 0, 5, -3, -2}};
  EXPECT_THROW(learned_joint_limits(model), Error);
  model.tensors["limits"] = {TensorType::f32, {2, 3}, {-1, 1, 0, 5, -3, -2}};
  EXPECT_THROW(learned_joint_limits(model), Error);
}

// The file's limits reach the channels of a body: decoded, a projected pose keeps them.
TEST(JointLimits, OfASkeletonHoldInTheTake) {
  Clip clip = synthesize({.motion = "walk", .duration_s = 3, .frame_rate_hz = 30});
  BodyLayoutBuilder builder;
  builder.add(clip);
  const BodyLayout layout = builder.finish();
  const auto knee = static_cast<std::size_t>(clip.skeleton.find("LeftLeg"));
  clip.skeleton.limits.resize(clip.joint_count());
  for (std::size_t j = 0; j < clip.joint_count(); ++j)
    clip.skeleton.limits[j].resize(clip.skeleton.channels[j].size());
  for (ChannelLimit& limit : clip.skeleton.limits[knee]) limit = {-20, 20};
  const BodyMatch match = match_body(layout, clip);
  const JointLimits limits = skeleton_joint_limits(clip.skeleton, layout, match);
  ASSERT_FALSE(limits.empty());
  BodyChannels channels = encode_body(clip, layout, match);
  PoseMatrix nearest;
  project_to_limits(limits, channels.poses, nearest);
  EXPECT_NE(nearest.values, channels.poses.values);
  channels.poses = nearest;
  Clip projected_clip = clip;
  decode_body(channels, layout, match, projected_clip);
  const RotationOrder order = clip.skeleton.rotation_order(knee);
  double most_before = 0, most = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double before = to_euler(clip.rotation(f, knee), order)[a];
      const double after = to_euler(projected_clip.rotation(f, knee), order)[a];
      most_before = std::max(most_before, std::abs(before) * degrees_per_radian);
      most = std::max(most, std::abs(after) * degrees_per_radian);
    }
  }
  EXPECT_GT(most_before, 40);
  EXPECT_LT(most, 20 + 1e-6);
}

}  // namespace
}  // namespace kinemend::test
