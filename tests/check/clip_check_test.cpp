// Each fault injected into a synthetic clip is found where it was injected, and no other fault is
// found.
#include <gmock/gmock.h>

#include "check/support.hpp"
#include "kinemend/error.hpp"
#include "translations.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

TEST(CheckClip, FindsNothingInCleanTakes) {
  for (const std::string_view motion : synth_motions()) {
    EXPECT_EQ(faults_of(check_take(synthetic_clip(std::string(motion), 5))), "") << motion;
  }
}

// A check reports only faults that cleaning removes, and cleaning leaves keyframes alone.
TEST(CheckClip, FindsNoNoiseAndNoSpikesInKeys) {
  Take clip = synthetic_clip("walk");
  Random random(3);
  for (Quat& q : clip.rotations)
    q = q * exp(radians_per_degree * Vec3{random.normal(), random.normal(), random.normal()});
  CheckSettings settings;
  const CheckReport unknown = check_take(clip, settings);
  EXPECT_FALSE(of_kind(unknown, FindingKind::noise).empty());
  EXPECT_EQ(unknown.source, TakeSource());
  settings.source = Source::keyframed;
  const CheckReport keyed = check_take(clip, settings);
  EXPECT_TRUE(of_kind(keyed, FindingKind::noise).empty());
  EXPECT_TRUE(of_kind(keyed, FindingKind::spike).empty());
  EXPECT_EQ(keyed.source, (TakeSource{Source::keyframed, "given"}));
}

TEST(CheckClip, HasNoDoubtsAboutCleanTakes) {
  for (const std::string_view motion : synth_motions())
    EXPECT_EQ(doubts_of(check_take(synthetic_clip(std::string(motion), 5))), "") << motion;
}

TEST(CheckClip, SaysThatTheModelExpectsTheNoiseOfVideo) {
  Take clip = synthetic_clip("walk", 8);
  Random random(1);
  apply_damage(clip, "system", {{"kind", std::string("video")}}, random);
  const CheckReport report = check_take(clip);
  const std::vector<Finding> found = of_kind(report, FindingKind::expected_noise);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::note);
  EXPECT_EQ(found[0].unit, "deg");
  EXPECT_GT(found[0].figure, 1);
  EXPECT_LT(found[0].figure, 8);
  EXPECT_THAT(found[0].words, HasSubstr("--source video"));
}

TEST(CheckClip, ExpectsNoNoiseThatIsMeasured) {
  Take clip = synthetic_clip("walk", 8);
  Random random(1);
  apply_damage(clip, "gaussian", {{"std_deg", 1.5}}, random);
  const CheckReport report = check_take(clip);
  EXPECT_FALSE(of_kind(report, FindingKind::noise).empty());
  EXPECT_TRUE(of_kind(report, FindingKind::expected_noise).empty());
}

// The body sways by 15 cm twice a second and carries both feet along.
Take swaying(double duration_s) {
  Take clip = synthetic_clip("still", duration_s);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double s = static_cast<double>(f) / clip.frame_rate_hz;
    clip.root_position(f).x += 15 * std::sin(4 * pi * s);
  }
  return clip;
}

TEST(CheckClip, SaysThatFeetNeverStand) {
  const std::vector<Finding> found = of_kind(check_take(swaying(5)), FindingKind::no_contact);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::note);
  EXPECT_LE(found[0].figure, 10);
}

TEST(CheckClip, DoesNotExpectFeetToStandInShortTakesOrOfABodyThatLies) {
  EXPECT_TRUE(of_kind(check_take(swaying(1.5)), FindingKind::no_contact).empty());
  Take lying = swaying(5);
  CheckSettings settings;
  settings.up = Axis::y;
  const Quat over = exp(Vec3{pi / 2, 0, 0});
  for (std::size_t f = 0; f < lying.frame_count(); ++f)
    lying.rotation(f, 0) = over * lying.rotation(f, 0);
  EXPECT_TRUE(of_kind(check_take(lying, settings), FindingKind::no_contact).empty());
}

TEST(CheckClip, TellsGapsByJoint) {
  Take clip = synthetic_clip("walk");
  const std::vector<NamedGap> gaps{{"LeftArm", 100, 129}, {"LeftArm", 300, 301}, {"Head", 10, 10}};
  mark_gaps(clip, gaps);
  const CheckReport report = check_take(clip);
  EXPECT_EQ(report.figures.gaps, 3u);
  EXPECT_DOUBLE_EQ(report.figures.longest_gap_s, 0.25);
  EXPECT_NEAR(report.figures.missing_percent, 100.0 * 33 / (720 * 31), 1e-9);
  const TrackHealth& arm = report.tracks[joint_of(clip, "LeftArm")];
  EXPECT_EQ(arm.gaps, 2u);
  EXPECT_EQ(arm.longest_gap, 30u);
  EXPECT_EQ(arm.missing_frames, 32u);
  const std::vector<Finding> found = of_kind(report, FindingKind::gap);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].track, "LeftArm");
  EXPECT_EQ(found[0].first_frame, 100u);
  EXPECT_EQ(found[0].last_frame, 129u);
}

