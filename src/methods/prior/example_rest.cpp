// Measures how strange a take is to the bases, smooths the rest, and blends in `auto`'s
// result.
#include "methods/prior/example_rest.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/experimental/signal.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "signal/evidence.hpp"

namespace kinemend {

namespace {

// Lowest noise of a channel, degrees. Chosen by hand, not swept.
constexpr double least_error_deg = 0.05;
constexpr double least_variance = 1e-6;  // square degrees: less is rounding
// Strangeness is the take's residual outside the bases divided by that of the training, so its
// minimum is 1 by definition. Samples of a lower weight count as missing. The other values are
// chosen by hand, not swept.
constexpr double least_strangeness = 1;
constexpr double least_rest_weight = 0.01;
constexpr double known_motion = 1.5, unknown_motion = 5;  // strangeness
// The bias is the running median of the filter's residuals over this time, in deviations of the
// noise. With 25 noise samples it stays within a quarter of a deviation, whatever a few outliers
// do; with 15, a fifth of outliers are seldom half. Chosen by hand, not swept.
constexpr double window_s = 0.2;
// Minimum of that window's frames on either side; the bias at which `auto` begins to take over and
// at which it has taken over; channels of a joint. Chosen by hand, not swept.
constexpr double least_half_window = 7;
constexpr double believable_bias = 1, unbelievable_bias = 2;
constexpr std::size_t part_channels = 3;

// Mean of the squares without the largest tenth, and its value for a Gaussian variance of 1. The
// share is chosen by hand, not swept. By definition the value is 0.623; the figures were measured
// with 0.64.
constexpr double trimmed_share = 0.9, trimmed_of_one = 0.64;
double trimmed_mean(std::vector<double>& squares) {
  const auto kept = std::max<std::size_t>(
      1, static_cast<std::size_t>(trimmed_share * static_cast<double>(squares.size())));
  of_rank(squares, kept - 1);
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += squares[i];
  return sum / static_cast<double>(kept);
}

// Moves a part's measured samples towards `auto`'s result by `share_at(frame)`. Returns the mean
// share over frames.
template <class Shares>
double blend_part(const PriorWork& work, std::size_t part, const Shares& share_at,
                  PoseMatrix& cleaned) {
  double sum = 0;
  for (std::size_t f = 0; f < cleaned.frames; ++f) {
    const double share = share_at(f);
    sum += share;
    for (std::size_t c = part_channels * part; c < part_channels * (part + 1) && share > 0; ++c) {
      if (work.channels.observed[f * cleaned.channels + c] != 0)
        cleaned(f, c) += share * (work.fallback(f, c) - cleaned(f, c));
    }
  }
  return sum / static_cast<double>(cleaned.frames);
}

// 0 up to `none`, 1 from `all` on.
double ramp(double value, double none, double all) {
  return std::clamp((value - none) / (all - none), 0.0, 1.0);
}

}  // namespace

std::vector<double> example_noise(const PriorWork& work) {
  std::vector<double> levels = work.noise, known;
  for (double& level : levels) {
    if (level <= 0) continue;
    level = std::max(level, least_error_deg);
    known.push_back(level);
  }
  const double typical = std::max(median_of(known), least_error_deg);
  for (double& level : levels) level = level > 0 ? level : typical;
  return levels;
}

double strangeness(const PriorWork& work, const PoseMatrix& guess, const PoseMatrix& expressed,
                   const std::vector<double>& noise, const std::vector<double>& residual) {
  double found = 0, known = 0;
  for (std::size_t c = 0; c < guess.channels; ++c) {
    std::vector<double> squares;
    for (std::size_t f = 0; f < guess.frames; ++f) {
      if (work.channels.observed[f * guess.channels + c] == 0) continue;
      const double left = guess(f, c) - expressed(f, c);
      squares.push_back(left * left);
    }
    if (squares.empty()) continue;
    found += trimmed_mean(squares) - trimmed_of_one * noise[c] * noise[c];
    known += trimmed_of_one * std::max(residual[c], least_variance);
  }
  return known > 0 ? std::max(least_strangeness, found / known) : least_strangeness;
}

void smooth_rest(const PriorWork& work, const PoseMatrix& weights, const PoseMatrix& expressed,
                 const std::vector<double>& noise, PoseMatrix& cleaned) {
  const signal::ModelGrid grid(cleaned.frames, work.channels.frame_rate_hz);
  if (grid.models().empty()) return;
  PoseMatrix& rest = cleaned;
  std::vector<std::uint8_t> missing(rest.values.size(), 0);
  std::vector<std::size_t> seen(rest.channels, 0);
  for (std::size_t i = 0; i < rest.values.size(); ++i) {
    const double weight = work.channels.observed[i] != 0 ? weights.values[i] : 0.0;
    const double measured = weight > 0 ? work.channels.poses.values[i] : 0.0;
    rest.values[i] = weight * measured + (1 - weight) * cleaned.values[i] - expressed.values[i];
    // Gaps get no motion outside the bases: a free curve through the gap would be no better than
    // one without bases.
    missing[i] = work.channels.observed[i] != 0 && weight < least_rest_weight ? 1 : 0;
    seen[i % rest.channels] += missing[i] == 0 ? 1 : 0;
  }
  // For a mostly rejected channel only the filter's result is available.
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (2 * seen[i % rest.channels] < rest.frames) missing[i] = 0;
  }
  std::vector<double> variances;
  variances.reserve(noise.size());
  for (const double n : noise) variances.push_back(n * n);
  const std::vector<std::size_t> chosen =
      signal::most_likely_models(rest, variances, grid, part_channels);
  std::vector<signal::SmoothingModel> models;
  models.reserve(chosen.size());
  for (const std::size_t model : chosen) models.push_back(grid.models()[model]);
  signal::smooth_adaptively(rest, missing, variances, models, work.channels.frame_rate_hz);
  for (std::size_t i = 0; i < rest.values.size(); ++i) cleaned.values[i] += expressed.values[i];
}

