// Tests of the input of trainings: takes in memory or in a file, and the sequences from them.
#include "lab/training/training_sequences.hpp"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/take.hpp"
#include "lab/training/take_store.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

Take walk_at(std::uint64_t seed, double rate_hz = 60) {
  SynthOptions options;
  options.duration_s = 3;
  options.frame_rate_hz = rate_hz;
  options.seed = seed;
  return synthesize(options);
}

Take markers_of(const Take& clip) {
  Take markers = make_marker_take(clip.skeleton.names, clip.frame_count(), clip.frame_rate_hz);
  markers.positions = joint_positions(clip);
  markers.observed.assign(markers.positions.size(), 1);
  return markers;
}

// Hides every part in frames 40 to 49.
void lose_frames(Take& clip) {
  clip.observed.assign(clip.rotations.size(), 1);
  std::fill_n(clip.observed.begin() + static_cast<std::ptrdiff_t>(40 * clip.joint_count()),
              10 * clip.joint_count(), std::uint8_t{0});
}

TrainingTakes takes_of(const std::vector<Take>& takes) {
  return {takes.size(), [&takes](std::size_t i) { return takes[i]; }};
}

std::vector<Take> joint_takes() {
  std::vector<Take> takes = {walk_at(1), walk_at(2, 120), walk_at(3, 50), walk_at(4)};
  lose_frames(takes[0]);
  return takes;
}
std::vector<Take> marker_takes() {
  return {markers_of(walk_at(1)), markers_of(walk_at(2, 120)), markers_of(walk_at(3, 50))};
}

// Trains a small, quick model; its quality does not matter here.
Model trained(const Training& method, const TrainingTakes& takes, TrainSettings settings = {}) {
  const std::map<std::string, OptionValues> quick = {
      {"example", {{"rate_hz", 20.0}, {"window_s", 0.2}, {"bases", std::int64_t{4}}}},
      {"wiener",
       {{"rate_hz", 30.0},
        {"coefficients", std::int64_t{4}},
        {"rank", std::int64_t{6}},
        {"components", std::int64_t{2}},
        {"rounds", std::int64_t{1}}}}};
  const auto options = quick.find(method.name);
  settings.names = {"Hips", "Left*"};
  return train_model(method.name, takes, options == quick.end() ? OptionValues{} : options->second,
                     settings);
}

TEST(TakeStore, GivesTakesBackToTheBit) {
  Take clip = walk_at(1);
  lose_frames(clip);
  test::add_translations(clip, {2}, Vec3{1, 2, 3});
  clip.observed_positions.assign(2 * clip.frame_count(), 1);
  Take markers = markers_of(clip);
  markers.residuals.assign(markers.positions.size(), 0.25F);
  markers.unit = "cm";
  for (const std::size_t most_memory : {std::size_t{0}, std::size_t{1} << 24}) {
    TakeStore store(most_memory);
    store.add(clip);
    store.add(markers);
    ASSERT_EQ(store.count(), 2u);
    const Take again = store.take(0);
    EXPECT_EQ(again.skeleton.names, clip.skeleton.names);
    EXPECT_EQ(again.frame_rate_hz, clip.frame_rate_hz);
    EXPECT_EQ(again.positions, clip.positions);
    EXPECT_EQ(again.rotations, clip.rotations);
    EXPECT_EQ(again.translated_joints, clip.translated_joints);
    EXPECT_EQ(again.observed, clip.observed);
    EXPECT_EQ(again.observed_positions, clip.observed_positions);
    const Take seen = store.take(1);
    EXPECT_EQ(seen.names, markers.names);
    EXPECT_EQ(seen.unit, "cm");
    EXPECT_EQ(seen.positions, markers.positions);
    EXPECT_EQ(seen.observed, markers.observed);
    EXPECT_EQ(seen.residuals, markers.residuals);
  }
}

