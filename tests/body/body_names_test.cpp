// Tests of the parts of the body that names of bones mean.
#include "body/body_names.hpp"

#include <gtest/gtest.h>

namespace kinemend::representation {
namespace {

struct Spelled {
  const char* name;
  Side side;
  Bone bone;
};

// Checks names that occur together in one skeleton.
void expect_bones(const std::vector<Spelled>& skeleton) {
  std::vector<std::string> names;
  for (const Spelled& joint : skeleton) names.emplace_back(joint.name);
  const std::vector<BoneName> bones = bone_names(names);
  for (std::size_t j = 0; j < names.size(); ++j) {
    EXPECT_EQ(bones[j].bone, skeleton[j].bone) << names[j];
    EXPECT_EQ(bones[j].side, skeleton[j].side) << names[j];
  }
}

constexpr Side none = Side::none, left = Side::left, right = Side::right;

TEST(BoneNames, KnowTheCmuSpellings) {
  expect_bones({{"root", none, Bone::pelvis},        {"lhipjoint", left, Bone::hip},
                {"lfemur", left, Bone::thigh},       {"ltibia", left, Bone::shin},
                {"lfoot", left, Bone::foot},         {"ltoes", left, Bone::toe},
                {"rfemur", right, Bone::thigh},      {"rtoes", right, Bone::toe},
                {"lowerback", none, Bone::spine},    {"upperback", none, Bone::spine},
                {"thorax", none, Bone::spine},       {"lowerneck", none, Bone::neck},
                {"upperneck", none, Bone::neck},     {"head", none, Bone::head},
                {"lclavicle", left, Bone::clavicle}, {"lhumerus", left, Bone::upper_arm},
                {"lradius", left, Bone::forearm},    {"lwrist", left, Bone::hand},
                {"lhand", left, Bone::palm},         {"rradius", right, Bone::forearm}});
  expect_bones({{"Hips", none, Bone::pelvis},
                {"LHipJoint", left, Bone::hip},
                {"LeftUpLeg", left, Bone::thigh},
                {"LeftLeg", left, Bone::shin},
                {"LeftToeBase", left, Bone::toe},
                {"LowerBack", none, Bone::spine},
                {"Neck1", none, Bone::neck},
                {"RightShoulder", right, Bone::clavicle},
                {"RightArm", right, Bone::upper_arm},
                {"RightForeArm", right, Bone::forearm},
                {"RightHand", right, Bone::hand},
                {"RightFingerBase", right, Bone::palm}});
}

TEST(BoneNames, ReadAWordBesideTheOthers) {
  // MotionBuilder and Biovision use the same names for different shoulders, legs and hips.
  expect_bones({{"LeftShoulder", left, Bone::clavicle},
                {"LeftArm", left, Bone::upper_arm},
                {"LeftLeg", left, Bone::shin},
                {"LeftUpLeg", left, Bone::thigh}});
  expect_bones({{"LeftCollar", left, Bone::clavicle},
                {"LeftShoulder", left, Bone::upper_arm},
                {"LeftElbow", left, Bone::forearm},
                {"LeftWrist", left, Bone::hand},
                {"LeftHip", left, Bone::thigh},
                {"LeftKnee", left, Bone::shin},
                {"LeftAnkle", left, Bone::foot}});
  // SMPL: beside an ankle, a foot means the toes; beside a wrist, a hand means the palm.
  expect_bones({{"m_avg_Pelvis", none, Bone::other},
                {"left_hip", left, Bone::thigh},
                {"left_ankle", left, Bone::foot},
                {"left_foot", left, Bone::toe},
                {"spine3", none, Bone::spine},
                {"left_wrist", left, Bone::hand},
                {"left_hand", left, Bone::palm}});
}

TEST(BoneNames, DropPrefixesAndFindSides) {
  expect_bones({{"mixamorig:Hips", none, Bone::pelvis},
                {"mixamorig:Spine2", none, Bone::spine},
                {"mixamorig:LeftForeArm", left, Bone::forearm},
                {"mixamorig:RightUpLeg", right, Bone::thigh},
                {"mixamorig:LeftEye", left, Bone::other}});
  expect_bones({{"Bip01", none, Bone::pelvis},
                {"Bip01 Pelvis", none, Bone::pelvis},
                {"Bip01 L Thigh", left, Bone::thigh},
                {"Bip01 R Calf", right, Bone::shin},
                {"Bip01 L Toe0", left, Bone::toe},
                {"Bip01 R UpperArm", right, Bone::upper_arm},
                {"Bip01 Spine1", none, Bone::spine}});
  expect_bones({{"mixamorigHips", none, Bone::pelvis},
                {"mixamorigLeftForeArm", left, Bone::forearm},
                {"mixamorigLeftHand", left, Bone::hand},
                {"mixamorigRightUpLeg", right, Bone::thigh},
                {"mixamorigRightToeBase", right, Bone::toe}});
  expect_bones({{"Character1_Ctrl:Hips", none, Bone::pelvis},
                {"Character1_Ctrl:LeftUpLeg", left, Bone::thigh},
                {"Character1_Ctrl:RightForeArm", right, Bone::forearm}});
  expect_bones({{"pelvis", none, Bone::pelvis},
                {"spine_03", none, Bone::spine},
                {"clavicle_l", left, Bone::clavicle},
                {"upperarm_r", right, Bone::upper_arm},
                {"lowerarm_l", left, Bone::forearm},
                {"thigh_r", right, Bone::thigh},
                {"calf_l", left, Bone::shin},
                {"ball_r", right, Bone::toe}});
  expect_bones({{"J_Bip_C_Hips", none, Bone::pelvis},
                {"J_Bip_L_UpperArm", left, Bone::upper_arm},
                {"J_Bip_R_LowerLeg", right, Bone::shin},
                {"J_Bip_L_Hand", left, Bone::hand}});
  expect_bones({{"joint_Root", none, Bone::pelvis},
                {"UpperLeg_L", left, Bone::thigh},
                {"LowerArm_R", right, Bone::forearm},
                {"Toes_L", left, Bone::toe},
                {"Shoulder_L", left, Bone::clavicle},
                {"UpperArm_L", left, Bone::upper_arm}});
  expect_bones({{"rShldr", right, Bone::upper_arm},
                {"lThigh", left, Bone::thigh},
                {"rCollar", right, Bone::clavicle},
                {"lShin", left, Bone::shin},
                {"rButtock", right, Bone::hip},
                {"abdomen", none, Bone::spine}});
}

TEST(BoneNames, GiveFingersOneWord) {
  const auto word = [](const char* name) { return bone_names({name, "LeftHandMiddle1"})[0].word; };
  EXPECT_EQ(word("mixamorig:LeftHandIndex1"), "index1");
  EXPECT_EQ(word("lIndex1"), "index1");
  EXPECT_EQ(word("LThumb"), "thumb1");
  EXPECT_EQ(word("LeftHandThumb1"), "thumb1");
  EXPECT_EQ(word("lMid2"), "middle2");
  // The hand has only one finger.
  EXPECT_EQ(bone_names({"LeftHandIndex1"})[0].word, "fingers");
  EXPECT_EQ(bone_names({"lfingers"})[0].word, "fingers");
}

TEST(BoneNames, LeaveOtherNamesWhole) {
  const auto bones = bone_names({"", "Prop1", "lamp", "Tail", "::", "L", "RIBS"});
  for (const BoneName& bone : bones) EXPECT_EQ(bone.bone, Bone::other) << bone.word;
  EXPECT_EQ(bones[2].word, "lamp");
  EXPECT_EQ(bones[2].side, Side::none);
}

TEST(FindBone, FindsTheLastJointOfABoneAndSide) {
  const std::vector<BoneName> bones =
      bone_names({"Hips", "Spine", "Spine1", "LeftArm", "RightArm"});
  EXPECT_EQ(find_bone(bones, Bone::spine, none), 2);
  EXPECT_EQ(find_bone(bones, Bone::upper_arm, left), 3);
  EXPECT_EQ(find_bone(bones, Bone::upper_arm, right), 4);
  EXPECT_EQ(find_bone(bones, Bone::upper_arm, none), -1);
  EXPECT_EQ(find_bone(bones, Bone::foot, left), -1);
}

TEST(PlainName, DropsCaseSeparatorsAndPrefixes) {
  EXPECT_EQ(plain_name("Ann:Left Arm"), "leftarm");
  EXPECT_EQ(plain_name("mixamorig:LeftArm"), "leftarm");
  EXPECT_EQ(plain_name("left_arm"), "leftarm");
  EXPECT_EQ(plain_name("LASI"), "lasi");
  EXPECT_EQ(plain_name(""), "");
}

}  // namespace
}  // namespace kinemend::representation
