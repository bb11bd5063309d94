// Defines the method `sparse` (Xiao et al. 2015): its options and its cleaner.
#include "papers/xiao2015_sparse/sparse.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "cleaner/method_row.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "models/model_reading.hpp"
#include "papers/xiao2015_sparse/sparse_filter.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend {

namespace {

constexpr double outlier_deviations = 5;  // of the noise of a channel
constexpr double many_outliers = 0.02;    // share of samples: one in fifty
constexpr double well_below = 0.7;        // share of the noise that `auto` measures
// Mean square of the residual outside the atoms, in those of the noise, from which `auto` is mixed
// in; and the largest share of `auto` in the result.
constexpr double usual_rest = 0.1, most_of_auto = 0.5;
// Turn of the root from the mean of the training, in all but a few frames.
constexpr double far_root_deg = 70, mostly = 0.98;
constexpr double least_channel_noise_deg = 0.05;  // against division by zero
constexpr double least_point_noise = 2e-4;        // body heights

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

// The measurements, with `auto`'s values in gaps and, for joints, at spikes, which would displace
// all points below them.
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

// Markers of a capture have about the same noise. If their estimates differ, outliers have moved
// the guide of those far from the body's middle, which must not lower their weight.
void level(std::vector<double>& noise) {
  std::vector<double> levels = noise;
  noise.assign(noise.size(), median_of(levels));
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

// The noise of each channel as `auto` measures it, but at most the scatter of the measurements
// about the result of the atoms: where many samples are outliers, `auto` takes them for noise.
std::vector<double> noise_about(const PriorWork& work, const PoseMatrix& cleaned, bool is_capped) {
  std::vector<double> noise = example_noise(work);
  if (!is_capped) return noise;
  const std::vector<double> scatter =
      point_noise(work.channels.poses, cleaned, work.channels.observed);
  for (std::size_t c = 0; c < noise.size(); ++c)
    noise[c] = std::min(noise[c], std::max(scatter[c], least_channel_noise_deg));
  return noise;
}

// The points that the result of wanted joints depends on: these joints and the ends of their bones;
// for markers the wanted ones themselves.
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

bool is_root_left_out(const PriorWork& work) {
  return !work.left_out.empty() && work.left_out.front() != 0;
}

// Whether the body leans farther than the poses of the training.
bool leans_far(const PriorWork& work) {
  if (is_root_left_out(work)) return true;
  std::vector<double> turns;
  for (std::size_t f = 0; f < work.fallback.frames; ++f)
    turns.push_back(norm(Vec3{work.fallback(f, 0), work.fallback(f, 1), work.fallback(f, 2)}));
  return quantile_of(turns, mostly) > far_root_deg;
}

// Fixes the root at its mean rotation. All points turn with the root, so the other joints stay the
// same.
PoseMatrix with_steady_root(PoseMatrix poses) {
  for (std::size_t f = 0; f < poses.frames; ++f) std::fill_n(poses.row(f).begin(), 3, 0.0);
  return poses;
}

// F x D. A root that is left to `auto` is marked as measured; otherwise no point of the body would
// be.
std::vector<std::uint8_t> observed_with_root(const PriorWork& work) {
  std::vector<std::uint8_t> observed = work.channels.observed;
  if (!is_root_left_out(work)) return observed;
  const std::size_t width = work.channels.poses.channels;
  for (std::size_t first = 0; first < observed.size(); first += width)
    std::fill_n(observed.begin() + static_cast<std::ptrdiff_t>(first), 3, std::uint8_t{1});
  return observed;
}

// The points after the dictionaries. If many are outliers, `auto`'s result is a poor guide, and a
// second turn takes the first result as its guide.
PoseMatrix filtered_points(const PriorWork& work, const PoseMatrix& positions, PoseMatrix guide,
                           const SparsePrior& prior, const BodyLayout& layout,
                           const std::vector<std::uint8_t>& wanted, const SparseSettings& settings,
                           const SparseTuning& tuning) {
  const std::vector<std::uint8_t> observed =
      observed_points(prior.points, layout, observed_with_root(work));
  const double rate_hz = work.channels.frame_rate_hz;
  const bool guides_again = tuning.guides_again && settings.loss != SparseLoss::squares;
  for (std::size_t turn = 0; turn < (guides_again ? 2 : 1); ++turn) {
    std::vector<double> noise = point_noise(positions, guide, observed);
    if (tuning.levels_markers && prior.points.kind == BodyKind::markers) level(noise);
    if (turn > 0 &&
        share_beyond(positions, guide, noise, settings.outlier_deviations) < many_outliers)
      break;
    guide = sparse_filter(prior, {positions, guide, observed, noise, rate_hz, wanted}, settings);
  }
  return guide;
}

// Rejects spikes and measurements far from the result of the atoms. One that is far while those
// before and after it are not is an impulse: motion that the atoms lack lasts longer. Impulses
// that `auto` has not seen become suspects, as the result is not to be held near `auto`'s there.
// Returns the share of far measurements that `auto` has taken for noise: those in channels that
// mostly lie nearer to this result than the noise that `auto` measures.
double reject_outliers(PriorWork& work, const std::vector<double>& noise,
                       const PoseMatrix& expressed, bool marks_impulses) {
  const std::vector<double> by_auto = example_noise(work);
  const std::size_t width = expressed.channels, count = expressed.values.size();
  std::vector<std::uint8_t> is_far(count);
  double taken_for_noise = 0, observed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (work.channels.observed[i] == 0) continue;
    const std::size_t c = i % width;
    const double distance = std::abs(work.channels.poses.values[i] - expressed.values[i]);
    is_far[i] = distance > outlier_deviations * noise[c] ? 1 : 0;
    taken_for_noise += is_far[i] != 0 && noise[c] < well_below * by_auto[c] ? 1 : 0;
    observed += 1;
  }
  work.rejected.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const bool goes_on =
        (i >= width && is_far[i - width] != 0) || (i + width < count && is_far[i + width] != 0);
    if (marks_impulses && is_far[i] != 0 && !goes_on) work.suspect[i] = 1;
    const bool is_rejected = is_far[i] != 0 || work.suspect[i] != 0;
    work.rejected[i] = work.channels.observed[i] != 0 && is_rejected ? 1 : 0;
  }
  return taken_for_noise / std::max(observed, 1.0);
}

