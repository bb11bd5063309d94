// Tests of bodies of markers, with noise, missing markers and several people.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "body/body_takes.hpp"
#include "kinemend/error.hpp"

namespace kinemend {
namespace {

using namespace body_test;
using testing::HasSubstr;

Take marker_walk(std::string motion = "walk") {
  return joint_markers(walk(std::move(motion)), true);
}

double largest_shift_of_markers(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    if (a.observed[i] != 0) largest = std::max(largest, norm(a.positions[i] - b.positions[i]));
  }
  return largest;
}

bool is_of_an_arm(std::string_view name) {
  return name.find("Arm") != name.npos || name.find("Hand") != name.npos;
}

TEST(BodyOfMarkers, DecodesWhatItEncodes) {
  for (const char* motion : {"walk", "turn", "stroll", "jump"}) {
    const Take clip = marker_walk(motion);
    const BodyLayout layout = layout_of(clip);
    const BodyMatch match = match_body(layout, clip);
    Take back = clip;
    for (Vec3& p : back.positions) p = {1, 2, 3};
    decode_body(encode_body(clip, layout, match), layout, match, back);
    EXPECT_LT(largest_shift_of_markers(clip, back), 1e-9) << motion;
    EXPECT_EQ(clip.observed, back.observed);
  }
}

TEST(BodyOfMarkers, StandsUprightAndFacesAhead) {
  const BodyLayout layout = layout_of(turn_axes(marker_walk("stroll"), Axis::y, Axis::z));
  const auto mean = [&](const char* name) { return layout.means[track_named(layout, name)]; };
  EXPECT_GT(mean("LeftUpLeg").x, 0.04);
  EXPECT_LT(mean("RightUpLeg").x, -0.04);
  EXPECT_GT(mean("Head").y, 0.85);
  EXPECT_GT(mean("LeftToeBase").z, mean("LeftFoot").z + 0.02);
  EXPECT_NEAR(mean("LeftToeBase").y, 0.03, 0.03);
  EXPECT_NE(layout.anchors[track_named(layout, "Spine1")], 0);
  EXPECT_EQ(layout.anchors[track_named(layout, "LeftHand")], 0);
}

TEST(BodyOfMarkers, DoesNotSeePlaceHeadingAxesAndUnits) {
  const Take clip = marker_walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const PoseMatrix expected = channels_of(layout, clip).poses;
  for (const double heading : {0.4, 2.0, -3.1}) {
    const Take other = moved(clip, heading, {300, 20, -1000});
    EXPECT_LT(largest_difference(expected, channels_of(layout, other).poses), 1e-7) << heading;
  }
  EXPECT_LT(
      largest_difference(expected, channels_of(layout, turn_axes(clip, Axis::y, Axis::z)).poses),
      1e-7);
  EXPECT_LT(largest_difference(expected, channels_of(layout, scale_lengths(clip, 10, "mm")).poses),
            1e-7);
}

TEST(BodyOfMarkers, MeansAreZeroWhereTheyWereLearned) {
  const Take clip = marker_walk();
  const BodyLayout layout = layout_of(clip);
  const BodyChannels channels = channels_of(layout, clip);
  for (std::size_t c = 0; c < layout.channel_count(); ++c) {
    double sum = 0;
    for (std::size_t f = 0; f < channels.poses.frames; ++f) sum += channels.poses(f, c);
    EXPECT_NEAR(sum / static_cast<double>(channels.poses.frames), 0, 1.5) << layout.channel_name(c);
  }
}

TEST(BodyOfMarkers, KeepsItsFrameUnderNoiseAndSpikes) {
  const Take clip = marker_walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const BodyChannels clean = channels_of(layout, clip);
  Take noisy = clip;
  Random random(1);
  for (Vec3& p : noisy.positions) p += normal_vector(random, 1);
  for (std::size_t f = 10; f < clip.frame_count(); f += 37) {
    for (std::size_t m = 0; m < clip.marker_count(); m += 3)
      noisy.position(f, m) += Vec3{100, 50, -80};
  }
  const BodyChannels found = channels_of(layout, noisy);
  EXPECT_NEAR(found.degrees_per_unit / clean.degrees_per_unit, 1, 0.01);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_NEAR(found.headings[f], clean.headings[f], 1.2 * radians_per_degree) << f;
    Vec3 shift = found.places[f] - clean.places[f];
    EXPECT_LT(std::fabs(shift.y), 1.2) << f;
    shift.y = 0;
    EXPECT_LT(norm(shift), 0.6) << f;
  }
}

TEST(BodyOfMarkers, HeedsNoAnchorThatLiesFarOff) {
  const Take clip = marker_walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const BodyChannels clean = channels_of(layout, clip);
  Take odd = clip;
  const auto shoulder = static_cast<std::size_t>(clip.find("LeftArm"));
  ASSERT_NE(layout.anchors[track_named(layout, "LeftArm")], 0);
  for (std::size_t f = 40; f < 120; ++f) odd.position(f, shoulder) += Vec3{60, 0, 40};
  const BodyChannels found = channels_of(layout, odd);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_NEAR(found.headings[f], clean.headings[f], 2.5 * radians_per_degree) << f;
    EXPECT_LT(norm(found.places[f] - clean.places[f]), 1) << f;
  }
}

