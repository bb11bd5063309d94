// Tests of joint bodies: channels that do not depend on place, heading, axes or rest pose, and
// decoding.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "body/body_takes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

using namespace body_test;

// Overwrites every joint that the layout knows in a copy and restores it by decoding.
Take decoded(const Take& clip, const BodyLayout& layout) {
  const BodyMatch match = match_body(layout, clip);
  const BodyChannels channels = encode_body(clip, layout, match);
  Take copy = clip;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (const std::int32_t joint : match.tracks) {
      if (joint >= 0) copy.rotation(f, static_cast<std::size_t>(joint)) = exp({0.3, -1.2, 0.7});
    }
    copy.root_position(f) = {17, -3, 40};
  }
  decode_body(channels, layout, match, copy);
  return copy;
}

double largest_turn(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rotations.size(); ++i)
    largest = std::max(largest, angle_between(a.rotations[i], b.rotations[i]));
  return largest;
}

double largest_shift(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t f = 0; f < a.frame_count(); ++f)
    largest = std::max(largest, norm(a.root_position(f) - b.root_position(f)));
  return largest;
}

TEST(BodyOfJoints, DecodesWhatItEncodes) {
  for (const char* motion : {"walk", "turn", "stroll", "jump", "punch"}) {
    const Take clip = walk(motion);
    const Take back = decoded(clip, layout_of(clip));
    EXPECT_LT(largest_turn(clip, back), 1e-9) << motion;
    EXPECT_LT(largest_shift(clip, back), 1e-9) << motion;
  }
}

TEST(BodyOfJoints, DoesNotSeeWhereAPersonStandsOrFaces) {
  const Take clip = walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const BodyChannels expected = channels_of(layout, clip);
  for (const double heading : {0.4, 2.0, -3.1}) {
    const BodyChannels found = channels_of(layout, moved(clip, heading, {300, 20, -1000}));
    EXPECT_LT(largest_difference(expected.poses, found.poses), 1e-8) << heading;
  }
}

TEST(BodyOfJoints, DoesNotSeeAxesAndUnits) {
  const Take clip = walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const PoseMatrix expected = channels_of(layout, clip).poses;
  EXPECT_LT(
      largest_difference(expected, channels_of(layout, turn_axes(clip, Axis::y, Axis::z)).poses),
      1e-8);
  EXPECT_LT(largest_difference(expected, channels_of(layout, scale_lengths(clip, 0.01)).poses),
            1e-8);
}

TEST(BodyOfJoints, DoesNotSeeHowFramesAreTurnedAtRest) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  // The same motion with random bone frames at rest: rest' = a_parent^-1 rest a, q' = a^-1 q a.
  Take turned = clip;
  Random random(5);
  std::vector<Quat> frames;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const std::int32_t parent = clip.skeleton.parents[j];
    const Quat above = parent < 0 ? Quat{} : frames[static_cast<std::size_t>(parent)];
    frames.push_back(exp(normal_vector(random, 1)));
    turned.skeleton.rest_rotations[j] =
        normalized(conjugate(above) * clip.skeleton.rest_rotations[j] * frames[j]);
    if (j > 0) turned.skeleton.offsets[j] = rotate(conjugate(above), clip.skeleton.offsets[j]);
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      turned.rotation(f, j) = normalized(conjugate(frames[j]) * clip.rotation(f, j) * frames[j]);
  }
  for (EndSite& site : turned.skeleton.end_sites)
    site.offset = rotate(conjugate(frames[static_cast<std::size_t>(site.parent)]), site.offset);
  ASSERT_LT(norm(forward_kinematics(clip, 50).positions.back() -
                 forward_kinematics(turned, 50).positions.back()),
            1e-9);
  EXPECT_LT(largest_difference(channels_of(layout, clip).poses, channels_of(layout, turned).poses),
            1e-8);
}

