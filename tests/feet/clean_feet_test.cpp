// Tests of `clean_feet` on walks that slide, jitter and sink, and on takes that it must not change.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "feet/leg_solver.hpp"
#include "feet/support.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

using test::forced;
using test::synthetic_clip;
using test::track_of;
using test::with_drift;

std::size_t count_held(const FeetReport& report) {
  return static_cast<std::size_t>(std::count(report.held.begin(), report.held.end(), 1));
}

double largest_turn_deg(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rotations.size(); ++i)
    largest = std::max(largest, angle_between(a.rotations[i], b.rotations[i]));
  return largest * degrees_per_radian;
}

double largest_root_shift(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t f = 0; f < a.frame_count(); ++f)
    largest = std::max(largest, norm(a.root_position(f) - b.root_position(f)));
  return largest;
}

// Moves the left foot in each frame by the leg solver.
Take with_left_foot_moved(Take clip, const std::function<Vec3(double)>& shift_at) {
  const std::vector<Leg> legs = find_legs(clip.skeleton);
  const feet::LegMotion motion = feet::leg_motion(clip, legs);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const feet::LegPose& pose = motion.pose(f, 0);
    feet::FootTarget target;
    target.moves = true;
    target.rotation = pose.ankle;
    target.place = pose.ankle_at + shift_at(static_cast<double>(f) / clip.frame_rate_hz);
    const feet::LegRotations turned = feet::solve_leg(pose, motion.models[0], target, {}, 0.001);
    clip.rotation(f, static_cast<std::size_t>(legs[0].hip)) = turned.hip;
    clip.rotation(f, static_cast<std::size_t>(legs[0].knee)) = turned.knee;
    clip.rotation(f, static_cast<std::size_t>(legs[0].ankle)) = turned.ankle;
  }
  return clip;
}

TEST(CleanFeet, TakesTheSlideOfAWanderingRootOut) {
  for (const double rate : {30.0, 120.0}) {
    const Take clip = with_drift(synthetic_clip("walk", 8, rate), 4);
    Take cleaned = clip;
    const FeetReport report = clean_feet(cleaned, forced());
    EXPECT_EQ(count_held(report), report.contacts.size());
    EXPECT_GT(report.before.most_slide, 2);
    EXPECT_LT(report.after.most_slide, 0.02) << rate << " Hz";  // cm
    EXPECT_LT(report.after.slide, 0.002);
    EXPECT_LT(report.after.knee_pop_deg, 1.1 * report.before.knee_pop_deg + 0.5);
    EXPECT_TRUE(report.warnings.empty());
    const Take& kept = cleaned;
    EXPECT_NO_THROW(kept.validate());
  }
}

TEST(CleanFeet, HoldsFeetOfJitteryRotationsByForce) {
  const Take clip = test::with_noise(synthetic_clip("walk", 6, 60), 0.3);
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned, forced());
  EXPECT_EQ(count_held(report), report.contacts.size());
  EXPECT_LT(report.after.most_slide, 0.02);
  EXPECT_GT(report.before.most_slide, 0.5);
}

// Noise that moves the feet affects the whole leg, so each joint and the root share the correction.
TEST(CleanFeet, TakesFeetThatJitterForMeasurementsOfAllThatTheyHangFrom) {
  const Take truth = synthetic_clip("walk", 6, 60), noisy = test::with_noise(truth, 0.3);
  Take cleaned = noisy;
  const FeetReport report = clean_feet(cleaned);
  EXPECT_EQ(count_held(report), report.contacts.size());
  EXPECT_LT(report.after.slide, 0.25 * report.before.slide);
  const std::vector<double> before = geodesic_rms_deg_per_joint(truth, noisy),
                            after = geodesic_rms_deg_per_joint(truth, cleaned);
  for (const Leg& leg : find_legs(truth.skeleton)) {
    for (const std::int32_t joint : {0, leg.hip, leg.knee, leg.ankle}) {
      const auto j = static_cast<std::size_t>(joint);
      EXPECT_LT(after[j], before[j]) << truth.skeleton.names[j];
    }
  }
}

TEST(CleanFeet, LiftsFeetThatSink) {
  Take clip = synthetic_clip("walk", 8);
  // For 120 of 960 frames, the feet stand 4 cm below the floor.
  for (std::size_t f = 300; f < 420; ++f) clip.root_position(f).y -= 4;
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned, forced());
  EXPECT_GT(report.before.sink, 2.5);
  EXPECT_LT(report.after.sink, 0.6);
}