TEST(CheckClip, TellsSpikesAndNoise) {
  Take clip = synthetic_clip("walk");
  Random random(1);
  const std::size_t joint = joint_of(clip, "RightForeArm");
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const double x = random.normal(), y = random.normal(), z = random.normal();
      clip.rotation(f, j) = clip.rotation(f, j) * exp(0.6 * radians_per_degree * Vec3{x, y, z});
    }
  }
  clip.rotation(333, joint) = clip.rotation(333, joint) * exp({0.6, 0, 0});
  const CheckReport report = check_take(clip);
  const std::vector<Finding> spikes = of_kind(report, FindingKind::spike);
  ASSERT_EQ(spikes.size(), 1u);
  EXPECT_EQ(spikes[0].track, "RightForeArm");
  EXPECT_EQ(spikes[0].first_frame, 333u);
  EXPECT_NEAR(spikes[0].figure, 0.6 * degrees_per_radian, 3);
  EXPECT_EQ(report.tracks[joint].spikes, 1u);
  EXPECT_NEAR(report.tracks[joint].noise, 0.6, 0.08);
  EXPECT_GE(of_kind(report, FindingKind::noise).size(), 25u);
}

TEST(CheckClip, FindsFrozenSpansThatTheDamageMade) {
  const Take clean = synthetic_clip("walk", 8);
  Take clip = clean;
  std::vector<NamedGap> truth;
  Random random(5);
  for (const char* name : {"LeftArm", "RightForeArm", "Head", "LeftUpLeg", "Spine"}) {
    const std::size_t first = 50 + static_cast<std::size_t>(random.uniform(0, 800));
    truth.push_back({name, first, first + 24});
    const std::size_t j = joint_of(clip, name);
    for (std::size_t f = first; f <= first + 24; ++f)
      clip.rotation(f, j) = clip.rotation(first - 1, j);
  }
  const CheckReport report = check_take(clip);
  const std::vector<Finding> frozen = of_kind(report, FindingKind::frozen);
  EXPECT_EQ(frozen.size(), truth.size());
  for (const NamedGap& gap : truth) {
    EXPECT_TRUE(std::any_of(report.stale.begin(), report.stale.end(),
                            [&](const NamedGap& found) {
                              return found.name == gap.name &&
                                     found.first_frame == gap.first_frame &&
                                     found.last_frame == gap.last_frame;
                            }))
        << gap.name << " from " << gap.first_frame;
  }
}

// Other programs close gaps along the geodesic or by straight lines of the file's Euler angles.
TEST(CheckClip, FindsSpansThatWereBridgedEitherWay) {
  for (const bool by_angles : {false, true}) {
    Take clip = synthetic_clip("walk", 8);
    const std::size_t j = joint_of(clip, "RightArm"), before = 400, after = 436;
    const RotationOrder order = clip.skeleton.rotation_order(j);
    const Quat a = clip.rotation(before, j), b = clip.rotation(after, j);
    const auto start = to_euler(a, order), end = to_euler_near(b, order, start);
    for (std::size_t f = before + 1; f < after; ++f) {
      const double share = static_cast<double>(f - before) / static_cast<double>(after - before);
      std::array<double, 3> angles{};
      for (std::size_t i = 0; i < 3; ++i) angles[i] = start[i] + share * (end[i] - start[i]);
      clip.rotation(f, j) = by_angles ? from_euler(angles, order) : slerp(a, b, share);
    }
    const CheckReport report = check_take(clip);
    ASSERT_EQ(report.stale.size(), 1u) << by_angles << " " << faults_of(report);
    EXPECT_EQ(report.stale[0].name, "RightArm");
    EXPECT_EQ(report.stale[0].first_frame, before + 1);
    EXPECT_EQ(report.stale[0].last_frame, after - 1);
    EXPECT_EQ(of_kind(report, FindingKind::bridged).size(), 1u);
  }
}

TEST(CheckClip, TakesAStretchedKneeForNoFrozenJoint) {
  Take clip = synthetic_clip("walk", 8);
  const std::size_t j = joint_of(clip, "LeftLeg");
  // The hinge stops at 0 from time to time and reaches it at speed.
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double angle = std::max(0.0, std::sin(0.05 * static_cast<double>(f)));
    clip.rotation(f, j) = exp({angle, 0, 0});
  }
  EXPECT_TRUE(of_kind(check_take(clip), FindingKind::frozen).empty());
}

