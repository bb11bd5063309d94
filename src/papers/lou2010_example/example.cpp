// Defines the method `example` (Lou & Chai 2010): its options, its cleaner, and its model, from
// which the most probable weights for a given noise follow.
#include "papers/lou2010_example/example.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "models/model_reading.hpp"
#include "papers/lou2010_example/example_filter.hpp"
#include "papers/lou2010_example/filter_bases.hpp"

namespace kinemend {

namespace {

// The weight below which a sample is rejected. Chosen by hand, not swept.
constexpr double rejected_weight = 0.01;
// Missing samples settle last, and weigh little in the objective. Chosen by hand;
// docs/details/example.md states what other tolerances do.
constexpr double tolerance_of_gaps = 1e-3;
// The paper's p and lambda (sections 3.2 and 3.3). The paper's solver makes short steps, so its
// tolerance is lower; that is chosen by hand, not swept.
constexpr double papers_welsch_deg = 3, papers_lambda = 0.1, tolerance_of_papers = 1e-4;

const OptionTable<ExampleOptions>& example_table() {
  static const auto options =
      OptionTable<ExampleOptions>()
          .text(&ExampleOptions::model, "model",
                "model file made by kinemend train example; empty: the model that ships")
          .text(&ExampleOptions::map, "map",
                "file that maps names in the take to names in the model")
          .choice(&ExampleOptions::solver, "solver", {"quick", "paper"},
                  "paper: the algorithm of the paper, with welsch_deg 3 and lambda 0.1 unless set")
          .flag(&ExampleOptions::robust, "robust",
                "give outliers less weight; off: linear filter, all samples count alike")
          .number(&ExampleOptions::welsch_deg, "welsch_deg", "deg", 0, 180,
                  "distance from the estimate at which a sample loses weight; 0: from the noise")
          .number(
              &ExampleOptions::lambda, "lambda", "", 0, 1e6,
              "weight of the learned patterns against the measurements; 0: from noise and model")
          .integer(&ExampleOptions::bases, "bases", "", 0, 1e5,
                   "number of filter bases; 0: all of the model")
          .integer(&ExampleOptions::iterations, "iterations", "", 1, 10000,
                   "largest number of iterations")
          .number(
              &ExampleOptions::tolerance, "tolerance", "", 0, 1,
              "stop when an iteration improves less than this share; a thousandth of it with gaps")
          .flag(&ExampleOptions::fill, "fill_gaps",
                "fill gaps of joints or markers that the model knows");
  return options;
}

// The first guess: the measurements, with `auto`'s values at spikes and in gaps, and the mean pose
// in channels without any measurement.
PoseMatrix first_guess(const PriorWork& work, const std::vector<double>& mean,
                       bool without_suspects) {
  PoseMatrix guess = work.channels.poses;
  for (std::size_t c = 0; c < guess.channels; ++c) {
    bool seen = false;
    for (std::size_t f = 0; f < guess.frames; ++f) {
      const std::size_t i = f * guess.channels + c;
      seen |= work.channels.observed[i] != 0;
      if (work.channels.observed[i] == 0 || (without_suspects && work.suspect[i] != 0)) {
        guess.values[i] = work.fallback.values[i];
      }
    }
    for (std::size_t f = 0; f < guess.frames && !seen; ++f) guess(f, c) = mean[c];
  }
  return guess;
}

// Whether samples that are to be filled are missing. Parts that the take lacks, or that `auto`
// keeps, are ignored.
bool has_gaps(const PriorWork& work) {
  const std::size_t parts = work.match->tracks.size();
  for (std::size_t i = 0; i < work.channels.observed.size(); ++i) {
    const std::size_t part = i % work.channels.poses.channels / 3;
    const bool lacking = part < parts && work.match->tracks[part] < 0;
    const bool left_out = !work.left_out.empty() && work.left_out[part] != 0;
    if (!lacking && !left_out && work.channels.observed[i] == 0) return true;
  }
  return false;
}

class ExampleCleaning {
 public:
  ExampleCleaning(const ExampleOptions& options, std::shared_ptr<const Model> model,
                  const ExampleTuning& tuning)
      : options_(options), tuning_(tuning), model_(std::move(model)), prior_(example_of(*model_)) {
    if (!is_papers()) return;
    if (options_.welsch_deg == 0) options_.welsch_deg = papers_welsch_deg;
    if (options_.lambda == 0) options_.lambda = papers_lambda;
  }

  PriorHold hold() const {
    const bool is_told = !options_.robust || options_.lambda > 0 || options_.welsch_deg > 0;
    return is_told ? PriorHold::nothing : PriorHold::white_noise;
  }

