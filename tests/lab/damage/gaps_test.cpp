// Tests of the damages that hide samples: lengths, places and held values.
#include <gmock/gmock.h>

#include <map>

#include "lab/damage/damage_support.hpp"

namespace kinemend {
namespace {

using test::chain_clip;
using test::damaged;
using test::moving_chain;
using test::moving_humanoid;
using test::same_bits;
using testing::HasSubstr;

struct LostRun {
  std::size_t first = 0, length = 0;
};

std::vector<LostRun> lost_runs(const Take& clip, std::size_t joint) {
  std::vector<LostRun> runs;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (clip.is_observed(f, joint)) continue;
    if (runs.empty() || runs.back().first + runs.back().length < f) runs.push_back({f, 0});
    ++runs.back().length;
  }
  return runs;
}

TEST(Gaps, HaveExponentiallyDecayingLengthsAndTheirStartProbability) {
  const Take clean = chain_clip(5, 40000, 100);
  const Take clip =
      damaged(clean, "gaps", {{"start_probability", 0.1}, {"mean_length_s", 0.05}}).clip;
  std::map<std::size_t, double> lengths;
  double total = 0, frames_lost = 0, chances = 0;
  for (std::size_t j = 1; j < 5; ++j) {
    const auto runs = lost_runs(clip, j);
    for (const LostRun run : runs) {
      ++lengths[run.length];
      ++total;
      frames_lost += static_cast<double>(run.length);
    }
    // A gap may begin at every frame whose predecessor is observed.
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      chances += f == 0 || clip.is_observed(f - 1, j);
  }
  EXPECT_NEAR(total / chances, 0.1, 0.002);
  EXPECT_NEAR(frames_lost / total, 5, 0.12);
  // P(length = n) = (1 - 1/5)^(n - 1) / 5
  for (std::size_t n = 1; n <= 12; ++n) {
    const double expected = total * std::pow(0.8, static_cast<double>(n - 1)) / 5;
    EXPECT_NEAR(lengths[n], expected, 5 * std::sqrt(expected)) << n;
  }
  EXPECT_TRUE(lost_runs(clip, 0).empty()) << "the root stays";
}

TEST(Gaps, HoldTheLastValueSeen) {
  const Take clean = moving_chain(3, 400);
  const Take clip = damaged(clean, "gaps", {{"mean_length_s", 0.05}}).clip;
  const auto runs = lost_runs(clip, 2);
  ASSERT_GT(runs.size(), 10u);
  for (const LostRun run : runs) {
    const Quat held = run.first > 0 ? clean.rotation(run.first - 1, 2) : Quat{};
    for (std::size_t f = run.first; f < run.first + run.length; ++f)
      EXPECT_TRUE(same_bits(clip.rotation(f, 2), held));
  }
  for (std::size_t f = 0; f < 400; ++f) {
    if (clip.is_observed(f, 2)) {
      EXPECT_TRUE(same_bits(clip.rotation(f, 2), clean.rotation(f, 2)));
    }
  }
}

TEST(Gaps, HoldTheRestPoseWhenAsked) {
  const Take clean = moving_chain(3, 200);
  const Take clip = damaged(clean, "gaps", {{"hold", std::string("rest")}}).clip;
  for (std::size_t f = 0; f < 200; ++f) {
    const Quat expected = clip.is_observed(f, 1) ? clean.rotation(f, 1) : Quat{};
    EXPECT_TRUE(same_bits(clip.rotation(f, 1), expected));
  }
}

TEST(Gaps, OfAChannelKeepTheOtherChannels) {
  const Take clean = moving_chain(2, 300);
  const Take clip =
      damaged(clean, "gaps", {{"scope", std::string("channel")}, {"start_probability", 0.02}}).clip;
  const RotationOrder order = clean.skeleton.rotation_order(1);
  std::array<double, 3> truth{};
  std::map<int, int> held_counts;
  for (std::size_t f = 0; f < 300; ++f) {
    truth = to_euler_near(clean.rotation(f, 1), order, truth);
    const auto found = to_euler_near(clip.rotation(f, 1), order, truth);
    int held = 0;
    for (std::size_t c = 0; c < 3; ++c) held += std::fabs(found[c] - truth[c]) > 1e-9;
    EXPECT_TRUE(held == 0 || !clip.is_observed(f, 1));
    if (clip.is_observed(f, 1)) {
      EXPECT_TRUE(same_bits(clip.rotation(f, 1), clean.rotation(f, 1)));
    }
    ++held_counts[held];
  }
  EXPECT_GT(held_counts[1], 10);
  EXPECT_GT(held_counts[1], held_counts[2] + held_counts[3]) << "mostly one channel at a time";
}

TEST(Gaps, OfALimbLoseItsJointsTogether) {
  const Take clean = moving_humanoid(600);
  const Take clip = damaged(clean, "gaps", {{"scope", std::string("limb")}}).clip;
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(clean.skeleton.find(name));
  };
  bool arm_alone = false;
  for (std::size_t f = 0; f < 600; ++f) {
    EXPECT_EQ(clip.is_observed(f, at("LeftArm")), clip.is_observed(f, at("LeftHandIndex1")));
    EXPECT_EQ(clip.is_observed(f, at("RightUpLeg")), clip.is_observed(f, at("RightToeBase")));
    arm_alone =
        arm_alone || (!clip.is_observed(f, at("LeftArm")) && clip.is_observed(f, at("RightArm")));
  }
  EXPECT_TRUE(arm_alone);
}