TEST(CheckClip, TakesRoundingForNoMotion) {
  Take clip = synthetic_clip("walk", 4);
  const std::size_t j = joint_of(clip, "Head");
  // A joint that rests, in 32-bit floats: now one value, now the next.
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.rotation(f, j) = exp({f % 7 < 3 || f > 200 ? 0 : 4e-8, 0.1, 0});
  EXPECT_TRUE(of_kind(check_take(clip), FindingKind::frozen).empty());
}

TEST(CheckClip, FindsARootThatMovesFartherWithinAFrameThanABodyCan) {
  Take clip = synthetic_clip("walk", 4);
  EXPECT_TRUE(of_kind(check_take(clip), FindingKind::jump).empty());
  const double metre = 1 / guess_length_unit(clip.skeleton)->metres;
  for (std::size_t f = 150; f < clip.frame_count(); ++f) clip.root_position(f).x += 1.8 * metre;
  const std::vector<Finding> jumps = of_kind(check_take(clip), FindingKind::jump);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_EQ(jumps[0].severity, Severity::serious);
  EXPECT_EQ(jumps[0].first_frame, 149u);
  EXPECT_NEAR(jumps[0].figure, 180, 5);
  EXPECT_FALSE(check_take(clip).figures.jumps.has_value());
}

TEST(CheckClip, FindsFramesThatRepeatAndFramesOfZeros) {
  Take clip = synthetic_clip("walk");
  const auto copy_frame = [&](std::size_t from, std::size_t to) {
    clip.root_position(to) = clip.root_position(from);
    for (std::size_t j = 0; j < clip.joint_count(); ++j)
      clip.rotation(to, j) = clip.rotation(from, j);
  };
  for (std::size_t f = 200; f < 206; ++f) copy_frame(199, f);
  for (std::size_t f = 500; f < 503; ++f) {
    clip.root_position(f) = {};
    for (std::size_t j = 0; j < clip.joint_count(); ++j) clip.rotation(f, j) = {};
  }
  const CheckReport report = check_take(clip);
  const std::vector<Finding> repeated = of_kind(report, FindingKind::repeated_frames);
  ASSERT_EQ(repeated.size(), 1u);
  EXPECT_EQ(repeated[0].first_frame, 200u);
  EXPECT_EQ(repeated[0].last_frame, 205u);
  const std::vector<Finding> zeros = of_kind(report, FindingKind::zero_frames);
  ASSERT_EQ(zeros.size(), 1u);
  EXPECT_EQ(zeros[0].first_frame, 500u);
  EXPECT_EQ(zeros[0].last_frame, 502u);
  EXPECT_EQ(report.findings[0].kind, FindingKind::zero_frames) << "worst first";
  EXPECT_TRUE(of_kind(report, FindingKind::frozen).empty());
}

TEST(CheckClip, TellsARateThatWasDoubledByRepeatingFrames) {
  const Take slow = synthetic_clip("walk", 5, 60);
  Take clip = slow;
  clip.frame_rate_hz = 120;
  clip.positions.clear();
  clip.rotations.clear();
  for (std::size_t f = 0; f < slow.frame_count(); ++f) {
    for (int twice = 0; twice < 2; ++twice) {
      clip.positions.push_back(slow.root_position(f));
      for (std::size_t j = 0; j < slow.joint_count(); ++j)
        clip.rotations.push_back(slow.rotation(f, j));
    }
  }
  const std::vector<Finding> rate = of_kind(check_take(clip), FindingKind::rate);
  ASSERT_EQ(rate.size(), 1u);
  EXPECT_DOUBLE_EQ(rate[0].figure, 60);
}

TEST(CheckClip, TellsARateAtWhichJumpsFallTooFast) {
  Take clip = synthetic_clip("jump", 12, 60);
  EXPECT_TRUE(of_kind(check_take(clip), FindingKind::rate).empty());
  clip.frame_rate_hz = 120;
  const std::vector<Finding> rate = of_kind(check_take(clip), FindingKind::rate);
  ASSERT_EQ(rate.size(), 1u);
  EXPECT_NEAR(rate[0].figure, 60, 12);
}

