// Takes at 30 Hz, models of them, noise and errors, for the experiments of Lou & Chai 2010.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiment.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/train.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend::papers {

constexpr double lou_rate_hz = 30;  // the paper's: 120 Hz, thinned

/// Clips for fitting a model, and other clips for testing it.
struct LouGroup {
  std::string name;
  std::vector<Take> training;  ///< at their own rate: all four phases are used for training
  std::vector<Take> tests;     ///< at 30 Hz
};

inline Take at_lou_rate(const Take& clip) { return resample(clip, lou_rate_hz); }

/// The takes of these names (`08_01`), or synthetic ones of `motion` without data.
inline std::vector<Take> lou_takes(const Arguments& arguments,
                                   const std::vector<std::string>& names, const std::string& motion,
                                   std::uint64_t first_seed) {
  std::vector<Take> clips;
  for (const std::string& name : names) {
    SynthOptions otherwise{.motion = motion, .duration_s = 4, .frame_rate_hz = 120};
    otherwise.seed = first_seed + clips.size();
    clips.push_back(load_take(arguments, name + ".bvh", otherwise).clip);
  }
  return clips;
}

inline LouGroup lou_group(const Arguments& arguments, const std::string& name,
                          const std::vector<std::string>& training,
                          const std::vector<std::string>& tests,
                          const std::string& motion = "walk") {
  LouGroup group{name, lou_takes(arguments, training, motion, 1), {}};
  for (const Take& clip : lou_takes(arguments, tests, motion, 101)) {
    group.tests.push_back(at_lou_rate(clip));
  }
  return group;
}

/// Five training walks of a subject with different speeds and steps, as in the paper, and other
/// walks of the same subject for tests.
inline std::vector<LouGroup> walking_groups(const Arguments& arguments) {
  std::vector<LouGroup> groups;
  groups.push_back(lou_group(arguments, "subject 08", {"08_01", "08_02", "08_06", "08_07", "08_11"},
                             {"08_03", "08_09"}));
  if (arguments.quick) {
    groups[0].tests.resize(1);
    return groups;
  }
  groups.push_back(lou_group(arguments, "subject 35", {"35_01", "35_05", "35_10", "35_15", "35_30"},
                             {"35_03", "35_28"}));
  groups.push_back(lou_group(arguments, "subject 07", {"07_01", "07_02", "07_03", "07_04", "07_09"},
                             {"07_06", "07_10"}));
  return groups;
}

inline std::shared_ptr<const Model> learned(const std::string& method,
                                            const std::vector<Take>& clips,
                                            OptionValues options = {}) {
  TrainingTakes takes;
  takes.count = clips.size();
  takes.take = [&clips](std::size_t i) { return Take(clips[i]); };
  if (method != "wiener") options.try_emplace("rate_hz", lou_rate_hz);
  return std::make_shared<const Model>(train_model(method, takes, options));
}

inline bool is_trained(const std::string& method) {
  for (const Training& entry : trainings()) {
    if (entry.name == method) return true;
  }
  return false;
}

/// The models for the methods of a comparison.
struct LouModels {
  std::shared_ptr<const Model> example, kalman, wiener;
};
inline LouModels lou_models(const std::vector<Take>& training) {
  return {learned("example", training), learned("kalman-learned", training),
          is_trained("wiener") ? learned("wiener", training) : nullptr};
}

struct LouMethod {
  std::string name;
  bool is_of_the_paper = false;
  /// Several cleaners if the truth selects the settings; the best of them is shown.
  std::vector<std::unique_ptr<Cleaner>> cleaners;
};

inline LouMethod lou_method(std::string name, bool is_of_the_paper,
                            std::unique_ptr<Cleaner> cleaner) {
  LouMethod method{std::move(name), is_of_the_paper, {}};
  method.cleaners.push_back(std::move(cleaner));
  return method;
}

/// The algorithm of the paper alone.
inline std::unique_ptr<Cleaner> papers_example(std::shared_ptr<const Model> model) {
  ExampleOptions options;
  options.solver = "paper";
  return make_example(options, std::move(model));
}

/// The paper's four methods, then others. A Gaussian window of 11 frames has a deviation of 2 (that
/// of the usual window function). The general Kalman filter assumes a constant pose and has the
/// best of a grid of process noises.
inline std::vector<LouMethod> lou_methods(const LouModels& models) {
  std::vector<LouMethod> methods;
  methods.push_back(lou_method("Gaussian, window 11", true, make_gaussian({2 / lou_rate_hz})));
  LouMethod kalman{"Kalman", true, {}};
  for (const double agility : {0.05, 0.16, 0.5, 1.6, 5.0, 16.0, 50.0})
    kalman.cleaners.push_back(
        make_kalman({.model = "position", .smoother = false, .agility = agility}));
  methods.push_back(std::move(kalman));
  KalmanLearnedOptions of_the_past;
  of_the_past.smoother = false;
  methods.push_back(
      lou_method("kalman-learned", true, make_kalman_learned(of_the_past, models.kalman)));
  methods.push_back(lou_method("example", true, make_example({}, models.example)));
  methods.push_back(lou_method("example, solver=paper", false, papers_example(models.example)));
  methods.push_back(
      lou_method("kalman-learned, smoother", false, make_kalman_learned({}, models.kalman)));
  if (models.wiener) methods.push_back(lou_method("wiener", false, make_wiener({}, models.wiener)));
  LouMethod best{"best Gaussian", false, {}};
  for (const double frames : {0.25, 0.4, 0.55, 0.7, 0.9, 1.2, 1.6, 2.2}) {
    best.cleaners.push_back(make_gaussian({frames / lou_rate_hz}));
  }
  methods.push_back(std::move(best));
  methods.push_back(lou_method("auto", false, make_auto()));
  return methods;
}

