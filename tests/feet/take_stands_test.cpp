// Tests of the stands of feet of joints and of markers, and of the times in which feet carry load.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "feet/support.hpp"
#include "kinemend/error.hpp"

namespace kinemend {
namespace {

using test::synthetic_clip;
using testing::ElementsAre;
using testing::IsEmpty;

// A marker at a joint, or at an offset from it in its frame.
struct MarkerPlace {
  const char* name;
  const char* joint;
  Vec3 offset;
};
constexpr std::array<MarkerPlace, 7> marker_set{{{"LASI", "LeftUpLeg", {}},
                                                 {"RASI", "RightUpLeg", {}},
                                                 {"C7", "Neck", {}},
                                                 {"LHEE", "LeftFoot", {0, -4, -6}},
                                                 {"LTOE", "LeftToeBase", {0, 2, 0}},
                                                 {"RHEE", "RightFoot", {0, -4, -6}},
                                                 {"RTOE", "RightToeBase", {0, 2, 0}}}};

Take markers_on(const Take& clip, const std::string& subject = "") {
  std::vector<std::string> names;
  for (const MarkerPlace& place : marker_set) names.push_back(subject + place.name);
  Take markers = make_marker_take(names, clip.frame_count(), clip.frame_rate_hz);
  markers.unit = "cm";
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const Pose pose = forward_kinematics(clip, f);
    for (std::size_t m = 0; m < marker_set.size(); ++m) {
      const std::size_t joint = test::joint_of(clip, marker_set[m].joint);
      markers.position(f, m) =
          pose.positions[joint] + rotate(pose.rotations[joint], marker_set[m].offset);
    }
  }
  std::fill(markers.observed.begin(), markers.observed.end(), std::uint8_t{1});
  return markers;
}

std::vector<std::uint8_t> flags_of(const FootStands& stands, std::size_t frames) {
  std::vector<std::uint8_t> flags(frames * stands.sides.size());
  for (const FootContact& contact : stands.contacts) {
    for (std::size_t f = contact.first_frame; f <= contact.last_frame; ++f)
      flags[f * stands.sides.size() + contact.leg] = 1;
  }
  return flags;
}

double share_equal(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  std::size_t equal = 0;
  for (std::size_t i = 0; i < a.size(); ++i) equal += a[i] == b[i] ? 1 : 0;
  return static_cast<double>(equal) / static_cast<double>(a.size());
}

TEST(TakeStands, MarkersOnAFootStandWhenTheJointsBelowThemDo) {
  const Take clip = synthetic_clip("walk");
  const FootStands joints = find_stands(clip), markers = find_stands(markers_on(clip));
  EXPECT_THAT(markers.sides, ElementsAre("left", "right"));
  EXPECT_THAT(markers.tracks[1], ElementsAre(5, 6));
  EXPECT_GT(
      share_equal(flags_of(joints, clip.frame_count()), flags_of(markers, clip.frame_count())),
      0.95);
  EXPECT_NEAR(markers.time.found_s, joints.time.found_s, 0.3);
  EXPECT_GT(markers.time.confidence, 0.9);
}

TEST(TakeStands, JointsGiveTheContactsOfFindContacts) {
  const Take clip = synthetic_clip("walk", 4, 60, 1, true);
  const FootStands stands = find_stands(clip);
  EXPECT_EQ(stands.contacts, find_contacts(clip));
  EXPECT_EQ(stands.time.held_s, 0);
}

TEST(TakeStands, AreTheSameWhenTheSceneIsTurnedMovedAndInAnotherUnit) {
  Take take = markers_on(synthetic_clip("walk", 4));
  const FootStands before = find_stands(take);
  const Quat turn = exp(Vec3{0, 1.1, 0});
  for (Vec3& p : take.positions) p = 10.0 * (rotate(turn, p) + Vec3{300, 40, -20});
  take.unit = "mm";
  EXPECT_EQ(find_stands(take).contacts, before.contacts);
}

TEST(TakeStands, OfSeveralPeopleHaveTheNamesOfThePeople) {
  const Take ann = markers_on(synthetic_clip("walk", 3), "Ann:"),
             bob = markers_on(synthetic_clip("run", 3), "Bob:");
  std::vector<std::string> names = ann.names;
  names.insert(names.end(), bob.names.begin(), bob.names.end());
  Take both = make_marker_take(names, ann.frame_count(), ann.frame_rate_hz);
  both.unit = "cm";
  for (std::size_t f = 0; f < both.frame_count(); ++f) {
    for (std::size_t m = 0; m < ann.marker_count(); ++m) {
      both.position(f, m) = ann.position(f, m);
      both.position(f, ann.marker_count() + m) = bob.position(f, m) + Vec3{200, 0, 0};
    }
  }
  std::fill(both.observed.begin(), both.observed.end(), std::uint8_t{1});
  const FootStands stands = find_stands(both);
  EXPECT_THAT(stands.sides, ElementsAre("Ann left", "Ann right", "Bob left", "Bob right"));
  std::vector<FootContact> of_ann = stands.contacts;
  std::erase_if(of_ann, [](const FootContact& contact) { return contact.leg > 1; });
  EXPECT_EQ(of_ann, find_stands(ann).contacts);
}

TEST(TakeStands, NeedMarkersOnHeelAndToeAndAUnit) {
  Take take = markers_on(synthetic_clip("walk", 3));
  take.names[3] = "LANK";  // no heel on the left
  EXPECT_THAT(find_stands(take).sides, ElementsAre("right"));
  const KnownNames known{{"LHEE", "LANK"}};
  EXPECT_THAT(find_stands(take, {}, known).sides, ElementsAre("left", "right"));
  take.names[5] = "RANK";
  EXPECT_THAT(find_stands(take).sides, IsEmpty());
  EXPECT_EQ(find_stands(take).time.expected_s, 0);
}

TEST(TakeStands, AMarkerThatIsNotSeenInTheSwingChangesNoStand) {
  const Take clip = synthetic_clip("walk", 4);
  Take take = markers_on(clip);
  const FootStands before = find_stands(take);
  const std::size_t swing = before.contacts.front().last_frame + 24;
  for (std::size_t f = swing; f < swing + 6; ++f) take.observed[f * take.marker_count() + 3] = 0;
  EXPECT_GT(share_equal(flags_of(before, take.frame_count()),
                        flags_of(find_stands(take), take.frame_count())),
            0.99);
}

TEST(TakeStands, FeetCarryLoadFromBeforeTheyStandUntilAfter) {
  const FootStands stands = find_stands(markers_on(synthetic_clip("walk")));
  ASSERT_GT(stands.ground.size(), 6u);
  for (std::size_t i = 0; i < stands.ground.size(); ++i) {
    const GroundTime& time = stands.ground[i];
    if (time.touch_down_s) {
      EXPECT_LT(*time.touch_down_s, static_cast<double>(time.first_frame) / 120 + 0.05);
    }
    if (time.lift_off_s) {
      EXPECT_GE(*time.lift_off_s, static_cast<double>(time.last_frame) / 120);
    }
    if (i == 0 || stands.ground[i - 1].leg != time.leg) continue;
    ASSERT_TRUE(stands.ground[i - 1].lift_off_s && time.touch_down_s);
    EXPECT_LT(*stands.ground[i - 1].lift_off_s, *time.touch_down_s);
  }
}

TEST(TakeStands, RefuseSettingsOutOfRange) {
  ContactSettings settings;
  settings.least_s = -1;
  EXPECT_THROW(find_stands(markers_on(synthetic_clip("walk", 2)), settings), Error);
}

}  // namespace
}  // namespace kinemend