// The same motion on a skeleton whose arms hang by 50 degrees in the rest pose.
Take with_hanging_arms(const Take& clip) {
  Take result = clip;
  Skeleton& skeleton = result.skeleton;
  for (const auto& [name, sign] : {std::pair("LeftArm", -1.0), std::pair("RightArm", 1.0)}) {
    const Quat hang = exp({0, 0, sign * 50 * radians_per_degree});
    const auto arm = static_cast<std::size_t>(skeleton.find(name));
    std::vector<std::uint8_t> below(clip.joint_count());
    below[arm] = 1;
    for (std::size_t j = arm + 1; j < clip.joint_count(); ++j) {
      if (below[static_cast<std::size_t>(skeleton.parents[j])] == 0) continue;
      below[j] = 1;
      skeleton.offsets[j] = rotate(hang, skeleton.offsets[j]);
    }
    for (EndSite& site : skeleton.end_sites) {
      if (below[static_cast<std::size_t>(site.parent)] != 0)
        site.offset = rotate(hang, site.offset);
    }
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      for (std::size_t j = arm; j < clip.joint_count(); ++j) {
        if (below[j] == 0) continue;
        const Quat q = clip.rotation(f, j);
        result.rotation(f, j) = j == arm ? q * conjugate(hang) : hang * q * conjugate(hang);
      }
    }
  }
  return result;
}

TEST(BodyOfJoints, DoesNotSeeWhetherArmsHangAtRest) {
  const Take clip = walk();
  const Take hanging = with_hanging_arms(clip);
  ASSERT_LT(norm(forward_kinematics(clip, 50).positions.back() -
                 forward_kinematics(hanging, 50).positions.back()),
            1e-9);
  const BodyLayout layout = layout_of(clip);
  const BodyChannels expected = channels_of(layout, clip), found = channels_of(layout, hanging);
  EXPECT_LT(largest_difference(expected.poses, found.poses), 0.05);
  const Take back = decoded(hanging, layout);
  EXPECT_LT(largest_turn(hanging, back), 1e-9);
}

TEST(BodyOfJoints, MeasuresFromAStandingFrameWhereTheRestPoseStandsNoPerson) {
  const Take clip = walk();
  Take odd = clip;
  // Gives bones random frames in the zero pose, keeping the rest rotation: q' = a_parent^-1 q a.
  Random random(8);
  std::vector<Quat> frames;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const std::int32_t parent = clip.skeleton.parents[j];
    const Quat above = parent < 0 ? Quat{} : frames[static_cast<std::size_t>(parent)];
    frames.push_back(exp(normal_vector(random, 2)));
    if (j > 0) odd.skeleton.offsets[j] = rotate(conjugate(above), clip.skeleton.offsets[j]);
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      odd.rotation(f, j) = normalized(conjugate(above) * clip.rotation(f, j) * frames[j]);
  }
  for (EndSite& site : odd.skeleton.end_sites)
    site.offset = rotate(conjugate(frames[static_cast<std::size_t>(site.parent)]), site.offset);
  ASSERT_LT(norm(forward_kinematics(clip, 50).positions.back() -
                 forward_kinematics(odd, 50).positions.back()),
            1e-9);
  const BodyLayout layout = layout_of(clip);
  const BodyChannels expected = channels_of(layout, clip), found = channels_of(layout, odd);
  // Elbows and wrists of a standing person differ from a T-pose; legs and trunk are read well.
  for (const char* name : {"Hips", "LeftUpLeg", "LeftLeg", "RightUpLeg", "RightLeg", "Spine"})
    EXPECT_LT(rms_difference(expected.poses, found.poses, track_named(layout, name)), 16) << name;
  EXPECT_LT(largest_turn(odd, decoded(odd, layout)), 1e-9);
}

TEST(BodyOfJoints, KeepsItsFrameUnderNoise) {
  const Take clip = walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const BodyChannels clean = channels_of(layout, clip);
  Take noisy = clip;
  Random random(1);
  for (Quat& q : noisy.rotations)
    q = normalized(q * exp(normal_vector(random, 2 * radians_per_degree)));
  for (std::size_t f = 0; f < noisy.frame_count(); ++f)
    noisy.root_position(f) += normal_vector(random, 1);
  const BodyChannels found = channels_of(layout, noisy);
  EXPECT_EQ(found.degrees_per_unit, clean.degrees_per_unit);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_NEAR(found.headings[f], clean.headings[f], 1.2 * radians_per_degree) << f;
    Vec3 shift = found.places[f] - clean.places[f];
    shift.y = 0;
    EXPECT_LT(norm(shift), 0.7) << f;
    EXPECT_NEAR(found.places[f].y, clean.places[f].y, 1) << f;
  }
}