inline Take cleaned(const Cleaner& cleaner, Take clip) {
  clean_in_place(cleaner, clip);
  return clip;
}

/// Adds Gaussian noise to every joint angle, then outliers.
inline Take lou_noise(Take clip, double std_deg, double share_of_outliers, std::uint64_t seed) {
  const Random random(seed);
  Random noise = random.fork(0), jumps = random.fork(1);
  if (std_deg > 0) apply_damage(clip, "gaussian", {{"std_deg", std_deg}}, noise);
  if (share_of_outliers > 0) apply_damage(clip, "outliers", {{"share", share_of_outliers}}, jumps);
  return clip;
}

/// Error of a limb that is hidden for a second in the middle of a take, over the limbs, degrees per
/// joint angle.
inline double filling_error(const Cleaner& cleaner, const Take& truth) {
  const std::vector<std::vector<std::string>> limbs = {{"LeftArm", "LeftForeArm", "LeftHand"},
                                                       {"RightArm", "RightForeArm", "RightHand"},
                                                       {"LeftUpLeg", "LeftLeg", "LeftFoot"},
                                                       {"RightUpLeg", "RightLeg", "RightFoot"}};
  const std::size_t frames = truth.frame_count();
  const std::size_t length = std::min<std::size_t>(30, frames / 2), first = (frames - length) / 2;
  double sum = 0, count = 0;
  for (const std::vector<std::string>& limb : limbs) {
    std::vector<NamedGap> gaps;
    for (const std::string& joint : limb) gaps.push_back({joint, first, first + length - 1});
    Take damaged = truth;
    mark_gaps(damaged, gaps);
    const Take filled = cleaned(cleaner, damaged);
    for (const std::string& name : limb) {
      const auto joint = static_cast<std::size_t>(truth.skeleton.find(name));
      for (std::size_t f = first; f < first + length; ++f) {
        const double angle =
            degrees_per_radian * angle_between(truth.rotation(f, joint), filled.rotation(f, joint));
        sum += angle * angle, count += 3;
      }
    }
  }
  return std::sqrt(sum / count);
}

/// Errors for one noise setting: for each method the mean over takes and seeds.
class LouErrors {
 public:
  void add(std::size_t method, std::size_t cleaner, double error) {
    if (sums_.size() <= method) sums_.resize(method + 1);
    if (sums_[method].size() <= cleaner) sums_[method].resize(cleaner + 1);
    sums_[method][cleaner].first += error;
    sums_[method][cleaner].second += 1;
  }
  /// The error of the method's best cleaner.
  double of(std::size_t method) const {
    double best = 1e300;
    for (const auto& [sum, count] : sums_[method]) best = std::min(best, sum / count);
    return best;
  }

 private:
  std::vector<std::vector<std::pair<double, double>>> sums_;
};

/// Mean error of takes with noise of 3 degrees, over so many draws of it.
inline double denoising_error(const Cleaner& cleaner, const std::vector<Take>& takes,
                              std::uint64_t draws) {
  LouErrors errors;
  for (const Take& truth : takes) {
    for (std::uint64_t seed = 1; seed <= draws; ++seed)
      errors.add(0, 0, rms_deg(truth, cleaned(cleaner, lou_noise(truth, 3, 0, seed))));
  }
  return errors.of(0);
}
inline double mean_filling_error(const Cleaner& cleaner, const std::vector<Take>& takes) {
  LouErrors errors;
  for (const Take& truth : takes) errors.add(0, 0, filling_error(cleaner, truth));
  return errors.of(0);
}

/// Prints rows of names and columns of numbers on the terminal.
class TextTable {
 public:
  explicit TextTable(const std::vector<std::string>& columns) {
    fmt::print("{:<30}", "");
    for (const std::string& column : columns) fmt::print("{:>9}", column);
    fmt::print("\n");
  }
  void add(const std::string& name, const std::vector<double>& values) const {
    fmt::print("{:<30}", name);
    for (const double value : values) fmt::print("{:9.2f}", value);
    fmt::print("\n");
    std::fflush(stdout);
  }
};

}  // namespace kinemend::papers