  void filter(PriorWork& work) const {
    if (work.channels.poses.frames == 0) return;
    const BodyChannels& channels = work.channels;
    const std::vector<double>& mean = prior_.bases.mean;
    PoseMatrix guess = first_guess(work, mean, tuning_.guesses_suspects && !is_papers());
    // Relative to motion that the bases express, outliers are visible at once.
    PoseMatrix cleaned = filter_linearly(guess, bases_at_rate_of(channels), mean);
    if (!options_.robust) {
      work.channels.poses = std::move(cleaned);
      return;
    }
    const std::vector<double> noise = example_noise(work);
    const double strange = strangeness(work, guess, cleaned, noise, prior_.bases.residual);
    const double suspects = suspect_share(work, cleaned);
    if (!tuning_.starts_expressible || is_papers()) cleaned = std::move(guess);
    guess = {};
    WindowBases bases = bases_at_rate_of(channels);
    const ExampleWeights weights = weights_for(noise, bases);
    example_filter(cleaned, channels.poses, channels.observed, std::move(bases), mean, weights,
                   settings_for(work));
    release_if_crowded(work, suspects);
    finish(work, {weights.welsch, noise, strange}, cleaned);
    work.channels.poses = std::move(cleaned);
  }

 private:
  WindowBases bases_at_rate_of(const BodyChannels& channels) const {
    return bases_at_rate(prior_.bases, prior_.rate_hz, channels.frame_rate_hz,
                         channels.poses.frames, static_cast<std::size_t>(options_.bases));
  }

  ExampleSettings settings_for(const PriorWork& work) const {
    ExampleSettings settings;
    settings.iterations = static_cast<std::size_t>(options_.iterations);
    settings.tolerance = options_.tolerance;
    if (is_papers()) {
      settings.solver = ExampleSolver::alternation;
      settings.tolerance *= tolerance_of_papers;
    } else if (has_gaps(work)) {
      settings.tolerance *= tolerance_of_gaps;
    }
    return settings;
  }

  // Known properties of a take and its noise.
  struct Findings {
    std::span<const double> welsch;
    const std::vector<double>& noise;
    double strangeness;
  };

  // Handles motion outside the bases, which the paper does not.
  void finish(PriorWork& work, const Findings& found, PoseMatrix& cleaned) const {
    const BodyChannels& channels = work.channels;
    const bool smooths = options_.lambda == 0 && tuning_.smooths_rest;
    PoseMatrix expressed;
    if (smooths)
      expressed = filter_linearly(cleaned, bases_at_rate_of(channels), prior_.bases.mean);
    const PoseMatrix counts =
        welsch_weights(cleaned, channels.poses, channels.observed, found.welsch);
    work.rejected.assign(channels.observed.size(), 0);
    for (std::size_t i = 0; i < work.rejected.size(); ++i)
      work.rejected[i] = channels.observed[i] != 0 && counts.values[i] < rejected_weight ? 1 : 0;
    if (smooths) smooth_rest(work, counts, expressed, found.noise, cleaned);
    if (options_.lambda > 0 || options_.welsch_deg > 0) return;
    // Where the bases are biased `auto` takes over, unless outliers are so frequent that they may
    // be the median.
    if (tuning_.leaves_biased && !work.is_whole) fall_back_where_biased(work, found.noise, cleaned);
    if (tuning_.leaves_strange) fall_back(work, found.strangeness, cleaned);
  }

  bool is_papers() const { return options_.solver == "paper"; }

  ExampleWeights weights_for(const std::vector<double>& noise, const WindowBases& bases) const {
    ExampleWeights weights = probable_weights(prior_, bases, noise, tuning_.welsch_deviations);
    if (!tuning_.knows_variances) weights.coefficients.clear();
    for (std::size_t c = 0; c < noise.size(); ++c) {
      weights.prior[c] /= tuning_.rest_memory_frames;
      weights.welsch[c] = portable::hypot(
          weights.welsch[c], tuning_.rest_deviations * std::sqrt(prior_.bases.residual[c]));
    }
    if (options_.lambda > 0) {
      std::fill(weights.data.begin(), weights.data.end(), 1.0);
      std::fill(weights.prior.begin(), weights.prior.end(), options_.lambda);
      weights.coefficients.clear();
    }
    if (options_.welsch_deg > 0)
      std::fill(weights.welsch.begin(), weights.welsch.end(), options_.welsch_deg);
    return weights;
  }

