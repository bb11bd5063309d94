// A take that was moved and turned is normalised again: feet stand at height 0, and the take starts
// at the origin, facing forward.
#include <gtest/gtest.h>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/normalise.hpp"
#include "kinemend/lab/synth.hpp"
#include "motion/conversions.hpp"

namespace kinemend::test {
namespace {

Take take_of(const std::string& motion, bool t_pose_first = false) {
  SynthOptions options;
  options.motion = motion;
  options.duration_s = 3;
  options.t_pose_first = t_pose_first;
  return synthesize(options);
}

NormaliseSettings both() {
  NormaliseSettings settings;
  settings.floor_at_zero = settings.face_forward = true;
  return settings;
}

// Turns the take by `angle` about y and moves it.
Take elsewhere(Take take, double angle, Vec3 shift) {
  const Quat turn = exp({0, angle, 0});
  for (std::size_t f = 0; f < take.frame_count(); ++f) {
    take.rotation(f, 0) = turn * take.rotation(f, 0);
    take.root_position(f) = rotate(turn, take.root_position(f)) + shift;
  }
  return take;
}

double largest_distance(const Take& a, const Take& b) {
  const std::vector<Vec3> p = joint_positions(a, true), q = joint_positions(b, true);
  double largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) largest = std::max(largest, norm(p[i] - q[i]));
  return largest;
}

TEST(Normalise, UndoesWhereverATakeWasMoved) {
  Take home = take_of("walk");
  normalise(home, both());
  for (const double angle : {0.3, 1.57, -2.9, 3.1}) {
    Take away = elsewhere(home, angle, {340, -27, 12});
    const Normalised done = normalise(away, both());
    EXPECT_LT(largest_distance(home, away), 1e-8) << angle;
    EXPECT_NEAR(done.turned_deg, -angle * degrees_per_radian, 1e-8);
    EXPECT_NEAR(done.raised, 27, 1e-8);
  }
}

TEST(Normalise, ASecondTimeChangesNothing) {
  for (const char* motion : {"walk", "run", "turn", "jump"}) {
    Take once = take_of(motion);
    normalise(once, both());
    Take twice = once;
    const Normalised done = normalise(twice, both());
    EXPECT_NEAR(done.raised, 0, 1e-9) << motion;
    EXPECT_NEAR(done.turned_deg, 0, 1e-9) << motion;
    EXPECT_LT(largest_distance(once, twice), 1e-9) << motion;
  }
}

TEST(Normalise, FacesTheLineBetweenTheHipsForwardAtTheOrigin) {
  Take take = elsewhere(take_of("turn"), 2, {50, 4, -80});
  normalise(take, both());
  const Pose pose = forward_kinematics(take, 0);
  const Vec3 left = pose.positions[static_cast<std::size_t>(take.skeleton.find("LeftUpLeg"))];
  const Vec3 right = pose.positions[static_cast<std::size_t>(take.skeleton.find("RightUpLeg"))];
  EXPECT_GT((left - right).x, 5) << "left is on the side of x";
  EXPECT_NEAR((left - right).z, 0, 1e-9);
  EXPECT_NEAR(take.root_position(0).x, 0, 1e-9);
  EXPECT_NEAR(take.root_position(0).z, 0, 1e-9);
}

TEST(Normalise, EachPartIsByItself) {
  const Take away = elsewhere(take_of("walk"), 1, {100, -30, 5});
  NormaliseSettings floor;
  floor.floor_at_zero = true;
  Take raised = away;
  normalise(raised, floor);
  for (std::size_t f = 0; f < away.frame_count(); ++f) {
    EXPECT_EQ(raised.root_position(f).x, away.root_position(f).x);
    EXPECT_EQ(raised.root_position(f).z, away.root_position(f).z);
    EXPECT_EQ(raised.rotation(f, 0), away.rotation(f, 0));
  }
  NormaliseSettings forward;
  forward.face_forward = true;
  Take turned = away;
  normalise(turned, forward);
  for (std::size_t f = 0; f < away.frame_count(); ++f)
    EXPECT_NEAR(turned.root_position(f).y, away.root_position(f).y, 1e-12);
  Take same = away;
  normalise(same, {});
  EXPECT_EQ(largest_distance(same, away), 0);
}

TEST(Normalise, KeepsEveryJointButTheRoot) {
  const Take before = elsewhere(take_of("run"), 1, {3, 4, 5});
  Take after = before;
  normalise(after, both());
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    for (std::size_t j = 1; j < before.joint_count(); ++j)
      EXPECT_EQ(before.rotation(f, j), after.rotation(f, j));
  }
}

TEST(Normalise, TheCalibrationPoseIsNotTheFirstFrameOfTheMotion) {
  Take posed = elsewhere(take_of("walk", true), 0.7, {9, 9, 9});
  ASSERT_EQ(leading_calibration_frames(posed), 1u);
  normalise(posed, both());
  EXPECT_NEAR(posed.root_position(1).x, 0, 1e-9);
  EXPECT_NEAR(posed.root_position(1).z, 0, 1e-9);
}

