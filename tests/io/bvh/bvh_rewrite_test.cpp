// Tests of changed takes that are written into the text of their BVH file.
#include <cmath>

#include "io/support.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;

// The words of a text and their positions, without white space.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  bool inside = false;
  for (const char c : text) {
    const bool blank = c == ' ' || (c >= '\t' && c <= '\r');
    if (!blank && !inside) words.emplace_back();
    if (!blank) words.back() += c;
    inside = !blank;
  }
  return words;
}

// The white space of a text, with each word replaced by one letter.
std::string blanks_of(const std::string& text) {
  std::string blanks;
  for (const char c : text) {
    const bool blank = c == ' ' || (c >= '\t' && c <= '\r');
    if (blank || blanks.empty() || blanks.back() != 'w') blanks += blank ? c : 'w';
  }
  return blanks;
}

// A take of one ball joint with the given angles (degrees), four decimals.
std::string spinner_text(const std::vector<std::array<double, 3>>& angles) {
  std::string text =
      "HIERARCHY\nROOT a\n{\n OFFSET 0 0 0\n CHANNELS 3 Zrotation Xrotation "
      "Yrotation\n}\nMOTION\nFrames: " +
      std::to_string(angles.size()) + "\nFrame Time: 0.01\n";
  char line[200];
  for (const auto& a : angles) {
    std::snprintf(line, sizeof line, "%.4f %.4f %.4f\n", a[0], a[1], a[2]);
    text += line;
  }
  return text;
}

double wrapped(double degrees) { return degrees - 360 * std::floor((degrees + 180) / 360); }

double largest_step(const std::vector<std::vector<double>>& rows) {
  double largest = 0;
  for (std::size_t f = 1; f < rows.size(); ++f) {
    for (std::size_t c = 0; c < rows[f].size(); ++c)
      largest = std::max(largest, std::fabs(rows[f][c] - rows[f - 1][c]));
  }
  return largest;
}

TEST(BvhRewriter, AnUnchangedClipComesBackToTheByte) {
  for (const auto& path : fixtures_in("good")) {
    const TakeResult read = read_joints(path);
    if (read.diagnostics.count("value_not_finite") > 0) continue;
    EXPECT_EQ(write_take(read.take), read_file(path)) << path;
  }
}

TEST(BvhRewriter, OneChangedSampleChangesItsDigitsOnly) {
  Random random(21);
  for (const auto& path : fixtures_in("good")) {
    SCOPED_TRACE(path);
    const TakeResult read = read_joints(path);
    const Take& clip = read.take;
    // A wrong head is mended too.
    const std::size_t faults = read.diagnostics.count("frame_time_unusable") +
                               read.diagnostics.count("frame_count_mismatch") +
                               read.diagnostics.count("frame_count_missing");
    for (int i = 0; i < 10 && clip.frame_count() > 0; ++i) {
      const std::size_t frame = random.below(clip.frame_count()),
                        joint = random.below(clip.joint_count());
      const std::size_t turns = clip.skeleton.rotation_order(joint).count;
      Take changed = clip;
      changed.rotation(frame, joint) = changed.rotation(frame, joint) * exp({0.01, 0.02, 0.03});
      const std::string before = write_take(clip), after = write_take(changed);
      EXPECT_EQ(blanks_of(before), blanks_of(after));
      const auto old_words = words_of(before), new_words = words_of(after);
      ASSERT_EQ(old_words.size(), new_words.size());
      std::size_t different = 0;
      for (std::size_t w = 0; w < old_words.size(); ++w)
        different += old_words[w] != new_words[w] ? 1 : 0;
      EXPECT_LE(different, turns + faults);
      EXPECT_EQ(different > 0, turns > 0);
    }
  }
}

// Two joints and three frames, with a head as given.
std::string small_bvh(const std::string& offset, const std::string& head) {
  return "HIERARCHY\nROOT Hips\n{\nOFFSET " + offset +
         "\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
         "JOINT Spine\n{\nOFFSET 0 20 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
         "End Site\n{\nOFFSET 0 10 0\n}\n}\n}\nMOTION\n" +
         head + "0 90 0 1 2 3 4 5 6\n0 91 0 2 3 4 5 6 7\n0 92 0 3 4 5 6 7 8\n";
}

