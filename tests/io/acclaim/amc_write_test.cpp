// Tests of the AMC writer: into the text of the source, and from any clip.
#include <fmt/format.h>

#include <map>

#include "acclaim.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

Take written_and_read(const Take& clip) {
  const Take again = read_pair(write_take(clip, "amc"), write_take(clip, "asf")).take;
  again.validate();
  return again;
}

// Compares positions by name; joints that only ASF needs are ignored.
void expect_same_positions(const Take& clip, const Take& again, double relative,
                           std::vector<std::string> names = {}) {
  ASSERT_EQ(clip.frame_count(), again.frame_count());
  if (names.empty()) names = clip.skeleton.names;
  names[0] = "root";
  const double size = body_height(clip.skeleton) + 1;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const Pose expected = forward_kinematics(clip, f), found = forward_kinematics(again, f);
    for (std::size_t j = 0; j < names.size(); ++j) {
      const std::int32_t k = again.skeleton.find(names[j]);
      ASSERT_GE(k, 0) << names[j];
      ASSERT_LT(norm(expected.positions[j] - found.positions[static_cast<std::size_t>(k)]),
                relative * size)
          << names[j];
    }
  }
}

TEST(AmcWriter, AnUnchangedTakeComesBackToTheByte) {
  for (const char* name : {"figure", "order", "radians", "three_dofs", "header_only"}) {
    const std::string text = read_file(acclaim_fixture(std::string("amc/good/") + name + ".amc"));
    const Take clip = read_pair(text, figure_asf()).take;
    EXPECT_EQ(write_take(clip, "amc"), text) << name;
    EXPECT_EQ(write_take(clip, "asf"), figure_asf()) << name;
  }
}

TEST(AmcWriter, IsTheDefaultForATakeThatWasReadFromAmc) {
  const Take clip = read_figure();
  EXPECT_EQ(write_take(clip), figure_amc());
  EXPECT_EQ(write_take(clip), figure_amc());
  Take made = without_rest_rotations(clip);
  made.source = {};
  EXPECT_EQ(write_take(made).substr(0, 9), "HIERARCHY") << "BVH where there is no source";
}

TEST(AmcWriter, WhatIsNoNumberIsWrittenAsItIsHeld) {
  const std::string text = read_file(acclaim_fixture("amc/good/gaps.amc"));
  const Take clip = read_pair(text, figure_asf()).take;
  const auto before = lines_of(text), after = lines_of(write_take(clip, "amc"));
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool had_gap =
        before[i].find("nan") != before[i].npos || before[i].find("inf") != before[i].npos;
    if (!had_gap) {
      EXPECT_EQ(after[i], before[i]);
    }
  }
  EXPECT_EQ(after[5], "thigh -5.268300 -35.656800 -66.701300");
  EXPECT_EQ(after[10], "slider -47.877000 50.6778 7.852000 76.9462 -47.2785");
  EXPECT_EQ(after[13], "root -22.285800 5.4957 -15.8819 18.1322 22.040000 -22.2744");
}

TEST(AmcWriter, OnlyChangedSamplesAreWrittenAnew) {
  Take clip = read_figure();
  const auto foot = static_cast<std::size_t>(clip.skeleton.find("foot"));
  clip.rotation(1, foot) = rotation_of({20, 10, 0}, "ZX");
  clip.root_position(2).y += 0.5;
  const auto before = lines_of(figure_amc()), after = lines_of(write_take(clip, "amc"));
  ASSERT_EQ(before.size(), after.size());
  std::map<std::size_t, std::string> changed;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] != after[i]) changed[i] = after[i];
  }
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed.begin()->second.substr(0, 5), "foot ");
  const Take again = read_pair(write_take(clip, "amc"), figure_asf()).take;
  EXPECT_LT(angle_between(again.rotation(1, foot), clip.rotation(1, foot)), 1e-6);
  EXPECT_NEAR(again.root_position(2).y, clip.root_position(2).y, 1e-6);
  EXPECT_EQ(again.root_position(2).x, clip.root_position(2).x);
}