TEST(Normalise, WhereZIsUpForwardIsX) {
  Take take = turn_axes(elsewhere(take_of("walk"), 0.4, {10, 20, 30}), Axis::y, Axis::z);
  const Normalised done = normalise(take, both());
  EXPECT_EQ(done.up, Axis::z);
  EXPECT_EQ(forward_axis(Axis::z), Axis::x);
  const Vec3 way = take.root_position(take.frame_count() - 1) - take.root_position(0);
  EXPECT_GT(way.x, 100);
  EXPECT_LT(std::fabs(way.y), 20);
  EXPECT_NEAR(take.root_position(0).x, 0, 1e-9);
}

TEST(Normalise, MovesMarkersAsTheJointsUnderThem) {
  Take markers = joint_markers(elsewhere(take_of("walk"), -1.2, {70, 15, 3}), true);
  for (std::string& name : markers.names) {
    if (name.starts_with("Left")) name = "L" + name.substr(4);
    if (name.starts_with("Right")) name = "R" + name.substr(5);
  }
  markers.observed[5] = 0;
  markers.position(0, 5) = {};
  normalise(markers, both());
  EXPECT_EQ(markers.position(0, 5), Vec3{}) << "what is missing stays zero";
  const auto at = [&](const char* name) {
    return markers.position(0, static_cast<std::size_t>(markers.find(name)));
  };
  EXPECT_GT((at("LUpLeg") - at("RUpLeg")).x, 5);
  const Vec3 way = markers.position(markers.frame_count() - 1, 0) - markers.position(0, 0);
  EXPECT_GT(way.z, 100) << "it walks forward";
  EXPECT_LT(std::fabs(way.x), 45) << "but for what the pelvis turns in a stride";
}

struct Recorder : FollowingDocument {
  TakeChange change;

  std::shared_ptr<const SourceDocument> after(const TakeChange& further) const override {
    auto moved = std::make_shared<Recorder>();
    moved->change = both(change, further);
    return moved;
  }
};

TEST(Normalise, TheRestOfAFileOfMarkersFollowsThem) {
  Take markers = joint_markers(elsewhere(take_of("walk"), -1.2, {70, 15, 3}), true);
  for (std::string& name : markers.names) {
    if (name.starts_with("Left")) name = "L" + name.substr(4);
    if (name.starts_with("Right")) name = "R" + name.substr(5);
  }
  markers.source.document = std::make_shared<Recorder>();
  const std::vector<Vec3> before = markers.positions;
  normalise(markers, both());
  const auto* document = dynamic_cast<const Recorder*>(markers.source.document.get());
  ASSERT_NE(document, nullptr);
  for (std::size_t i = 0; i < before.size(); ++i)
    ASSERT_LT(norm(document->change.moved(before[i]) - markers.positions[i]), 1e-9) << i;
}

TEST(Normalise, PutsThePelvisAtTheOriginWhereTheRootStaysBehind) {
  const Take walk = elsewhere(take_of("walk"), 1, {120, 7, -40});
  // The root stays at 0 above moving hips.
  Take take = walk;
  Skeleton& skeleton = take.skeleton;
  skeleton.names.insert(skeleton.names.begin(), "Reference");
  for (std::int32_t& parent : skeleton.parents) ++parent;
  skeleton.parents.insert(skeleton.parents.begin(), -1);
  skeleton.offsets.insert(skeleton.offsets.begin(), Vec3{});
  skeleton.rest_rotations.insert(skeleton.rest_rotations.begin(), Quat{});
  skeleton.channels.insert(skeleton.channels.begin(), skeleton.channels[0]);
  for (EndSite& site : skeleton.end_sites) ++site.parent;
  take.translated_joints = {1};
  take.rotations.clear();
  take.positions.clear();
  for (std::size_t f = 0; f < walk.frame_count(); ++f) {
    take.rotations.push_back({});
    for (std::size_t j = 0; j < walk.joint_count(); ++j)
      take.rotations.push_back(walk.rotation(f, j));
    take.positions.insert(take.positions.end(), {Vec3{}, walk.root_position(f)});
  }
  take.validate();
  normalise(take, both());
  Take plain = walk;
  normalise(plain, both());
  for (const std::size_t f : {std::size_t{0}, walk.frame_count() - 1}) {
    const Vec3 hips = forward_kinematics(take, f).positions[1];
    EXPECT_LT(norm(hips - plain.root_position(f)), 1e-8) << f;
  }
}

TEST(Normalise, RefusesWhatItCannotMove) {
  Take chain = take_of("spin");
  EXPECT_THROW(normalise(chain, both()), Error) << "no feet";
  Take fixed = take_of("walk");
  fixed.skeleton.channels[0] = {Channel::z_rotation, Channel::x_rotation, Channel::y_rotation};
  const Take before = fixed;
  EXPECT_THROW(normalise(fixed, both()), Error) << "no position channels";
  EXPECT_EQ(largest_distance(fixed, before), 0) << "nothing was changed";
  Take empty = take_of("walk");
  empty.rotations.clear();
  empty.positions.clear();
  EXPECT_THROW(normalise(empty, both()), Error);
}

}  // namespace
}  // namespace kinemend::test