Take read_at(const std::string& bytes, double frame_rate_hz) {
  ReadOptions options;
  options.frame_rate_hz = frame_rate_hz;
  return read_joints(bytes, "a.bvh", options).take;
}

TEST(BvhRewriter, AWrongHeadIsMendedInAFileThatIsChangedAnyway) {
  const std::string bytes = small_bvh("0 90 0", "Frames: 7\nFrame Time: 0\n");
  Take clip = read_at(bytes, 30);
  EXPECT_EQ(write_take(clip), bytes);
  clip.root_position(1).y += 1;
  std::string expected = small_bvh("0 90 0", "Frames: 3\nFrame Time: 0.033333\n");
  expected.replace(expected.find("0 91 0"), 6, "0 92.0000 0");
  EXPECT_EQ(write_take(clip), expected);
  // The two lines may come the other way round.
  const std::string turned = small_bvh("0 90 0", "Frame Time: -1\nFrames: 2.5\n");
  clip = read_at(turned, 50);
  clip.root_position(1).y += 1;
  EXPECT_NE(write_take(clip).find("MOTION\nFrame Time: 0.020000\nFrames: 3\n"), std::string::npos);
}

TEST(BvhRewriter, RestAnglesBehindAnOffsetAreSkippedAndStay) {
  const std::string bytes = small_bvh("0 90 0 0 0 5", "Frames: 3\nFrame Time: 0.01\n");
  const TakeResult read = read_joints(bytes, "a.bvh", {});
  EXPECT_EQ(read.diagnostics.count("offset_rest_angles"), 1u);
  EXPECT_EQ(read.take.skeleton.offsets[0], (Vec3{0, 90, 0}));
  EXPECT_EQ(
      read.take.rotations,
      read_joints(small_bvh("0 90 0", "Frames: 3\nFrame Time: 0.01\n"), "b.bvh").take.rotations);
  EXPECT_EQ(write_take(read.take), bytes);
}

TEST(BvhRewriter, ChangedSamplesReadBackAsWritten) {
  for (const auto& path : fixtures_in("good")) {
    SCOPED_TRACE(path);
    Take clip = read_joints(path).take;
    const Take source = clip;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      clip.root_position(f) += {0.125, 0.25, -0.5};
      for (std::size_t i = 1; i < clip.point_count(); ++i) clip.position(f, i) += {0.1, 0.2, 0.3};
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        const auto count = clip.skeleton.rotation_order(j).count;
        if (count == 3)
          clip.rotation(f, j) =
              clip.rotation(f, j) * exp({0.01, -0.02, 0.015 * static_cast<double>(f)});
      }
    }
    const Take again = read_joints(write_take(clip), path.string()).take;
    ASSERT_EQ(again.rotations.size(), clip.rotations.size());
    for (std::size_t i = 0; i < clip.rotations.size(); ++i) {
      if (clip.skeleton.rotation_order(i % clip.joint_count()).count != 3) continue;
      EXPECT_LT(angle_between(again.rotations[i], clip.rotations[i]), 2e-6) << i;
    }
    // Axes without a position channel keep the offset.
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const bool all_axes =
          std::count_if(clip.skeleton.channels[0].begin(), clip.skeleton.channels[0].end(),
                        [](Channel c) { return !is_rotation(c); }) == 3;
      if (all_axes) {
        EXPECT_LT(norm(again.root_position(f) - clip.root_position(f)), 1e-4);
      }
    }
  }
}

TEST(BvhRewriter, WritesNoExponentsAndAsManyDecimalsAsTheSource) {
  Take clip = read_joints(fixture("good/plain.bvh")).take;
  clip.rotation(1, 1) = rotation_of({1e-7, 12.34567, -0.00004}, "ZXY");
  EXPECT_NE(write_take(clip).find(" 0.0000 12.3457 0.0000\n"), std::string::npos);
  // A changed value gets four decimals if the source has fewer.
  Take coarse = read_joints(fixture("good/coarse.bvh")).take;
  coarse.rotation(1, 1) = rotation_of({5.5, 6, -7.125}, "ZXY");
  EXPECT_NE(write_take(coarse).find(" 5.5000 6 -7.1250\n"), std::string::npos);
  Take comma = read_joints(fixture("good/decimal_comma.bvh")).take;
  comma.rotation(1, 1) = rotation_of({5.5, 6, -7.125}, "ZXY");
  EXPECT_NE(write_take(comma).find(" 5,5000 6,0000 -7,1250\n"), std::string::npos);
}

