// Tests of the ASF reader: the hierarchy, axes, lengths and limits, and errors with their line.
#include "acclaim.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace test;

Take read_skeleton(const std::string& asf) { return read_joints(asf, "take.asf").take; }

std::string refusal(const std::string& asf) {
  return message_of([&] { read_joints(asf, "take.asf"); }, ErrorKind::unreadable_input);
}

TEST(AsfReader, AFileAloneIsAClipOfNoFrames) {
  const TakeResult result = read_joints(figure_asf(), "take.asf");
  EXPECT_EQ(result.take.frame_count(), 0u);
  EXPECT_EQ(result.take.joint_count(), 10u);
  EXPECT_EQ(result.take.frame_rate_hz, 120);
  EXPECT_TRUE(result.diagnostics.empty());
  result.take.validate();
  EXPECT_EQ(result.take.translated_joints.size(), 1u);
}

TEST(AsfReader, JointsAreDepthFirstWhateverTheHierarchySays) {
  EXPECT_EQ(read_skeleton(figure_asf()).skeleton.names,
            (std::vector<std::string>{"root", "hip", "thigh", "shin", "foot", "spine", "arm",
                                      "slider", "hand", "neck"}));
}

TEST(AsfReader, TurnsAboutFixedAxesAreAProductInReverse) {
  const Skeleton skeleton = read_skeleton(figure_asf()).skeleton;
  const auto order = [&](const char* name) {
    return to_string(skeleton.rotation_order(static_cast<std::size_t>(skeleton.find(name))));
  };
  EXPECT_EQ(order("root"), "XYZ");  // the file says: order TX RZ TZ RY TY RX
  EXPECT_EQ(order("thigh"), "ZYX");
  EXPECT_EQ(order("shin"), "X");
  EXPECT_EQ(order("foot"), "ZX");
  EXPECT_EQ(order("arm"), "XZ");
  EXPECT_EQ(order("hip"), "");
}

TEST(AsfReader, LengthsAreInchesOverTheUnit) {
  const auto metres = [](const char* units) {
    return read_skeleton(chain_asf({"length 1"}, units)).metres_per_unit;
  };
  EXPECT_DOUBLE_EQ(metres("length 0.45\n"), (1 / 0.45) * 2.54 / 100);
  EXPECT_DOUBLE_EQ(metres("length 2.54\n"), 0.01);
  EXPECT_EQ(metres("length 1.0\n"), 0);
  EXPECT_EQ(metres(""), 0);
}

TEST(AsfReader, RadiansAreOfAxesLimitsAndOrientation) {
  const Take degrees =
      read_skeleton(chain_asf({"axis 0 0 90 XYZ\ndof rx\nlimits (-180 90)"}, "angle deg\n"));
  const Take radians = read_skeleton(chain_asf(
      {"axis 0 0 1.5707963267948966 XYZ\ndof rx\nlimits (-3.141592653589793 1.5707963267948966)"},
      "angle rad\n"));
  EXPECT_LT(angle_between(degrees.skeleton.rest_rotations[1], radians.skeleton.rest_rotations[1]),
            1e-12);
  EXPECT_NEAR(radians.skeleton.limits[1][0].minimum, -180, 1e-9);
  EXPECT_NEAR(radians.skeleton.limits[1][0].maximum, 90, 1e-9);
}

TEST(AsfReader, LimitsGoWithTheirChannels) {
  const Skeleton skeleton = read_skeleton(figure_asf()).skeleton;
  const auto& limits = skeleton.limits[static_cast<std::size_t>(skeleton.find("thigh"))];
  ASSERT_EQ(limits.size(), 3u);  // Z, Y, X
  EXPECT_EQ(limits[0].maximum, 65.5);
  EXPECT_TRUE(std::isinf(limits[0].minimum));
  EXPECT_EQ(limits[1].minimum, -70);
  EXPECT_EQ(limits[2].minimum, -160);
  EXPECT_EQ(limits[2].maximum, 20);
  EXPECT_TRUE(skeleton.limits[static_cast<std::size_t>(skeleton.find("shin"))].empty());
}

