// Defines the method `wiener`: its options and its cleaner.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/quantiles.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "methods/auto/smoothing.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "methods/wiener/wiener_prior.hpp"
#include "methods/wiener/wiener_steps.hpp"
#include "models/model_reading.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

const OptionTable<WienerOptions>& wiener_table() {
  static const auto options =
      OptionTable<WienerOptions>()
          .text(&WienerOptions::model, "model",
                "model file made by kinemend train wiener; empty: the model that ships")
          .text(&WienerOptions::map, "map",
                "file that maps names in the take to names in the model")
          .number(&WienerOptions::noise_deg, "noise_deg", "deg", 0, 45,
                  "standard deviation of the noise per channel; 0: estimated from the take")
          .number(&WienerOptions::sensitivity, "sensitivity", "", 0, 4,
                  "factor on the noise: above 1 smooths more, below 1 less, 0 not at all")
          .flag(&WienerOptions::despike, "despike", "find and repair spikes")
          .flag(&WienerOptions::fill, "fill_gaps",
                "fill gaps of joints or markers that the model knows");
  return options;
}

// Lower limit of the noise, against division by zero; fewest differences that determine a channel's
// noise; share of suspects, and noise in degrees, above which the filter looks for dense outliers
// itself (ablation_wiener.csv: "dense ones not looked for", "by suspects only", "always").
constexpr double least_noise_deg = 1e-3;
constexpr std::size_t fewest_differences = 8;
constexpr double dense_share = 0.03, strong_noise_deg = 3;

// The noise of a channel from runs of five samples that were measured and are not spikes; that of
// `auto` if there are too few.
double channel_noise(const PriorWork& work, std::span<const std::uint8_t> suspect,
                     std::size_t channel) {
  const PoseMatrix& y = work.channels.poses;
  std::vector<double> sizes;
  const auto is_used = [&](std::size_t sample) {
    return work.channels.observed[sample] != 0 && suspect[sample] == 0;
  };
  for_each_fourth_difference(y, channel, is_used,
                             [&](double difference) { sizes.push_back(std::abs(difference)); });
  if (sizes.size() < fewest_differences) return work.noise[channel];
  return deviations_per_median * upper_median_of(sizes) / std::sqrt(fourth_difference_variance);
}

double share_of(const std::vector<std::uint8_t>& suspect, const PriorWork& work) {
  const std::vector<std::uint8_t>& observed = work.channels.observed;
  const auto samples = std::accumulate(observed.begin(), observed.end(), std::size_t{0});
  const auto suspects = std::accumulate(suspect.begin(), suspect.end(), std::size_t{0});
  return static_cast<double>(suspects) / std::max(static_cast<double>(samples), 1.0);
}

// `auto` finds only some of dense outliers, or takes them all for noise.
bool may_have_dense_outliers(const PriorWork& work, std::vector<double> noise) {
  return share_of(work.suspect, work) > dense_share || median_of(noise) > strong_noise_deg;
}

std::vector<double> noise_of(const PriorWork& work, std::span<const std::uint8_t> suspect,
                             const WienerOptions& options) {
  std::vector<double> noise(work.channels.poses.channels, options.noise_deg);
  for (std::size_t c = 0; c < noise.size(); ++c) {
    if (options.noise_deg <= 0) noise[c] = channel_noise(work, suspect, c);
    noise[c] = std::max(options.sensitivity * noise[c], least_noise_deg);
  }
  return noise;
}

// The axes of each three channels' noise, as rows: along them noise is independent.
std::vector<Eigen::Matrix3d> noise_axes(const PriorWork& work) {
  const PoseMatrix& poses = work.channels.poses;
  const VectorTracks tracks(poses.frames, poses.channels / 3,
                            [&](std::size_t f, std::size_t n) { return vector_at(poses, f, n); });
  const SampleMarks marks(poses.frames, tracks.tracks(), [&](std::size_t f, std::size_t n) {
    const std::uint8_t* observed = &work.channels.observed[f * poses.channels + 3 * n];
    return observed[0] == 0 || observed[1] == 0 || observed[2] == 0;
  });
  std::vector<Eigen::Matrix3d> axes;
  for (const Whitening& whitening : estimate_whitening(tracks, marks, work.channels.frame_rate_hz))
    axes.push_back(whitening.matrix.rowwise().normalized());
  return axes;
}

// Multiplies each three channels by their matrix.
void turn_channels(PoseMatrix& poses, std::span<const Eigen::Matrix3d> turns) {
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t part = 0; part < turns.size(); ++part) {
      Eigen::Map<Eigen::Vector3d> values(poses.row(f).data() + 3 * part);
      values = (turns[part] * values).eval();
    }
  }
}

void filter(PriorWork& work, const WienerOptions& options, const WienerPrior& known) {
  PoseMatrix& poses = work.channels.poses;
  std::vector<Eigen::Matrix3d> axes = noise_axes(work);
  const WienerPrior prior = with_turned_channels(known, axes);
  turn_channels(poses, axes);
  turn_channels(work.fallback, axes);
  std::vector<double> noise = noise_of(work, work.suspect, options);
  WienerSettings settings;
  if (!options.despike) settings.outlier_deviations = 0;
  const double rate_hz = work.channels.frame_rate_hz;
  WienerOutliers outliers{work.suspect, work.fallback};
  if (options.despike && may_have_dense_outliers(work, noise)) {
    WienerOutliers found = dense_outliers(
        prior, {poses, work.fallback, work.channels.observed, work.suspect, noise, rate_hz});
    const double share = share_of(found.suspect, work);
    if (share > dense_share) {
      release_if_crowded(work, share);
      outliers = std::move(found);
      noise = noise_of(work, outliers.suspect, options);
    }
  }
  WienerResult result = guarded_wiener_filter(
      prior, {poses, outliers.guess, work.channels.observed, outliers.suspect, noise, rate_hz},
      settings);
  poses = std::move(result.poses);
  for (Eigen::Matrix3d& turn : axes) turn.transposeInPlace();
  turn_channels(poses, axes);
  turn_channels(work.fallback, axes);
  work.rejected = std::move(result.rejected);
  for (double& deviation : work.noise) deviation *= std::max(options.sensitivity, 1.0);
}

}  // namespace

std::unique_ptr<Cleaner> make_wiener(const WienerOptions& options,
                                     std::shared_ptr<const Model> model) {
  wiener_table().validate(options);
  model = model_of(wiener_models, options.model, std::move(model));
  const PriorHold hold = options.noise_deg > 0 ? PriorHold::nothing : PriorHold::white_noise;
  return make_prior_cleaner(model,
                            {.name = "wiener",
                             .options = wiener_table().values(options),
                             .map = options.map,
                             .fill = options.fill,
                             .hold = hold,
                             .filter = [options, prior = wiener_prior_of(*model)](PriorWork& work) {
                               filter(work, options, prior);
                             }});
}

Method wiener_method() {
  return {"wiener",
          "estimates short stretches of motion from what was learned of motion and noise",
          "a stronger linear prior than Lou & Chai 2010",
          wiener_table().specs(),
          [](const OptionValues& values) { return make_wiener(wiener_table().parse(values)); },
          true};
}

}  // namespace kinemend
