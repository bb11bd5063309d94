// Tests of the methods `example` and `wiener` on takes, with models trained on synthetic walks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "clean/repair_checks.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/lab/train.hpp"
#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

Take walk(std::uint64_t seed, double rate_hz = 30, double duration_s = 4) {
  SynthOptions options{.motion = "walk", .duration_s = duration_s, .frame_rate_hz = rate_hz};
  options.seed = seed;
  return synthesize(options);
}

std::shared_ptr<const Model> learned(const std::string& method, const std::vector<Take>& clips) {
  return std::make_shared<const Model>(
      train_model(method, {clips.size(), [&](std::size_t i) { return Take(clips[i]); }}));
}

std::shared_ptr<const Model> walking(const std::string& method) {
  const std::vector<Take> clips = {walk(1, 120), walk(2, 120), walk(3, 120)};
  return learned(method, clips);
}

struct LearnedFilter {
  const char* name;
  std::unique_ptr<Cleaner> (*make)(std::shared_ptr<const Model> model);
  friend void PrintTo(const LearnedFilter& method, std::ostream* out) { *out << method.name; }
};

class Learned : public testing::TestWithParam<LearnedFilter> {
 protected:
  // Each model is trained once.
  const Cleaner& cleaner() const {
    static std::map<std::string, std::unique_ptr<Cleaner>> cleaners;
    auto& made = cleaners[GetParam().name];
    if (!made) made = GetParam().make(walking(GetParam().name));
    return *made;
  }
};

Take noisy(Take clip, double std_deg, double outlier_share) {
  Random random(7);
  apply_damage(clip, "gaussian", {{"std_deg", std_deg}}, random);
  if (outlier_share > 0) apply_damage(clip, "outliers", {{"share", outlier_share}}, random);
  return clip;
}

double error(const Take& truth, const Take& input, const Cleaner& cleaner) {
  return rms_deg(truth, clean_take(input, cleaner).take);
}

TEST_P(Learned, BringsANoisyWalkNearerToTheTruthThanAutoDoes) {
  const Take truth = walk(4), input = noisy(truth, 3, 0);
  const double ours = error(truth, input, cleaner());
  EXPECT_LT(ours, 0.5 * rms_deg(truth, input));
  EXPECT_LT(ours, error(truth, input, *make_auto()));
}

TEST_P(Learned, TakesSpikesOut) {
  const Take truth = walk(4), input = noisy(truth, 1, 0.03);
  EXPECT_LT(error(truth, input, cleaner()), 0.4 * rms_deg(truth, input));
}

TEST_P(Learned, TakesDenseSpikesOut) {
  const Take truth = walk(4);
  for (const double share : {0.1, 0.2}) {
    const Take input = noisy(truth, 0.3, share);
    EXPECT_LT(error(truth, input, cleaner()), 0.21 * rms_deg(truth, input)) << share;
  }
}

// At 30 Hz, `auto` takes a fifth of outliers for noise, so its result is not a reference.
TEST_P(Learned, TakesMoreSpikesOutThanAutoTellsFromNoise) {
  const Take truth = walk(4, 30);
  for (const double share : {0.2, 0.25}) {
    const Take input = noisy(truth, 0.3, share);
    EXPECT_LT(error(truth, input, cleaner()), 0.35 * error(truth, input, *make_auto())) << share;
  }
}

TEST_P(Learned, RepairsWholeAtEveryStrength) {
  Take input = noisy(walk(4), 1, 0);
  const std::vector<Thrown> thrown = throw_spikes(input, {2, 3, 8, 20}, 25, 3);
  EXPECT_GT(expect_whole_repairs(input, thrown, cleaner()), thrown.size() / 3);
}

TEST_P(Learned, KeepsTheRateOfTheTake) {
  for (const double rate_hz : {120.0, 100.0, 60.0, 25.0}) {
    const Take truth = walk(4, rate_hz), input = noisy(truth, 3, 0);
    const Take result = clean_take(input, cleaner()).take;
    EXPECT_EQ(result.frame_count(), truth.frame_count());
    EXPECT_EQ(result.frame_rate_hz, rate_hz);
    EXPECT_LT(rms_deg(truth, result), 0.55 * rms_deg(truth, input)) << rate_hz;
  }
}