TEST(BodyOfJoints, KeepsItsFrameUnderSpikes) {
  const Take clip = walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const BodyChannels clean = channels_of(layout, clip);
  Take spiked = clip;
  for (std::size_t f = 10; f < clip.frame_count(); f += 37) {
    spiked.rotation(f, 0) = normalized(exp({0.5, 2.5, -1}) * spiked.rotation(f, 0));
    spiked.root_position(f) += Vec3{80, 50, -100};
  }
  const BodyChannels found = channels_of(layout, spiked);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_NEAR(found.headings[f], clean.headings[f], 0.5 * radians_per_degree) << f;
    EXPECT_LT(norm(found.places[f] - clean.places[f]), 1) << f;
  }
  // A spike changes only the channels of its own frame.
  EXPECT_LT(std::fabs(found.poses(20, 1) - clean.poses(20, 1)), 0.5);
  EXPECT_GT(std::fabs(found.poses(47, 1) - clean.poses(47, 1)), 20);
}

TEST(BodyOfJoints, FollowsASteadyTurnToTheEnds) {
  Take clip = slice(walk("still"), 0, 1);
  const std::size_t frames = 240;
  const Vec3 still = clip.root_position(0);
  const Quat facing = clip.rotation(0, 0);
  clip.positions.assign(frames, still);
  const std::vector<Quat> pose(clip.rotations);
  clip.rotations.clear();
  for (std::size_t f = 0; f < frames; ++f) {
    clip.rotations.insert(clip.rotations.end(), pose.begin(), pose.end());
    const double t = static_cast<double>(f) / clip.frame_rate_hz;
    clip.rotation(f, 0) = exp({0, 3 * t, 0}) * facing;  // passes a whole turn
    clip.root_position(f) += Vec3{140 * t, 0, -60 * t};
  }
  const BodyLayout layout = layout_of(walk());
  const BodyChannels channels = channels_of(layout, clip);
  for (std::size_t f = 0; f < frames; ++f) {
    EXPECT_NEAR(channels.headings[f] - channels.headings[0],
                3 * static_cast<double>(f) / clip.frame_rate_hz, 1e-9);
    for (std::size_t c = 0; c < layout.channel_count(); ++c)
      EXPECT_NEAR(channels.poses(f, c), channels.poses(0, c), 1e-6) << layout.channel_name(c);
  }
}

TEST(BodyOfJoints, KeepsItsHeadingThroughACartwheel) {
  Take clip = walk("still");
  const BodyLayout layout = layout_of(walk());
  const std::size_t frames = clip.frame_count();
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / static_cast<double>(frames);
    clip.rotation(f, 0) = exp({0, 0, 2 * pi * t}) * exp({0.1 * std::sin(9 * t), 0, 0});
  }
  const BodyChannels channels = channels_of(layout, clip);
  for (const double heading : channels.headings) EXPECT_NEAR(heading, 0, 12 * radians_per_degree);
}