TEST(BvhRewriter, WhatIsNoNumberIsWrittenAsItIsHeld) {
  Take clip = read_joints(fixture("good/gaps.bvh")).take;
  const std::string held = write_take(clip);
  EXPECT_THAT(held, testing::EndsWith(
                        "1.0000 92.0000 -3.5000 11.0000 -21.0000 31.0000 5.5000 6.2500 -7.1250\n"
                        "1.1000 92.0000 -3.4000 11.0000 -21.0000 31.0000 5.5000 6.2500 -7.1250\n"
                        "1.1000 92.2000 -3.3000 12.0000 -22.0000 32.0000 5.5000 6.2500 -7.1250\n"));
  clip.rotation(1, 1) = rotation_of({5.6, 6.35, -7.225}, "ZXY");
  EXPECT_THAT(write_take(clip),
              testing::HasSubstr(
                  "1.1000 92.0000 -3.4000 11.0000 -21.0000 31.0000 5.6000 6.3500 -7.2250\n"));
}

TEST(BvhRewriter, ANewRateReplacesTheFrameTimeOnly) {
  Take clip = read_joints(fixture("good/tabs.bvh")).take;
  clip.frame_rate_hz = 60;
  std::string expected = read_file(fixture("good/tabs.bvh"));
  expected.replace(expected.find("0.0083333"), 9, "0.016667");
  EXPECT_EQ(write_take(clip), expected);
}

TEST(BvhRewriter, OtherFramesKeepTheHierarchyText) {
  const std::string source = read_file(fixture("good/crlf.bvh"));
  Take clip = read_joints(fixture("good/crlf.bvh")).take;
  clip.positions.pop_back();
  clip.rotations.resize(clip.frame_count() * clip.joint_count());
  const std::string text = write_take(clip);
  const std::size_t motion = source.find("MOTION");
  EXPECT_EQ(text.substr(0, motion), source.substr(0, motion));
  EXPECT_NE(text.find("MOTION\r\nFrames: 2\r\nFrame Time: 0.0083333\r\n1.0000 92.0000"),
            std::string::npos);
  expect_same_motion(read_text(text), clip, 1e-5);
}

TEST(BvhRewriter, AFullyChangedTrackIsContinuousWhereTheSourceWraps) {
  std::vector<std::array<double, 3>> angles;
  for (int f = 0; f < 300; ++f)
    angles.push_back({wrapped(4.0 * f), 30 * std::sin(f * 0.1), wrapped(-3.0 * f)});
  Take clip = read_text(spinner_text(angles));
  EXPECT_GT(largest_step(rows_of(write_take(clip), 3)), 300);
  for (Quat& q : clip.rotations) q = q * exp({0.01, 0.01, 0.01});
  EXPECT_LT(largest_step(rows_of(write_take(clip), 3)), 10);
}