TEST(TrainingSequences, AreTheChannelsOfWholeStretchesInEveryPhase) {
  const std::vector<Take> takes = joint_takes();
  const TrainingSequences sequences = encode_takes(takes_of(takes), {}, 60);
  std::vector<std::size_t> of_take(takes.size(), 0);
  for (const auto& entry : sequences.entries) ++of_take[entry.take];
  // The first take has a gap; the second has twice the rate.
  EXPECT_EQ(of_take, (std::vector<std::size_t>{2, 2, 1, 1}));
  EXPECT_EQ(sequences.takes, takes.size());

  const auto& clip = takes[1];
  const BodyChannels channels =
      encode_body(clip, sequences.layout, match_body(sequences.layout, clip));
  for (std::size_t phase = 0; phase < 2; ++phase) {
    const TrainingSequence sequence = sequence_at(sequences, 2 + phase);
    EXPECT_EQ(sequence.take, 1u);
    EXPECT_EQ(sequence.weight, 0.5);
    ASSERT_EQ(sequence.poses.frames, 180u);
    for (std::size_t f = 0; f < sequence.poses.frames; ++f) {
      for (std::size_t c = 0; c < sequence.poses.channels; ++c)
        ASSERT_EQ(sequence.poses(f, c), channels.poses(2 * f + phase, c));
    }
  }
  EXPECT_EQ(sequence_at(sequences, 0).poses.frames, 40u);
  EXPECT_EQ(sequence_at(sequences, 1).poses.frames, 130u);
}

TEST(TrainingSequences, GiveAnyFramesOfThem) {
  const std::vector<Take> takes = {walk_at(1)};
  const TrainingSequences sequences = encode_takes(takes_of(takes), {}, 60);
  const PoseMatrix all = sequence_at(sequences, 0).poses;
  const PoseMatrix part = sequence_at(sequences, 0, 20, 52).poses;
  ASSERT_EQ(part.frames, 32u);
  for (std::size_t c = 0; c < part.channels; ++c) EXPECT_EQ(part(31, c), all(51, c));
  EXPECT_EQ(sequence_at(sequences, 0, 170, 999).poses.frames, 10u);
  EXPECT_EQ(sequence_at(sequences, 0, 999).poses.frames, 0u);
}

TEST(TrainingSequences, AreWalkedThroughAsOftenAsOneLikesButReadOnce) {
  for (const Training& method : trainings()) {
    std::vector<std::size_t> asked;
    trained(method, {3, [&](std::size_t i) {
                       asked.push_back(i);
                       return walk_at(i + 1);
                     }});
    EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1, 2})) << method.name;
  }
}

TEST(TrainingSequences, GiveTheSameModelFromMemoryAndFromAFile) {
  for (const std::vector<Take>& takes : {joint_takes(), marker_takes()}) {
    for (const Training& method : trainings()) {
      const auto bytes = [&](std::size_t most_memory) {
        TrainSettings settings;
        settings.most_memory = most_memory;
        return write_model(trained(method, takes_of(takes), settings));
      };
      const std::string in_memory = bytes(std::size_t{1} << 30);
      EXPECT_EQ(bytes(0), in_memory) << method.name;
      EXPECT_EQ(bytes(300'000), in_memory) << method.name;  // partly in memory, partly in the file
    }
  }
}

TEST(TrainingSequences, LeaveTakesOutThatAreNotGiven) {
  const std::vector<Take> takes = joint_takes();
  const std::vector<Take> fewer = {takes[0], takes[2], takes[3]};
  const TrainingTakes skipping{takes.size(), [&](std::size_t i) -> std::optional<Take> {
                                 if (i == 1) return std::nullopt;
                                 return takes[i];
                               }};
  for (const Training& method : trainings()) {
    const Model model = trained(method, skipping);
    EXPECT_EQ(model.takes, 3u);
    EXPECT_EQ(write_model(model), write_model(trained(method, takes_of(fewer))));
  }
  const TrainingTakes none{2, [](std::size_t) { return std::optional<Take>(); }};
  EXPECT_THROW(train_model("wiener", none), Error);
}

}  // namespace
}  // namespace kinemend