TEST(CheckClip, TellsAUnitThatMakesAGiant) {
  Take clip = synthetic_clip("walk");
  clip.metres_per_unit = 0.01;
  EXPECT_TRUE(of_kind(check_take(clip), FindingKind::unit).empty());
  clip.metres_per_unit = 1;
  const std::vector<Finding> unit = of_kind(check_take(clip), FindingKind::unit);
  ASSERT_EQ(unit.size(), 1u);
  EXPECT_NEAR(unit[0].figure, 185, 20);
  EXPECT_THAT(unit[0].words, HasSubstr("in cm"));
}

TEST(CheckClip, MeasuresHowFarAStandingFootSlides) {
  Take clip = synthetic_clip("still", 4);
  EXPECT_LT(*check_take(clip).figures.slide_cm, 0.1);
  // Both feet glide 12 cm in one second, slower than a step.
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double share = std::clamp((static_cast<double>(f) - 200) / 120, 0.0, 1.0);
    clip.root_position(f).x += 12 * share;
  }
  const CheckReport report = check_take(clip);
  EXPECT_NEAR(*report.figures.slide_cm, 12, 0.5);
  EXPECT_EQ(of_kind(report, FindingKind::slide).size(), 2u);
}

TEST(CheckClip, MeasuresHowDeepAFootSinks) {
  Take clip = synthetic_clip("walk", 12);
  EXPECT_LT(*check_take(clip).figures.sink_cm, 0.5);
  // For about one second the body walks 6 cm lower.
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double s = static_cast<double>(f) / clip.frame_rate_hz;
    const double share = std::clamp(std::min(s - 6, 7.6 - s) / 0.3, 0.0, 1.0);
    clip.root_position(f).y -= 6 * share;
  }
  const CheckReport report = check_take(clip);
  EXPECT_NEAR(*report.figures.sink_cm, 6, 0.8);
  for (const Finding& finding : of_kind(report, FindingKind::sink)) {
    EXPECT_GE(finding.last_frame, 720u);
    EXPECT_LE(finding.first_frame, 912u);
  }
}

TEST(CheckClip, TellsABoneThatGrows) {
  Take clip = synthetic_clip("walk");
  const std::size_t j = joint_of(clip, "LeftLeg");
  clip.skeleton.channels[j] = make_channels(true, clip.skeleton.rotation_order(j));
  add_translations(clip, {static_cast<std::int32_t>(j)}, clip.skeleton.offsets[j]);
  EXPECT_EQ(check_take(clip).figures.length_change_percent, 0);
  for (std::size_t f = 300; f < 340; ++f) clip.position(f, 1) = 1.25 * clip.position(f, 1);
  const CheckReport report = check_take(clip);
  EXPECT_NEAR(report.figures.length_change_percent, 25, 1e-9);
  const std::vector<Finding> found = of_kind(report, FindingKind::length);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].track, "LeftLeg");
  EXPECT_EQ(found[0].first_frame, 300u);
  EXPECT_EQ(found[0].last_frame, 339u);
}

TEST(CheckClip, LeavesTheCalibrationPoseOut) {
  const CheckReport report = check_take(synthetic_clip("walk", 6, 120, true));
  EXPECT_EQ(report.calibration_frames, 1u);
  EXPECT_EQ(of_kind(report, FindingKind::calibration).size(), 1u);
  EXPECT_EQ(faults_of(report), "");
}

TEST(CheckClip, FindsOutliersAndFrozenSpansOfTheTableOfDamages) {
  const Take clean = synthetic_clip("walk", 8);
  Take spiked = clean, frozen = clean;
  Random random(3);
  apply_damage(spiked, "gaussian", {{"std_deg", 0.5}}, random);
  apply_damage(spiked, "outliers", {{"share", 0.002}, {"std_deg", 40.0}}, random);
  apply_damage(frozen, "frozen", {{"share", 0.05}, {"mean_length_s", 0.2}}, random);
  EXPECT_GT(check_take(spiked).figures.spikes, 20u);
  const CheckReport report = check_take(frozen);
  EXPECT_GT(report.figures.frozen, 20u);
  for (const NamedGap& gap : report.stale) {
    const std::size_t j = joint_of(clean, gap.name);
    EXPECT_EQ(frozen.rotation(gap.first_frame - 1, j), frozen.rotation(gap.last_frame, j));
  }
}

TEST(CheckClip, AcceptsTakesOfAnyLength) {
  const Take clip = synthetic_clip("walk", 1);
  for (std::size_t frames = 0; frames < 12; ++frames)
    EXPECT_EQ(check_take(Take(slice(clip, 0, frames))).frames, frames);
}

TEST(CheckClip, RefusesSettingsOutOfRange) {
  CheckSettings settings;
  settings.slide_cm = -1;
  EXPECT_THROW(check_take(synthetic_clip("walk", 1), settings), Error);
}

}  // namespace
}  // namespace kinemend::test
