// Tests of the AMC reader: units, rates, frames, and the skeleton that belongs to a file.
#include <stdlib.h>

#include <fstream>
#include <map>
#include <sstream>

#include "acclaim.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace test;

struct BoneEnds {
  Vec3 begin, end;
};

// Reference positions of tools/reference/acclaim_figure.py, by frame and bone.
std::map<std::pair<std::size_t, std::string>, BoneEnds> figure_positions() {
  std::map<std::pair<std::size_t, std::string>, BoneEnds> positions;
  std::ifstream file(acclaim_fixture("amc/figure_positions.csv"));
  for (std::string line; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::size_t frame = 0;
    std::string bone;
    BoneEnds ends;
    words >> frame >> bone >> ends.begin.x >> ends.begin.y >> ends.begin.z >> ends.end.x >>
        ends.end.y >> ends.end.z;
    positions[{frame, bone}] = ends;
  }
  return positions;
}

void expect_figure_positions(const Take& clip) {
  const auto expected = figure_positions();
  ASSERT_EQ(expected.size(), clip.frame_count() * clip.joint_count());
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const Pose pose = forward_kinematics(clip, f);
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const BoneEnds& ends = expected.at({f, clip.skeleton.names[j]});
      EXPECT_LT(norm(pose.positions[j] - ends.begin), 1e-6) << f << " " << clip.skeleton.names[j];
    }
    for (const EndSite& site : clip.skeleton.end_sites) {
      const auto j = static_cast<std::size_t>(site.parent);
      const Vec3 end = pose.positions[j] + rotate(pose.rotations[j], site.offset);
      EXPECT_LT(norm(end - expected.at({f, clip.skeleton.names[j]}).end), 1e-6);
    }
  }
}

std::string refusal(const std::string& amc, const std::string& asf) {
  return message_of([&] { read_pair(amc, asf); }, ErrorKind::unreadable_input);
}

TEST(AmcReader, BonesStandWhereTheRecipeOfTheFormatPutsThem) {
  expect_figure_positions(read_figure());
}

TEST(AmcReader, RadiansOtherOrdersAndLineEndsSayTheSame) {
  expect_figure_positions(
      read_pair(read_file(acclaim_fixture("amc/good/radians.amc")), figure_asf()).take);
  expect_figure_positions(
      read_pair(read_file(acclaim_fixture("amc/good/order.amc")), figure_asf()).take);
}

TEST(AmcReader, AngleUnitIsThatOfTheSkeletonUnlessTheTakeSays) {
  const std::string asf = chain_asf({"dof rx"}, "angle rad\n");
  const auto degrees = [&](const char* header) {
    const Take clip = read_pair(std::string(header) + "1\nroot 0 0 0 0 0 0\na 1\n", asf).take;
    return angle_between(clip.rotation(0, 1), Quat{}) * degrees_per_radian;
  };
  EXPECT_NEAR(degrees(""), degrees_per_radian, 1e-9);
  EXPECT_NEAR(degrees(":RADIANS\n"), degrees_per_radian, 1e-9);
  EXPECT_NEAR(degrees(":DEGREES\n"), 1, 1e-9);
}

TEST(AmcReader, TheRateIsGivenOrAssumed) {
  const TakeResult assumed = read_pair(figure_amc(), figure_asf());
  EXPECT_EQ(assumed.take.frame_rate_hz, 120);
  EXPECT_EQ(assumed.diagnostics.count("frame_rate_assumed"), 1u);
  ReadOptions options;
  options.frame_rate_hz = 60;
  const TakeResult given = read_pair(figure_amc(), figure_asf(), options);
  EXPECT_EQ(given.take.frame_rate_hz, 60);
  EXPECT_TRUE(given.diagnostics.empty());
  ReadOptions strict;
  strict.strict = true;
  EXPECT_EQ(read_pair(figure_amc(), figure_asf(), strict).take.frame_rate_hz, 120);
}

