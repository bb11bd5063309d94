// Tests of damage on sequences of channels, for training.
#include "lab/samples/sequence_damage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/lab/synth.hpp"
#include "lab/training/training_sequences.hpp"
#include "motion/rotation.hpp"

namespace kinemend {
namespace {

TrainingSequences walk() {
  return encode_takes({1,
                       [](std::size_t) {
                         SynthOptions options;
                         options.duration_s = 10;
                         options.frame_rate_hz = 60;
                         return synthesize(options);
                       }},
                      {}, 60);
}

TEST(SequenceDamage, TurnsJointsAndMovesThePlaceByWhatIsAskedFor) {
  const TrainingSequences sequences = walk();
  const PoseMatrix clean = sequence_at(sequences, 0).poses;
  PoseMatrix noisy = clean;
  std::vector<std::uint8_t> observed;
  Random random(1);
  const DamageReport report = damage_sequence(sequences.layout, 60, noisy, observed, "gaussian",
                                              {{"std_deg", 2.0}}, random);
  double turns = 0, moves = 0;
  const std::size_t joints = sequences.layout.track_count();
  for (std::size_t f = 0; f < clean.frames; ++f) {
    for (std::size_t n = 0; n < joints; ++n) {
      const double angle =
          degrees_per_radian * angle_between(exp(radians_per_degree * vector_at(clean, f, n)),
                                             exp(radians_per_degree * vector_at(noisy, f, n)));
      turns += angle * angle / static_cast<double>(clean.frames * joints);
    }
    const Vec3 move = vector_at(noisy, f, joints) - vector_at(clean, f, joints);
    moves += dot(move, move) / static_cast<double>(clean.frames);
  }
  EXPECT_NEAR(std::sqrt(turns), 2 * std::sqrt(3), 0.05);
  EXPECT_NEAR(std::sqrt(moves), 2 * std::sqrt(3), 0.15);
  EXPECT_EQ(report.samples, clean.frames * (joints + 1));
  EXPECT_EQ(observed, std::vector<std::uint8_t>(report.samples, 1));
}

TEST(SequenceDamage, GivesTheSameForTheSameSeedAndComposes) {
  const TrainingSequences sequences = walk();
  const auto damaged = [&](std::uint64_t seed, std::vector<std::uint8_t>& observed) {
    PoseMatrix poses = sequence_at(sequences, 0, 100, 228).poses;
    Random random(seed);
    for (const char* name : {"ar1", "outliers", "gaps", "frozen"})
      damage_sequence(sequences.layout, 60, poses, observed, name, {}, random);
    return poses.values;
  };
  std::vector<std::uint8_t> first, again, other;
  EXPECT_EQ(damaged(4, first), damaged(4, again));
  EXPECT_EQ(first, again);
  EXPECT_NE(damaged(5, other), damaged(4, again));
  EXPECT_NE(first, other);
  EXPECT_GT(std::count(first.begin(), first.end(), 0), 0);
}

TEST(SequenceDamage, LeavesTheRootAloneUnlessAskedFor) {
  const TrainingSequences sequences = walk();
  const PoseMatrix clean = sequence_at(sequences, 0).poses;
  PoseMatrix gappy = clean;
  std::vector<std::uint8_t> observed;
  Random random(1);
  damage_sequence(sequences.layout, 60, gappy, observed, "gaps", {}, random);
  const std::size_t tracks = clean.channels / 3;
  for (std::size_t f = 0; f < clean.frames; ++f) {
    EXPECT_EQ(vector_at(gappy, f, 0), vector_at(clean, f, 0));
    EXPECT_EQ(vector_at(gappy, f, tracks - 1), vector_at(clean, f, tracks - 1));
    EXPECT_EQ(observed[f * tracks], 1);
  }
}

TEST(SequenceDamage, RefusesLengthsThatAreNotKnownAndLeavesTheSequenceAlone) {
  const TrainingSequences sequences = walk();
  const PoseMatrix clean = sequence_at(sequences, 0).poses;
  PoseMatrix poses = clean;
  std::vector<std::uint8_t> observed;
  Random random(1);
  EXPECT_THROW(damage_sequence(sequences.layout, 60, poses, observed, "position-noise", {}, random),
               Error);
  EXPECT_THROW(damage_sequence(sequences.layout, 60, poses, observed, "gaussian-log", {}, random),
               Error);
  EXPECT_EQ(poses.values, clean.values);
}

}  // namespace
}  // namespace kinemend
