// Motion that a robot cannot follow is found where it was injected; takes that it can follow have
// no findings.
#include <gmock/gmock.h>

#include "check/marker_support.hpp"
#include "check/support.hpp"
#include "kinemend/error.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

CheckReport robot_check(const Take& take, const RobotSettings& robot = {}) {
  CheckSettings settings;
  settings.robot = robot;
  return check_take(take, settings);
}

// Turns the joint at a constant speed about one axis from frame `first` to `last`.
void turn_steadily(Take& clip, std::size_t joint, std::size_t first, std::size_t last,
                   double speed_deg_s) {
  const double step = speed_deg_s * radians_per_degree / clip.frame_rate_hz;
  for (std::size_t f = first + 1; f < clip.frame_count(); ++f) {
    const double angle = step * static_cast<double>(std::min(f, last) - first);
    clip.rotation(f, joint) = clip.rotation(f, joint) * exp({angle, 0, 0});
  }
}

TEST(RobotCheck, IsLeftOutUnlessAskedFor) {
  Take clip = synthetic_clip("jump", 2);
  const CheckReport report = check_take(clip);
  EXPECT_FALSE(report.robot.has_value());
  EXPECT_FALSE(report.figures.joint_speed_deg_s.has_value());
  EXPECT_FALSE(report.figures.flights.has_value());
  EXPECT_TRUE(of_kind(report, FindingKind::flight).empty());
}

TEST(RobotCheck, FindsNothingToWarnOfInAWalk) {
  for (const char* motion : {"walk", "turn", "clap"})
    EXPECT_EQ(faults_of(robot_check(synthetic_clip(motion, 2))), "") << motion;
}

TEST(RobotCheck, FindsTheJointThatIsTooFastAndWhen) {
  Take clip = synthetic_clip("still", 4);
  const std::size_t arm = joint_of(clip, "LeftForeArm");
  turn_steadily(clip, arm, 120, 180, 1500);
  const CheckReport report = robot_check(clip);
  const std::vector<Finding> found = of_kind(report, FindingKind::joint_speed);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].track, "LeftForeArm");
  EXPECT_NEAR(static_cast<double>(found[0].first_frame), 119, 2);
  EXPECT_NEAR(static_cast<double>(found[0].last_frame), 181, 2);
  EXPECT_NEAR(found[0].figure, 1500, 15);
  EXPECT_THAT(found[0].words, HasSubstr("1146 deg/s"));
  EXPECT_NEAR(*report.figures.joint_speed_deg_s, 1500, 15);
  EXPECT_NEAR(report.tracks[arm].peak_speed_deg_s, 1500, 15);
}

TEST(RobotCheck, MeasuresSpeedAndAccelerationAlikeAtEveryRate) {
  for (const double rate_hz : {50.0, 100.0, 500.0}) {
    Take clip = synthetic_clip("still", 1, rate_hz);
    const std::size_t arm = joint_of(clip, "LeftArm");
    const double acceleration = 5000;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const double t = std::min(static_cast<double>(f) / rate_hz, 0.2);
      clip.rotation(f, arm) = exp({0.5 * acceleration * radians_per_degree * t * t, 0, 0});
    }
    const TrackHealth& track = robot_check(clip).tracks[arm];
    // The stop at 0.2 s is the largest change of speed: 1000 deg/s, less half a step.
    EXPECT_NEAR(track.peak_speed_deg_s, 950, 1) << rate_hz;
    EXPECT_NEAR(track.peak_acceleration_deg_s2, 47500, 500) << rate_hz;
  }
}

TEST(RobotCheck, TheRootAndWhatCarriesTheBodyHaveNoLimits) {
  Take clip = synthetic_clip("still", 3);
  turn_steadily(clip, 0, 60, 200, 3000);
  EXPECT_TRUE(of_kind(robot_check(clip), FindingKind::joint_speed).empty());
}