  ExampleOptions options_;
  ExampleTuning tuning_;
  std::shared_ptr<const Model> model_;
  ExamplePrior prior_;
};

}  // namespace

std::unique_ptr<Cleaner> make_example(const ExampleOptions& options,
                                      std::shared_ptr<const Model> model) {
  return make_tuned_example(options, std::move(model), {});
}

std::unique_ptr<Cleaner> make_tuned_example(const ExampleOptions& options,
                                            std::shared_ptr<const Model> model,
                                            const ExampleTuning& tuning) {
  example_table().validate(options);
  model = model_of(example_models, options.model, std::move(model));
  const ExampleCleaning cleaning(options, model, tuning);
  return make_prior_cleaner(model,
                            {.name = "example",
                             .options = example_table().values(options),
                             .map = options.map,
                             .fill = options.fill,
                             .hold = cleaning.hold(),
                             .filter = [cleaning](PriorWork& work) { cleaning.filter(work); }});
}

Method example_method() {
  return {"example",
          "keeps the motion that patterns learned from clean clips can express",
          "Lou & Chai 2010, Example-based Human Motion Denoising",
          example_table().specs(),
          [](const OptionValues& values) { return make_example(example_table().parse(values)); },
          true};
}

namespace {

// Variances below this are rounding, square degrees. Not swept.
constexpr double least_kept_variance = 1e-6;

const std::vector<double>& variances(const Tensor& tensor, const char* name) {
  for (const double value : tensor.values) {
    if (value < 0) {
      throw Error(ErrorKind::unreadable_input,
                  std::string("the model's ") + name + " have a negative variance");
    }
  }
  return tensor.values;
}

}  // namespace

void store_example(const ExamplePrior& prior, Model& model) {
  const FilterBases& b = prior.bases;
  model.rate_hz = prior.rate_hz;
  model.numbers["energy"] = b.total_energy;
  model.tensors["bases"] = {TensorType::f16, {b.window_frames, b.channels, b.count}, b.bases};
  model.tensors["eigenvalues"] = {TensorType::f32, {b.count}, b.eigenvalues};
  model.tensors["mean"] = {TensorType::f32, {b.channels}, b.mean};
  model.tensors["residual"] = {TensorType::f32, {b.channels}, b.residual};
  Tensor limits{TensorType::f32, {b.channels, 2}, {}};
  for (std::size_t c = 0; c < b.channels; ++c) {
    limits.values.push_back(prior.lowest[c]);
    limits.values.push_back(prior.highest[c]);
  }
  model.tensors["limits"] = limits;
}

ExamplePrior example_of(const Model& model) {
  ExamplePrior prior;
  prior.rate_hz = model.rate_hz;
  // Braces alone would be taken as a number of dimensions.
  using Shape = std::vector<std::size_t>;
  const Tensor& bases = model.tensor("bases", 3);
  FilterBases& b = prior.bases;
  b.window_frames = bases.shape[0];
  b.channels = bases.shape[1];
  b.count = bases.shape[2];
  if (b.channels != model.layout.channel_count() || b.window_frames == 0) {
    throw Error(ErrorKind::unreadable_input, "the model's bases are not those of its body");
  }
  b.bases = bases.values;
  b.eigenvalues = variances(model.tensor("eigenvalues", Shape{b.count}), "eigenvalues");
  b.mean = model.tensor("mean", Shape{b.channels}).values;
  b.residual = variances(model.tensor("residual", Shape{b.channels}), "residuals");
  b.total_energy = model.number("energy");
  const Tensor& limits = model.tensor("limits", Shape{b.channels, 2});
  for (std::size_t c = 0; c < b.channels; ++c) {
    prior.lowest.push_back(limits.values[2 * c]);
    prior.highest.push_back(limits.values[2 * c + 1]);
  }
  return prior;
}

ExampleWeights probable_weights(const ExamplePrior& prior, const WindowBases& bases,
                                std::span<const double> noise, double welsch_deviations) {
  // The number of windows over a frame.
  const double overlap =
      std::ceil(static_cast<double>(bases.frames) / static_cast<double>(bases.hop));
  const double windows = std::max(overlap, 1.0);
  ExampleWeights weights;
  for (std::size_t c = 0; c < bases.channels; ++c) {
    const double residual = std::max(prior.bases.residual[c], least_kept_variance);
    weights.data.push_back(1 / (noise[c] * noise[c]));
    weights.welsch.push_back(welsch_deviations * noise[c]);
    // Motion outside the bases is smooth: samples between two frames of the model are not
    // independent.
    weights.prior.push_back(1 / (2 * windows * static_cast<double>(bases.hop) * residual));
  }
  for (std::size_t k = 0; k < bases.count; ++k) {
    weights.coefficients.push_back(
        1 / (2 * windows * std::max(prior.bases.eigenvalues[k], least_kept_variance)));
  }
  return weights;
}

}  // namespace kinemend