// F x D, 1 for measurements that are not rejected.
PoseMatrix counted(const PriorWork& work) {
  PoseMatrix counts(work.channels.poses.frames, work.channels.poses.channels);
  for (std::size_t i = 0; i < counts.values.size(); ++i)
    counts.values[i] = work.channels.observed[i] != 0 && work.rejected[i] == 0 ? 1 : 0;
  return counts;
}

// Averages `cleaned` with `auto`'s result. Where the atoms miss much of the motion, the smoothed
// rest has errors as large as those of `auto`, and the mean is better than either. The share of
// `auto` grows with the ratio of the rest to the noise.
void average_with_auto(const PriorWork& work, const PoseMatrix& expressed,
                       const std::vector<double>& noise, PoseMatrix& cleaned) {
  for (std::size_t first = 0; first + 2 < cleaned.channels; first += 3) {
    double squares = 0;
    for (std::size_t f = 0; f < cleaned.frames; ++f) {
      for (std::size_t c = first; c < first + 3; ++c)
        squares += portable::pow((cleaned(f, c) - expressed(f, c)) / noise[c], 2);
    }
    const double rest = squares / (3 * static_cast<double>(cleaned.frames)) / usual_rest;
    const double share = most_of_auto * rest * rest / (1 + rest * rest);
    for (std::size_t f = 0; f < cleaned.frames; ++f) {
      for (std::size_t c = first; c < first + 3; ++c) {
        if (work.channels.observed[f * cleaned.channels + c] != 0)
          cleaned(f, c) += share * (work.fallback(f, c) - cleaned(f, c));
      }
    }
  }
}

void filter_sparse(PriorWork& work, const SparseOptions& options, const SparsePrior& prior,
                   const BodyLayout& layout, const SparseTuning& tuning) {
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
  const bool is_steadied = prior.points.kind == BodyKind::joints && leans_far(work);
  const auto steadied = [&](PoseMatrix poses) {
    return is_steadied ? with_steady_root(std::move(poses)) : std::move(poses);
  };
  const PoseMatrix guide = steadied(work.fallback);
  const PoseMatrix positions =
      points_of(prior.points, layout, steadied(guess_of(work, prior.points.kind)));
  const PoseMatrix found = filtered_points(work, positions, points_of(prior.points, layout, guide),
                                           prior, layout, wanted, settings, tuning);
  PoseMatrix cleaned = channels_of(prior.points, layout, found, guide);
  // The root itself is left to `auto`.
  for (std::size_t f = 0; f < cleaned.frames && is_steadied; ++f)
    std::copy_n(work.fallback.row(f).begin(), 3, cleaned.row(f).begin());
  if (is_steadied && !is_root_left_out(work)) {
    std::vector<double> root_alone(work.needs.size(), 0);
    root_alone.front() = 1;
    add_fall_back(work, "they lean farther than the poses that the model was learned from",
                  std::move(root_alone));
  }
  if (settings.exact) {
    work.channels.poses = std::move(cleaned);
    return;
  }
  const std::vector<double> noise = noise_about(work, cleaned, tuning.caps_noise);
  release_if_crowded(work, reject_outliers(work, noise, cleaned, tuning.marks_impulses));
  // For joints, whose noise is seldom the same about each axis, the smoothing flips between two
  // estimates.
  if (tuning.smooths_rest && prior.points.kind == BodyKind::markers) {
    const PoseMatrix expressed = cleaned;
    smooth_rest(work, counted(work), expressed, noise, cleaned);
    if (tuning.averages && !work.is_whole) average_with_auto(work, expressed, noise, cleaned);
  }
  // Where many samples are outliers, `auto` is the worst choice.
  if (tuning.leaves_biased && !work.is_whole) fall_back_where_biased(work, noise, cleaned);
  work.channels.poses = std::move(cleaned);
}

}  // namespace

std::unique_ptr<Cleaner> make_sparse(const SparseOptions& options,
                                     std::shared_ptr<const Model> model) {
  return make_tuned_sparse(options, std::move(model), {});
}

std::unique_ptr<Cleaner> make_tuned_sparse(const SparseOptions& options,
                                           std::shared_ptr<const Model> model,
                                           const SparseTuning& tuning) {
  sparse_table().validate(options);
  model = model_of(sparse_models, options.model, std::move(model));
  const bool is_free = options.solver == "paper" || !tuning.holds;
  return make_prior_cleaner(
      model, {.name = "sparse",
              .options = sparse_table().values(options),
              .map = options.map,
              .fill = options.fill,
              .hold = is_free ? PriorHold::nothing : PriorHold::white_noise,
              .filter = [options, model, tuning, prior = sparse_prior_of(*model)](PriorWork& work) {
                filter_sparse(work, options, prior, model->layout, tuning);
              }});
}

Method sparse_method() {
  return learned_method_row<sparse_table, make_sparse>(
      "sparse", "rebuilds each part of the body from a few learned pieces of motion",
      "Xiao et al. 2015, Sparse motion bases selection for human motion denoising");
}

}  // namespace kinemend
