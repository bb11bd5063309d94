// Tests of the pose update, against the minimum of its cost.
#include "feet/leg_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "feet/support.hpp"

namespace kinemend::feet {
namespace {

// A walk, its legs, and a correction requested for its foot parts in frame 10.
struct Scene {
  Take clip = test::synthetic_clip("walk", 1);
  std::vector<Leg> found = find_legs(clip.skeleton);
  LegMotion motion = leg_motion(clip, found);
  std::vector<PartCorrection> parts;
  static constexpr std::size_t frame = 10;

  Scene() {
    for (std::size_t l = 0; l < motion.legs(); ++l) {
      motion.models[l].has = {true, true};
      motion.models[l].sole[0] = {0, -8, -4};
    }
    parts.resize(2 * motion.legs());
    for (PartCorrection& part : parts) {
      part.shift.resize(motion.frames);
      part.weight.resize(motion.frames);
    }
  }
  void ask(std::size_t part, Vec3 shift, double weight = 1) {
    parts[part].shift[frame] = shift;
    parts[part].weight[frame] = weight;
  }
  PoseUpdate update(const PoseUncertainty& uncertainty) const {
    return update_by_contacts(motion, frame, parts, uncertainty);
  }
};

PoseUncertainty all_alike(const Scene& scene) {
  return {1, 0.02, std::vector<std::uint8_t>(scene.motion.legs(), 1), 0.02};
}

// The part's position after the update, by forward kinematics from the root down.
Vec3 part_after(const Scene& scene, const PoseUpdate& update, std::size_t part) {
  const LegPose& pose = scene.motion.pose(Scene::frame, part / 2);
  const LegUpdate& leg = update.legs[part / 2];
  const Vec3 root = scene.motion.carrier.at[Scene::frame];
  const Quat by_root = exp(update.root_turn), by_hip = by_root * exp(leg.hip),
             by_knee = by_hip * exp(leg.knee), by_ankle = by_knee * exp(leg.ankle);
  const Vec3 hip = root + update.root_shift + rotate(by_root, pose.hip_at - root);
  const Vec3 knee = hip + rotate(by_hip, pose.knee_at - pose.hip_at);
  const Vec3 ankle = knee + rotate(by_knee, pose.ankle_at - pose.knee_at);
  const Vec3 sole = scene.motion.models[part / 2].sole[part % 2];
  return ankle + rotate(by_ankle, rotate(pose.ankle, sole));
}

// The cost that the update minimises; 0.003 of the height is how far standing feet move.
double cost(const Scene& scene, const PoseUncertainty& uncertainty, const PoseUpdate& update) {
  double sum = dot(update.root_shift, update.root_shift) / std::pow(uncertainty.root_position, 2) +
               dot(update.root_turn, update.root_turn) / std::pow(uncertainty.root_rotation, 2);
  for (const LegUpdate& leg : update.legs) {
    for (const Vec3 turn : {leg.hip, leg.knee, leg.ankle})
      sum += dot(turn, turn) / std::pow(uncertainty.joint_rotation, 2);
  }
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    if (scene.parts[p].weight[Scene::frame] == 0) continue;
    const Vec3 target = scene.motion.pose(Scene::frame, p / 2)
                            .sole_at(scene.motion.models[p / 2], static_cast<FootPart>(p % 2)) +
                        scene.parts[p].shift[Scene::frame];
    const Vec3 rest = part_after(scene, update, p) - target;
    sum += dot(rest, rest) / std::pow(0.003 * scene.motion.height, 2);
  }
  return sum;
}

TEST(PoseUpdate, IsTheLeastOfItsCost) {
  Random random(11);
  for (int i = 0; i < 20; ++i) {
    Scene scene;
    for (std::size_t p = 0; p < scene.parts.size(); ++p) {
      if (random.chance(0.7))
        scene.ask(p, {random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(-3, 3)});
    }
    const PoseUncertainty uncertainty = all_alike(scene);
    const PoseUpdate best = scene.update(uncertainty);
    if (best.legs.empty()) continue;
    const double least = cost(scene, uncertainty, best);
    for (int trial = 0; trial < 200; ++trial) {
      PoseUpdate other = best;
      const auto vector = [&](double size) {
        return Vec3{random.uniform(-size, size), random.uniform(-size, size),
                    random.uniform(-size, size)};
      };
      other.root_shift += vector(0.2);
      other.root_turn += vector(0.004);
      for (LegUpdate& leg : other.legs) {
        leg.hip += vector(0.004);
        leg.knee += vector(0.004);
        leg.ankle += vector(0.004);
      }
      EXPECT_LT(least, cost(scene, uncertainty, other) + 0.01 * least) << i << " " << trial;
    }
  }
}

TEST(PoseUpdate, IsNothingWithoutAFootThatStands) {
  const Scene scene;
  EXPECT_TRUE(scene.update(all_alike(scene)).legs.empty());
}

TEST(PoseUpdate, LeavesWhatMayNotChange) {
  Scene scene;
  scene.ask(0, {3, 1, -2});
  scene.ask(3, {-2, 0, 2});
  PoseUncertainty uncertainty = all_alike(scene);
  uncertainty.root_position = uncertainty.root_rotation = 0;
  uncertainty.legs[1] = 0;
  const PoseUpdate update = scene.update(uncertainty);
  EXPECT_EQ(norm(update.root_shift), 0);
  EXPECT_EQ(norm(update.root_turn), 0);
  EXPECT_GT(norm(update.legs[0].hip), 0.001);
  EXPECT_EQ(norm(update.legs[1].hip), 0);
  EXPECT_EQ(norm(update.legs[1].ankle), 0);
}

TEST(PoseUpdate, CountsForLessAsAContactFades) {
  double before = 0;
  for (const double weight : {0.001, 0.1, 0.5, 1.0}) {
    Scene scene;
    scene.ask(1, {4, 0, 0}, weight);
    const double turn = norm(scene.update(all_alike(scene)).legs[0].hip);
    EXPECT_GT(turn, before);
    before = turn;
  }
  EXPECT_GT(before, 0.01);
}

TEST(PoseUpdate, TurnsAHingeAboutItsAxisOnly) {
  Scene scene;
  LegModel& model = scene.motion.models[0];
  model.knee.order = parse_rotation_order("X");
  scene.ask(1, {4, 2, 3});
  const LegPose& pose = scene.motion.pose(Scene::frame, 0);
  const Vec3 axis = rotate(pose.knee_parent * model.knee.rest, {1, 0, 0});
  const Vec3 knee = scene.update(all_alike(scene)).legs[0].knee;
  EXPECT_GT(norm(knee), 1e-4);
  EXPECT_LT(norm(cross(knee, axis)), 1e-9 * norm(knee));
}

TEST(JointDeviation, GrowsWithWhatPartsInContactDeviateAndIgnoresTheRest) {
  Scene scene;
  EXPECT_EQ(joint_deviation(scene.parts, 170), 0);
  scene.ask(0, {50, 0, 0}, 0.5);
  EXPECT_EQ(joint_deviation(scene.parts, 170), 0);
  scene.ask(1, {3, 0, 0});
  const double once = joint_deviation(scene.parts, 170);
  EXPECT_NEAR(once, std::sqrt(5.0 / 3) * 3 / 170, 1e-12);
  scene.ask(1, {6, 0, 0});
  EXPECT_NEAR(joint_deviation(scene.parts, 170), 2 * once, 1e-12);
}

}  // namespace
}  // namespace kinemend::feet
