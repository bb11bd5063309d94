// Tests of the match between a layout and a skeleton: by names, by topology, and by a name map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body/body_takes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace body_test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// The take's name for a track of the layout, or "-" if unmatched.
std::string matched(const BodyLayout& layout, const Take& clip, std::string_view track,
                    const NameMap& names = {}) {
  const std::int32_t joint = match_body(layout, clip, names).tracks[track_named(layout, track)];
  return joint < 0 ? "-" : clip.skeleton.names[static_cast<std::size_t>(joint)];
}

// Adds the "Right" pair to each name that starts with "Left".
std::map<std::string, std::string> both_sides(std::map<std::string, std::string> names) {
  const auto other = [](std::string name) {
    for (const auto& [from, to] : {std::pair("Left", "Right"), {"left", "right"}, {"L ", "R "}}) {
      if (const auto at = name.find(from); at != name.npos)
        return name.replace(at, std::string_view(from).size(), to);
    }
    name[name.front() == 'l' ? 0 : name.size() - 1] = name.front() == 'l' ? 'r' : 'R';
    return name;
  };
  for (const auto& [from, to] : std::map(names)) {
    if (from.starts_with("Left")) names[other(from)] = other(to);
  }
  return names;
}

const std::map<std::string, std::string>& cmu_names() {
  static const auto names = both_sides({{"Hips", "root"},
                                        {"Spine", "lowerback"},
                                        {"Spine1", "upperback"},
                                        {"Spine2", "thorax"},
                                        {"Neck", "lowerneck"},
                                        {"Neck1", "upperneck"},
                                        {"Head", "head"},
                                        {"LeftShoulder", "lclavicle"},
                                        {"LeftArm", "lhumerus"},
                                        {"LeftForeArm", "lradius"},
                                        {"LeftHand", "lwrist"},
                                        {"LeftUpLeg", "lfemur"},
                                        {"LeftLeg", "ltibia"},
                                        {"LeftFoot", "lfoot"},
                                        {"LeftToeBase", "ltoes"}});
  return names;
}

TEST(MatchBody, FindsTheUsualSpellings) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const auto expect_same = [&](const std::map<std::string, std::string>& names) {
    const Take other = renamed(clip, names);
    for (const auto& [from, to] : names) {
      if (track_named(layout, from) == layout.track_count()) continue;
      EXPECT_EQ(matched(layout, other, from), to);
    }
    EXPECT_LT(largest_difference(channels_of(layout, clip).poses, channels_of(layout, other).poses),
              1e-9);
    // The match also works in the other direction.
    EXPECT_THAT(match_body(layout_of(other), clip).missing, IsEmpty());
  };
  expect_same(cmu_names());
  expect_same(both_sides({{"Spine", "Chest"},
                          {"Spine1", "Chest2"},
                          {"Spine2", "Chest3"},
                          {"LeftShoulder", "LeftCollar"},
                          {"LeftArm", "LeftShoulder"},
                          {"LeftForeArm", "LeftElbow"},
                          {"LeftHand", "LeftWrist"},
                          {"LeftUpLeg", "LeftHip"},
                          {"LeftLeg", "LeftKnee"},
                          {"LeftFoot", "LeftAnkle"},
                          {"LeftToeBase", "LeftToe"}}));
  expect_same(both_sides({{"Hips", "Bip01 Pelvis"},
                          {"Spine", "Bip01 Spine"},
                          {"Spine1", "Bip01 Spine1"},
                          {"Spine2", "Bip01 Spine2"},
                          {"LeftShoulder", "Bip01 L Clavicle"},
                          {"LeftArm", "Bip01 L UpperArm"},
                          {"LeftForeArm", "Bip01 L Forearm"},
                          {"LeftHand", "Bip01 L Hand"},
                          {"LeftUpLeg", "Bip01 L Thigh"},
                          {"LeftLeg", "Bip01 L Calf"},
                          {"LeftFoot", "Bip01 L Foot"},
                          {"LeftToeBase", "Bip01 L Toe0"}}));
  expect_same(both_sides({{"LeftShoulder", "Shoulder_L"},
                          {"LeftArm", "UpperArm_L"},
                          {"LeftForeArm", "LowerArm_L"},
                          {"LeftHand", "Hand_L"},
                          {"LeftUpLeg", "UpperLeg_L"},
                          {"LeftLeg", "LowerLeg_L"},
                          {"LeftFoot", "Foot_L"},
                          {"LeftToeBase", "Toes_L"}}));
}