TEST(AsfReader, DirectionsNeedNotBeOfUnitLength) {
  const Skeleton skeleton =
      read_skeleton(chain_asf({"direction 0 0 7\nlength 3", "direction 1 0 0\nlength 1"})).skeleton;
  EXPECT_LT(norm(skeleton.offsets[2] - Vec3{0, 0, 3}), 1e-12);
  ASSERT_EQ(skeleton.end_sites.size(), 1u);
  EXPECT_LT(norm(skeleton.end_sites[0].offset - Vec3{1, 0, 0}), 1e-12);
}

TEST(AsfReader, ThePresetOfTheRootMovesAndTurnsTheWholeFigure) {
  const std::string asf = chain_asf({"direction 0 1 0\nlength 2", "length 1"}, "",
                                    "order tx ty tz rx ry rz\naxis XYZ\nposition 1 2 3\n"
                                    "orientation 0 0 90\n");
  const Take clip = read_pair("1\nroot 10 0 0 0 0 0\n", asf).take;
  const Pose pose = forward_kinematics(clip, 0);
  EXPECT_LT(norm(pose.positions[0] - Vec3{11, 2, 3}), 1e-12);
  EXPECT_LT(norm(pose.positions[2] - Vec3{9, 2, 3}), 1e-12);
}

TEST(AsfReader, RepairsAreNamed) {
  const auto repairs = [](const std::string& asf, const char* name) {
    return read_joints(asf, "take.asf").diagnostics.count(name);
  };
  EXPECT_EQ(repairs(chain_asf({"dof rx ry\nlimits (0 1)"}), "limits_mismatch"), 1u);
  EXPECT_EQ(repairs(chain_asf({"colour red"}), "unknown_keyword"), 1u);
  EXPECT_EQ(repairs(chain_asf({"direction 0 0 0\nlength 2"}), "direction_zero"), 1u);
  EXPECT_EQ(repairs(chain_asf({""}, "", "axis XYZ\n"), "root_order_missing"), 1u);
  ReadOptions strict;
  strict.strict = true;
  EXPECT_EQ(message_of([&] { read_joints(chain_asf({"colour red"}), "take.asf", strict); },
                       ErrorKind::quality_limit),
            "take.asf:7: \"colour\" is not a keyword of the format");
}

TEST(AsfReader, ErrorsNameTheLine) {
  EXPECT_EQ(refusal(""), "take.asf:1: the file is empty");
  EXPECT_EQ(refusal(replaced(figure_asf(), "length 7.5", "length")),
            "take.asf:39: expected a number, found \"axis\"");
  EXPECT_EQ(refusal(replaced(figure_asf(), "root hip spine", "root hip spin")),
            "take.asf:93: the hierarchy names the bone \"spin\", which :bonedata does not have");
  EXPECT_EQ(refusal(replaced(figure_asf(), "hip thigh", "hip thigh arm")),
            "take.asf:96: the bone \"arm\" has two parents");
  EXPECT_EQ(refusal(replaced(figure_asf(), "    shin foot\n", "")),
            "take.asf:42: the hierarchy does not join the bone \"foot\" to the root");
  EXPECT_EQ(refusal(replaced(figure_asf(), "ZYX", "ZYZ")),
            "take.asf:39: expected an order of axes such as XYZ, found \"ZYZ\"");
}

TEST(AsfReader, DepthIsLimited) {
  ReadOptions shallow;
  shallow.max_depth = 3;
  EXPECT_EQ(message_of([&] { read_joints(figure_asf(), "take.asf", shallow); },
                       ErrorKind::unreadable_input),
            "take.asf:34: bones nested deeper than 3");
}

}  // namespace
}  // namespace kinemend
