// Tests that limbs are recognised by the names of joints and markers.
#include "lab/damage/body_parts.hpp"

#include <gmock/gmock.h>

namespace kinemend::corrupt {
namespace {

TEST(BodyParts, AreToldByTheNamesOfJointsAndMarkers) {
  for (const char* name : {"LeftForeArm", "Right_Wrist", "LWRA", "Ann:RFIN", "LELB", "HandLeft",
                           "LeftHandIndex1", "RUPA"})
    EXPECT_EQ(named_part(name), NamedPart::arm) << name;
  for (const char* name :
       {"LeftUpLeg", "Right_Heel", "Left_Foot_Index", "LKNE", "RTOE", "AnkleLeft", "HipRight"})
    EXPECT_EQ(named_part(name), NamedPart::leg) << name;
  for (const char* name : {"Hips", "Spine1", "Neck", "Head", "C7", "", "x1"})
    EXPECT_EQ(named_part(name), NamedPart::other) << name;
}

TEST(BodyParts, OfOneSideAreOneLimb) {
  const auto limbs = named_limbs({"LeftArm", "LeftHand", "RightArm", "Left_Knee", "LKNE",
                                  "Ann:LTOE", "RToe", "Head", "C7", "HandRight", "hand_r"});
  EXPECT_THAT(limbs, testing::ElementsAre(0, 0, 1, 2, 2, 2, 3, 4, 4, 1, 1));
}

}  // namespace
}  // namespace kinemend::corrupt
