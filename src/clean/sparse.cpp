#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "clean/example_rest.hpp"
#include "clean/method_list.hpp"
#include "clean/prior_cleaning.hpp"
#include "clean/prior_hold.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/methods.hpp"
#include "priors/sparse_filter.hpp"
#include "priors/sparse_prior.hpp"

namespace kinemend {

namespace {

constexpr double outlier_deviations = 5;  // of the noise of a channel
constexpr double many_outliers = 0.02;
constexpr double least_channel_noise_deg = 0.05;
constexpr double least_point_noise = 2e-4;  // body heights

const OptionTable<SparseOptions>& sparse_table() {
  static const auto options =
      OptionTable<SparseOptions>()
          .text(&SparseOptions::model, "model",
                "model file made by kinemend train sparse; empty: the model that ships")
          .text(&SparseOptions::map, "map",
                "file that maps names in the take to names in the model")
          .choice(&SparseOptions::loss, "loss", {"mixed", "l2", "l1"},
                  "l2: for noise; l1: for outliers; mixed: l1 finds outliers, then l2 removes the "
                  "noise")
          .number(&SparseOptions::lambda, "lambda", "", 0, 1000,
                  "sparsity: a larger one uses fewer learned pieces and smooths more")
          .integer(&SparseOptions::hops, "hops", "", 1, 1000,
                   "number of overlapping windows that are averaged in each frame")
          .choice(&SparseOptions::solver, "solver", {"quick", "paper"},
                  "paper: the algorithm of the paper alone, without later corrections")
          .flag(&SparseOptions::fill, "fill_gaps",
                "fill gaps of joints or markers that the model knows");
  return options;
}

SparseLoss loss_of(const SparseOptions& options) {
  if (options.loss == "l2") return SparseLoss::squares;
  return options.loss == "l1" ? SparseLoss::absolute : SparseLoss::mixed;
}

// What was measured; `auto`'s opinion of gaps and, of joints, of spikes, which would throw all
// points below them.
PoseMatrix guess_of(const PriorWork& work, BodyKind kind) {
  PoseMatrix guess = work.channels.poses;
  for (std::size_t i = 0; i < guess.values.size(); ++i) {
    const bool is_spike = kind == BodyKind::joints && work.suspect[i] != 0;
    if (work.channels.observed[i] == 0 || is_spike) guess.values[i] = work.fallback.values[i];
  }
  return guess;
}

// Standard deviation of each point's noise, the same for its axes: median distance from the guide.
std::vector<double> point_noise(const PoseMatrix& positions, const PoseMatrix& guide,
                                const std::vector<std::uint8_t>& observed) {
  std::vector<double> noise(positions.channels, least_point_noise);
  for (std::size_t first = 0; first + 2 < positions.channels; first += 3) {
    std::vector<double> sizes;
    for (std::size_t f = 0; f < positions.frames; ++f) {
      for (std::size_t c = first; c < first + 3; ++c) {
        const std::size_t i = f * positions.channels + c;
        if (observed[i] != 0) sizes.push_back(std::abs(positions.values[i] - guide.values[i]));
      }
    }
    const double level = std::max(least_point_noise, deviations_per_median * median_of(sizes));
    std::fill_n(noise.begin() + static_cast<std::ptrdiff_t>(first), 3, level);
  }
  return noise;
}

double share_beyond(const PoseMatrix& positions, const PoseMatrix& guide,
                    const std::vector<double>& noise, double deviations) {
  double count = 0;
  for (std::size_t i = 0; i < positions.values.size(); ++i) {
    const double distance = std::abs(positions.values[i] - guide.values[i]);
    count += distance > deviations * noise[i % positions.channels] ? 1 : 0;
  }
  return count / std::max(1.0, static_cast<double>(positions.values.size()));
}

// Of each channel: as `auto` measures it, but no more than what is measured scatters about what the
// atoms express. Where many samples are outliers `auto` takes them for noise.
std::vector<double> noise_about(const PriorWork& work, const PoseMatrix& cleaned) {
  std::vector<double> noise = example_noise(work);
  const std::vector<double> scatter =
      point_noise(work.channels.poses, cleaned, work.channels.observed);
  for (std::size_t c = 0; c < noise.size(); ++c)
    noise[c] = std::min(noise[c], std::max(scatter[c], least_channel_noise_deg));
  return noise;
}

// The points that the result of wanted joints depends on, which are they and the ends of their
// bones; of markers they themselves.
std::vector<std::uint8_t> wanted_points(const SparsePoints& points,
                                        const std::vector<std::uint8_t>& wanted) {
  std::vector<std::uint8_t> marks(points.count(), 0);
  for (std::size_t p = 0; p < marks.size(); ++p) {
    const std::int32_t parent = points.parents[p];
    const bool is_own = p < wanted.size() && wanted[p] != 0;
    marks[p] = is_own || (parent >= 0 && wanted[static_cast<std::size_t>(parent)] != 0) ? 1 : 0;
  }
  return marks;
}

// F x D. A root that is left to `auto` counts as measured: all points turn with it, so that it does
// not matter in the local coordinates that they are compared in. Else a body that turns about a
// level axis would have no point that was measured.
std::vector<std::uint8_t> observed_with_root(const PriorWork& work) {
  std::vector<std::uint8_t> observed = work.channels.observed;
  if (work.left_out.empty() || work.left_out.front() == 0) return observed;
  const std::size_t width = work.channels.poses.channels;
  for (std::size_t first = 0; first < observed.size(); first += width)
    std::fill_n(observed.begin() + static_cast<std::ptrdiff_t>(first), 3, std::uint8_t{1});
  return observed;
}

// What the dictionaries make of the points. Where many are outliers, what `auto` makes of them is
// no good guide, and the result is the guide of another turn.
PoseMatrix filtered_points(const PriorWork& work, const PoseMatrix& positions,
                           const SparsePrior& prior, const BodyLayout& layout,
                           const std::vector<std::uint8_t>& wanted,
                           const SparseSettings& settings) {
  PoseMatrix guide = points_of(prior.points, layout, work.fallback);
  const std::vector<std::uint8_t> observed =
      observed_points(prior.points, layout, observed_with_root(work));
  const double rate_hz = work.channels.frame_rate_hz;
  const std::size_t turns = settings.loss == SparseLoss::squares ? 1 : 2;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    const std::vector<double> noise = point_noise(positions, guide, observed);
    if (turn > 0 &&
        share_beyond(positions, guide, noise, settings.outlier_deviations) < many_outliers)
      break;
    guide = sparse_filter(prior, {positions, guide, observed, noise, rate_hz, wanted}, settings);
  }
  return guide;
}

// Spikes, and what is measured far from what the atoms express.
void reject_outliers(PriorWork& work, const std::vector<double>& noise,
                     const PoseMatrix& expressed) {
  work.rejected.assign(expressed.values.size(), 0);
  for (std::size_t i = 0; i < expressed.values.size(); ++i) {
    if (work.channels.observed[i] == 0) continue;
    const double distance = std::abs(work.channels.poses.values[i] - expressed.values[i]);
    const bool is_far = distance > outlier_deviations * noise[i % expressed.channels];
    work.rejected[i] = work.suspect[i] != 0 || is_far ? 1 : 0;
  }
}

// F x D, 1 for measurements that are not rejected.
PoseMatrix counted(const PriorWork& work) {
  PoseMatrix counts(work.channels.poses.frames, work.channels.poses.channels);
  for (std::size_t i = 0; i < counts.values.size(); ++i)
    counts.values[i] = work.channels.observed[i] != 0 && work.rejected[i] == 0 ? 1 : 0;
  return counts;
}

void filter_sparse(PriorWork& work, const SparseOptions& options, const SparsePrior& prior,
                   const BodyLayout& layout) {
  if (work.channels.poses.frames == 0) return;
  SparseSettings settings;
  settings.loss = loss_of(options);
  settings.lambda = options.lambda;
  settings.hops = static_cast<std::size_t>(options.hops);
  settings.exact = options.solver == "paper";
  std::vector<std::uint8_t> wanted;
  if (!settings.exact) {
    const std::vector<std::uint8_t> parts = wanted_parts(work, options.fill);
    if (std::find(parts.begin(), parts.end(), 1) == parts.end()) {
      work.channels.poses = work.fallback;
      return;
    }
    wanted = wanted_points(prior.points, parts);
  }
  const PoseMatrix positions = points_of(prior.points, layout, guess_of(work, prior.points.kind));
  PoseMatrix found = filtered_points(work, positions, prior, layout, wanted, settings);
  PoseMatrix cleaned = channels_of(prior.points, layout, found, work.fallback);
  if (settings.exact) {
    work.channels.poses = std::move(cleaned);
    return;
  }
  const std::vector<double> noise = noise_about(work, cleaned);
  reject_outliers(work, noise, cleaned);
  // Of joints, whose noise is seldom the same about each axis, it flips between two estimates.
  if (prior.points.kind == BodyKind::markers) {
    const PoseMatrix expressed = cleaned;
    smooth_rest(work, counted(work), expressed, noise, cleaned);
  }
  fall_back_where_biased(work, noise, cleaned);
  work.channels.poses = std::move(cleaned);
}

}  // namespace

std::unique_ptr<Cleaner> make_sparse(const SparseOptions& options,
                                     std::shared_ptr<const Model> model) {
  sparse_table().validate(options);
  model = model_for("sparse", options.model, std::move(model));
  const PriorHold hold = options.solver == "paper" ? PriorHold::nothing : PriorHold::white_noise;
  return make_prior_cleaner(model, options.map, options.fill, hold,
                            [options, model, prior = sparse_prior_of(*model)](PriorWork& work) {
                              filter_sparse(work, options, prior, model->layout);
                            });
}

Method sparse_method() {
  return {"sparse",
          "rebuilds each part of the body from a few learned pieces of motion",
          "Xiao et al. 2015, Sparse motion bases selection for human motion denoising",
          sparse_table().specs(),
          [](const OptionValues& values) { return make_sparse(sparse_table().parse(values)); },
          true};
}

}  // namespace kinemend