TEST(BodyOfMarkers, HardlyMissesBothArms) {
  const Take clip = marker_walk("stroll");
  const BodyLayout layout = layout_of(clip);
  const BodyChannels whole = channels_of(layout, clip);
  Take armless = clip;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (!is_of_an_arm(clip.names[m])) continue;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      armless.observed[f * clip.marker_count() + m] = 0;
      armless.position(f, m) = {};
    }
  }
  const BodyMatch match = match_body(layout, armless);
  EXPECT_TRUE(match.missing.empty());
  const BodyChannels channels = encode_body(armless, layout, match);
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    const bool arm = is_of_an_arm(layout.names[i]);
    EXPECT_EQ(channels.observed[3 * i], arm ? 0 : 1);
    if (arm)
      EXPECT_EQ(channels.poses(20, 3 * i), 0);
    else
      EXPECT_LT(rms_difference(whole.poses, channels.poses, i), 1.5) << layout.names[i];
  }
  // Learns the layout from a body without arms.
  Take without = make_marker_take({}, 0, clip.frame_rate_hz);
  for (const std::string& name : clip.names) {
    if (!is_of_an_arm(name)) without.names.push_back(name);
  }
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      if (!is_of_an_arm(clip.names[m])) without.positions.push_back(clip.position(f, m));
    }
  }
  without.observed.assign(without.positions.size(), 1);
  const BodyMatch other = match_body(layout, without);
  EXPECT_FALSE(other.missing.empty());
  const BodyChannels found = encode_body(without, layout, other);
  EXPECT_LT(rms_difference(whole.poses, found.poses, track_named(layout, "LeftFoot")), 1.5);
}

TEST(BodyOfMarkers, BridgesFramesWithoutAnchors) {
  const Take clip = marker_walk();
  const BodyLayout layout = layout_of(clip);
  const BodyChannels whole = channels_of(layout, clip);
  Take gappy = clip;
  for (std::size_t f = 60; f < 90; ++f) {
    for (std::size_t m = 0; m < clip.marker_count(); ++m)
      gappy.observed[f * clip.marker_count() + m] = 0;
  }
  const BodyChannels channels = channels_of(layout, gappy);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_NEAR(channels.headings[f], whole.headings[f], 3 * radians_per_degree);
    EXPECT_LT(norm(channels.places[f] - whole.places[f]), 6);
  }
  EXPECT_EQ(channels.poses(75, 0), channels.poses(59, 0));
  EXPECT_EQ(channels.observed[75 * layout.channel_count()], 0);
}

Take of_subject(Take clip, const std::string& prefix) {
  for (std::string& name : clip.names) name = prefix + name;
  return clip;
}

TEST(BodyOfMarkers, FindsNamesInAnyCaseAndOfAnySubject) {
  const Take clip = joint_markers(walk());
  const BodyLayout layout = layout_of(clip);
  const auto tracks = match_body(layout, clip).tracks;
  for (const char* prefix : {"Ann:", "Subject36_"}) {
    const Take ann = of_subject(clip, prefix);
    EXPECT_EQ(match_body(layout, ann).tracks, tracks) << prefix;
    EXPECT_EQ(match_body(layout_of(ann), clip).tracks, tracks) << prefix;
  }
  Take upper = clip;
  for (std::string& name : upper.names)
    std::transform(name.begin(), name.end(), name.begin(), ::toupper);
  EXPECT_EQ(match_body(layout, upper).tracks, tracks);
}

TEST(BodyOfMarkers, DoesNotMixTwoPeople) {
  const Take clip = joint_markers(walk());
  const BodyLayout layout = layout_of(clip);
  const std::size_t count = clip.marker_count();
  Take two = of_subject(clip, "Ann:");
  for (const std::string& name : clip.names) two.names.push_back("Bob:" + name);
  two.names[3] = "Ann:lost";
  two.positions.clear();
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t m = 0; m < 2 * count; ++m)
      two.positions.push_back(clip.position(f, m % count) + Vec3{m < count ? 0.0 : 200.0, 0, 0});
  }
  two.observed.assign(two.positions.size(), 1);
  two.is_position.clear();
  two.residuals.clear();
  // Ann is observed in more frames, but one of her markers never is.
  for (std::size_t i = 0; i < two.observed.size(); i += 3) {
    if (i % (2 * count) >= count) two.observed[i] = 0;
  }
  const BodyMatch match = match_body(layout, two);
  ASSERT_EQ(match.tracks.size(), layout.track_count());
  for (const std::int32_t marker : match.tracks)
    EXPECT_GE(marker, static_cast<std::int32_t>(count));
}

TEST(BodyOfMarkers, RefusesWhatItDoesNotKnow) {
  const Take clip = marker_walk();
  const BodyLayout layout = layout_of(clip);
  Take other = clip;
  for (std::size_t m = 3; m < clip.marker_count(); ++m) other.names[m] = "x" + std::to_string(m);
  try {
    match_body(layout, other);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("the model knows " + std::to_string(layout.track_count()) +
                                        " markers, of which the take lacks " +
                                        std::to_string(layout.track_count() - 3)));
    EXPECT_THAT(error.what(), HasSubstr(layout.names.back()));
  }
  NameMap map;
  for (std::size_t m = 3; m < clip.marker_count(); ++m) map[clip.names[m]] = other.names[m];
  EXPECT_EQ(match_body(layout, other, map).tracks, match_body(layout, clip).tracks);
  EXPECT_THROW(match_body(layout, walk()), Error);
  EXPECT_THROW(match_body(layout_of(walk()), clip), Error);
}

TEST(BodyOfMarkers, TakesAnyNumberOfFrames) {
  const Take clip = marker_walk();
  const BodyLayout layout = layout_of(clip);
  for (const std::size_t frames : {0, 1, 2, 3}) {
    Take few = slice(clip, 10, 10 + frames);
    const BodyMatch match = match_body(layout, few);
    const BodyChannels channels = encode_body(few, layout, match);
    EXPECT_EQ(channels.poses.frames, frames);
    for (const double v : channels.poses.values) EXPECT_TRUE(std::isfinite(v));
    decode_body(channels, layout, match, few);
  }
}

}  // namespace
}  // namespace kinemend