TEST(AmcReader, ValuesThatAreNoNumberAreHeld) {
  const TakeResult result =
      read_pair(read_file(acclaim_fixture("amc/good/gaps.amc")), figure_asf());
  const Take& clip = result.take;
  clip.validate();
  EXPECT_EQ(result.diagnostics.count("value_not_finite"), 3u);
  const auto thigh = static_cast<std::size_t>(clip.skeleton.find("thigh"));
  EXPECT_FALSE(clip.is_observed(0, thigh));
  EXPECT_TRUE(clip.is_observed(1, thigh));
  EXPECT_EQ(clip.rotation(0, thigh), clip.rotation(1, thigh));
  EXPECT_EQ(clip.root_position(1).x, clip.root_position(0).x);
}

TEST(AmcReader, EveryBoneMayHaveThreeAngles) {
  const std::string declared = read_file(acclaim_fixture("amc/good/three_dofs.amc"));
  const TakeResult flagged = read_pair(declared, figure_asf());
  EXPECT_EQ(flagged.diagnostics.count("three_dofs_undeclared"), 0u);
  const TakeResult silent =
      read_pair(replaced(declared, ":FORCE-ALL-JOINTS-BE-3DOF\n", ""), figure_asf());
  EXPECT_EQ(silent.diagnostics.count("three_dofs_undeclared"), 1u);
  expect_same_motion(flagged.take, silent.take, 0);
  const Take plain = read_figure();
  const auto foot = static_cast<std::size_t>(plain.skeleton.find("foot"));
  EXPECT_EQ(flagged.take.skeleton.channels[foot].size(), 3u);
  EXPECT_LT(angle_between(flagged.take.rotation(1, foot), plain.rotation(1, foot)), 1e-12);
}

TEST(AmcReader, LengthsThatStretchHaveAColumnAndNoEffect) {
  const std::string asf = chain_asf({"direction 1 0 0\nlength 2\ndof rx l rz", "dof rx"});
  const Take clip = read_pair("1\nroot 0 0 0 0 0 0\na 10 5 20\nb 1\n", asf).take;
  EXPECT_LT(angle_between(clip.rotation(0, 1), rotation_of({20, 10, 0}, "ZX")), 1e-12);
  EXPECT_LT(norm(forward_kinematics(clip, 0).positions[2] - rotate(clip.rotation(0, 1), {2, 0, 0})),
            1e-12);
}

TEST(AmcReader, FrameNumbersMayStartAnywhereAndJumpsAreCounted) {
  const std::string asf = chain_asf({});
  const auto jumps = [&](const char* amc) {
    return read_pair(amc, asf).diagnostics.count("frame_number_jump");
  };
  EXPECT_EQ(jumps("7\nroot 0 0 0 0 0 0\n8\nroot 0 0 0 0 0 0\n"), 0u);
  EXPECT_EQ(jumps("1\nroot 0 0 0 0 0 0\n5\nroot 0 0 0 0 0 0\n5\nroot 0 0 0 0 0 0\n"), 2u);
}

TEST(AmcReader, NamesMatchInAnyCase) {
  const Take clip = read_pair("1\nROOT 0 0 0 0 0 0\nA 5\n", chain_asf({"dof rx"})).take;
  EXPECT_NEAR(angle_between(clip.rotation(0, 1), Quat{}), 5 * radians_per_degree, 1e-12);
}

TEST(AmcReader, WhatDoesNotFitTheSkeletonIsNamed) {
  EXPECT_EQ(refusal(figure_amc(), chain_asf({"dof rx"})),
            "take.amc:6: the skeleton take.asf has no bone \"thigh\"");
  EXPECT_EQ(refusal("1\nroot 0 0 0 0 0 0\n", chain_asf({"dof rx"})),
            "take.amc:1: the frame has no bone \"a\", which the skeleton take.asf has");
  EXPECT_EQ(refusal("1\nroot 0 0 0 0 0 0\na 1 2\n", chain_asf({"dof rx"})),
            "take.amc:3: expected 1 values of the bone \"a\" as in the skeleton take.asf, found 2");
}