TEST(AmcWriter, ChangesOfEverySampleReadBack) {
  for (const char* name : {"figure", "gaps", "order", "radians", "three_dofs"}) {
    const std::string text = read_file(acclaim_fixture(std::string("amc/good/") + name + ".amc"));
    Take clip = read_pair(text, figure_asf()).take;
    Random random(4);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        const RotationOrder order = clip.skeleton.rotation_order(j);
        if (order.count == 0) continue;
        clip.rotation(f, j) = from_euler(
            {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, order);
      }
      clip.root_position(f) += {random.normal(), random.normal(), random.normal()};
    }
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      for (std::size_t i = 1; i < clip.point_count(); ++i)
        clip.position(f, i) += {0.25, random.normal(), -0.5};
    }
    const Take again = read_pair(write_take(clip, "amc"), figure_asf()).take;
    expect_same_motion(clip, again, 1e-4);
  }
}

TEST(AmcWriter, AnglesContinueTheFrameBefore) {
  const std::string asf = chain_asf({"dof rx ry rz"});
  std::string amc;
  for (int f = 0; f < 40; ++f) {
    amc += fmt::format("{}\nroot 0 0 0 0 0 0\na {} 10.0000 20.0000\n", f + 1, 170.0 + f);
  }
  Take clip = read_pair(amc, asf).take;
  for (std::size_t f = 5; f < 30; ++f)
    clip.rotation(f, 1) = clip.rotation(f, 1) * exp({0.01, 0, 0});
  const auto lines = lines_of(write_take(clip, "amc"));
  double previous = 170;
  for (std::size_t i = 2; i < lines.size(); i += 3) {
    const double x = std::stod(lines[i].substr(2));
    EXPECT_LT(std::fabs(x - previous), 3) << lines[i];
    previous = x;
  }
}

TEST(AmcWriter, OtherFramesKeepHeaderOrderAndColumns) {
  const Take clip = read_figure();
  Take shorter = slice(clip, 1, 3);
  shorter.source = clip.source;
  const std::string text = write_take(shorter, "amc");
  EXPECT_EQ(text.substr(0, text.find("1\n")), figure_amc().substr(0, figure_amc().find("1\n")));
  const Take again = read_pair(text, figure_asf()).take;
  expect_same_motion(shorter, again, 1e-4);
}

TEST(AmcWriter, AnyClipBecomesASkeletonAndItsMotion) {
  Random random(9);
  for (const char* order : {"XYZ", "ZXY", "YZX", "ZYX", "XZY", "YXZ"}) {
    Take clip;
    const auto channels = make_channels(false, parse_rotation_order(order));
    clip.skeleton.add_joint("Hips", -1, {1, 2, 3},
                            make_channels(true, parse_rotation_order(order)));
    clip.skeleton.add_joint("Spine", 0, {0, 4, 1}, channels);
    clip.skeleton.add_joint("Left", 1, {2, 1, 0}, channels);
    clip.skeleton.add_joint("Right", 1, {-2, 1, 0},
                            make_channels(true, parse_rotation_order(order)));
    clip.skeleton.add_joint("Hand", 3, {-3, 0, 0}, {Channel::x_rotation});
    clip.skeleton.add_joint("Tail", 0, {}, channels);
    clip.skeleton.end_sites = {{2, {1, 1, 0}, ""}, {4, {-1, 0, 0}, ""}, {1, {0, 5, 0}, "head"}};
    for (Quat& rest : clip.skeleton.rest_rotations) {
      rest = normalized({random.normal(), random.normal(), random.normal(), random.normal()});
    }
    clip.frame_rate_hz = 60;
    clip.metres_per_unit = 0.01;
    clip.translated_joints = {3};
    for (int f = 0; f < 5; ++f) {
      for (int track = 0; track < 2; ++track)
        clip.positions.push_back({random.normal(), random.normal(), random.normal()});
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        clip.rotations.push_back(
            from_euler({random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3)},
                       clip.skeleton.rotation_order(j)));
      }
    }
    clip.validate();
    const Take again = written_and_read(clip);
    expect_same_positions(clip, again, 1e-9);
    EXPECT_DOUBLE_EQ(again.metres_per_unit, 0.01);
    for (const char* name : {"Spine", "Left", "Right", "Hand"}) {
      const auto a = static_cast<std::size_t>(clip.skeleton.find(name));
      const auto b = static_cast<std::size_t>(again.skeleton.find(name));
      EXPECT_EQ(clip.skeleton.rotation_order(a), again.skeleton.rotation_order(b)) << name;
    }
  }
}