TEST(RobotCheck, LimitsAreByNameAndTheLastThatMatchesCounts) {
  Take clip = synthetic_clip("still", 3);
  turn_steadily(clip, joint_of(clip, "LeftForeArm"), 60, 120, 500);
  turn_steadily(clip, joint_of(clip, "RightForeArm"), 60, 120, 500);
  RobotSettings robot;
  robot.joints = {{"*ForeArm", {400, 1e9}}, {"Right*", {600, 1e9}}};
  const std::vector<Finding> found = of_kind(robot_check(clip, robot), FindingKind::joint_speed);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].track, "LeftForeArm");
}

TEST(RobotCheck, TellsAJumpFromASpike) {
  Take clip = synthetic_clip("walk", 4);
  const std::size_t arm = joint_of(clip, "LeftArm"), head = joint_of(clip, "Head");
  for (std::size_t f = 201; f < clip.frame_count(); ++f)
    clip.rotation(f, arm) = clip.rotation(f, arm) * exp({0.8, 0, 0});
  clip.rotation(300, head) = clip.rotation(300, head) * exp({0.8, 0, 0});
  const CheckReport report = robot_check(clip);
  const std::vector<Finding> found = of_kind(report, FindingKind::jump);
  ASSERT_EQ(found.size(), 1u) << faults_of(report);
  EXPECT_EQ(found[0].track, "LeftArm");
  EXPECT_EQ(found[0].first_frame, 200u);
  EXPECT_EQ(found[0].last_frame, 201u);
  EXPECT_NEAR(found[0].figure, 0.8 * degrees_per_radian, 2);
  EXPECT_EQ(found[0].severity, Severity::serious);
  EXPECT_EQ(report.figures.jumps, 1u);
}

TEST(RobotCheck, FindsABodyThatIsElsewhereInTheNextFrame) {
  Take clip = synthetic_clip("walk", 4);
  for (std::size_t f = 150; f < clip.frame_count(); ++f) clip.root_position(f).x += 40;
  const std::vector<Finding> found = of_kind(robot_check(clip), FindingKind::jump);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].track, "Hips");
  EXPECT_EQ(found[0].first_frame, 149u);
  EXPECT_NEAR(found[0].figure, 40, 1);
}

TEST(RobotCheck, FindsNoJumpInNoise) {
  Take clip = synthetic_clip("run", 2);
  Random random(3);
  for (Quat& q : clip.rotations) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    q = q * exp(4 * radians_per_degree * Vec3{x, y, z});
  }
  EXPECT_TRUE(of_kind(robot_check(clip), FindingKind::jump).empty());
}

TEST(RobotCheck, TellsAFlightFromABodyThatFloats) {
  const Take jump = synthetic_clip("jump", 6, 60);
  const CheckReport falls = robot_check(jump);
  EXPECT_EQ(of_kind(falls, FindingKind::flight).size(), 2u);
  EXPECT_EQ(falls.figures.flights, 2u);
  EXPECT_TRUE(of_kind(falls, FindingKind::floating).empty()) << faults_of(falls);
  // The same body is carried up, along and down again.
  Take carried = synthetic_clip("walk", 4);
  for (std::size_t f = 120; f < 360; ++f)
    carried.root_position(f).y += 30 * std::min({1.0, (static_cast<double>(f) - 119) / 30,
                                                 (360 - static_cast<double>(f)) / 30});
  const std::vector<Finding> floats = of_kind(robot_check(carried), FindingKind::floating);
  ASSERT_FALSE(floats.empty());
  EXPECT_GE(floats[0].first_frame, 120u);
  EXPECT_LE(floats[0].last_frame, 360u);
}

TEST(RobotCheck, FindsAFootInTheFloorAndOneAboveIt) {
  Take clip = synthetic_clip("still", 4);
  for (std::size_t f = 200; f < 230; ++f) clip.root_position(f).y -= 8;
  const CheckReport sunk = robot_check(clip);
  const std::vector<Finding> deep = of_kind(sunk, FindingKind::penetration);
  ASSERT_EQ(deep.size(), 2u) << "both feet";
  EXPECT_NEAR(static_cast<double>(deep[0].first_frame), 200, 2);
  EXPECT_NEAR(static_cast<double>(deep[0].last_frame), 229, 2);
  EXPECT_NEAR(*sunk.figures.penetration_cm, 8, 0.2);
  // A 40 cm box counts as a step; a simulated floor has no steps.
  const CheckReport box = robot_check(synthetic_clip("landing", 3));
  EXPECT_EQ(of_kind(box, FindingKind::floating).size(), 2u) << faults_of(box);
  EXPECT_NEAR(*box.figures.floating_cm, 40, 1);
}