TEST(BodyOfJoints, MarksWhatWasNotMeasuredAndHoldsTheLastSeen) {
  Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const BodyChannels whole = channels_of(layout, clip);
  const auto arm = static_cast<std::size_t>(clip.skeleton.find("LeftArm"));
  clip.observed.assign(clip.frame_count() * clip.joint_count(), 1);
  for (std::size_t f = 30; f < 60; ++f) {
    clip.observed[f * clip.joint_count() + arm] = 0;
    clip.rotation(f, arm) = exp({1, 2, 3});
  }
  clip.observed_positions.assign(clip.frame_count(), 1);
  for (std::size_t f = 0; f < 5; ++f) clip.observed_positions[f] = 0;
  const BodyChannels channels = channels_of(layout, clip);
  const std::size_t channel = 3 * track_named(layout, "LeftArm");
  const std::size_t place = 3 * layout.track_count(), width = layout.channel_count();
  EXPECT_EQ(channels.observed[29 * width + channel], 1);
  EXPECT_EQ(channels.observed[30 * width + channel + 2], 0);
  EXPECT_EQ(channels.observed[59 * width + channel], 0);
  EXPECT_EQ(channels.observed[60 * width + channel], 1);
  EXPECT_EQ(channels.poses(45, channel), channels.poses(29, channel));
  EXPECT_NEAR(channels.poses(60, channel), whole.poses(60, channel), 1e-9);
  EXPECT_EQ(channels.observed[4 * width + place], 0);
  EXPECT_EQ(channels.observed[5 * width + place], 1);
  EXPECT_EQ(channels.poses(0, place + 1), channels.poses(5, place + 1));
}

TEST(BodyOfJoints, WritesTheChosenTracksOnly) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const BodyMatch match = match_body(layout, clip);
  BodyChannels channels = encode_body(clip, layout, match);
  for (double& v : channels.poses.values) v += 5;
  std::vector<std::uint8_t> chosen(layout.track_count() + 1);
  chosen[track_named(layout, "LeftLeg")] = 1;
  Take changed = clip;
  decode_body(channels, layout, match, changed, chosen);
  const auto leg = static_cast<std::size_t>(clip.skeleton.find("LeftLeg"));
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const double turn = angle_between(clip.rotation(7, j), changed.rotation(7, j));
    if (j == leg)
      EXPECT_NEAR(turn, std::sqrt(75.0) * radians_per_degree, 0.02);
    else
      EXPECT_EQ(turn, 0);
  }
  EXPECT_EQ(clip.positions, changed.positions);
  chosen.pop_back();
  EXPECT_THROW(decode_body(channels, layout, match, changed, chosen), Error);
}

TEST(BodyOfJoints, EncodesInTheFrameOfAGuide) {
  const Take clip = walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const BodyMatch match = match_body(layout, clip);
  const BodyChannels guide = encode_body(clip, layout, match);
  Take spiked = clip;
  spiked.rotation(100, 0) = normalized(exp({0, 1, 0}) * clip.rotation(100, 0));
  spiked.root_position(50) += Vec3{0, 100, 0};
  const BodyChannels found = encode_body(spiked, layout, match, guide);
  EXPECT_EQ(found.headings, guide.headings);
  EXPECT_EQ(found.places, guide.places);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t c = 0; c < layout.channel_count(); ++c) {
      const bool spike = (f == 100 && c < 3) || (f == 50 && c >= 3 * layout.track_count());
      if (spike) continue;
      EXPECT_NEAR(found.poses(f, c), guide.poses(f, c), 1e-9);
    }
  }
  EXPECT_NEAR(norm(Vec3{found.poses(100, 0) - guide.poses(100, 0),
                        found.poses(100, 1) - guide.poses(100, 1),
                        found.poses(100, 2) - guide.poses(100, 2)}),
              degrees_per_radian, 3);
  EXPECT_THROW(encode_body(Take(slice(clip, 0, 9)), layout, match, guide), Error);
}

TEST(BodyOfJoints, ContinuesRotationVectorsPastHalfATurn) {
  Take clip = walk("still");
  const auto arm = static_cast<std::size_t>(clip.skeleton.find("LeftArm"));
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.rotation(f, arm) = exp({2.8 + 0.8 * std::sin(0.0125 * static_cast<double>(f)), 0, 0});
  BodyLayout layout = layout_of(clip);
  const std::size_t track = track_named(layout, "LeftArm");
  layout.references[track] = {};
  const auto spike = clip.frame_count() / 2;
  clip.rotation(spike, arm) = exp({0, -1.5, 0});
  const BodyChannels channels = channels_of(layout, clip);
  double most = 0;
  for (std::size_t f = 1; f < clip.frame_count(); ++f) {
    most = std::max(most, channels.poses(f, 3 * track));
    if (f == spike || f == spike + 1) continue;
    EXPECT_LT(std::fabs(channels.poses(f, 3 * track) - channels.poses(f - 1, 3 * track)), 0.7) << f;
  }
  EXPECT_NEAR(most, 3.6 * degrees_per_radian, 0.1);
}