// Removes a joint; its children become children of its parent and keep their world motion.
Take without_joint(const Take& clip, std::string_view name) {
  const auto gone = static_cast<std::size_t>(clip.skeleton.find(name));
  const std::int32_t above = clip.skeleton.parents[gone];
  Take result;
  result.frame_rate_hz = clip.frame_rate_hz;
  result.positions = clip.positions;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (j == gone) continue;
    std::int32_t parent = clip.skeleton.parents[j];
    Vec3 offset = clip.skeleton.offsets[j];
    if (parent == static_cast<std::int32_t>(gone)) {
      parent = above;
      offset += clip.skeleton.offsets[gone];
    }
    if (parent > static_cast<std::int32_t>(gone)) --parent;
    result.skeleton.add_joint(clip.skeleton.names[j], parent, offset, clip.skeleton.channels[j]);
  }
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      if (j == gone) continue;
      const bool child = clip.skeleton.parents[j] == static_cast<std::int32_t>(gone);
      result.rotations.push_back(child ? clip.rotation(f, gone) * clip.rotation(f, j)
                                       : clip.rotation(f, j));
    }
  }
  return result;
}

TEST(MatchBody, TellsTrunksOfOtherLengthsByTheirEnds) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const Take two =
      renamed(without_joint(clip, "Spine1"), {{"Spine", "Abdomen"}, {"Spine2", "Chest"}});
  EXPECT_EQ(matched(layout, two, "Spine"), "Abdomen");
  EXPECT_EQ(matched(layout, two, "Spine1"), "-");
  EXPECT_EQ(matched(layout, two, "Spine2"), "Chest");
  EXPECT_EQ(matched(layout, two, "LeftArm"), "LeftArm");
  const Take one =
      renamed(without_joint(without_joint(clip, "Spine1"), "Spine"), {{"Spine2", "Torso"}});
  EXPECT_EQ(matched(layout, one, "Spine"), "-");
  EXPECT_EQ(matched(layout, one, "Spine2"), "Torso");
  const Take neckless = without_joint(clip, "Neck1");
  EXPECT_EQ(matched(layout, neckless, "Neck"), "Neck");
  EXPECT_EQ(matched(layout, neckless, "Neck1"), "-");
  EXPECT_EQ(matched(layout, neckless, "Head"), "Head");
  // The take's trunk has more joints than the layout's.
  const BodyLayout shorter = layout_of(renamed(two, {{"Abdomen", "a"}, {"Chest", "b"}}));
  EXPECT_EQ(matched(shorter, clip, "a"), "Spine");
  EXPECT_EQ(matched(shorter, clip, "b"), "Spine2");
}

TEST(MatchBody, FindsByTopologyWhatHasAnotherName) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const Take odd = renamed(clip, {{"Hips", "XYZ"}, {"LeftLeg", "Knie"}, {"RightForeArm", "Q7"}});
  EXPECT_EQ(matched(layout, odd, "Hips"), "XYZ");
  EXPECT_EQ(matched(layout, odd, "LeftLeg"), "Knie");
  EXPECT_EQ(matched(layout, odd, "RightForeArm"), "Q7");
  EXPECT_LT(largest_difference(channels_of(layout, clip).poses, channels_of(layout, odd).poses),
            1e-9);
}

TEST(MatchBody, LetsGoOfJointsThatHangElsewhere) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  // The left arm is a child of the hips.
  Take odd = renamed(clip, {{"Head", "Skull"}});
  odd.skeleton.parents[static_cast<std::size_t>(odd.skeleton.find("LeftArm"))] = 0;
  const BodyMatch match = match_body(layout, odd);
  EXPECT_EQ(matched(layout, odd, "LeftArm"), "-");
  EXPECT_THAT(match.missing, Contains("LeftArm"));
  EXPECT_THAT(match.unknown, Contains("LeftArm"));
  EXPECT_EQ(matched(layout, odd, "RightArm"), "RightArm");
}

TEST(MatchBody, ListsWhatIsMissingAndUnknown) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const BodyMatch match =
      match_body(layout, without_joint(renamed(clip, {{"Head", "Lamp"}}), "LeftToeBase"));
  EXPECT_THAT(match.missing, ElementsAre("LeftToeBase", "Head"));
  EXPECT_THAT(match.unknown, Contains("Lamp"));
  EXPECT_EQ(match.tracks[track_named(layout, "Head")], -1);
}