TEST(RobotCheck, TellsWhereTheFloorIs) {
  Take clip = synthetic_clip("walk", 2);
  EXPECT_TRUE(of_kind(robot_check(clip), FindingKind::floor).empty());
  for (std::size_t f = 0; f < clip.frame_count(); ++f) clip.root_position(f).y -= 12;
  const CheckReport report = robot_check(clip);
  const std::vector<Finding> found = of_kind(report, FindingKind::floor);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::note);
  EXPECT_NEAR(found[0].figure, -12, 1);
  EXPECT_THAT(found[0].words, HasSubstr("below height 0"));
}

TEST(RobotCheck, ListsHeelsAndToesThatStandInTheFramesOfTheTake) {
  const Take plain = synthetic_clip("walk", 3), posed = synthetic_clip("walk", 3, 120, true);
  const CheckReport report = robot_check(plain), shifted = robot_check(posed);
  ASSERT_EQ(shifted.calibration_frames, 1u);
  ASSERT_EQ(report.robot->contacts.size(), shifted.robot->contacts.size());
  EXPECT_EQ(report.robot->contacts, find_contacts(plain));
  std::size_t heels = 0;
  for (std::size_t i = 0; i < report.robot->contacts.size(); ++i) {
    heels += report.robot->contacts[i].part == FootPart::heel;
    EXPECT_EQ(report.robot->contacts[i].first_frame + 1, shifted.robot->contacts[i].first_frame);
  }
  EXPECT_GT(heels, 3u);
  EXPECT_LT(heels, report.robot->contacts.size());
}

TEST(RobotCheck, ChecksMarkersForJumpsFlightsAndDepth) {
  Take markers = synthetic_markers("jump", 3);
  const std::size_t hand = static_cast<std::size_t>(markers.find("LeftHand"));
  for (std::size_t f = 300; f < markers.frame_count(); ++f) markers.position(f, hand).x += 25;
  const CheckReport report = robot_check(markers);
  const std::vector<Finding> jumps = of_kind(report, FindingKind::jump);
  ASSERT_EQ(jumps.size(), 1u) << faults_of(report);
  EXPECT_EQ(jumps[0].track, "LeftHand");
  EXPECT_EQ(jumps[0].first_frame, 299u);
  EXPECT_EQ(report.figures.flights, 1u);
  EXPECT_LT(*report.figures.penetration_cm, 1);
  EXPECT_FALSE(report.figures.joint_speed_deg_s.has_value());
}

TEST(RobotCheck, TakesShortAndEmptyTakes) {
  const Take clip = synthetic_clip("walk", 2);
  for (const std::size_t frames : {1u, 2u, 3u, 5u, 11u}) {
    const CheckReport report = robot_check(slice(clip, 0, frames));
    EXPECT_EQ(faults_of(report), "") << frames;
  }
}

TEST(RobotCheck, RefusesSettingsOutOfRange) {
  const Take clip = synthetic_clip("still", 1);
  const auto refused = [&](auto change) {
    RobotSettings robot;
    change(robot);
    EXPECT_THROW(robot_check(clip, robot), Error);
  };
  refused([](RobotSettings& r) { r.limits.speed_deg_s = 0; });
  refused([](RobotSettings& r) { r.limits.acceleration_deg_s2 = -1; });
  refused([](RobotSettings& r) { r.joints = {{"*", {0, 1}}}; });
  refused([](RobotSettings& r) { r.step_s = 0; });
  refused([](RobotSettings& r) { r.jump_deg = std::nan(""); });
  refused([](RobotSettings& r) { r.penetration_cm = -1; });
}

}  // namespace
}  // namespace kinemend::test