TEST(BodyOfJoints, ForgetsWholeTurns) {
  Take clip = walk("still", 6);
  const auto hand = static_cast<std::size_t>(clip.skeleton.find("LeftHand"));
  // The hand makes one turn in two seconds.
  const auto angle = [](std::size_t f) {
    return 0.3 + 2 * pi * std::clamp((static_cast<double>(f) / 60 - 1) / 2, 0.0, 1.0);
  };
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.rotation(f, hand) = exp({0, angle(f), 0});
  BodyLayout layout = layout_of(clip);
  const std::size_t track = track_named(layout, "LeftHand");
  layout.references[track] = {};
  const BodyChannels channels = channels_of(layout, clip);
  int jumps = 0;
  for (std::size_t f = 1; f < clip.frame_count(); ++f)
    jumps +=
        std::fabs(channels.poses(f, 3 * track + 1) - channels.poses(f - 1, 3 * track + 1)) > 300;
  EXPECT_EQ(jumps, 1);
  EXPECT_NEAR(channels.poses(clip.frame_count() - 1, 3 * track + 1), 0.3 * degrees_per_radian,
              1e-6);
}

TEST(BodyOfJoints, LeavesAloneWhatHoldsUpTheHips) {
  const Take clip = walk("stroll");
  // The same motion below a joint that turns and travels by itself.
  Take carried;
  carried.frame_rate_hz = clip.frame_rate_hz;
  carried.skeleton.add_joint("Reference", -1, {}, clip.skeleton.channels[0]);
  for (std::size_t j = 0; j < clip.joint_count(); ++j)
    carried.skeleton.add_joint(clip.skeleton.names[j], clip.skeleton.parents[j] + 1,
                               clip.skeleton.offsets[j], clip.skeleton.channels[j]);
  carried.skeleton.end_sites = clip.skeleton.end_sites;
  for (EndSite& site : carried.skeleton.end_sites) ++site.parent;
  carried.translated_joints = {1};
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double t = static_cast<double>(f) / 60;
    const Quat turn = exp({0.1, 0.3 * t, 0});
    const Vec3 place{10 * t, 3, 0};
    carried.positions.push_back(place);
    carried.positions.push_back(rotate(conjugate(turn), clip.root_position(f) - place));
    carried.rotations.push_back(turn);
    carried.rotations.push_back(conjugate(turn) * clip.rotation(f, 0));
    for (std::size_t j = 1; j < clip.joint_count(); ++j)
      carried.rotations.push_back(clip.rotation(f, j));
  }
  carried.validate();
  const BodyLayout layout = layout_of(clip);
  const BodyMatch match = match_body(layout, carried);
  const BodyChannels channels = encode_body(carried, layout, match);
  EXPECT_LT(largest_difference(channels.poses, channels_of(layout, clip).poses), 1e-8);
  Take back = carried;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    back.rotation(f, 1) = {};
    back.position(f, 1) = {};
  }
  decode_body(channels, layout, match, back);
  EXPECT_LT(largest_turn(carried, back), 1e-9);
  EXPECT_EQ(test::point_track(carried, 0), test::point_track(back, 0));
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    EXPECT_LT(norm(carried.position(f, 1) - back.position(f, 1)), 1e-9);
}

TEST(BodyOfJoints, TakesAnyNumberOfFrames) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  for (const std::size_t frames : {0, 1, 2, 3, 5}) {
    const Take few = slice(clip, 10, 10 + frames);
    const BodyMatch match = match_body(layout, few);
    const BodyChannels channels = encode_body(few, layout, match);
    EXPECT_EQ(channels.poses.frames, frames);
    EXPECT_EQ(channels.headings.size(), frames);
    for (const double v : channels.poses.values) EXPECT_TRUE(std::isfinite(v));
    Take back = few;
    decode_body(channels, layout, match, back);
    EXPECT_LT(largest_turn(few, back), 1e-9);
  }
}

}  // namespace
}  // namespace kinemend
