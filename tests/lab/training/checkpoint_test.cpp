// Interrupted and resumed trainings give the same bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/lab/train.hpp"
#include "lab/training/training_stages.hpp"

namespace kinemend {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TrainingTakes walks(std::size_t count, std::uint64_t first_seed = 1) {
  return {count, [first_seed](std::size_t index) {
            SynthOptions options;
            options.duration_s = 3;
            options.frame_rate_hz = 60;
            options.seed = first_seed + index;
            return synthesize(options);
          }};
}

struct Case {
  std::string method;
  OptionValues options;
};

const Case sparse_case{"sparse",
                       {{"atoms", std::int64_t{30}},
                        {"window_frames", std::int64_t{6}},
                        {"sparsity", std::int64_t{4}},
                        {"iterations", std::int64_t{5}}}};
const Case wiener_case{"wiener",
                       {{"rate_hz", 30.0},
                        {"coefficients", std::int64_t{4}},
                        {"rank", std::int64_t{6}},
                        {"components", std::int64_t{3}},
                        {"rounds", std::int64_t{6}}}};

std::string trained(const Case& which, TrainCheckpoint checkpoint = {}) {
  TrainSettings settings;
  settings.names = {"Hips", "Left*"};
  settings.checkpoint = std::move(checkpoint);
  return write_model(train_model(which.method, walks(2), which.options, settings));
}

/// Every state that a training keeps, in order.
std::vector<std::string> states_of(const Case& which) {
  std::vector<std::string> states;
  TrainCheckpoint checkpoint;
  checkpoint.every_s = 0;
  checkpoint.keep = [&](const std::string& bytes) { states.push_back(bytes); };
  trained(which, checkpoint);
  return states;
}

TrainCheckpoint starting_at(std::string state) {
  TrainCheckpoint checkpoint;
  checkpoint.start = std::move(state);
  checkpoint.name = "m.checkpoint";
  return checkpoint;
}

Error error_of(const Case& which, const std::string& state,
               const std::function<void(TrainSettings&, TrainingTakes&)>& change = {}) {
  TrainSettings settings;
  settings.names = {"Hips", "Left*"};
  settings.checkpoint = starting_at(state);
  TrainingTakes takes = walks(2);
  if (change) change(settings, takes);
  try {
    train_model(which.method, takes, which.options, settings);
  } catch (const Error& error) {
    return error;
  }
  return {ErrorKind::quality_limit, "no error"};
}

class EveryCase : public testing::TestWithParam<Case> {};

TEST_P(EveryCase, GoesOnFromWhateverItKeptToTheSameBytes) {
  const std::string whole = trained(GetParam());
  const std::vector<std::string> states = states_of(GetParam());
  ASSERT_GE(states.size(), 5u);
  for (const std::string& state : states)
    EXPECT_TRUE(trained(GetParam(), starting_at(state)) == whole);
}

TEST_P(EveryCase, GoesOnAfterItWasStoppedTimeAndAgain) {
  const std::string whole = trained(GetParam());
  std::string kept;
  std::size_t stops = 0;
  for (; stops < 100; ++stops) {
    TrainCheckpoint checkpoint = starting_at(kept);
    std::atomic<bool> got_on = false;
    checkpoint.keep = [&](const std::string& bytes) {
      kept = bytes;
      got_on = true;
    };
    checkpoint.stop = [&] { return got_on.load(); };
    try {
      EXPECT_TRUE(trained(GetParam(), checkpoint) == whole);
      break;
    } catch (const TrainingStopped&) {
    }
  }
  EXPECT_GE(stops, 5u);
  EXPECT_LT(stops, 100u);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryCase, testing::Values(sparse_case, wiener_case),
                         [](const auto& tested) { return tested.param.method; });

TEST(Checkpoint, GoesOnWithTheIterationAndDoesNotBeginAnew) {
  std::vector<std::string> states = states_of(sparse_case);
  std::size_t again = 0;
  TrainCheckpoint checkpoint = starting_at(states[states.size() - 2]);
  checkpoint.every_s = 0;
  checkpoint.keep = [&](const std::string&) { ++again; };
  trained(sparse_case, checkpoint);
  EXPECT_EQ(again, 1u);
}

TEST(Checkpoint, IsKeptNoOftenerThanAsked) {
  std::size_t seldom = 0;
  TrainCheckpoint checkpoint;
  checkpoint.every_s = 1e6;
  checkpoint.keep = [&](const std::string&) { ++seldom; };
  trained(sparse_case, checkpoint);
  // Only the first and the last state of each poselet are kept.
  EXPECT_LE(seldom, 2 * 5u);
  EXPECT_GT(states_of(sparse_case).size(), seldom);
}

TEST(Checkpoint, OfAnotherTrainingIsRefusedWithWhatDiffers) {
  const std::string state = states_of(sparse_case).back();
  const Error same = error_of(sparse_case, state);
  EXPECT_STREQ(same.what(), "no error");

  Case more = sparse_case;
  more.options["atoms"] = std::int64_t{31};
  EXPECT_EQ(error_of(more, state).kind(), ErrorKind::usage);
  EXPECT_STREQ(error_of(more, state).what(),
               "m.checkpoint: is of another training: atoms was 30, and is 31");
  EXPECT_STREQ(error_of(wiener_case, state).what(),
               "m.checkpoint: is of another training: method was sparse 1, and is wiener 1");
  EXPECT_THAT(error_of(sparse_case, state,
                       [](TrainSettings& settings, TrainingTakes&) { settings.seed = 2; })
                  .what(),
              HasSubstr("seed was 1, and is 2"));
  const auto names = [](TrainSettings& settings, TrainingTakes&) { settings.names = {}; };
  EXPECT_THAT(error_of(sparse_case, state, names).what(), HasSubstr("names was Hips,Left*"));
}

TEST(Checkpoint, OfOtherTakesIsRefused) {
  const std::string state = states_of(sparse_case).back();
  for (const TrainingTakes& others : {walks(3), walks(2, 7), walks(1)}) {
    const Error error =
        error_of(sparse_case, state, [&](TrainSettings&, TrainingTakes& takes) { takes = others; });
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), StartsWith("m.checkpoint: is of another training: its takes"));
  }
}

TEST(Checkpoint, ThatIsDamagedIsRefused) {
  const std::string state = states_of(wiener_case).back();
  std::string flipped = state;
  flipped[flipped.size() / 2] ^= 1;
  for (const std::string& bad : {flipped, state.substr(0, state.size() - 1), state + "x",
                                 state.substr(0, 30), std::string("no checkpoint")}) {
    const Error error = error_of(wiener_case, bad);
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    EXPECT_STREQ(error.what(),
                 "m.checkpoint: is damaged, or no checkpoint; train from the beginning");
  }
}

TEST(StageReader, RefusesMoreThanThereIs) {
  StageWriter writer;
  writer.values(std::vector<double>{1, 2});
  writer.value<std::size_t>(std::size_t{1} << 61);
  const std::string bytes = writer.take();
  StageReader reader(bytes);
  EXPECT_THAT(reader.values<double>(), testing::ElementsAre(1, 2));
  EXPECT_THROW(reader.end(), Error);
  EXPECT_THROW(reader.values<double>(), Error);
  EXPECT_THROW(reader.value<double>(), Error);
}

}  // namespace
}  // namespace kinemend
