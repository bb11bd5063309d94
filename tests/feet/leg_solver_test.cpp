// Tests of the leg solver: targets within and out of reach, and joints of one or two channels.
#include "feet/leg_solver.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "feet/support.hpp"

namespace kinemend::feet {
namespace {

// Hips, thigh, shank and foot with random bones, rest rotations, and poses within their channels.
struct RandomLeg {
  Take clip;
  std::vector<Leg> legs;

  RandomLeg(Random& random, const char* hip, const char* knee, const char* ankle) {
    Skeleton& skeleton = clip.skeleton;
    skeleton.add_joint("Hips", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
    skeleton.add_joint("Thigh", 0, 10.0 * vector(random), channels(hip));
    skeleton.add_joint("Shin", 1, {random.uniform(-4, 4), -random.uniform(35, 50), 0},
                       channels(knee));
    skeleton.add_joint("Foot", 2, {random.uniform(-4, 4), -random.uniform(35, 50), 0},
                       channels(ankle));
    skeleton.end_sites.push_back({3, {0, -4, 15}, ""});
    for (std::size_t j = 1; j < 4; ++j) skeleton.rest_rotations[j] = exp(0.3 * vector(random));
    clip.frame_rate_hz = 60;
    clip.positions = {30.0 * vector(random)};
    clip.rotations.resize(4);
    clip.rotations[0] = exp(vector(random));
    pose(random);
    legs = find_legs(skeleton);
  }

  static Vec3 vector(Random& random) {
    return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  }
  static std::vector<Channel> channels(const char* order) {
    return make_channels(false, parse_rotation_order(order));
  }

  // Bends the knee by 15 to 90 degrees.
  void pose(Random& random) {
    for (std::size_t j = 1; j < 4; ++j) {
      const RotationOrder order = clip.skeleton.rotation_order(j);
      std::array<double, 3> angles{};
      for (std::size_t i = 0; i < order.count; ++i) angles[i] = random.uniform(-0.4, 0.4);
      if (j == 2) {
        angles = {};
        for (std::size_t i = 0; i < order.count; ++i)
          if (order.axes[i] == Axis::x) angles[i] = random.uniform(0.6, 1.6);
      }
      clip.rotations[j] = from_euler(angles, order);
    }
  }

  LegMotion motion() const { return leg_motion(clip, legs); }
};

FootTarget target_at(const LegPose& pose, Vec3 pivot) {
  FootTarget target;
  target.moves = true;
  target.rotation = pose.ankle;
  target.pivot = pivot;
  target.place = pose.ankle_at + rotate(pose.ankle, pivot);
  return target;
}

void put(Take& clip, const LegRotations& turned) {
  clip.rotations[1] = turned.hip;
  clip.rotations[2] = turned.knee;
  clip.rotations[3] = turned.ankle;
}

struct Orders {
  const char *hip, *knee, *ankle;
};
constexpr std::array<Orders, 3> free_ankles{
    {{"ZXY", "ZXY", "ZXY"}, {"XYZ", "X", "XYZ"}, {"ZYX", "ZX", "YXZ"}}};

TEST(LegSolver, PutsTheFootWhereAnotherPoseOfTheLegHasIt) {
  Random random(3);
  for (const Orders& orders : free_ankles) {
    for (int i = 0; i < 200; ++i) {
      RandomLeg leg(random, orders.hip, orders.knee, orders.ankle);
      const LegMotion before = leg.motion();
      RandomLeg other = leg;
      other.pose(random);
      const FootTarget target = target_at(other.motion().pose(0, 0), {1, -4, 9});
      const Vec3 shift = RandomLeg::vector(random);
      FootTarget moved = target;
      moved.place += shift;
      put(leg.clip, solve_leg(before.pose(0, 0), before.models[0], moved, shift, 0.001));
      leg.clip.root_position(0) += shift;
      const Pose after = forward_kinematics(leg.clip, 0);
      EXPECT_LT(norm(after.positions[3] + rotate(after.rotations[3], target.pivot) - moved.place),
                1e-6)
          << orders.knee << " leg " << i;
      EXPECT_LT(angle_between(after.rotations[3], target.rotation), 1e-7);
    }
  }
}

TEST(LegSolver, HoldsAPointOfAFootWhoseAnkleHasTwoChannels) {
  Random random(4);
  int exact = 0;
  constexpr int legs = 200;
  for (int i = 0; i < legs; ++i) {
    RandomLeg leg(random, "XYZ", "X", "XZ");
    const LegMotion before = leg.motion();
    FootTarget target = target_at(before.pose(0, 0), {0, -4, 12});
    target.place += 2.0 * RandomLeg::vector(random);
    put(leg.clip, solve_leg(before.pose(0, 0), before.models[0], target, {}, 0.001));
    const Pose after = forward_kinematics(leg.clip, 0);
    exact +=
        norm(after.positions[3] + rotate(after.rotations[3], target.pivot) - target.place) < 0.02;
  }
  EXPECT_GT(exact, 190);
}

TEST(LegSolver, ChangesNothingWhereNothingMoves) {
  Random random(5);
  for (const Orders& orders : free_ankles) {
    for (int i = 0; i < 50; ++i) {
      RandomLeg leg(random, orders.hip, orders.knee, orders.ankle);
      const LegMotion before = leg.motion();
      const LegRotations turned = solve_leg(before.pose(0, 0), before.models[0],
                                            target_at(before.pose(0, 0), {0, -4, 12}), {}, 0.02);
      EXPECT_LT(angle_between(turned.hip, leg.clip.rotations[1]), 1e-6);
      EXPECT_LT(angle_between(turned.knee, leg.clip.rotations[2]), 1e-6);
      EXPECT_LT(angle_between(turned.ankle, leg.clip.rotations[3]), 1e-6);
    }
  }
}

TEST(LegSolver, StretchesTowardsWhatIsOutOfReachAndNeverStraightensTheKnee) {
  Random random(6);
  for (const Orders& orders : free_ankles) {
    for (int i = 0; i < 100; ++i) {
      RandomLeg leg(random, orders.hip, orders.knee, orders.ankle);
      const LegMotion before = leg.motion();
      const LegPose& pose = before.pose(0, 0);
      const Reach reach = reach_of(pose, before.models[0], 0.02, 0);
      FootTarget target = target_at(pose, {});
      target.place = pose.hip_at + 1.2 * reach.most / reach.now * (pose.ankle_at - pose.hip_at);
      put(leg.clip, solve_leg(pose, before.models[0], target, {}, 0.02));
      const Pose after = forward_kinematics(leg.clip, 0);
      const double found = norm(after.positions[3] - after.positions[1]);
      EXPECT_LT(found, reach.most);
      EXPECT_GT(found, reach.easy);
      const Vec3 way = target.place - pose.hip_at;
      EXPECT_LT(norm(cross(after.positions[3] - after.positions[1], way)) / norm(way), 1e-6);
    }
  }
}

TEST(LegSolver, KeepsAKneeOfOneChannelOnItsAxis) {
  Random random(7);
  RandomLeg leg(random, "XYZ", "X", "XZ");
  const LegMotion before = leg.motion();
  FootTarget target = target_at(before.pose(0, 0), {});
  target.place += Vec3{2, 3, 1};
  const LegRotations turned = solve_leg(before.pose(0, 0), before.models[0], target, {}, 0.02);
  EXPECT_NEAR(turned.knee.y, 0, 1e-12);
  EXPECT_NEAR(turned.knee.z, 0, 1e-12);
  EXPECT_GT(angle_between(turned.knee, leg.clip.rotations[2]), 1e-3);
}

TEST(LegSolver, SoftDistanceIsSmoothAndNeverPassesTheLongest) {
  const Reach reach{0.5, 0.98, 1.0};
  double before = soft_distance(0.9, reach), slope = 1;
  constexpr double step = 1e-3;
  for (double d = 0.9 + step; d < 1.5; d += step) {
    const double now = soft_distance(d, reach);
    EXPECT_GE(now, before);
    EXPECT_LT(now, reach.most + 1e-15);
    EXPECT_LT(std::fabs((now - before) / step - slope), 0.06) << "at " << d;
    slope = (now - before) / step;
    before = now;
  }
  EXPECT_EQ(soft_distance(0.97, reach), 0.97);
}

TEST(TurnBetween, IsTheLeastTurnThatAlignsTwoDirections) {
  Random random(8);
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = RandomLeg::vector(random), b = RandomLeg::vector(random);
    const Vec3 turned = rotate(exp(turn_between(a, b)), a);
    EXPECT_LT(norm(cross(turned, b)), 1e-12);
    EXPECT_GT(dot(turned, b), 0);
    EXPECT_NEAR(dot(turn_between(a, b), a), 0, 1e-12);
    EXPECT_LT(angle_between(least_turn(a, b), exp(turn_between(a, b))), 1e-12);
    EXPECT_LT(norm(rotate(least_turn(a, -a + 1e-8 * b), a) + a), 1e-7);
  }
  EXPECT_LT(angle_between(least_turn({}, {1, 2, 3}), Quat{}), 1e-15);
}

}  // namespace
}  // namespace kinemend::feet
