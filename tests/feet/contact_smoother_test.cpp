// Tests of the smoother of errors that standing feet show, against the minimum of its cost.
#include "feet/contact_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "feet/support.hpp"

namespace kinemend::feet {
namespace {

using test::y_up;

// A walk and its legs, with contacts of its foot parts that are asked for.
struct Scene {
  Take clip;
  std::vector<Leg> found;
  LegMotion motion;
  std::vector<StandingPart> parts;
  MotionError error;

  explicit Scene(std::size_t frames = 40) : clip(test::synthetic_clip("walk", 2)) {
    clip = slice(clip, 0, frames);
    found = find_legs(clip.skeleton);
    motion = leg_motion(clip, found);
    for (LegModel& model : motion.models) {
      model.has = {true, true};
      model.sole[0] = {0, -8, -4};
    }
    StandingPart none{std::vector<double>(motion.frames),
                      std::vector<double>(motion.frames, std::nan(""))};
    parts.assign(2 * motion.legs(), none);
    error = {{2, 0.02, std::vector<std::uint8_t>(motion.legs(), 1), 0.02}, 0.05};
  }
  void stand(std::size_t part, std::size_t first, std::size_t last, double certainty = 1) {
    for (std::size_t f = first; f <= last; ++f) parts[part].certainty[f] = certainty;
  }
  std::vector<PoseUpdate> step() const {
    return ContactSmoother(motion, y_up, parts, error).step(motion);
  }
  Vec3 at(std::size_t frame, std::size_t part) const {
    return motion.pose(frame, part / 2)
        .sole_at(motion.models[part / 2], static_cast<FootPart>(part % 2));
  }
  // The part's place after the turns and the shift, to first order.
  Vec3 at(std::size_t frame, std::size_t part, const PoseUpdate& update) const {
    const LegPose& pose = motion.pose(frame, part / 2);
    const LegUpdate& leg = update.legs[part / 2];
    const Vec3 place = at(frame, part);
    return place + update.root_shift + cross(update.root_turn, place - motion.carrier.at[frame]) +
           cross(leg.hip, place - pose.hip_at) + cross(leg.knee, place - pose.knee_at) +
           cross(leg.ankle, place - pose.ankle_at);
  }
};

// The sum of squares that docs/details/feet.md states.
double cost(const Scene& scene, const std::vector<PoseUpdate>& x) {
  const double rate = scene.motion.frame_rate_hz, time_s = scene.error.time_s;
  const PoseUncertainty& size = scene.error.size;
  double sum = 0;
  const auto add_error = [&](double deviation, const auto& value) {
    for (std::size_t f = 0; f < x.size(); ++f) {
      const double share = 1 / (rate * 2 * time_s * deviation * deviation);
      sum += share * dot(value(x[f]), value(x[f]));
      if (f == 0) continue;
      const Vec3 change = rate * (value(x[f]) - value(x[f - 1]));
      sum += share * time_s * time_s * dot(change, change);
    }
  };
  add_error(size.root_position, [](const PoseUpdate& u) { return u.root_shift; });
  add_error(size.root_rotation, [](const PoseUpdate& u) { return u.root_turn; });
  for (std::size_t l = 0; l < scene.motion.legs(); ++l) {
    add_error(size.joint_rotation, [l](const PoseUpdate& u) { return u.legs[l].hip; });
    add_error(size.joint_rotation, [l](const PoseUpdate& u) { return u.legs[l].knee; });
    add_error(size.joint_rotation, [l](const PoseUpdate& u) { return u.legs[l].ankle; });
  }
  const double roll = 0.02 * scene.motion.height, floor = 0.06 * scene.motion.height;
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    for (std::size_t f = 0; f < x.size(); ++f) {
      if (scene.parts[p].certainty[f] == 0) continue;
      const Vec3 now = scene.at(f, p, x[f]);
      if (std::isfinite(scene.parts[p].floor[f]))
        sum += std::pow(now.y - scene.parts[p].floor[f], 2) / (rate * 0.1 * floor * floor);
      if (f == 0 || scene.parts[p].certainty[f - 1] == 0) continue;
      const Vec3 moved = now - scene.at(f - 1, p, x[f - 1]);
      sum += rate * dot(moved, moved) / (roll * roll);
    }
  }
  return sum;
}

TEST(ContactSmoother, FindsTheLeastOfItsCost) {
  Scene scene;
  scene.stand(0, 5, 25);
  scene.stand(1, 8, 30);
  scene.stand(3, 20, 39);
  for (std::size_t f = 5; f <= 25; ++f) scene.parts[0].floor[f] = scene.at(f, 0).y + 3;
  const std::vector<PoseUpdate> best = scene.step();
  const double least = cost(scene, best);
  EXPECT_LT(least,
            cost(scene, std::vector<PoseUpdate>(best.size(), {{}, {}, std::vector<LegUpdate>(2)})));
  Random random(11);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<PoseUpdate> other = best;
    const double size = trial % 2 == 0 ? 0.01 : 0.001;
    const auto vector = [&] {
      return Vec3{random.uniform(-size, size), random.uniform(-size, size),
                  random.uniform(-size, size)};
    };
    const std::size_t first = random.below(other.size()), last = random.below(other.size());
    const Vec3 shift = vector(), turn = vector(), hip = vector();
    for (std::size_t f = std::min(first, last); f <= std::max(first, last); ++f) {
      other[f].root_shift += 20 * shift;
      other[f].root_turn += turn;
      other[f].legs[0].hip += hip;
      other[f].legs[1].ankle += turn;
    }
    EXPECT_LT(least, cost(scene, other)) << trial;
  }
}

