// Tests of layouts: their channels, their rules, and how they are learned from takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "body/body_takes.hpp"
#include "kinemend/error.hpp"

namespace kinemend {
namespace {

using namespace body_test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

template <class Work>
std::string usage_error_of(Work work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

TEST(BodyLayout, NamesItsChannels) {
  const BodyLayout layout = layout_of(walk());
  EXPECT_EQ(layout.channel_count(), 3 * (layout.track_count() + 1));
  EXPECT_EQ(layout.channel_name(0), "Hips x");
  EXPECT_EQ(layout.channel_name(5), layout.names[1] + " z");
  EXPECT_EQ(layout.channel_name(3 * layout.track_count() + 1), "place y");
  const BodyLayout markers = layout_of(joint_markers(walk()));
  EXPECT_EQ(markers.channel_count(), 3 * markers.track_count());
  EXPECT_EQ(to_string(layout.kind), "joints");
  EXPECT_EQ(to_string(markers.kind), "markers");
}

TEST(BodyLayout, DiffersByAnyMember) {
  const BodyLayout layout = layout_of(walk());
  BodyLayout other = layout;
  EXPECT_EQ(layout, other);
  other.references[1] = -other.references[1];
  EXPECT_NE(layout, other);
  other = layout;
  other.trend_s *= 2;
  EXPECT_NE(layout, other);
}

TEST(BodyLayout, SaysWhichTrackBreaksARule) {
  const BodyLayout good = layout_of(walk());
  EXPECT_NO_THROW(good.validate());
  const auto broken = [&](auto change) {
    BodyLayout layout = good;
    change(layout);
    return usage_error_of([&] { layout.validate(); });
  };
  EXPECT_THAT(broken([](BodyLayout& l) {
                l.references[3] = {2, 0, 0, 0};
              }),
              HasSubstr("joint 3 \"" + good.names[3] + "\""));
  EXPECT_THAT(broken([](BodyLayout& l) { l.bones[2] = {0.5, 0, 0}; }), HasSubstr("bone"));
  EXPECT_THAT(broken([](BodyLayout& l) { l.parents[2] = 5; }), HasSubstr("parent 5"));
  EXPECT_THAT(broken([](BodyLayout& l) { l.parents[2] = -1; }), HasSubstr("parent -1"));
  EXPECT_THAT(broken([](BodyLayout& l) { l.parents.pop_back(); }), HasSubstr("parents"));
  EXPECT_THAT(broken([](BodyLayout& l) { l.place.y = NAN; }), HasSubstr("place"));
  EXPECT_THAT(broken([](BodyLayout& l) { l.trend_s = 0; }), HasSubstr("trend of 0 s"));
  EXPECT_THAT(broken([](BodyLayout& l) { l = {}; }), HasSubstr("no parts"));
  const BodyLayout markers = layout_of(joint_markers(walk()));
  const auto broken_markers = [&](auto change) {
    BodyLayout layout = markers;
    change(layout);
    return usage_error_of([&] { layout.validate(); });
  };
  EXPECT_THAT(broken_markers([](BodyLayout& l) { l.means[1].x = INFINITY; }),
              HasSubstr("marker 1"));
  EXPECT_THAT(broken_markers([](BodyLayout& l) { l.shape.pop_back(); }), HasSubstr("shape"));
  EXPECT_THAT(broken_markers([](BodyLayout& l) { l.anchors.assign(l.anchors.size(), 0); }),
              HasSubstr("expected at least 3 anchors, found 0"));
}

TEST(BodyLayoutBuilder, LearnsWhatMovesWithTheRootForemost) {
  Take clip = walk("wave");
  const auto knee = static_cast<std::size_t>(clip.skeleton.find("LeftLeg"));
  for (std::size_t f = 0; f < clip.frame_count(); ++f) clip.rotation(f, knee) = exp({0.2, 0, 0});
  const BodyLayout layout = layout_of(clip);
  EXPECT_EQ(layout.names.front(), "Hips");
  EXPECT_THAT(layout.names, Not(Contains("LeftLeg")));
  // Children of the removed knee become children of the hip.
  const auto foot = track_named(layout, "LeftFoot");
  ASSERT_LT(foot, layout.track_count());
  EXPECT_EQ(layout.names[static_cast<std::size_t>(layout.parents[foot])], "LeftUpLeg");
}

TEST(BodyLayoutBuilder, ReferencesAreMeansOverAllTakes) {
  const Take a = slice(walk(), 0, 100), b = slice(walk("stroll"), 30, 230);
  BodyLayoutBuilder builder;
  builder.add(a);
  builder.add(b);
  const BodyLayout layout = builder.finish();
  std::vector<Quat> rotations;
  for (const Take* clip : {&a, &b}) {
    const auto arm = static_cast<std::size_t>(clip->skeleton.find("RightArm"));
    for (std::size_t f = 0; f < clip->frame_count(); ++f)
      rotations.push_back(clip->rotation(f, arm));
  }
  const Quat reference = layout.references[track_named(layout, "RightArm")];
  EXPECT_LT(angle_between(reference, chordal_mean(rotations)), 1e-6);
}

TEST(BodyLayoutBuilder, LearnsTheNamesAskedForAndTheRoot) {
  BodyLayoutBuilder builder({"*Leg", "LeftFoot"});
  builder.add(walk());
  EXPECT_THAT(builder.finish().names,
              ElementsAre("Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg", "RightLeg"));
  BodyLayoutBuilder other({"Tail*"});
  EXPECT_THAT(usage_error_of([&] { other.add(walk()); }), HasSubstr("no joint matches \"Tail*\""));
}

TEST(BodyLayoutBuilder, DropsWhatMostTakesLack) {
  const Take clip = walk();
  const Take other = renamed(clip, {{"LeftHandThumb1", "Prop"}, {"LeftHandThumb2", "Prop2"}});
  BodyLayoutBuilder builder;
  builder.add(clip);
  builder.add(other);
  builder.add(other);
  const std::size_t tracks = builder.finish().track_count();
  EXPECT_THAT(builder.finish().names, Not(Contains("LeftHandThumb1")));
  EXPECT_EQ(tracks, layout_of(clip).track_count() - (layout_of(clip).track_count() - tracks));
}

TEST(BodyLayoutBuilder, RefusesTakesThatItCannotLearnFrom) {
  EXPECT_THAT(usage_error_of([] { BodyLayoutBuilder().finish(); }), HasSubstr("no takes"));
  EXPECT_THAT(usage_error_of([] { BodyLayoutBuilder({}, -1); }), HasSubstr("trend of -1 s"));
  BodyLayoutBuilder builder;
  builder.add(walk());
  EXPECT_THAT(usage_error_of([&] { builder.add(joint_markers(walk())); }),
              HasSubstr("takes of different kinds"));
  const Take chain = synthesize({"spin", 2, 60, 1, false});
  EXPECT_THAT(usage_error_of([&] { builder.add(chain); }), HasSubstr("of which the take lacks"));
  Take still = slice(walk(), 0, 1);
  EXPECT_THAT(usage_error_of([&] { layout_of(still); }), HasSubstr("nothing moves"));
}

TEST(BodyLayoutBuilder, LearnsChainsThatAreNoBody) {
  const Take chain = synthesize({"spin", 4, 60, 1, false});
  const BodyLayout layout = layout_of(chain);
  EXPECT_GE(layout.track_count(), 3U);
  const BodyMatch match = match_body(layout, chain);
  const BodyChannels channels = encode_body(chain, layout, match);
  Take back = chain;
  for (Quat& q : back.rotations) q = normalized(q * exp({0.1, 0.2, 0.3}));
  const std::vector<Quat> shaken = back.rotations;
  decode_body(channels, layout, match, back);
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    const auto joint = static_cast<std::size_t>(match.tracks[i]);
    EXPECT_LT(angle_between(chain.rotation(50, joint), back.rotation(50, joint)), 1e-9);
  }
}

TEST(BodyLayoutBuilder, MarkersOfOneTakeAreThoseOfManyCopies) {
  const Take clip = joint_markers(walk(), true);
  BodyLayoutBuilder builder;
  builder.add(clip);
  builder.add(moved(clip, 2, {100, 30, 0}));
  const BodyLayout one = layout_of(clip), two = builder.finish();
  ASSERT_EQ(one.names, two.names);
  EXPECT_EQ(one.anchors, two.anchors);
  for (std::size_t i = 0; i < one.track_count(); ++i)
    EXPECT_LT(norm(one.means[i] - two.means[i]), 0.01) << one.names[i];
}

}  // namespace
}  // namespace kinemend
