// Tests of BVH in a plain layout: a written file reads back the same.
#include <cmath>
#include <limits>

#include "io/bvh/bvh.hpp"
#include "io/bvh/bvh_hierarchy.hpp"
#include "io/support.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;

// A random valid clip: tree, channels, rates and motion. Angles avoid rotations that the channels
// cannot represent.
Take random_clip(Random& random) {
  Take clip;
  const std::size_t joints = 1 + random.below(12), frames = random.below(20);
  std::vector<RotationOrder> orders;
  for (std::size_t j = 0; j < joints; ++j) {
    // Chooses the parent on the current path, so that joints are in depth-first order.
    std::int32_t parent = static_cast<std::int32_t>(j) - 1;
    while (parent > 0 && random.chance(0.3))
      parent = clip.skeleton.parents[static_cast<std::size_t>(parent)];
    if (j > 0 && random.chance(0.1)) parent = -1;
    RotationOrder order = all_rotation_orders()[random.below(12)];
    order.count = static_cast<std::uint8_t>(random.below(4));
    const bool moves = j == 0 || random.chance(0.3);
    std::vector<Channel> channels = make_channels(moves, order);
    if (random.chance(0.3))
      std::rotate(channels.begin(), channels.begin() + (moves ? 3 : 0), channels.end());
    const Vec3 offset{random.normal(), random.normal() * 100,
                      random.chance(0.5) ? 0 : random.normal() * 1e-6};
    clip.skeleton.add_joint(random.chance(0.1) ? "same name" : "joint:" + std::to_string(j), parent,
                            offset, channels);
    orders.push_back(order);
    if (j > 0 && moves) clip.translated_joints.push_back(static_cast<std::int32_t>(j));
  }
  for (std::size_t j = 0; j < joints; ++j) {
    const bool leaf = std::count(clip.skeleton.parents.begin(), clip.skeleton.parents.end(),
                                 static_cast<std::int32_t>(j)) == 0;
    if (leaf && random.chance(0.7)) {
      clip.skeleton.end_sites.push_back(
          {static_cast<std::int32_t>(j), {1, 2, random.normal()}, random.chance(0.2) ? "tip" : ""});
    }
  }
  const double rates[] = {23.976, 25, 29.97, 30, 60, 72, 100, 119.88, 120, 240, 87.3, 1000, 12.5};
  clip.frame_rate_hz = rates[random.below(13)];
  for (std::size_t f = 0; f < frames; ++f) {
    const auto position = [&] {
      return Vec3{random.normal() * 50, random.normal(), random.uniform(-1e4, 1e4)};
    };
    for (std::size_t i = 0; i < clip.point_count(); ++i) clip.positions.push_back(position());
    for (std::size_t j = 0; j < joints; ++j) {
      std::array<double, 3> angles{};
      for (std::size_t i = 0; i < orders[j].count; ++i) angles[i] = random.uniform(-pi, pi);
      clip.rotations.push_back(from_euler(angles, orders[j]));
    }
  }
  return clip;
}

TEST(BvhWriter, WhatIsWrittenReadsBackTheSame) {
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const Take clip = random_clip(random);
    clip.validate();
    const std::string text = write_take(clip);
    const TakeResult again = read_joints(text, "again.bvh");
    EXPECT_TRUE(again.diagnostics.empty());
    const Skeleton &a = clip.skeleton, &b = again.take.skeleton;
    ASSERT_EQ(a.names, b.names);
    ASSERT_EQ(a.parents, b.parents);
    ASSERT_EQ(a.offsets, b.offsets);
    ASSERT_EQ(a.channels, b.channels);
    ASSERT_EQ(a.end_sites.size(), b.end_sites.size());
    for (std::size_t e = 0; e < a.end_sites.size(); ++e) {
      const auto same = [&](const EndSite& site) {
        return site.parent == a.end_sites[e].parent && site.offset == a.end_sites[e].offset &&
               site.name == a.end_sites[e].name;
      };
      ASSERT_EQ(std::count_if(b.end_sites.begin(), b.end_sites.end(), same), 1);
    }
    ASSERT_NEAR(again.take.frame_rate_hz, clip.frame_rate_hz, 1e-12 * clip.frame_rate_hz);
    expect_same_motion(clip, again.take, 3e-6);
    EXPECT_EQ(write_take(again.take), text);
  }
}

TEST(BvhWriter, PlainLayoutIsTheUsualOne) {
  Take clip;
  clip.skeleton.add_joint("Hips", -1, {0, 90.5, 0},
                          make_channels(true, parse_rotation_order("ZXY")));
  clip.skeleton.add_joint("Spine", 0, {0, 10, -0.25},
                          make_channels(false, parse_rotation_order("XYZ")));
  clip.skeleton.end_sites.push_back({1, {0, 20, 0}, ""});
  clip.frame_rate_hz = 120;
  clip.positions = {{1, 2, 3}};
  clip.rotations = {rotation_of({10, 20, 30}, "ZXY"), rotation_of({-1, -2, -3}, "XYZ")};
  EXPECT_EQ(
      write_take(clip),
      "HIERARCHY\n"
      "ROOT Hips\n"
      "{\n"
      "\tOFFSET 0 90.5 0\n"
      "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
      "\tJOINT Spine\n"
      "\t{\n"
      "\t\tOFFSET 0 10 -0.25\n"
      "\t\tCHANNELS 3 Xrotation Yrotation Zrotation\n"
      "\t\tEnd Site\n"
      "\t\t{\n"
      "\t\t\tOFFSET 0 20 0\n"
      "\t\t}\n"
      "\t}\n"
      "}\n"
      "MOTION\n"
      "Frames: 1\n"
      "Frame Time: 0.008333\n"
      "1.000000 2.000000 3.000000 10.000000 20.000000 30.000000 -1.000000 -2.000000 -3.000000\n");
}