TEST_P(Learned, LeavesACleanWalkNearlyAlone) {
  const Take truth = walk(4, 120);
  EXPECT_LT(error(truth, truth, cleaner()), 0.1);
}

TEST_P(Learned, FillsBothArmsThatAreMissingThroughout) {
  const Take truth = walk(4);
  Take input = truth;
  input.observed.assign(truth.rotations.size(), 1);
  std::vector<std::size_t> arms;
  for (const char* name : {"LeftArm", "LeftForeArm", "RightArm", "RightForeArm"})
    arms.push_back(static_cast<std::size_t>(truth.skeleton.find(name)));
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    for (const std::size_t joint : arms) {
      input.observed[f * truth.joint_count() + joint] = 0;
      input.rotation(f, joint) = exp({2, -1, 1});
    }
  }
  const CleanResult result = clean_take(input, cleaner());
  const std::vector<double> errors = geodesic_rms_deg_per_joint(truth, result.take);
  Take still = truth;
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    for (const std::size_t joint : arms) still.rotation(f, joint) = truth.rotation(0, joint);
  }
  const std::vector<double> of_stillness = geodesic_rms_deg_per_joint(truth, still);
  for (const std::size_t joint : arms) {
    EXPECT_LT(errors[joint], 3) << truth.skeleton.names[joint];
    EXPECT_EQ(result.report.tracks[joint].frames_repaired, truth.frame_count());
  }
  EXPECT_LT(errors[arms[0]] + errors[arms[2]], of_stillness[arms[0]] + of_stillness[arms[2]]);
}

TEST_P(Learned, RefusesABodyThatTheModelDoesNotKnow) {
  const Take chain = synthesize({.motion = "spin", .duration_s = 1});
  try {
    clean_take(chain, cleaner());
    FAIL() << "a chain is no body";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("LeftArm"));
  }
}

TEST_P(Learned, RefusesTheModelOfAnotherMethod) {
  const auto other = walking(std::string(GetParam().name) == "example" ? "wiener" : "example");
  EXPECT_THROW(GetParam().make(other), Error);
}

TEST_P(Learned, TakesAnyNumberOfFrames) {
  for (const std::size_t frames : {0, 1, 2, 3, 7}) {
    const Take input = slice(noisy(walk(4), 1, 0), 0, frames);
    EXPECT_EQ(clean_take(input, cleaner()).take.frame_count(), frames);
  }
}

TEST_P(Learned, WorksOnMarkersAndFillsThoseThatAreNeverSeen) {
  std::vector<Take> clips;
  for (const std::uint64_t seed : {1, 2, 3}) clips.push_back(joint_markers(walk(seed, 60), true));
  const auto model = learned(GetParam().name, clips);
  const Take truth = joint_markers(walk(4, 60), true);
  Take input = damaged(truth, 1, 0.005, 20, 3);
  const auto hand = static_cast<std::size_t>(truth.find("LeftHand"));
  for (std::size_t f = 0; f < truth.frame_count(); ++f)
    input.observed[f * truth.marker_count() + hand] = 0;
  const Take result = clean_take(input, *GetParam().make(model)).take;
  double before = 0, after = 0, of_hand = 0;
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    for (std::size_t m = 0; m < truth.marker_count(); ++m) {
      const double left = norm(result.position(f, m) - truth.position(f, m));
      if (m == hand) {
        of_hand += left * left;
        continue;
      }
      after += left * left;
      before += std::pow(norm(input.position(f, m) - truth.position(f, m)), 2);
    }
  }
  EXPECT_LT(std::sqrt(after), 0.6 * std::sqrt(before));
  EXPECT_LT(std::sqrt(of_hand / static_cast<double>(truth.frame_count())), 8);  // cm
}

INSTANTIATE_TEST_SUITE_P(Methods, Learned,
                         testing::Values(LearnedFilter{"example",
                                                       [](std::shared_ptr<const Model> model) {
                                                         return make_example({}, std::move(model));
                                                       }},
                                         LearnedFilter{"wiener",
                                                       [](std::shared_ptr<const Model> model) {
                                                         return make_wiener({}, std::move(model));
                                                       }}),
                         [](const auto& method) { return camel_case(method.param.name); });

