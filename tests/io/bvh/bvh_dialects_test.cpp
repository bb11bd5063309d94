// Tests of the BVH reader on the layouts and repairs of many programs.
#include "io/bvh/bvh.hpp"
#include "io/bvh/bvh_hierarchy.hpp"
#include "io/support.hpp"

namespace kinemend {
namespace {

using namespace test;

Take read_good(const std::string& name) { return read_joints(fixture("good/" + name)).take; }
std::size_t repairs(const std::string& name, const char* kind) {
  return read_joints(fixture("good/" + name)).diagnostics.count(kind);
}

TEST(BvhReader, ReadsNamesOffsetsChannelsAndMotion) {
  const Take clip = read_good("plain.bvh");
  clip.validate();
  EXPECT_EQ(clip.skeleton.names, (std::vector<std::string>{"Hips", "Spine"}));
  EXPECT_EQ(clip.skeleton.parents, (std::vector<std::int32_t>{-1, 0}));
  EXPECT_EQ(clip.skeleton.offsets[0], (Vec3{0, 90.5, 0}));
  EXPECT_EQ(clip.skeleton.offsets[1], (Vec3{0, 10, -1.25}));
  EXPECT_EQ(to_string(clip.skeleton.rotation_order(0)), "ZXY");
  EXPECT_EQ(clip.skeleton.channels[1].size(), 3u);
  ASSERT_EQ(clip.skeleton.end_sites.size(), 1u);
  EXPECT_EQ(clip.skeleton.end_sites[0].parent, 1);
  EXPECT_EQ(clip.skeleton.end_sites[0].offset, (Vec3{0, 20, 0}));
  EXPECT_EQ(clip.frame_rate_hz, 120);
  ASSERT_EQ(clip.frame_count(), 3u);
  // Position channels replace the offset.
  EXPECT_EQ(clip.root_position(1), (Vec3{1.1, 92.1, -3.4}));
  EXPECT_LT(angle_between(clip.rotation(1, 0), rotation_of({11, -21, 31}, "ZXY")), 1e-14);
  EXPECT_LT(angle_between(clip.rotation(2, 1), rotation_of({5.7, 6.45, -7.325}, "ZXY")), 1e-14);
  EXPECT_TRUE(clip.observed.empty());
  EXPECT_TRUE(clip.translated_joints.empty());
  EXPECT_EQ(clip.source.format, "bvh");
}

TEST(BvhReader, LayoutDoesNotChangeTheMotion) {
  const Take plain = read_good("plain.bvh");
  for (const char* name : {"no_final_line_end.bvh", "crlf.bvh",
                           "cr_only.bvh",           "mixed_line_ends.bvh",
                           "byte_order_mark.bvh",   "tabs.bvh",
                           "lower_case.bvh",        "wrapped.bvh",
                           "one_line.bvh",          "header_on_one_line.bvh",
                           "frames_too_many.bvh",   "frames_too_few.bvh",
                           "frames_missing.bvh",    "frames_not_a_count.bvh",
                           "comments.bvh",          "trailing_blanks.bvh",
                           "trailing_text.bvh",     "decimal_comma.bvh",
                           "comma_separated.bvh",   "no_keyword.bvh"}) {
    SCOPED_TRACE(name);
    const Take clip = read_good(name);
    clip.validate();
    EXPECT_EQ(clip.frame_rate_hz, 120);
    EXPECT_EQ(clip.skeleton.names, plain.skeleton.names);
    EXPECT_EQ(clip.skeleton.offsets, plain.skeleton.offsets);
    EXPECT_EQ(clip.skeleton.channels, plain.skeleton.channels);
    EXPECT_EQ(clip.rotations, plain.rotations);
    EXPECT_EQ(clip.positions, plain.positions);
  }
}

TEST(BvhReader, SpacesMayStandOnEitherSideOfASeparatingComma) {
  const std::string text = read_file(fixture("good/comma_separated.bvh"));
  const std::size_t data = text.find("1.0000");
  for (const char* separator : {",", " ,", ", ", " , ", "\t,\t", ",,"}) {
    std::string changed = text.substr(0, data);
    for (std::size_t i = data; i < text.size(); ++i) {
      if (text[i] == ',') changed += separator;
      if (text[i] != ',' && text[i] != ' ') changed += text[i];
    }
    const Take clip = read_text(changed);
    EXPECT_EQ(clip.rotations, read_good("plain.bvh").rotations) << separator;
    EXPECT_EQ(write_take(clip), changed);
  }
}

TEST(BvhReader, RepairsAreNamedAndCounted) {
  EXPECT_EQ(repairs("frames_too_many.bvh", "frame_count_mismatch"), 1u);
  EXPECT_EQ(repairs("frames_too_few.bvh", "frame_count_mismatch"), 1u);
  EXPECT_EQ(repairs("frames_missing.bvh", "frame_count_missing"), 1u);
  EXPECT_EQ(repairs("frames_not_a_count.bvh", "frame_count_missing"), 1u);
  EXPECT_EQ(repairs("time_missing.bvh", "frame_time_missing"), 1u);
  EXPECT_EQ(repairs("time_zero.bvh", "frame_time_unusable"), 1u);
  EXPECT_EQ(repairs("comments.bvh", "comment_skipped"), 4u);
  EXPECT_EQ(repairs("trailing_text.bvh", "trailing_text"), 1u);
  EXPECT_EQ(repairs("decimal_comma.bvh", "decimal_comma"), 1u);
  EXPECT_EQ(repairs("comma_separated.bvh", "comma_separator"), 1u);
  EXPECT_EQ(repairs("no_keyword.bvh", "hierarchy_keyword_missing"), 1u);
  EXPECT_EQ(repairs("no_offset.bvh", "offset_missing"), 1u);
  EXPECT_EQ(repairs("no_motion.bvh", "motion_missing"), 1u);
  EXPECT_EQ(repairs("gaps.bvh", "value_not_finite"), 5u);
  const TakeResult result = read_joints(fixture("good/frames_too_many.bvh"));
  ASSERT_EQ(result.diagnostics.entries().size(), 1u);
  EXPECT_EQ(result.diagnostics.entries()[0].first_line, 17u);
  EXPECT_EQ(result.diagnostics.entries()[0].message, "Frames: says 10, the file holds 3");
  for (const char* name : {"plain.bvh", "crlf.bvh", "tabs.bvh", "wrapped.bvh", "one_line.bvh",
                           "trailing_blanks.bvh"}) {
    EXPECT_TRUE(read_joints(fixture(std::string("good/") + name)).diagnostics.empty()) << name;
  }
}

TEST(BvhReader, StrictTurnsARepairIntoAnError) {
  ReadOptions strict;
  strict.strict = true;
  std::size_t refused = 0;
  for (const auto& path : fixtures_in("good")) {
    const TakeResult lenient = read_joints(path);
    if (lenient.diagnostics.empty()) {
      EXPECT_NO_THROW(read_joints(path, strict)) << path;
      continue;
    }
    ++refused;
    const Diagnostic& first = lenient.diagnostics.entries()[0];
    EXPECT_EQ(message_of([&] { read_joints(path, strict); }, ErrorKind::quality_limit),
              path.string() + ":" + std::to_string(first.first_line) + ": " + first.message);
  }
  EXPECT_GE(refused, 13u);
}

TEST(BvhReader, NamesMayHoldAnything) {
  const Take clip = read_good("names.bvh");
  EXPECT_EQ(clip.skeleton.names,
            (std::vector<std::string>{"mixamorig:Hips of Eve", "endJoint", "endJoint", ""}));
  EXPECT_EQ(clip.skeleton.parents, (std::vector<std::int32_t>{-1, 0, 0, 2}));
  EXPECT_EQ(clip.skeleton.end_sites[0].name, "tip: End Site");
  EXPECT_EQ(clip.skeleton.end_sites[1].parent, 3);
}

TEST(BvhReader, SeveralRootsAreAllowed) {
  const Take clip = read_good("several_roots.bvh");
  clip.validate();
  EXPECT_EQ(clip.skeleton.parents, (std::vector<std::int32_t>{-1, 0, -1, 2}));
  EXPECT_EQ(clip.translated_joints, (std::vector<std::int32_t>{2}));
  EXPECT_EQ(clip.position(0, 1), (Vec3{8, 9, 7}));
  EXPECT_LT(angle_between(clip.rotation(1, 3), rotation_of({1.5, 2.5, 3.5}, "ZXY")), 1e-14);
  EXPECT_EQ(clip.rotation(1, 2), Quat{});
}

TEST(BvhReader, PositionChannelsReplaceTheOffsetOnAnyJoint) {
  const Take clip = read_good("positions_everywhere.bvh");
  clip.validate();
  EXPECT_EQ(clip.translated_joints, (std::vector<std::int32_t>{1}));
  EXPECT_EQ(clip.position(2, 1), (Vec3{1, 10.2, -1}));
  EXPECT_EQ(clip.skeleton.offsets[1], (Vec3{0, 10, -1.25}));
  EXPECT_LT(angle_between(clip.rotation(2, 1), rotation_of({5.7, 6.45, -7.325}, "ZXY")), 1e-14);
}

TEST(BvhReader, AxesWithoutAChannelKeepTheOffset) {
  const Take clip = read_good("some_positions.bvh");
  EXPECT_EQ(clip.root_position(1), (Vec3{0, 92.1, 0}));
  EXPECT_EQ(read_good("no_channels.bvh").frame_count(), 0u);
}

TEST(BvhReader, ChannelsMayComeInAnyOrderAndNumber) {
  const Take first = read_good("rotation_first.bvh");
  EXPECT_EQ(first.root_position(0), (Vec3{10, -20, 30}));
  EXPECT_LT(angle_between(first.rotation(0, 0), rotation_of({1, 92, -3.5}, "ZXY")), 1e-14);
  const Take mixed = read_good("mixed_channels.bvh");
  mixed.validate();
  EXPECT_EQ(mixed.root_position(0), (Vec3{1, 3, 2}));
  EXPECT_LT(angle_between(mixed.rotation(0, 0), rotation_of({10, 20, 30}, "YZX")), 1e-14);
  EXPECT_EQ(mixed.rotation(0, 1), Quat{});
  EXPECT_LT(angle_between(mixed.rotation(0, 2), rotation_of({40, 0, 0}, "X")), 1e-14);
  EXPECT_LT(angle_between(mixed.rotation(0, 3), rotation_of({50, 60, 0}, "ZY")), 1e-14);
  EXPECT_LT(angle_between(mixed.rotation(1, 4), rotation_of({71, 81, 91}, "XYZ")), 1e-14);
  EXPECT_LT(angle_between(mixed.rotation(1, 5), rotation_of({16, 26, 36}, "ZXZ")), 1e-14);
  EXPECT_EQ(mixed.translated_joints, (std::vector<std::int32_t>{6}));
  EXPECT_EQ(mixed.position(1, 1), (Vec3{1, 5, 0}));
}

TEST(BvhReader, FewOrNoFramesAreRead) {
  EXPECT_EQ(read_good("one_frame.bvh").frame_count(), 1u);
  EXPECT_EQ(read_good("zero_frames.bvh").frame_count(), 0u);
  const Take clip = read_good("no_motion.bvh");
  clip.validate();
  EXPECT_EQ(clip.frame_count(), 0u);
  EXPECT_EQ(clip.frame_rate_hz, 30);
}

TEST(BvhReader, NumbersComeInManyForms) {
  const Take clip = read_good("number_forms.bvh");
  const Take plain = read_good("plain.bvh");
  EXPECT_EQ(clip.root_position(0), plain.root_position(0));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(angle_between(clip.rotations[i], plain.rotations[i]), 1e-14) << i;
  }
  EXPECT_EQ(clip.root_position(2), (Vec3{0, -0.5, 0.5}));
  EXPECT_EQ(clip.frame_rate_hz, 120);
}

TEST(BvhReader, SamplesThatAreNoNumberAreHeldAndUnobserved) {
  const Take clip = read_good("gaps.bvh"), plain = read_good("plain.bvh");
  clip.validate();
  EXPECT_EQ(clip.observed, (std::vector<std::uint8_t>{0, 1, 1, 0, 1, 0}));
  // Missing samples at the start get the next value, all others the previous one.
  EXPECT_EQ(clip.rotation(0, 0), plain.rotation(1, 0));
  EXPECT_EQ(clip.rotation(1, 1), plain.rotation(0, 1));
  EXPECT_EQ(clip.rotation(2, 1), plain.rotation(0, 1));
  EXPECT_EQ(clip.rotation(2, 0), plain.rotation(2, 0));
  EXPECT_EQ(clip.root_position(1), (Vec3{1.1, 92, -3.4}));
  EXPECT_EQ(clip.root_position(2), (Vec3{1.1, 92.2, -3.3}));
}

TEST(BvhReader, AJointWithoutAnyNumberRests) {
  const Take clip = read_good("joint_of_gaps.bvh");
  clip.validate();
  EXPECT_EQ(clip.observed, (std::vector<std::uint8_t>{1, 0, 1, 0, 1, 0}));
  EXPECT_EQ(clip.rotation(1, 1), Quat{});
}

TEST(BvhReader, FrameTimesMeanTheRateTheyWereRoundedFrom) {
  const std::pair<const char*, double> times[] = {{"0.0083333", 120},
                                                  {".0083333", 120},
                                                  {"0.008333", 120},
                                                  {"0.00833", 120},
                                                  {"0.0333333", 30},
                                                  {"0.033333", 30},
                                                  {"0.0333", 30},
                                                  {"0.033367", 29.97},
                                                  {"0.03336670003", 29.97},
                                                  {"0.041667", 24},
                                                  {"0.04", 25},
                                                  {"0.02", 50},
                                                  {"0.016683", 59.94},
                                                  {"0.016667", 60},
                                                  {"0.011111", 90},
                                                  {"0.01", 100},
                                                  {"0.0041667", 240},
                                                  {"0.0417083750417", 23.976},
                                                  {"0.016666666666666666", 60},
                                                  {"8.33333e-03", 120},
                                                  {"0.0138889", 72},
                                                  {"0.005", 200},
                                                  {"0.001", 1000},
                                                  {"0.0083417", 119.88}};
  for (const auto& [text, rate] : times)
    EXPECT_EQ(rate_from_frame_time(std::strtod(text, nullptr), text), rate) << text;
  // A frame time with nine digits or more is used exactly.
  EXPECT_NEAR(rate_from_frame_time(1 / 119.95, "0.008336807"), 120, 1e-12);
  EXPECT_NEAR(rate_from_frame_time(1 / 119.95, "0.0083368070029179"), 119.95, 1e-9);
  EXPECT_NEAR(rate_from_frame_time(0.0114, "0.0114"), 87.719298, 1e-6);
}

TEST(BvhReader, NestingIsLimitedByTheOption) {
  const auto nested = [](std::size_t depth) {
    std::string text = "HIERARCHY\n";
    for (std::size_t i = 0; i < depth; ++i)
      text += (i == 0 ? "ROOT a{OFFSET 0 0 0\n" : "JOINT a{OFFSET 0 0 0\n");
    for (std::size_t i = 0; i < depth; ++i) text += '}';
    return text;
  };
  EXPECT_EQ(read_text(nested(512)).joint_count(), 512u);
  EXPECT_EQ(read_error(nested(513)), "take.bvh:514: joints are nested deeper than 512");
  ReadOptions options;
  options.max_depth = 3;
  EXPECT_EQ(read_error(nested(4), options), "take.bvh:5: joints are nested deeper than 3");
}

}  // namespace
}  // namespace kinemend
