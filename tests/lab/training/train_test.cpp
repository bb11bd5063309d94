// Tests of the table of trainings, the settings that they share, and models from each of them.
#include "kinemend/lab/train.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend {
namespace {

using testing::HasSubstr;

std::string usage_error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    return error.what();
  }
  return "no error";
}

TrainingTakes training_walks(std::size_t count) {
  return {count, [](std::size_t index) {
            SynthOptions options;
            options.duration_s = 4;
            options.frame_rate_hz = 60;
            options.seed = index + 1;
            return synthesize(options);
          }};
}

TEST(LearnedMethods, AreCleaningMethodsWithOptionsOfTheirOwn) {
  std::vector<std::string> names;
  for (const Training& method : trainings()) {
    names.push_back(method.name);
    EXPECT_FALSE(method.summary.empty()) << method.name;
    for (const OptionSpec& option : method.options) EXPECT_FALSE(option.help.empty());
  }
  EXPECT_THAT(names, testing::ElementsAre("example", "wiener", "sparse", "kalman-learned"));
}

TEST(LearnedMethods, AnswersAnUnknownNameWithTheOneMeant) {
  EXPECT_EQ(usage_error_of([] { find_training("exampel"); }),
            "no model is trained for \"exampel\"; did you mean example? (there are example, "
            "wiener, sparse, kalman-learned)");
  EXPECT_EQ(find_training("wiener").name, "wiener");
  EXPECT_EQ(usage_error_of([] { find_training("recurrent"); }),
            "the network of recurrent is trained by kinemend-train");
}

TEST(TrainModel, RefusesWhatMakesNoSenseBeforeATakeIsRead) {
  const TrainingTakes unread{1, [](std::size_t) -> Take {
                               ADD_FAILURE() << "a take was read";
                               return Take();
                             }};
  for (const Training& method : trainings()) {
    const auto message = [&](const OptionValues& values) {
      return usage_error_of([&] { train_model(method.name, unread, values); });
    };
    EXPECT_THAT(
        message({{"rate_h", 30.0}}),
        HasSubstr("training " + method.name + " has no option \"rate_h\"; did you mean rate_hz?"));
    EXPECT_THAT(message({{"rate_hz", -1.0}}), HasSubstr("rate_hz: -1 is outside"));
    EXPECT_THAT(message({{"rate_hz", true}}), HasSubstr("rate_hz"));
    EXPECT_EQ(usage_error_of([&] {
                train_model(method.name, {0, unread.take});
              }),
              "no takes to learn from");
  }
}

TEST(TrainModel, FillsInWhatDoesNotDependOnTheMethod) {
  TrainSettings settings;
  settings.card = {"walks", "made up", "CC0", "a test", "none"};
  std::vector<double> done;
  settings.progress = [&](std::string_view, double share) { done.push_back(share); };
  const Model model = train_model("kalman-learned", training_walks(2), {}, settings);
  EXPECT_EQ(model.method, "kalman-learned");
  EXPECT_EQ(model.takes, 2u);
  EXPECT_NEAR(model.seconds, 8, 0.2);
  EXPECT_EQ(model.card.licence, "CC0");
  EXPECT_FALSE(done.empty());
  for (const double share : done) EXPECT_TRUE(share >= 0 && share <= 1) << share;
}

TEST(TrainModel, GivesTheSameBytesForTheSameTakes) {
  for (const Training& method : trainings()) {
    const auto bytes = [&] { return write_model(train_model(method.name, training_walks(2))); };
    const std::string first = bytes();
    EXPECT_EQ(bytes(), first) << method.name;
    EXPECT_EQ(write_model(parse_model(first, "a")), first) << method.name;
  }
}

// The mixture is small, so other windows give another mixture.
TEST(TrainModel, DrawsFromOneSeed) {
  const OptionValues few = {{"rate_hz", 30.0},
                            {"coefficients", std::int64_t{4}},
                            {"rank", std::int64_t{6}},
                            {"components", std::int64_t{2}},
                            {"windows", std::int64_t{20}}};
  const auto bytes = [&](const std::string& method, std::uint64_t seed) {
    TrainSettings settings;
    settings.names = {"Hips", "Left*"};
    settings.seed = seed;
    return write_model(train_model(method, training_walks(2),
                                   method == "wiener" ? few : OptionValues{}, settings));
  };
  EXPECT_NE(bytes("wiener", 1), bytes("wiener", 2));
  EXPECT_EQ(bytes("wiener", 2), bytes("wiener", 2));
  EXPECT_EQ(bytes("kalman-learned", 1), bytes("kalman-learned", 2));
  for (const Training& method : trainings()) {
    for (const OptionSpec& option : method.options) EXPECT_NE(option.name, "seed") << method.name;
  }
}

}  // namespace
}  // namespace kinemend