TEST(Wiener, TakesNoiseForWhatItIsInEachDirection) {
  const Take truth = walk(4, 120);
  const auto shaken = [&](const auto& turn) {
    Take clip = truth;
    Random random(5);
    for (Quat& rotation : clip.rotations) rotation = rotation * exp(turn(random));
    return clip;
  };
  constexpr double deviation = 8 * radians_per_degree;
  const Take even = shaken([](Random& random) {
    return (deviation / std::sqrt(3)) * Vec3{random.normal(), random.normal(), random.normal()};
  });
  const Take uneven = shaken([](Random& random) {
    return (deviation * random.normal() / std::sqrt(3)) * Vec3{1, -1, 1};
  });
  const auto wiener = make_wiener({}, walking("wiener"));
  EXPECT_LT(error(truth, uneven, *wiener), 0.8 * error(truth, even, *wiener));
}

// `auto` takes some outliers for spikes and the rest for noise; the rest are too few to show in its
// result.
TEST(Wiener, IsNotHeldToAutoWhereItFindsDenseOutliersItself) {
  SynthOptions options{.motion = "run", .duration_s = 4, .frame_rate_hz = 30};
  options.seed = 4;
  const Take truth = synthesize(options), input = noisy(truth, 0.3, 0.2);
  const auto wiener = make_wiener({}, walking("wiener"));
  EXPECT_LT(error(truth, input, *wiener), 0.35 * error(truth, input, *make_auto()));
}

// Both arms are missing throughout; stopping early changes the result by less than 2 %.
TEST(Example, StopsWhereLimbsThatAreMissingHaveSettled) {
  const Take truth = walk(4, 30);
  Take input = noisy(truth, 1, 0);
  input.observed.assign(input.rotations.size(), 1);
  for (std::size_t i = 0; i < input.observed.size(); ++i) {
    const std::string& name = input.skeleton.names[i % input.joint_count()];
    if (name.find("Arm") == std::string::npos && name.find("Hand") == std::string::npos) continue;
    input.observed[i] = 0;
    input.rotations[i] = {};
  }
  const auto arms = [&](const ExampleOptions& options) {
    Take filled = input;
    clean_in_place(*make_example(options, walking("example")), filled);
    double sum = 0;
    for (std::size_t i = 0; i < input.observed.size(); ++i) {
      const double angle = angle_between(filled.rotations[i], truth.rotations[i]);
      sum += input.observed[i] == 0 ? angle * angle : 0;
    }
    return std::sqrt(sum);
  };
  ExampleOptions to_the_end;
  to_the_end.tolerance = 1e-9, to_the_end.iterations = 5000;
  const double end = arms(to_the_end);
  EXPECT_NEAR(arms({}), end, 0.02 * end);
}

// The paper's objective has the same minimum whoever finds it.
TEST(Example, FindsWithThePapersAlternationWhatTheQuickSolverFinds) {
  const Take input = noisy(walk(4, 30), 1, 0);
  const auto result = [&](const std::string& solver, double tolerance) {
    ExampleOptions options;
    options.solver = solver, options.tolerance = tolerance;
    options.welsch_deg = 3, options.lambda = 0.1, options.iterations = 10000;
    Take clip = input;
    clean_in_place(*make_example(options, walking("example")), clip);
    return clip;
  };
  const Take quick = result("quick", 1e-10), paper = result("paper", ExampleOptions().tolerance);
  EXPECT_GT(rms_deg(input, paper), 0.3);
  EXPECT_LT(rms_deg(quick, paper), 0.02);
  ExampleOptions by_default;
  by_default.solver = "paper";
  Take clip = input;
  clean_in_place(*make_example(by_default, walking("example")), clip);
  EXPECT_LT(rms_deg(quick, clip), 0.02) << "p = 3 and lambda = 0.1";
  by_default.solver = "papers";
  EXPECT_THROW(make_example(by_default), Error);
}

}  // namespace
}  // namespace kinemend::test