TEST(ContactSmoother, ChangesNothingWithoutAFootThatStands) {
  const Scene scene;
  for (const PoseUpdate& update : scene.step()) {
    EXPECT_EQ(norm(update.root_shift), 0);
    EXPECT_EQ(norm(update.legs[0].hip), 0);
  }
}

TEST(ContactSmoother, LeavesWhatMayNotChange) {
  Scene scene;
  scene.stand(0, 5, 30);
  scene.stand(3, 5, 30);
  scene.error.size.root_position = scene.error.size.root_rotation = 0;
  scene.error.size.legs[1] = 0;
  const PoseUpdate update = scene.step()[20];
  EXPECT_LT(norm(update.root_shift), 1e-6);
  EXPECT_LT(norm(update.root_turn), 1e-6);
  EXPECT_GT(norm(update.legs[0].hip), 0.001);
  EXPECT_LT(norm(update.legs[1].hip), 1e-6);
}

TEST(ContactSmoother, FadesBesideAContact) {
  Scene scene(150);
  scene.stand(1, 40, 60);
  const std::vector<PoseUpdate> updates = scene.step();
  const auto hip = [&](std::size_t frame) { return norm(updates[frame].legs[0].hip); };
  EXPECT_GT(hip(60), 0.001);
  EXPECT_LT(hip(66), hip(60));
  EXPECT_LT(hip(80), 0.2 * hip(60));
  EXPECT_LT(hip(149), 1e-4 * hip(60));
}

TEST(ContactSmoother, AttributesASharedSlideToAnUncertainRoot) {
  Scene scene;
  for (std::size_t part = 0; part < 4; ++part) scene.stand(part, 0, 39);
  // The whole body stands in the pose of the first frame and drifts ahead.
  for (std::size_t f = 0; f < scene.motion.frames; ++f) {
    const Vec3 drift{0.1 * static_cast<double>(f), 0, 0};
    for (std::size_t l = 0; l < 2; ++l) {
      LegPose& pose = scene.motion.pose(f, l);
      pose = scene.motion.pose(0, l);
      for (Vec3* const place : {&pose.hip_at, &pose.knee_at, &pose.ankle_at}) *place += drift;
    }
    scene.motion.carrier.at[f] = scene.motion.carrier.at[0] + drift;
  }
  scene.error.size.root_position = 20;
  const std::vector<PoseUpdate> updates = scene.step();
  const double travelled = 3.9, returned = updates[0].root_shift.x - updates[39].root_shift.x;
  EXPECT_GT(returned, 0.9 * travelled);
}

TEST(ContactSmoother, TurnsAHingeAboutItsAxisOnly) {
  Scene scene;
  LegModel& model = scene.motion.models[0];
  model.knee.order = parse_rotation_order("X");
  scene.stand(1, 5, 30);
  const LegPose& pose = scene.motion.pose(20, 0);
  const Vec3 axis = rotate(pose.knee_parent * model.knee.rest, {1, 0, 0});
  const Vec3 knee = scene.step()[20].legs[0].knee;
  EXPECT_GT(norm(knee), 1e-5);
  EXPECT_LT(norm(cross(knee, axis)), 0.01 * norm(knee));
}

TEST(ContactSmoother, BelievesALikelyContactMore) {
  double before = std::numeric_limits<double>::infinity();
  for (const double certainty : {0.05, 0.5, 0.99}) {
    Scene scene;
    scene.stand(1, 5, 30, certainty);
    const std::vector<PoseUpdate> updates = scene.step();
    const double left = norm(scene.at(30, 1, updates[30]) - scene.at(5, 1, updates[5]));
    EXPECT_LT(left, before);
    before = left;
  }
}

}  // namespace
}  // namespace kinemend::feet