TEST(MatchBody, RefusesAStrangerWithTheJointsNamed) {
  const BodyLayout layout = layout_of(walk());
  try {
    match_body(layout, synthesize({"spin", 1, 60, 1, false}));
    FAIL();
  } catch (const Error& error) {
    const std::string count = std::to_string(layout.track_count());
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(),
                HasSubstr("the model knows " + count + " joints, of which the take lacks "));
    for (const std::string& name : layout.names) EXPECT_THAT(error.what(), HasSubstr(name));
  }
}

TEST(MatchBody, TakesTheWordOfANameMap) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  std::map<std::string, std::string> numbers;
  NameMap map;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const std::string& name = clip.skeleton.names[j];
    numbers[name] = "bone-" + std::to_string(j) + "x";
    if (track_named(layout, name) < layout.track_count()) map[name] = numbers[name];
  }
  const Take other = renamed(clip, numbers);
  EXPECT_THROW(match_body(layout, other), Error);
  EXPECT_THAT(match_body(layout, other, map).missing, IsEmpty());
  // Body height, floor and axes are found as well as with usual names.
  EXPECT_LT(largest_difference(channels_of(layout, clip).poses,
                               channels_of(layout, turn_axes(other, Axis::y, Axis::z), map).poses),
            1e-8);
  EXPECT_EQ(matched(layout, clip, "LeftArm", {{"LeftArm", ""}}), "-");
  EXPECT_EQ(matched(layout, clip, "LeftHand", {{"LeftArm", ""}}), "LeftHand");
}

TEST(MatchBody, RefusesNamesOfAMapThatThereAreNot) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const auto message = [&](const NameMap& map) -> std::string {
    try {
      match_body(layout, clip, map);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message({{"Tail", "Hips"}}), HasSubstr("the model has no joint \"Tail\""));
  EXPECT_THAT(message({{"Hips", "Tail"}}), HasSubstr("the take has no joint \"Tail\""));
}

TEST(MatchBody, MeasuresBodyHeightWhateverTheRestPose) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const double body_height = match_body(layout, clip).body_height;
  EXPECT_NEAR(body_height, 172, 10);
  EXPECT_NEAR(match_body(layout, scale_lengths(clip, 0.01)).body_height, 0.01 * body_height, 1e-9);
}

TEST(MatchBody, IsExactForTheSameSkeleton) {
  const Take clip = walk();
  const BodyMatch match = match_body(layout_of(clip), clip);
  EXPECT_EQ(match.upright, Quat{});
  for (std::size_t i = 0; i < match.tracks.size(); ++i) {
    EXPECT_EQ(match.before[i], Quat{});
    EXPECT_EQ(match.after[i], Quat{});
  }
}

TEST(MatchBody, FindsTheWorldsUpAxisWhereTheRestPoseHasAnother) {
  // The rest pose of this skeleton is upright along z; y is up in the world.
  const Take clip = walk("stroll");
  Take z_up = turn_axes(clip, Axis::y, Axis::z);
  const Quat back = exp({-pi / 2, 0, 0});
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    z_up.rotation(f, 0) = back * z_up.rotation(f, 0);
    z_up.root_position(f) = rotate(back, z_up.root_position(f));
  }
  ASSERT_LT(norm(forward_kinematics(clip, 40).positions.back() -
                 forward_kinematics(z_up, 40).positions.back()),
            1e-9);
  const BodyLayout layout = layout_of(clip);
  EXPECT_LT(largest_difference(channels_of(layout, clip).poses, channels_of(layout, z_up).poses),
            1e-8);
}

TEST(MatchBody, StaysTheSameUnderNoise) {
  const Take clip = walk("stroll");
  const BodyLayout layout = layout_of(clip);
  Take noisy = turn_axes(clip, Axis::y, Axis::z);
  const BodyMatch expected = match_body(layout, noisy);
  Random random(7);
  for (Quat& q : noisy.rotations)
    q = normalized(q * exp(normal_vector(random, 10 * radians_per_degree)));
  const BodyMatch found = match_body(layout, noisy);
  EXPECT_EQ(found.upright, expected.upright);
  EXPECT_EQ(found.before, expected.before);
  EXPECT_EQ(found.after, expected.after);
  EXPECT_EQ(found.body_height, expected.body_height);
}

}  // namespace
}  // namespace kinemend
