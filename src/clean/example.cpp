#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "clean/example_rest.hpp"
#include "clean/example_self.hpp"
#include "clean/joint_limits.hpp"
#include "clean/method_list.hpp"
#include "clean/prior_cleaning.hpp"
#include "kinemend/error.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/model.hpp"
#include "priors/example_filter.hpp"
#include "priors/example_prior.hpp"
#include "priors/window_bases.hpp"

namespace kinemend {

namespace {

constexpr double welsch_deviations = 3;
// What the bases leave lasts: it says something new in one frame of so many.
constexpr double rest_memory_frames = 3;
// Where spikes are about, p is narrower against what the bases leave.
constexpr double many_suspects = 0.005;
constexpr double rejected_weight = 0.01;
// What is missing settles last, and weighs little in the objective.
constexpr double tolerance_of_gaps = 0.02;

const OptionTable<ExampleOptions>& table() {
  static const auto options =
      OptionTable<ExampleOptions>()
          .text(&ExampleOptions::model, "model",
                "model file, made by kinemend train example; none: the one that ships")
          .text(&ExampleOptions::map, "map", "file of names in the take for the model's")
          .flag(&ExampleOptions::self, "self", "bases from the take itself; no model")
          .flag(&ExampleOptions::robust, "robust", "off: the linear filter, every sample counts")
          .number(&ExampleOptions::welsch_deg, "welsch_deg", "deg", 0, 180,
                  "p: how far off a sample counts less; 0: from the noise")
          .number(&ExampleOptions::lambda, "lambda", "", 0, 1e6,
                  "weight of the patterns against the measurements; 0: from noise and model")
          .integer(&ExampleOptions::bases, "bases", "", 0, 1e5,
                   "filter bases; 0: all that the model has")
          .integer(&ExampleOptions::iterations, "iterations", "", 1, 10000, "at most")
          .number(
              &ExampleOptions::tolerance, "tolerance", "", 0, 1,
              "stops where the objective falls by less than this share; a fiftieth of it with gaps")
          .number(&ExampleOptions::limits, "limits", "", 0, 1000,
                  "weight of the joint limits; 0: none")
          .flag(&ExampleOptions::fill, "fill_gaps", "fills gaps of what the model knows");
  return options;
}

// The first guess: what was measured, `auto`'s opinion of spikes and gaps, and the mean pose where
// there is no measurement at all.
PoseMatrix first_guess(const PriorWork& work, const std::vector<double>& mean) {
  PoseMatrix guess = work.channels.poses;
  for (std::size_t c = 0; c < guess.channels; ++c) {
    bool seen = false;
    for (std::size_t f = 0; f < guess.frames; ++f) {
      const std::size_t i = f * guess.channels + c;
      seen |= work.channels.observed[i] != 0;
      if (work.channels.observed[i] == 0 || work.suspect[i] != 0) {
        guess.values[i] = work.fallback.values[i];
      }
    }
    for (std::size_t f = 0; f < guess.frames && !seen; ++f) guess(f, c) = mean[c];
  }
  return guess;
}

// Whether anything is missing of what the take has; parts that it lacks are nobody's.
bool has_gaps(const PriorWork& work) {
  const std::size_t parts = work.match->parts.size();
  for (std::size_t i = 0; i < work.channels.observed.size(); ++i) {
    const std::size_t part = i % work.channels.poses.channels / 3;
    const bool lacking = part < parts && work.match->parts[part] < 0;
    if (!lacking && work.channels.observed[i] == 0) return true;
  }
  return false;
}

class ExampleCleaning {
 public:
  ExampleCleaning(const ExampleOptions& options, std::shared_ptr<const Model> model)
      : options_(options), model_(std::move(model)), prior_(example_of(*model_)) {}

  void filter(PriorWork& work) const {
    if (work.channels.poses.frames == 0) return;
    if (!options_.robust || options_.lambda > 0 || options_.welsch_deg > 0)
      std::fill(work.needs.begin(), work.needs.end(), 1.0);
    JointLimits limits = learned_joint_limits(*model_);
    if (work.skeleton != nullptr && !work.skeleton->limits.empty())
      limits.joints = skeleton_joint_limits(*work.skeleton, model_->layout, *work.match).joints;
    filter(work, std::move(limits));
  }