TEST(Gaps, OfAllLoseEveryJointButTheRootTogether) {
  const Take clean = moving_humanoid(300);
  const Take clip = damaged(clean, "gaps", {{"scope", std::string("all")}}).clip;
  for (std::size_t f = 0; f < 300; ++f) {
    EXPECT_TRUE(clip.is_observed(f, 0));
    for (std::size_t j = 2; j < clean.joint_count(); ++j)
      EXPECT_EQ(clip.is_observed(f, j), clip.is_observed(f, 1));
  }
}

TEST(LongGap, HasItsLengthAndASeenFrameOnEitherSide) {
  const Take clean = moving_humanoid(600, 120);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Take clip =
        damaged(clean, "long-gap", {{"length_s", 2.0}, {"scope", std::string("joint")}}, seed).clip;
    std::size_t joints_hit = 0;
    for (std::size_t j = 0; j < clean.joint_count(); ++j) {
      const auto runs = lost_runs(clip, j);
      if (runs.empty()) continue;
      ++joints_hit;
      ASSERT_EQ(runs.size(), 1u);
      EXPECT_EQ(runs[0].length, 240u);
      EXPECT_GE(runs[0].first, 1u);
      EXPECT_LE(runs[0].first + runs[0].length, 599u);
    }
    EXPECT_EQ(joints_hit, 1u);
  }
}

TEST(LongGap, IsShortenedInAShortClipAndSaysSo) {
  const auto [clip, report] = damaged(moving_chain(2, 10, 100), "long-gap", {{"length_s", 1.0}});
  EXPECT_EQ(lost_runs(clip, 1).at(0).length, 8u);
  EXPECT_THAT(report.notes.at(0),
              HasSubstr("gaps are 8 frames long, not 100: the clip is too short"));
}

TEST(LongGap, ComesAsOftenAsAskedAndWhereAsked) {
  const Take clean = moving_humanoid(2000, 100);
  const auto [clip, report] = damaged(clean, "long-gap",
                                      {{"length_s", 0.1},
                                       {"count", std::int64_t{5}},
                                       {"joints", std::string("Left*Leg")},
                                       {"scope", std::string("joint")}});
  std::size_t frames_lost = 0;
  for (std::size_t j = 0; j < clean.joint_count(); ++j) {
    for (const LostRun run : lost_runs(clip, j)) {
      EXPECT_THAT(clean.skeleton.names[j], HasSubstr("Left"));
      EXPECT_THAT(clean.skeleton.names[j], HasSubstr("Leg"));
      frames_lost += run.length;
    }
  }
  EXPECT_GT(frames_lost, 30u);
  EXPECT_LE(frames_lost, 50u);
}

TEST(Frozen, RepeatsTheFrameBeforeForItsShareOfFramesUnmarked) {
  const Take clean = moving_chain(3, 40000, 100);
  const auto [clip, report] = damaged(
      clean, "frozen", {{"share", 0.1}, {"mean_length_s", 0.1}, {"scope", std::string("joint")}});
  EXPECT_TRUE(clip.observed.empty());
  for (std::size_t j = 1; j < 3; ++j) {
    std::size_t frozen = 0, spans = 0;
    for (std::size_t f = 1; f < 40000; ++f) {
      if (same_bits(clip.rotation(f, j), clean.rotation(f, j))) continue;
      EXPECT_TRUE(same_bits(clip.rotation(f, j), clip.rotation(f - 1, j)));
      ++frozen;
      spans += same_bits(clip.rotation(f - 1, j), clean.rotation(f - 1, j));
    }
    EXPECT_NEAR(static_cast<double>(frozen) / 40000, 0.1, 0.015);
    EXPECT_NEAR(static_cast<double>(frozen) / static_cast<double>(spans), 10, 1.5);
  }
}

}  // namespace
}  // namespace kinemend