TEST(AmcWriter, EndsOfChainsStayWhereTheyAre) {
  Take clip;
  clip.skeleton.add_joint("a", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
  clip.skeleton.add_joint("b", 0, {0, 1, 0}, make_channels(false, parse_rotation_order("ZXY")));
  clip.skeleton.end_sites = {{1, {0, 2, 0}, ""}, {0, {3, 0, 0}, ""}};
  clip.frame_rate_hz = 30;
  clip.positions = {{1, 1, 1}};
  clip.rotations = {rotation_of({10, 20, 30}, "ZXY"), rotation_of({40, 50, 60}, "ZXY")};
  const Take again = written_and_read(clip);
  const auto expected = joint_positions(clip, true), found = joint_positions(again, true);
  for (std::size_t i = 2; i < expected.size(); ++i) {
    EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                            [&](Vec3 p) { return norm(p - expected[i]) < 1e-8; }));
  }
}

TEST(AmcWriter, NamesThatTheFormatCannotHoldAreAltered) {
  Take clip;
  const auto channels = make_channels(false, parse_rotation_order("ZXY"));
  clip.skeleton.add_joint("hips", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
  for (const char* name : {"left arm", "left_arm", "root", "12", "", "a(b),c#d", ":mark", "end",
                           "mixamorig:Hips", "nan"}) {
    clip.skeleton.add_joint(name, 0, {1, 0, 0}, channels);
  }
  clip.frame_rate_hz = 30;
  clip.positions = {{}};
  clip.rotations.assign(clip.joint_count(), rotation_of({1, 2, 3}, "ZXY"));
  const Take again = written_and_read(clip);
  expect_same_positions(clip, again, 1e-9,
                        {"root", "left_arm", "left_arm_2", "_root", "_12", "joint", "a_b__c_d",
                         "_mark", "_end", "mixamorig:Hips", "_nan"});
}

TEST(AmcWriter, LimitsAreWritten) {
  Take clip = read_figure();
  clip.source = {};
  const Take again = written_and_read(clip);
  const auto a = static_cast<std::size_t>(clip.skeleton.find("thigh"));
  const auto b = static_cast<std::size_t>(again.skeleton.find("thigh"));
  ASSERT_EQ(again.skeleton.limits[b].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.skeleton.limits[b][i].minimum, clip.skeleton.limits[a][i].minimum);
    EXPECT_EQ(again.skeleton.limits[b][i].maximum, clip.skeleton.limits[a][i].maximum);
  }
  expect_same_positions(clip, again, 1e-9);
}

TEST(AmcWriter, RefusesWhatTheFormatCannotHold) {
  const auto refuse = [](auto change) {
    Take clip;
    clip.skeleton.add_joint("a", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
    clip.skeleton.add_joint("b", 0, {1, 2, 3}, {});
    clip.frame_rate_hz = 30;
    clip.positions = {{}};
    clip.rotations = {{}, {}};
    change(clip);
    return message_of([&] { write_take(clip, "amc"); }, ErrorKind::usage);
  };
  EXPECT_EQ(refuse([](Take&) {}), "no error");
  EXPECT_EQ(refuse([](Take& clip) { clip.skeleton.parents[1] = -1; }),
            "ASF holds one root; joint \"b\" is another");
  EXPECT_EQ(refuse([](Take& clip) {
              clip.skeleton.channels[1] = make_channels(false, parse_rotation_order("ZXZ"));
            }),
            "ASF cannot hold joint \"b\", which turns about one axis twice");
  EXPECT_EQ(refuse([](Take& clip) {
              clip.rotation(0, 1) = rotation_of({5, 0, 0}, "Z");
            }),
            "joint \"b\" turns but has no rotation channels");
}

TEST(AmcWriter, ARootWithoutPositionsKeepsItsPlace) {
  Take clip;
  clip.skeleton.add_joint("a", -1, {1, 2, 3}, make_channels(false, parse_rotation_order("ZXY")));
  clip.skeleton.add_joint("b", 0, {0, 1, 0}, make_channels(false, parse_rotation_order("ZXY")));
  clip.frame_rate_hz = 30;
  clip.positions = {{1, 2, 3}};
  clip.rotations = {rotation_of({10, 20, 30}, "ZXY"), rotation_of({40, 50, 60}, "ZXY")};
  expect_same_positions(clip, written_and_read(clip), 1e-9);
}

}  // namespace
}  // namespace kinemend