 private:
  void filter(PriorWork& work, JointLimits limits) const {
    BodyChannels& channels = work.channels;
    const std::vector<double>& mean = prior_.bases.mean;
    const WindowBases bases =
        bases_at_rate(prior_.bases, prior_.rate_hz, channels.frame_rate_hz, channels.poses.frames,
                      static_cast<std::size_t>(options_.bases));
    PoseMatrix guess = first_guess(work, mean);
    // Starting from what the bases express, outliers stand out at once.
    PoseMatrix cleaned = guess;
    LinearExampleFilter expressible(bases, mean, cleaned.frames);
    expressible.filter(cleaned);
    if (!options_.robust) {
      channels.poses = std::move(cleaned);
      return;
    }
    const std::vector<double> noise = example_noise(work);
    const double suspects = suspect_share(work, cleaned);
    const double rest = strangeness(work, guess, cleaned, noise, prior_.bases.residual);
    guess = {};
    ExampleSettings settings;
    settings.iterations = static_cast<std::size_t>(options_.iterations);
    settings.tolerance = options_.tolerance;
    if (has_gaps(work)) settings.tolerance *= tolerance_of_gaps;
    const ExampleWeights weights = weights_for(noise, rest, suspects, bases);
    hold_to_limits(work, limits, weights, bases, settings);
    const ExampleTrace trace =
        example_filter(cleaned, channels.poses, channels.observed, bases, mean, weights, settings);
    work.rejected.assign(channels.observed.size(), 0);
    for (std::size_t i = 0; i < work.rejected.size(); ++i) {
      work.rejected[i] =
          channels.observed[i] != 0 && trace.weights.values[i] < rejected_weight ? 1 : 0;
    }
    if (options_.lambda == 0) {
      smooth_rest(work, trace.weights, expressible, noise, cleaned);
      if (options_.welsch_deg == 0) {
        fall_back_where_rejected(work, trace.weights, cleaned);
        fall_back_where_biased(work, noise, cleaned);
        if (suspects <= many_suspects) fall_back(work, rest, cleaned);
      }
    }
    channels.poses = std::move(cleaned);
  }

  // A pose beyond the limits is drawn back about as much as the patterns draw. (A term as strong as
  // the measurements would hold what is not measured at its first guess.)
  void hold_to_limits(PriorWork& work, JointLimits& limits, const ExampleWeights& weights,
                      const WindowBases& bases, ExampleSettings& settings) const {
    if (options_.limits == 0) return;
    const std::vector<std::string> broken = widen_joint_limits(limits, work.fallback);
    if (!broken.empty()) {
      work.warnings.push_back(
          fmt::format("the take goes beyond the joint limits of its skeleton file, which were "
                      "moved or left: {}",
                      fmt::join(broken, ", ")));
    }
    std::vector<double> prior = weights.prior;
    const double windows =
        std::max(1.0, static_cast<double>(bases.frames) /
                          static_cast<double>(std::max<std::size_t>(1, bases.hop)));
    settings.limit_weight = options_.limits * windows * median_of(prior);
    settings.project = [&limits](const PoseMatrix& poses, PoseMatrix& nearest) {
      project_to_limits(limits, poses, nearest);
    };
  }

  ExampleWeights weights_for(const std::vector<double>& noise, double rest, double suspects,
                             const WindowBases& bases) const {
    ExampleWeights weights = probable_weights(prior_, bases, noise, welsch_deviations);
    const double deviations = suspects > many_suspects ? 1 : welsch_deviations;
    for (std::size_t c = 0; c < noise.size(); ++c) {
      weights.prior[c] /= rest_memory_frames * rest;
      weights.welsch[c] =
          std::hypot(weights.welsch[c], deviations * std::sqrt(rest * prior_.bases.residual[c]));
    }
    if (options_.lambda > 0) {
      std::fill(weights.data.begin(), weights.data.end(), 1.0);
      std::fill(weights.prior.begin(), weights.prior.end(), options_.lambda);
      weights.coefficients.clear();
    }
    if (options_.welsch_deg > 0) {
      std::fill(weights.welsch.begin(), weights.welsch.end(), options_.welsch_deg);
    }
    return weights;
  }

  ExampleOptions options_;
  std::shared_ptr<const Model> model_;
  ExamplePrior prior_;
};

// Bases of the take itself come with weights of their own.
void refuse_beside_self(const ExampleOptions& options, bool has_model) {
  const ExampleOptions usual;
  const char* name = nullptr;
  if (has_model || !options.model.empty()) name = "model";
  if (!options.map.empty()) name = "map";
  if (!options.robust) name = "robust";
  if (options.welsch_deg != usual.welsch_deg) name = "welsch_deg";
  if (options.lambda != usual.lambda) name = "lambda";
  if (options.bases != usual.bases) name = "bases";
  if (name != nullptr)
    throw Error(ErrorKind::usage, fmt::format("{}: has no meaning with self", name));
}

}  // namespace

std::unique_ptr<Cleaner> make_example(const ExampleOptions& options,
                                      std::shared_ptr<const Model> model) {
  table().validate(options);
  if (options.self) {
    refuse_beside_self(options, model != nullptr);
    return make_self_example(options);
  }
  model = model_for("example", options.model, std::move(model));
  return make_prior_cleaner(
      model, options.map, options.fill,
      [cleaning = ExampleCleaning(options, model)](PriorWork& work) { cleaning.filter(work); });
}

Method example_method() {
  return {"example",
          "keeps what patterns learned from clean clips can express",
          "Lou & Chai 2010, Example-based Human Motion Denoising",
          table().specs(),
          [](const OptionValues& values) { return make_example(table().parse(values)); },
          true};
}

}  // namespace kinemend