TEST(CleanFeet, LeavesACleanWalkAlone) {
  for (const char* motion : {"walk", "turn", "run", "jump", "still"}) {
    const Take clip = synthetic_clip(motion, 6);
    Take cleaned = clip;
    const FeetReport report = clean_feet(cleaned);
    EXPECT_EQ(count_held(report), 0u) << motion;
    EXPECT_EQ(cleaned.rotations, clip.rotations) << motion;
    EXPECT_EQ(cleaned.positions, clip.positions) << motion;
    for (const std::string& reason : report.reasons)
      EXPECT_THAT(reason, testing::StartsWith("stands still: moves ")) << motion;
  }
}

TEST(CleanFeet, HardlyChangesACleanWalkByForce) {
  const Take clip = synthetic_clip("walk", 6);
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned, forced());
  EXPECT_GT(count_held(report), 10u);
  EXPECT_LT(report.after.most_slide, 0.02);
  EXPECT_LT(report.after.knee_pop_deg, report.before.knee_pop_deg + 0.5);
}

TEST(CleanFeet, ChangesNothingFartherFromContactsThanTheBlend) {
  const Take clip = with_drift(synthetic_clip("run", 6), 4);
  FeetSettings settings;
  const std::vector<FootContact> all = find_contacts(clip);
  settings.contacts = {{all[1], all.back()}};
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned, settings);
  const auto blend = static_cast<std::size_t>(std::lround(settings.blend_s * clip.frame_rate_hz));
  std::vector<std::uint8_t> near(clip.frame_count());
  for (const FootContact& c : report.contacts) {
    for (std::size_t f = 0; f < near.size(); ++f)
      if (f + blend >= c.first_frame && f <= c.last_frame + blend) near[f] = 1;
  }
  ASSERT_GT(std::count(near.begin(), near.end(), 0), 10);
  for (std::size_t f = 0; f < near.size(); ++f) {
    EXPECT_TRUE(near[f] != 0 || test::same_bits(clip, cleaned, f)) << "frame " << f;
    EXPECT_EQ(cleaned.root_position(f).x, clip.root_position(f).x);
    EXPECT_EQ(cleaned.root_position(f).z, clip.root_position(f).z);
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const bool changed = report.changed[f * clip.joint_count() + j] != 0;
      EXPECT_EQ(changed, !(cleaned.rotation(f, j) == clip.rotation(f, j)));
      const std::string& name = clip.skeleton.names[j];
      const bool of_leg = name.find("Leg") != name.npos || name.find("Foot") != name.npos;
      EXPECT_TRUE(of_leg || !changed) << name;
    }
  }
}

// The largest change of the ankle's velocity between frames near ends of contacts, cm/s.
double largest_kick(double rate, const std::vector<FootContact>& at_120) {
  const Take clip = with_drift(synthetic_clip("walk", 6, rate), 4);
  FeetSettings settings = forced();
  settings.contacts.emplace();
  const auto times = static_cast<std::size_t>(std::lround(rate / 120));
  for (FootContact c : at_120) {
    c.first_frame *= times;
    c.last_frame *= times;
    settings.contacts->push_back(c);
  }
  Take cleaned = clip;
  clean_feet(cleaned, settings);
  double largest = 0;
  const std::vector<Vec3> before = track_of(clip, "LeftFoot"),
                          after = track_of(cleaned, "LeftFoot");
  for (std::size_t f = 2; f < after.size(); ++f) {
    const auto kick = [&](const std::vector<Vec3>& p) {
      return rate * norm(p[f] - 2.0 * p[f - 1] + p[f - 2]);
    };
    largest = std::max(largest, kick(after) - kick(before));
  }
  return largest;
}

TEST(CleanFeet, KeepsVelocityContinuousAtTheEndsOfContacts) {
  // At 960 Hz the steps of a smooth motion are small, and a jump is clearly visible: an uncorrected
  // jump is as large as the slide, 20 cm/s and more.
  ContactSettings thresholds;
  thresholds.finder = ContactFinder::thresholds;
  const std::vector<FootContact> contacts =
      find_contacts(with_drift(synthetic_clip("walk", 6, 120), 4), thresholds);
  EXPECT_LT(largest_kick(960, contacts), 5);
}