TEST(AmcReader, DamagedFramesAreRefusedWithTheirLine) {
  const auto bad = [](const char* name) {
    return refusal(read_file(acclaim_fixture(std::string("amc/bad/") + name)), figure_asf());
  };
  EXPECT_EQ(bad("empty.amc"), "take.amc:1: the file is empty");
  EXPECT_EQ(bad("missing_bone.amc"), "take.amc:18: frame 2 ends without the bone \"spine\"");
  EXPECT_EQ(bad("twice.amc"), "take.amc:22: the bone \"foot\" occurs twice in a frame");
  EXPECT_EQ(bad("text.amc"), "take.amc:9: expected a number, found \"26.x\"");
  EXPECT_EQ(bad("no_frame_number.amc"),
            "take.amc:4: expected the number of a frame, found \"root\"");
  const std::string frame = "1\nroot 0 0 0 0 0 0\na 1 2\n", asf = chain_asf({"dof rx rz"});
  EXPECT_EQ(refusal(frame + "2\nroot 0 0 0 0 0 0\na 1\n", asf),
            "take.amc:6: expected 2 values of the bone \"a\", found 1");
  EXPECT_EQ(refusal(frame + "2\nroot 0 0 0 0 0 0\na 1 2 3\n", asf),
            "take.amc:6: expected 2 values of the bone \"a\", found 3");
  EXPECT_EQ(refusal(frame + "2\nroot 0 0 0 0 0 0\nb 1 2\n", asf),
            "take.amc:6: the bone \"b\" is not in the first frame");
  EXPECT_EQ(refusal(frame + "2\nroot 0 0 0 0 0 0\n", asf),
            "take.amc:6: frame 2 ends without the bone \"a\"");
  EXPECT_EQ(refusal(frame + "2 2\nroot 0 0 0 0 0 0\n", asf),
            "take.amc:4: expected only the number of a frame, found \"2\"");
}

class SkeletonFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "kinemend-amc-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path put(const std::string& name, const std::string& bytes) {
    write_file(folder_ / name, bytes, true);
    return folder_ / name;
  }
  // The file whose unit of length was used.
  std::string chosen(const std::filesystem::path& amc, const ReadOptions& options = {}) {
    return std::filesystem::path(read_joints(amc, options).take.source.facts.at(0).text)
        .filename()
        .string();
  }

  std::filesystem::path folder_;
};

TEST_F(SkeletonFolder, TheLikeliestSkeletonIsTaken) {
  const std::string asf = chain_asf({}), amc = "1\nroot 0 0 0 0 0 0\n";
  const auto take = put("35_01.amc", "#!OML:ASF F:\\VICON\\Some One.ASF\n" + amc);
  put("other.asf", asf);
  EXPECT_EQ(chosen(take), "other.asf");
  put("35-walk.asf", asf);
  EXPECT_EQ(chosen(take), "35-walk.asf");
  put("35.ASF", asf);
  EXPECT_EQ(chosen(take), "35.ASF");
  put("35_01.asf", asf);
  EXPECT_EQ(chosen(take), "35_01.asf");
  put("some one.asf", asf);
  EXPECT_EQ(chosen(take), "some one.asf");
  ReadOptions options;
  options.skeleton = folder_ / "other.asf";
  EXPECT_EQ(chosen(take, options), "other.asf");
}

TEST_F(SkeletonFolder, WithoutASkeletonTheNamesThatWereTriedAreSaid) {
  const auto take = put("35_01.amc", "#!OML:ASF F:\\x\\Justin.ASF\n1\nroot 0\n");
  EXPECT_EQ(
      message_of([&] { read_joints(take); }, ErrorKind::unreadable_input),
      take.string() +
          ": an AMC file needs its skeleton: its folder has no Justin.ASF, 35_01.asf, 35.asf, "
          "and no other ASF file; name one with --asf");
}

TEST(AmcReader, IsFoundByContent) {
  EXPECT_EQ(read_joints(figure_asf(), "noname").take.source.format, "asf");
  ReadOptions options;
  options.skeleton = acclaim_fixture("asf/good/figure.asf");
  for (const char* start :
       {"#!OML:ASF a.asf\n1\n", ":FULLY-SPECIFIED\n1\n", ":DEGREES\n1\n", "1\n"}) {
    const std::string body = figure_amc().substr(figure_amc().find("root"));
    EXPECT_EQ(read_joints(start + body, "noname", options).take.source.format, "amc") << start;
  }
}

}  // namespace
}  // namespace kinemend
