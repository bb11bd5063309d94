// Tests of skeletons: validity, channels, and the guessed unit.
#include "kinemend/take.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "kinemend/error.hpp"
#include "motion/clips.hpp"
#include "motion/take.hpp"

namespace kinemend {
namespace {

using test::chain_skeleton;
using testing::AllOf;
using testing::Property;
using testing::Throws;
using testing::ThrowsMessage;

auto skeleton_usage(const char* message) {
  return AllOf(Throws<Error>(Property(&Error::kind, ErrorKind::usage)),
               ThrowsMessage<Error>(message));
}

// Makes one change to a valid skeleton and returns a function that validates it.
template <class Change>
auto validating_skeleton(Change change) {
  Skeleton skeleton = chain_skeleton(4);
  change(skeleton);
  return [skeleton] { skeleton.validate(); };
}

TEST(SkeletonRules, AcceptGoodSkeletons) {
  EXPECT_NO_THROW(chain_skeleton(4).validate());
  EXPECT_NO_THROW(chain_skeleton(1).validate());
  // Several roots, repeated and empty names, channels in any order, and a repeated axis are valid.
  EXPECT_NO_THROW(validating_skeleton([](Skeleton& s) {
    s.add_joint("", -1, {}, {});
    s.add_joint(
        "joint1", 4, {0, 0, 0},
        {Channel::z_rotation, Channel::y_position, Channel::x_rotation, Channel::z_rotation});
  })());
}

TEST(SkeletonRules, NameTheFirstJointThatBreaksOne) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([] { Skeleton{}.validate(); }, skeleton_usage("a skeleton has at least one joint"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.parents.pop_back(); }),
              skeleton_usage("skeleton arrays differ in length"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.offsets.emplace_back(); }),
              skeleton_usage("skeleton arrays differ in length"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.rest_rotations.pop_back(); }),
              skeleton_usage("skeleton arrays differ in length"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.channels.pop_back(); }),
              skeleton_usage("skeleton arrays differ in length"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.parents[0] = 0; }),
              skeleton_usage("joint 0 is not a root"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.parents[2] = 2; }),
              skeleton_usage("joint 2 \"joint2\": parent 2 does not precede it"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.parents[1] = 3; }),
              skeleton_usage("joint 1 \"joint1\": parent 3 does not precede it"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.parents[1] = -2; }),
              skeleton_usage("joint 1 \"joint1\": parent -2 does not precede it"));
  EXPECT_THAT(validating_skeleton([&](Skeleton& s) { s.offsets[3].y = nan; }),
              skeleton_usage("joint 3 \"joint3\": offset is not finite"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.rest_rotations[1].w = 1.1; }),
              skeleton_usage("joint 1 \"joint1\": rest rotation is not a unit quaternion"));
  EXPECT_THAT(validating_skeleton([&](Skeleton& s) { s.rest_rotations[1].x = nan; }),
              skeleton_usage("joint 1 \"joint1\": rest rotation is not a unit quaternion"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) {
                s.channels[2] = {Channel::x_rotation, Channel::x_rotation};
              }),
              skeleton_usage("joint 2 \"joint2\": a rotation channel follows itself"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) {
                s.channels[2] = {Channel::x_rotation, Channel::y_position, Channel::x_rotation};
              }),
              skeleton_usage("joint 2 \"joint2\": a rotation channel follows itself"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) {
                s.channels[2] = {Channel::x_rotation, Channel::y_rotation, Channel::x_rotation,
                                 Channel::y_rotation};
              }),
              skeleton_usage("joint 2 \"joint2\": 4 rotation channels, at most 3 are possible"));
  EXPECT_THAT(validating_skeleton([](Skeleton& s) {
                s.channels[1] = {Channel::x_position, Channel::y_position, Channel::x_position};
              }),
              skeleton_usage("joint 1 \"joint1\": a position channel occurs twice"));
  const auto bad_end =
      skeleton_usage("an end site has no parent joint or an offset that is not finite");
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.end_sites[0].parent = 4; }), bad_end);
  EXPECT_THAT(validating_skeleton([](Skeleton& s) { s.end_sites[0].parent = -1; }), bad_end);
  EXPECT_THAT(validating_skeleton([&](Skeleton& s) { s.end_sites[0].offset.z = nan; }), bad_end);
}

TEST(Skeleton, FindsTheFirstJointOfAName) {
  Skeleton skeleton = chain_skeleton(3);
  skeleton.add_joint("joint1", 0, {}, {});
  EXPECT_EQ(skeleton.find("joint1"), 1);
  EXPECT_EQ(skeleton.find("Joint1"), -1);
  EXPECT_EQ(skeleton.find(""), -1);
}

TEST(Skeleton, TellsRotationOrderAndPositionChannels) {
  Skeleton skeleton = chain_skeleton(2);
  skeleton.add_joint("mixed", 0, {},
                     {Channel::y_rotation, Channel::z_position, Channel::x_rotation});
  skeleton.add_joint("fixed", 0, {}, {});
  EXPECT_EQ(to_string(skeleton.rotation_order(0)), "ZXY");
  EXPECT_TRUE(skeleton.has_position_channels(0));
  EXPECT_FALSE(skeleton.has_position_channels(1));
  EXPECT_EQ(to_string(skeleton.rotation_order(2)), "YX");
  EXPECT_TRUE(skeleton.has_position_channels(2));
  EXPECT_EQ(skeleton.rotation_order(3).count, 0);
}

TEST(MakeChannels, ListsPositionsThenTheOrder) {
  using enum Channel;
  EXPECT_EQ(make_channels(true, parse_rotation_order("ZYX")),
            (std::vector<Channel>{x_position, y_position, z_position, z_rotation, y_rotation,
                                  x_rotation}));
  EXPECT_EQ(make_channels(false, parse_rotation_order("XZ")),
            (std::vector<Channel>{x_rotation, z_rotation}));
}

TEST(LengthUnit, IsGuessedFromTheHeight) {
  Skeleton skeleton;
  skeleton.add_joint("hips", -1, {3, 85, 0}, {});
  skeleton.add_joint("toe", 0, {0, -85, 0}, {});
  skeleton.end_sites.push_back({0, {0, 85, 0}, "top"});
  EXPECT_NEAR(body_height(skeleton), 170, 1e-12);
  const auto guess_at = [&](double scale) {
    Skeleton scaled = skeleton;
    for (Vec3& offset : scaled.offsets) offset = scale * offset;
    for (EndSite& site : scaled.end_sites) site.offset = scale * site.offset;
    return guess_length_unit(scaled);
  };
  EXPECT_EQ(guess_at(1)->name, "cm");
  EXPECT_EQ(guess_at(0.01)->name, "m");
  EXPECT_EQ(guess_at(10)->name, "mm");
  EXPECT_EQ(guess_at(1 / 2.54)->name, "inch");
  EXPECT_EQ(guess_at(0.45 / 2.54)->name, "CMU unit");
  EXPECT_FALSE(guess_at(3));
  EXPECT_FALSE(guess_at(0));
}

TEST(ChildCounts, CountJointsAndNoEndSites) {
  Skeleton skeleton = chain_skeleton(3);
  skeleton.add_joint("side", 1, {0, 1, 0}, {});
  skeleton.end_sites.push_back({3, {0, 1, 0}, ""});
  skeleton.add_joint("other root", -1, {}, {});
  EXPECT_THAT(child_counts(skeleton), testing::ElementsAre(1, 2, 0, 0, 0));
}

}  // namespace
}  // namespace kinemend