TEST(CleanFeet, DoesNotFlingAFootThatJittersWhereItsContactEnds) {
  Take clip = synthetic_clip("still", 3);
  constexpr std::size_t last = 200;
  Quat& hip = clip.rotation(last, test::joint_of(clip, "LeftUpLeg"));
  hip = hip * exp({0.1, 0, 0});
  FeetSettings settings;
  settings.contacts = {{{0, FootPart::toe, 100, last}}};
  Take cleaned = clip;
  clean_feet(cleaned, settings);
  const std::vector<Vec3> before = track_of(clip, "LeftToeBase"),
                          after = track_of(cleaned, "LeftToeBase");
  const double jump = norm(after[last] - before[last]);
  EXPECT_GT(jump, 5);
  for (std::size_t f = last + 1; f < after.size(); ++f)
    EXPECT_LT(norm(after[f] - before[f]), 1.2 * jump) << "frame " << f;
}

TEST(CleanFeet, HasNothingLeftToDoTheSecondTime) {
  const Take clip = with_drift(synthetic_clip("walk", 8), 4);
  Take once = clip;
  FeetSettings settings;
  const FeetReport report = clean_feet(once, settings);
  ASSERT_GT(count_held(report), 5u);
  Take twice = once;
  EXPECT_EQ(count_held(clean_feet(twice, settings)), 0u);
  EXPECT_EQ(twice.rotations, once.rotations);

  settings.contacts = report.contacts;
  once = clip;
  clean_feet(once, settings);
  twice = once;
  clean_feet(twice, settings);
  EXPECT_LT(largest_turn_deg(once, twice), 1.5);
  EXPECT_LT(largest_root_shift(once, twice), 0.15);
}

TEST(CleanFeet, DoesTheSameWhicheverWayIsUpAndWhateverTheUnit) {
  const Take clip = with_drift(synthetic_clip("walk", 5, 60), 4);
  const Quat turn = exp({pi / 2, 0, 0});
  const Take other = test::moved(clip, turn, {30, 40, 50}, 0.01);
  Take plain = clip, turned = other;
  clean_feet(plain, forced());
  clean_feet(turned, forced());
  const Take expected = test::moved(plain, turn, {30, 40, 50}, 0.01);
  EXPECT_LT(largest_turn_deg(expected, turned), 1e-4);
  EXPECT_LT(largest_root_shift(expected, turned), 1e-6);
}

TEST(CleanFeet, LeavesTheCalibrationFrameAlone) {
  const Take clip = with_drift(synthetic_clip("walk", 5, 120, 1, true), 4);
  ASSERT_EQ(leading_calibration_frames(clip), 1u);
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned, forced());
  EXPECT_TRUE(test::same_bits(clip, cleaned, 0));
  EXPECT_EQ(report.changed.size(), clip.rotations.size());
  EXPECT_EQ(report.root_changed.size(), clip.frame_count());
  EXPECT_LT(report.after.most_slide, 0.02);
  for (const FootContact& c : report.contacts) EXPECT_GE(c.first_frame, 1u);
}

TEST(CleanFeet, LeavesAFootAloneThatIsDrawnAlongWhileTheOtherStands) {
  const Take clip = with_left_foot_moved(synthetic_clip("still", 4), [](double t) {
    const double u = std::clamp(t - 1.0, 0.0, 1.0);
    return Vec3{9 * u * u * (3 - 2 * u), 0, 0};
  });
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned);
  bool said = false;
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    EXPECT_EQ(report.held[i], 0);
    said = said || (report.contacts[i].leg == 0 &&
                    report.reasons[i].find("while the other foot stands") != std::string::npos);
  }
  EXPECT_TRUE(said);
  EXPECT_EQ(cleaned.rotations, clip.rotations);
  Take held = clip;
  EXPECT_LT(clean_feet(held, forced()).after.most_slide, 0.1);
}

TEST(CleanFeet, LeavesAGlideAloneButHoldsASlowDrift) {
  const auto carried = [](double speed) {
    Take clip = synthetic_clip("still", 4, 60);
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      clip.root_position(f).x += speed * static_cast<double>(f) / clip.frame_rate_hz;
    return clip;
  };
  Take glide = carried(18);
  const FeetReport left = clean_feet(glide);
  EXPECT_EQ(count_held(left), 0u);
  ASSERT_FALSE(left.reasons.empty());
  EXPECT_THAT(left.reasons[0], testing::HasSubstr("along with the body"));
  Take drift = carried(2);
  const FeetReport held = clean_feet(drift);
  EXPECT_EQ(count_held(held), held.contacts.size());
  EXPECT_GT(held.before.most_slide, 7);
  EXPECT_LT(held.after.most_slide, 0.05);
}