TEST(BvhRewriter, SmallChangesStayOnTheSourcesBranch) {
  // The source uses the second branch, many rotations away, which a new decomposition would not
  // find.
  std::vector<std::array<double, 3>> angles;
  for (int f = 0; f < 100; ++f) angles.push_back({730 + 0.5 * f, 120 - 0.1 * f, -400 + 0.2 * f});
  Take clip = read_text(spinner_text(angles));
  Random random(3);
  for (Quat& q : clip.rotations)
    q = q * exp({0.01 * random.normal(), 0.01 * random.normal(), 0.01 * random.normal()});
  const auto rows = rows_of(write_take(clip), 3);
  for (std::size_t f = 0; f < rows.size(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(rows[f][c], angles[f][c], 12) << f;
  }
}

TEST(BvhRewriter, ARepairAmidKeptFramesMovesNoJumpOfTheSource) {
  std::vector<std::array<double, 3>> angles;
  for (int f = 0; f < 60; ++f) angles.push_back({wrapped(150 + 2.0 * f), 10, 5});
  const std::string text = spinner_text(angles);
  Take clip = read_text(text);
  // The source wraps between frames 14 and 15; frames 13 to 17 get a small change.
  for (std::size_t f = 13; f < 18; ++f)
    clip.rotation(f, 0) = clip.rotation(f, 0) * exp({0, 0.001, 0.001});
  const auto before = rows_of(text, 3), after = rows_of(write_take(clip), 3);
  for (std::size_t f = 0; f < before.size(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(before[f][c], after[f][c], 0.2) << f;
    if (f < 13 || f > 17) {
      ASSERT_EQ(before[f], after[f]);
    }
  }
}

TEST(BvhRewriter, ASpikeThatFlippedTheBranchIsWrittenLikeItsNeighbours) {
  std::vector<std::array<double, 3>> angles;
  for (int f = 0; f < 40; ++f) angles.push_back({20.0 + f, 70, -10.0 + f});
  const auto smooth = angles;
  angles[20] = {-150, 95, 170};
  Take clip = read_text(spinner_text(angles));
  clip.rotation(20, 0) = rotation_of(smooth[20], "ZXY");
  const auto rows = rows_of(write_take(clip), 3);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(rows[20][c], smooth[20][c], 1e-3);
}

TEST(BvhRewriter, NothingJumpsNearGimbalLock) {
  std::vector<std::array<double, 3>> angles;
  for (int f = 0; f < 400; ++f)
    angles.push_back({0.5 * f, 89.9 * std::sin(f * 0.05), 20 * std::cos(f * 0.03)});
  Take clip = read_text(spinner_text(angles));
  for (Quat& q : clip.rotations) q = q * exp({1e-4, 1e-4, 1e-4});
  const auto rows = rows_of(write_take(clip), 3);
  // Near the poles the outer angles change in opposite directions, but never flip.
  EXPECT_LT(largest_step(rows), 90);
  const Take again = read_text(write_take(clip));
  expect_same_motion(clip, again, 1e-5);
}

TEST(BvhRewriter, HugeSourceAnglesDoNoHarm) {
  const Take source = read_text(spinner_text({{1, 2, 3}, {1e15, 2, 3}, {1, 2, 3}}));
  source.validate();
  for (std::size_t f = 1; f < 3; ++f) {
    Take clip = source;
    clip.rotation(f, 0) = rotation_of({1.3171, 2, 3}, "ZXY");
    EXPECT_LT(angle_between(read_text(write_take(clip)).rotation(f, 0), clip.rotation(f, 0)), 1e-5);
  }
}

TEST(BvhRewriter, LongTakesWithGapsKeepTheirDigits) {
  std::string text =
      "HIERARCHY\nROOT a\n{\n OFFSET 0 0 0\n CHANNELS 4 Xposition Zrotation Xrotation "
      "Yrotation\n}\nMOTION\n"
      "Frames: 5000\nFrame Time: 0.01\n";
  const std::size_t first_word = words_of(text).size();
  const auto is_gap = [](std::size_t f) { return f % 1024 < 2 || f % 97 == 0; };
  for (std::size_t f = 0; f < 5000; ++f) {
    const bool gap = is_gap(f);
    text += gap ? "nan 1.0 nan 2.0\n"
                : std::to_string(f) + ".25 1.5 " + std::to_string(f % 90) + ".125 2.0\n";
  }
  Take clip = read_text(text);
  clip.validate();
  EXPECT_EQ(clip.root_position(0).x, 2.25);
  EXPECT_EQ(clip.root_position(2049).x, 2047.25);
  EXPECT_LT(angle_between(clip.rotation(2049, 0), rotation_of({1.5, 67.125, 2}, "ZXY")), 1e-14);
  clip.rotation(4000, 0) = clip.rotation(4000, 0) * exp({0.1, 0, 0});
  const auto before = words_of(text), after = words_of(write_take(clip));
  ASSERT_EQ(before.size(), after.size());
  std::size_t different = 0;
  for (std::size_t w = first_word; w < before.size(); ++w) {
    EXPECT_NE(after[w], "nan") << w;
    if (!is_gap((w - first_word) / 4)) different += before[w] != after[w] ? 1 : 0;
  }
  EXPECT_GE(different, 1u);
  EXPECT_LE(different, 3u);
}

}  // namespace
}  // namespace kinemend
