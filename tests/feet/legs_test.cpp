// Tests that legs are found in the skeletons of many programs.
#include <gmock/gmock.h>

#include "feet/support.hpp"

namespace kinemend {
namespace {

using test::synthetic_clip;

// The names of a leg from the hip down.
struct Dialect {
  const char* name;
  std::vector<std::string> left, right;  // hip, knee, ankle, toe
};

const std::vector<Dialect>& dialects() {
  static const std::vector<Dialect> all = {
      {"CMU BVH",
       {"LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase"},
       {"RightUpLeg", "RightLeg", "RightFoot", "RightToeBase"}},
      {"Acclaim", {"lfemur", "ltibia", "lfoot", "ltoes"}, {"rfemur", "rtibia", "rfoot", "rtoes"}},
      {"Xsens",
       {"LeftHip", "LeftKnee", "LeftAnkle", "LeftToe"},
       {"RightHip", "RightKnee", "RightAnkle", "RightToe"}},
      {"Bandai",
       {"UpperLeg_L", "LowerLeg_L", "Foot_L", "Toes_L"},
       {"UpperLeg_R", "LowerLeg_R", "Foot_R", "Toes_R"}},
      {"Mixamo",
       {"mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot", "mixamorig:LeftToeBase"},
       {"mixamorig:RightUpLeg", "mixamorig:RightLeg", "mixamorig:RightFoot",
        "mixamorig:RightToeBase"}},
      {"Rigify",
       {"thigh.L", "shin.L", "foot.L", "toe.L"},
       {"thigh.R", "shin.R", "foot.R", "toe.R"}},
      {"Biped",
       {"Bip01 L Thigh", "Bip01 L Calf", "Bip01 L Foot", "Bip01 L Toe0"},
       {"Bip01 R Thigh", "Bip01 R Calf", "Bip01 R Foot", "Bip01 R Toe0"}},
      {"Unreal",
       {"thigh_l", "calf_l", "foot_l", "ball_l"},
       {"thigh_r", "calf_r", "foot_r", "ball_r"}},
      {"Unity",
       {"LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "LeftToes"},
       {"RightUpperLeg", "RightLowerLeg", "RightFoot", "RightToes"}},
      {"Mixamo without a colon",
       {"mixamorigLeftUpLeg", "mixamorigLeftLeg", "mixamorigLeftFoot", "mixamorigLeftToeBase"},
       {"mixamorigRightUpLeg", "mixamorigRightLeg", "mixamorigRightFoot", "mixamorigRightToeBase"}},
      {"VRM",
       {"J_Bip_L_UpperLeg", "J_Bip_L_LowerLeg", "J_Bip_L_Foot", "J_Bip_L_ToeBase"},
       {"J_Bip_R_UpperLeg", "J_Bip_R_LowerLeg", "J_Bip_R_Foot", "J_Bip_R_ToeBase"}},
      {"MotionBuilder",
       {"Character1_Ctrl:LeftUpLeg", "Character1_Ctrl:LeftLeg", "Character1_Ctrl:LeftFoot",
        "Character1_Ctrl:LeftToeBase"},
       {"Character1_Ctrl:RightUpLeg", "Character1_Ctrl:RightLeg", "Character1_Ctrl:RightFoot",
        "Character1_Ctrl:RightToeBase"}},
      {"HumanIK",
       {"Character1_LeftUpLeg", "Character1_LeftLeg", "Character1_LeftFoot",
        "Character1_LeftToeBase"},
       {"Character1_RightUpLeg", "Character1_RightLeg", "Character1_RightFoot",
        "Character1_RightToeBase"}},
      {"SMPL", {"L_Hip", "L_Knee", "L_Ankle", "L_Foot"}, {"R_Hip", "R_Knee", "R_Ankle", "R_Foot"}},
  };
  return all;
}

TEST(FindLegs, KnowsTheLegsOfManyDialects) {
  const Take clip = synthetic_clip("walk", 0.1);
  for (const Dialect& dialect : dialects()) {
    Skeleton skeleton = clip.skeleton;
    const std::array<const char*, 4> joints{"UpLeg", "Leg", "Foot", "ToeBase"};
    for (std::size_t i = 0; i < 4; ++i) {
      skeleton
          .names[static_cast<std::size_t>(clip.skeleton.find(std::string("Left") + joints[i]))] =
          dialect.left[i];
      skeleton
          .names[static_cast<std::size_t>(clip.skeleton.find(std::string("Right") + joints[i]))] =
          dialect.right[i];
    }
    const std::vector<Leg> legs = find_legs(skeleton);
    ASSERT_EQ(legs.size(), 2u) << dialect.name;
    EXPECT_EQ(legs[0].side, "left") << dialect.name;
    EXPECT_EQ(legs[1].side, "right") << dialect.name;
    EXPECT_EQ(legs[0].hip, clip.skeleton.find("LeftUpLeg")) << dialect.name;
    EXPECT_EQ(legs[0].knee, clip.skeleton.find("LeftLeg")) << dialect.name;
    EXPECT_EQ(legs[0].ankle, clip.skeleton.find("LeftFoot")) << dialect.name;
    EXPECT_EQ(legs[1].toe, clip.skeleton.find("RightToeBase")) << dialect.name;
  }
}

TEST(FindLegs, PassesOverTwistBones) {
  Skeleton skeleton;
  const auto zxy = make_channels(false, parse_rotation_order("ZXY"));
  skeleton.add_joint("Hips", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
  skeleton.add_joint("LeftUpLeg", 0, {10, 0, 0}, zxy);
  skeleton.add_joint("LeftUpLegTwist", 1, {0, -20, 0}, zxy);
  skeleton.add_joint("LeftLeg", 2, {0, -22, 0}, zxy);
  skeleton.add_joint("LeftLegRoll", 3, {0, -20, 0}, zxy);
  skeleton.add_joint("LeftFoot", 4, {0, -21, 0}, zxy);
  skeleton.add_joint("Head", 0, {0, 70, 0}, zxy);
  const std::vector<Leg> legs = find_legs(skeleton);
  ASSERT_EQ(legs.size(), 1u);
  EXPECT_EQ(legs[0].hip, 1);
  EXPECT_EQ(legs[0].knee, 3);
  EXPECT_EQ(legs[0].ankle, 5);
  EXPECT_EQ(legs[0].toe, -1);
}

TEST(FindLegs, FindsNoneWhereThereAreNone) {
  EXPECT_TRUE(find_legs(synthetic_clip("spin", 0.1).skeleton).empty());
  EXPECT_TRUE(find_legs(Skeleton{}).empty());
  Skeleton table;  // a foot without a leg
  table.add_joint("foot", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
  EXPECT_TRUE(find_legs(table).empty());
}

}  // namespace
}  // namespace kinemend