void fall_back(PriorWork& work, double strangeness, PoseMatrix& cleaned) {
  const double share =
      ramp(portable::log(strangeness), portable::log(known_motion), portable::log(unknown_motion));
  for (std::size_t part = 0; part_channels * part < cleaned.channels; ++part)
    blend_part(
        work, part, [share](std::size_t) { return share; }, cleaned);
  add_fall_back(work, "the motion is unlike what the model was learned from",
                std::vector<double>(work.needs.size(), share));
}

void fall_back_where_biased(PriorWork& work, const std::vector<double>& noise,
                            PoseMatrix& cleaned) {
  PoseMatrix bias = work.channels.poses;
  for (std::size_t i = 0; i < bias.values.size(); ++i) {
    const double left = work.channels.observed[i] != 0 ? bias.values[i] - cleaned.values[i] : 0;
    bias.values[i] = left / noise[i % bias.channels];
  }
  const double half =
      std::max(least_half_window, std::round(0.5 * window_s * work.channels.frame_rate_hz));
  median_filter(bias, static_cast<std::size_t>(std::min(half, static_cast<double>(bias.frames))));
  std::vector<double> shares(work.needs.size(), 0);
  for (std::size_t part = 0; part_channels * (part + 1) <= cleaned.channels; ++part) {
    const auto share_at = [&](std::size_t f) {
      double squares = 0;
      for (std::size_t c = part_channels * part; c < part_channels * (part + 1); ++c)
        squares += bias(f, c) * bias(f, c);
      return ramp(std::sqrt(squares / part_channels), believable_bias, unbelievable_bias);
    };
    shares[part] = blend_part(work, part, share_at, cleaned);
  }
  add_fall_back(work, "the filter moves them off what was measured", std::move(shares));
}

}  // namespace kinemend