TEST(BvhWriter, AnglesContinueTheFrameBefore) {
  Take clip;
  const RotationOrder order = parse_rotation_order("ZXY");
  clip.skeleton.add_joint("spinner", -1, {}, make_channels(true, order));
  clip.frame_rate_hz = 120;
  // Two rotations about the first axis, the middle one up to 88 degrees.
  for (int f = 0; f < 500; ++f) {
    clip.positions.push_back({});
    clip.rotations.push_back(rotation_of({1.44 * f, 88 * std::sin(f * 0.01), 0.3 * f}, "ZXY"));
  }
  const auto rows = rows_of(write_take(clip), 6);
  ASSERT_EQ(rows.size(), 500u);
  for (int f = 0; f < 500; ++f) {
    const std::vector<double>& row = rows[static_cast<std::size_t>(f)];
    ASSERT_NEAR(row[3], 1.44 * f, 1e-4);
    ASSERT_NEAR(row[4], 88 * std::sin(f * 0.01), 1e-4);
    ASSERT_NEAR(row[5], 0.3 * f, 1e-4);
  }
}

TEST(BvhWriter, RestRotationsGoIntoTheAngles) {
  Take clip;
  clip.skeleton.add_joint("a", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
  clip.skeleton.add_joint("b", 0, {0, 1, 0}, make_channels(false, parse_rotation_order("ZXY")));
  clip.skeleton.end_sites.push_back({1, {0, 1, 0}, ""});
  clip.skeleton.rest_rotations = {rotation_of({10, 20, 30}, "XYZ"),
                                  rotation_of({70, -20, 30}, "XYZ")};
  clip.frame_rate_hz = 30;
  clip.positions = {{0, 0, 0}};
  clip.rotations = {rotation_of({40, 50, 60}, "XYZ"), rotation_of({1, 2, 3}, "XYZ")};
  const auto before = joint_positions(clip, true),
             after = joint_positions(read_text(write_take(clip)), true);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT(norm(before[i] - after[i]), 1e-6);
}

TEST(BvhWriter, JointsAreWrittenDepthFirstWhateverTheirOrder) {
  Take clip;
  const auto channels = make_channels(false, parse_rotation_order("ZXY"));
  clip.skeleton.add_joint("root", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
  clip.skeleton.add_joint("left", 0, {1, 0, 0}, channels);
  clip.skeleton.add_joint("right", 0, {-1, 0, 0}, channels);
  clip.skeleton.add_joint("left hand", 1, {2, 0, 0}, channels);
  clip.frame_rate_hz = 30;
  clip.positions = {{}};
  clip.rotations = {Quat{}, rotation_of({1, 0, 0}, "Z"), rotation_of({2, 0, 0}, "Z"),
                    rotation_of({3, 0, 0}, "Z")};
  const Take again = read_text(write_take(clip));
  EXPECT_EQ(again.skeleton.names, (std::vector<std::string>{"root", "left", "left hand", "right"}));
  EXPECT_LT(angle_between(again.rotation(0, 2), rotation_of({3, 0, 0}, "Z")), 1e-8);
}

TEST(BvhWriter, RefusesWhatTheFormatCannotHold) {
  const auto refuse = [](auto change) {
    Take clip;
    clip.skeleton.add_joint("a", -1, {1, 2, 3}, make_channels(true, parse_rotation_order("ZXY")));
    clip.skeleton.add_joint("b", 0, {1, 2, 3}, {});
    clip.frame_rate_hz = 30;
    clip.positions = {{1, 2, 3}};
    clip.rotations = {Quat{}, Quat{}};
    write_take(clip);
    change(clip);
    return message_of([&] { write_take(clip); }, ErrorKind::usage);
  };
  EXPECT_EQ(refuse([](Take& c) { c.skeleton.names[1] = "a\nb"; }),
            "BVH cannot hold the name \"a.b\"");
  EXPECT_EQ(refuse([](Take& c) {
              c.rotations[1] = rotation_of({1, 0, 0}, "X");
            }),
            "joint \"b\" turns but has no rotation channels");
  EXPECT_EQ(refuse([](Take& c) {
              c.skeleton.channels[0] = make_channels(false, parse_rotation_order("ZXY"));
              c.root_position(0).x = 9;
            }),
            "joint \"a\" moves but has no position channels");
  EXPECT_EQ(
      refuse([](Take& c) { c.root_position(0).x = std::numeric_limits<double>::quiet_NaN(); }),
      "a value to write is not finite");
  EXPECT_EQ(refuse([](Take& c) { c.rotations.pop_back(); }),
            "the arrays of the clip have different numbers of frames");
  EXPECT_EQ(refuse([](Take& c) { c.frame_rate_hz = 0; }),
            "a frame rate of 0 Hz is outside 0.1 to 100000 Hz");
}

TEST(BvhWriter, FrameTimesReadBackAsTheirRate) {
  for (const double rate :
       {1.0,  12.5,  23.976, 24.0,   25.0,  29.97, 30.0,   59.94, 60.0,   72.0, 87.3,
        90.0, 100.0, 119.95, 119.88, 120.0, 144.0, 239.76, 240.0, 1000.0, 0.1,  3333.3}) {
    const std::string text = frame_time_text(rate);
    EXPECT_NEAR(rate_from_frame_time(std::strtod(text.c_str(), nullptr), text), rate, 1e-12 * rate)
        << text;
  }
}

}  // namespace
}  // namespace kinemend
