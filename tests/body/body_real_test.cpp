// Tests of bodies on real takes: one motion in two formats, and walks of other skeletons.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "body/body_takes.hpp"
#include "kinemend/io.hpp"

namespace kinemend {
namespace {

using namespace body_test;
using testing::IsEmpty;

std::filesystem::path data(std::string_view path) {
  return std::filesystem::path(KINEMEND_DATA_FOLDER) / path;
}

Take motion(std::string_view path) {
  const Take clip = read_joints(data(path)).take;
  return slice(clip, leading_calibration_frames(clip), clip.frame_count());
}

Take markers(std::string_view path) { return read_take(data(path)).take; }

std::string_view take_name(const Take& clip, const BodyMatch& match, std::size_t track) {
  return match.tracks[track] < 0
             ? std::string_view("-")
             : clip.skeleton.names[static_cast<std::size_t>(match.tracks[track])];
}

TEST(RealBodies, DecodeWhatTheyEncode) {
  const BodyLayout layout = layout_of(motion("cmu/bvh/35_01.bvh"));
  for (const char* path :
       {"cmu/bvh/35_01.bvh", "cmu/bvh/01_01.bvh", "cmu/amc/05/05_02.amc", "cmu/amc/49/49_01.amc",
        "bvh-other/bvh-python/test_freebvh.bvh", "bvh-other/pybvh/bvh_data_bvh_example.bvh",
        "bvh-other/bvh-python/test_mocapbank.bvh", "paired/S02-Trial-Walk-1-xsens.bvh"}) {
    const Take clip = motion(path);
    const BodyMatch match = match_body(layout, clip);
    Take back = clip;
    for (const std::int32_t joint : match.tracks) {
      for (std::size_t f = 0; joint >= 0 && f < clip.frame_count(); ++f)
        back.rotation(f, static_cast<std::size_t>(joint)) = exp({0.3, 0.2, 1});
    }
    for (std::size_t f = 0; f < clip.frame_count(); ++f) back.root_position(f) = {};
    decode_body(encode_body(clip, layout, match), layout, match, back);
    for (std::size_t i = 0; i < clip.rotations.size(); ++i)
      ASSERT_LT(angle_between(clip.rotations[i], back.rotations[i]), 1e-9) << path;
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      ASSERT_LT(norm(clip.root_position(f) - back.root_position(f)), 1e-9 * match.body_height);
  }
}

TEST(RealBodies, SeeOneTakeInTwoFormatsAlike) {
  for (const auto& [bvh, amc] : {std::pair("cmu/bvh/35_01.bvh", "cmu/amc/35/35_01.amc"),
                                 std::pair("cmu/bvh/35_17.bvh", "cmu/amc/35/35_17.amc"),
                                 std::pair("cmu/bvh/16_35.bvh", "cmu/amc/16/16_35.amc"),
                                 std::pair("cmu/bvh/07_01.bvh", "cmu/amc/07/07_01.amc"),
                                 std::pair("cmu/bvh/09_01.bvh", "cmu/amc/09/09_01.amc")}) {
    if (!std::filesystem::exists(data(bvh)) || !std::filesystem::exists(data(amc))) continue;
    const Take a = motion(bvh), b = motion(amc);
    const BodyLayout layout = layout_of(a);
    const BodyMatch match = match_body(layout, b);
    EXPECT_THAT(match.missing, IsEmpty()) << amc;
    const BodyChannels expected = channels_of(layout, a), found = encode_body(b, layout, match);
    ASSERT_EQ(expected.poses.frames, found.poses.frames) << amc;
    for (std::size_t i = 0; i <= layout.track_count(); ++i) {
      EXPECT_LT(rms_difference(expected.poses, found.poses, i), 0.3)
          << amc << " "
          << (i < layout.track_count() ? layout.names[i] + " " + std::string(take_name(b, match, i))
                                       : "place");
    }
  }
}

TEST(RealBodies, FindTheJointsOfOtherSkeletons) {
  const BodyLayout layout = layout_of(motion("cmu/bvh/35_01.bvh"));
  const auto expect = [&](const char* path, const std::map<std::string, std::string>& names) {
    const Take clip = motion(path);
    const BodyMatch match = match_body(layout, clip);
    for (const auto& [track, name] : names)
      EXPECT_EQ(take_name(clip, match, track_named(layout, track)), name) << path << " " << track;
  };
  expect("paired/S02-Trial-Walk-1-xsens.bvh", {{"LeftUpLeg", "LeftHip"},
                                               {"LeftFoot", "LeftAnkle"},
                                               {"LowerBack", "Chest"},
                                               {"Spine1", "Chest4"},
                                               {"LeftArm", "LeftShoulder"},
                                               {"RightHand", "RightWrist"},
                                               {"Neck1", "-"}});
  expect("bvh-other/bandai-namco/dataset-1_walk_normal_001.bvh", {{"Hips", "Hips"},
                                                                  {"LeftUpLeg", "UpperLeg_L"},
                                                                  {"Spine1", "Chest"},
                                                                  {"RightArm", "UpperArm_R"}});
  expect("bvh-other/GPmat/Swagger.bvh", {{"Hips", "root"},
                                         {"LeftUpLeg", "lfemur"},
                                         {"Spine1", "upperback"},
                                         {"Neck", "thorax"},
                                         {"LeftArm", "lhumerus"}});
  expect("bvh-other/lawrennd-mocap/python_files_10_01.bvh", {{"Hips", "hip"},
                                                             {"LeftUpLeg", "lThigh"},
                                                             {"LowerBack", "abdomen"},
                                                             {"LeftArm", "lShldr"},
                                                             {"LThumb", "lThumb1"}});
}

// Walks on other skeletons, rest poses and programs lie near the means of a CMU walk.
TEST(RealBodies, SeeWalksOfOtherSkeletonsMuchAlike) {
  const BodyLayout layout = layout_of(motion("cmu/bvh/35_01.bvh"));
  for (const char* path :
       {"bvh-other/bvh-python/test_freebvh.bvh", "bvh-other/Mocap-Data-Utilities/Male1_B3_Walk.bvh",
        "bvh-other/bandai-namco/dataset-1_walk_normal_001.bvh",
        "bvh-other/pybvh/bvh_data_bvh_example.bvh", "paired/S02-Trial-Walk-1-xsens.bvh"}) {
    const Take clip = motion(path);
    const BodyMatch match = match_body(layout, clip);
    const BodyChannels channels = encode_body(clip, layout, match);
    for (const char* name : {"Hips", "LeftUpLeg", "LeftLeg", "RightUpLeg", "RightLeg", "LowerBack",
                             "Spine1", "LeftArm", "RightArm"}) {
      const std::size_t track = track_named(layout, name);
      ASSERT_GE(match.tracks[track], 0) << path << " " << name;
      for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
        double sum = 0;
        for (std::size_t f = 0; f < channels.poses.frames; ++f) sum += channels.poses(f, c);
        EXPECT_LT(std::fabs(sum / static_cast<double>(channels.poses.frames)), 35)
            << path << " " << layout.channel_name(c);
      }
    }
  }
}

TEST(RealBodies, OfMarkersDecodeAndStand) {
  const Take clip = markers("cmu/c3d/85_12.c3d");
  const BodyLayout layout = layout_of(clip);
  const auto is_anchor = [&](const char* name) {
    return layout.anchors[track_named(layout, name)] != 0;
  };
  for (const char* name : {"LFWT", "RBWT", "CLAV", "STRN", "C7", "T10"})
    EXPECT_TRUE(is_anchor(name)) << name;
  for (const char* name : {"LFIN", "RELB", "LTOE", "RKNE"}) EXPECT_FALSE(is_anchor(name)) << name;
  EXPECT_GT(layout.means[track_named(layout, "LSHO")].x, 0.05);
  EXPECT_LT(layout.means[track_named(layout, "RSHO")].x, -0.05);
  const Take other = markers("cmu/c3d/85_02.c3d");
  const BodyMatch match = match_body(layout, other);
  EXPECT_THAT(match.missing, IsEmpty());
  EXPECT_NEAR(match.body_height, 1700, 60);
  Take back = other;
  for (Vec3& p : back.positions) p = {};
  decode_body(encode_body(other, layout, match), layout, match, back);
  for (std::size_t f = 0; f < other.frame_count(); ++f) {
    for (const std::int32_t marker : match.tracks) {
      const auto m = static_cast<std::size_t>(marker);
      if (!other.is_observed(f, m)) continue;
      ASSERT_LT(norm(other.position(f, m) - back.position(f, m)), 1e-9);
    }
  }
}

TEST(RealBodies, HardlyMissTheMarkersOfBothArms) {
  const Take clip = markers("cmu/c3d/85_12.c3d");
  const BodyLayout layout = layout_of(clip);
  const BodyChannels whole = channels_of(layout, clip);
  const auto is_of_an_arm = [](std::string_view name) {
    for (const char* word : {"UPA", "ELB", "FRM", "WRA", "WRB", "FIN"}) {
      if (name.find(word) != name.npos) return true;
    }
    return false;
  };
  Take armless = clip;
  for (std::size_t i = 0; i < armless.observed.size(); ++i) {
    if (is_of_an_arm(clip.names[i % clip.marker_count()])) armless.observed[i] = 0;
  }
  const BodyChannels channels = channels_of(layout, armless);
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    if (is_of_an_arm(layout.names[i])) continue;
    EXPECT_LT(rms_difference(whole.poses, channels.poses, i), 0.1) << layout.names[i];
  }
}

}  // namespace
}  // namespace kinemend