TEST(CleanFeet, HoldsWhatIsListedAndNothingElse) {
  const Take clip = with_drift(synthetic_clip("walk", 6), 4);
  FeetSettings settings;
  const std::vector<FootContact> all = find_contacts(clip);
  settings.contacts = {{all[2]}};
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned, settings);
  EXPECT_EQ(report.contacts, *settings.contacts);
  EXPECT_EQ(count_held(report), 1u);
  EXPECT_LT(feet_figures(cleaned, *settings.contacts).most_slide, 0.05);
  settings.contacts->front().last_frame = clip.frame_count();
  EXPECT_THROW(clean_feet(cleaned, settings), Error);
  settings.contacts->front() = {7, FootPart::heel, 3, 9};
  EXPECT_THROW(clean_feet(cleaned, settings), Error);
}

TEST(CleanFeet, ManagesWithoutARootThatMoves) {
  Take clip = with_drift(synthetic_clip("walk", 6), 6);
  Take free = clip;
  const FeetReport lowered = clean_feet(free, forced());
  EXPECT_GT(std::count(lowered.root_changed.begin(), lowered.root_changed.end(), 1), 0);
  clip.skeleton.channels[0] = make_channels(false, parse_rotation_order("ZXY"));
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned, forced());
  EXPECT_EQ(cleaned.positions, clip.positions);
  EXPECT_LT(report.after.slide, 0.5 * report.before.slide);
  EXPECT_LT(report.after.knee_pop_deg, report.before.knee_pop_deg + 1);
}

TEST(CleanFeet, KeepsTranslationsOfJoints) {
  Take clip = with_drift(synthetic_clip("walk", 4, 60), 4);
  const std::vector<std::int32_t> joints = {clip.skeleton.find("LeftLeg"),
                                            clip.skeleton.find("LeftFoot")};
  for (const std::int32_t j : joints)
    clip.skeleton.channels[static_cast<std::size_t>(j)] =
        make_channels(true, parse_rotation_order("ZXY"));
  test::add_translations(clip, joints, [&](std::size_t f, std::size_t k) {
    const double stretch = 1 + 0.01 * std::sin(0.1 * static_cast<double>(f));
    return stretch * clip.skeleton.offsets[static_cast<std::size_t>(joints[k])];
  });
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned, forced());
  for (const std::size_t track : {1, 2})
    EXPECT_EQ(test::point_track(cleaned, track), test::point_track(clip, track));
  EXPECT_LT(report.after.most_slide, 0.05);
}

TEST(CleanFeet, SaysWhereItCanDoNothing) {
  Take chain = synthetic_clip("spin", 1);
  EXPECT_THAT(clean_feet(chain).warnings, testing::ElementsAre(testing::HasSubstr("no legs")));
  Take lying = test::moved(synthetic_clip("walk", 1), exp({pi / 4, 0, 0}), {});
  EXPECT_THAT(clean_feet(lying).warnings, testing::ElementsAre(testing::HasSubstr("which way")));
  Take empty = slice(synthetic_clip("walk", 1), 0, 0);
  EXPECT_TRUE(clean_feet(empty).contacts.empty());
  EXPECT_EQ(empty.frame_count(), 0u);
}

TEST(CleanFeet, RefusesSettingsOutOfRange) {
  Take clip = synthetic_clip("walk", 1);
  FeetSettings settings;
  settings.blend_s = 0;
  EXPECT_THROW(clean_feet(clip, settings), Error);
  settings = {};
  settings.soft_reach = 0.5;
  EXPECT_THROW(clean_feet(clip, settings), Error);
  settings = {};
  settings.contact.keep_speed = 0.01;
  EXPECT_THROW(clean_feet(clip, settings), Error);
}

TEST(CleanFeet, DoesNothingWhenItIsOff) {
  const Take clip = with_drift(synthetic_clip("walk", 2), 4);
  Take cleaned = clip;
  FeetSettings settings;
  settings.mode = FeetMode::off;
  EXPECT_TRUE(clean_feet(cleaned, settings).contacts.empty());
  EXPECT_EQ(cleaned.rotations, clip.rotations);
}

}  // namespace
}  // namespace kinemend
