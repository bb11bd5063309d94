// Blends the filter's result with that of `auto` by need, strangeness and bias, and sums up the
// parts that were left to `auto`.
#include "methods/prior/prior_fall_backs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/extend/signal.hpp"
#include "signal/evidence.hpp"

namespace kinemend {

namespace {

// For messages, chosen by hand.
constexpr double least_share = 0.005;  // smaller shares are not reported

// Sets `track` to the joint or marker of a part, or to -1 for the root position; false if the part
// is not selected.
bool track_of(const PriorWork& work, const std::vector<std::uint8_t>& selected, bool place,
              std::size_t part, std::int32_t& track) {
  const std::vector<std::int32_t>& parts = work.match->tracks;
  track = part < parts.size() ? parts[part] : -1;
  if (part == parts.size()) return place;
  return track >= 0 && selected[static_cast<std::size_t>(track)] != 0;
}

}  // namespace

void add_fall_back(PriorWork& work, std::string reason, std::vector<double> shares) {
  for (PartFallBack& before : work.fall_backs) {
    for (std::size_t part = 0; part < shares.size(); ++part)
      before.shares[part] *= 1 - shares[part];
  }
  work.fall_backs.push_back({std::move(reason), std::move(shares)});
}

bool is_fallen_back(const PriorWork& work, std::size_t part) {
  double share = 0;
  for (const PartFallBack& noted : work.fall_backs) share += noted.shares[part];
  return share > 0.5;
}

std::vector<FallBack> fall_backs_of(const PriorWork& work,
                                    const std::vector<std::uint8_t>& selected, bool place) {
  std::vector<FallBack> result;
  for (const PartFallBack& noted : work.fall_backs) {
    FallBack fall_back;
    fall_back.reason = noted.reason;
    for (std::size_t part = 0; part < noted.shares.size(); ++part) {
      std::int32_t track = -1;
      if (noted.shares[part] < least_share || !track_of(work, selected, place, part, track))
        continue;
      fall_back.tracks.push_back(track);
      fall_back.shares.push_back(noted.shares[part]);
    }
    if (!fall_back.tracks.empty()) result.push_back(std::move(fall_back));
  }
  std::vector<std::uint8_t> unknown = selected;
  for (const std::int32_t track : work.match->tracks) {
    if (track >= 0) unknown[static_cast<std::size_t>(track)] = 0;
  }
  FallBack fall_back;
  fall_back.reason = "the model does not know them";
  for (std::size_t track = 0; track < unknown.size(); ++track) {
    if (unknown[track] != 0) fall_back.tracks.push_back(static_cast<std::int32_t>(track));
  }
  fall_back.shares.assign(fall_back.tracks.size(), 1);
  if (!fall_back.tracks.empty()) result.push_back(std::move(fall_back));
  return result;
}

namespace {

// The rows `hold` of docs/details/wiener.md state what other values do.
constexpr double mostly_own = 0.5;     // need
constexpr double most_deviations = 1;  // deviations of the noise, from `auto`'s value of a sample
// A measurement is far from another result if it exceeds both this multiple of its channel's median
// distance and this distance. The same rows state what half and double of them do.
constexpr double far_medians = 8, least_far_deg = 8;
constexpr double crowded_share = 0.02;  // a share that `auto` does not repair well

// Interpolates the offsets of a channel linearly between held samples and continues them constantly
// beyond; without held samples they are 0.
void bridge_offsets(std::vector<double>& offsets, const std::vector<std::uint8_t>& held) {
  const std::size_t frames = offsets.size();
  std::size_t last = frames, next = 0;  // held frames before f, and at or after f; `frames`: none
  for (std::size_t f = 0; f < frames; ++f) {
    if (held[f] != 0) {
      last = f;
      continue;
    }
    next = std::max(next, f);
    while (next < frames && held[next] == 0) ++next;
    if (last == frames || next == frames) {
      offsets[f] = last < frames ? offsets[last] : next < frames ? offsets[next] : 0;
    } else {
      const double u = static_cast<double>(f - last) / static_cast<double>(next - last);
      offsets[f] = offsets[last] + u * (offsets[next] - offsets[last]);
    }
  }
}

// A sample that is farther from `auto`'s result than its noise explains has lost motion. Returns F
// x D / 3: the share of its distance that it may keep. Spikes are ignored.
std::vector<double> shares_within_noise(const PriorWork& work) {
  const PoseMatrix& poses = work.channels.poses;
  const std::size_t parts = work.needs.size();
  std::vector<double> shares(poses.frames * parts, 1);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t first = channels_of_part * part;
    double noise = 0;
    for (std::size_t c = first; c < first + channels_of_part; ++c)
      noise += work.noise[c] * work.noise[c];
    const double farthest = most_deviations * most_deviations * noise;
    if (work.needs[part] == 0) continue;
    for (std::size_t f = 0; f < poses.frames; ++f) {
      double change = 0;
      bool counts = true;
      for (std::size_t c = first; c < first + channels_of_part; ++c) {
        const std::size_t i = f * poses.channels + c;
        counts = counts && work.channels.observed[i] != 0 && work.suspect[i] == 0;
        change += portable::pow(poses(f, c) - work.fallback(f, c), 2);
      }
      if (counts && change > farthest) shares[f * parts + part] = std::sqrt(farthest / change);
    }
  }
  return shares;
}

// The mean over frames of 1 - share, for each part.
std::vector<double> mean_rest(const std::vector<double>& shares, std::size_t parts) {
  std::vector<double> rest(parts);
  const double weight = static_cast<double>(parts) / static_cast<double>(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) rest[i % parts] += weight * (1 - shares[i]);
  return rest;
}

}  // namespace

double suspect_share(const PriorWork& work, const PoseMatrix& result) {
  double suspects = 0, count = 0;
  std::vector<double> sizes;
  for (std::size_t c = 0; c < result.channels; ++c) {
    sizes.clear();
    double by_auto = 0;
    for (std::size_t f = 0; f < result.frames; ++f) {
      const std::size_t i = f * result.channels + c;
      if (work.channels.observed[i] == 0) continue;
      sizes.push_back(std::abs(work.channels.poses.values[i] - result.values[i]));
      by_auto += work.suspect[i] != 0 ? 1 : 0;
    }
    const double far = std::max(least_far_deg, far_medians * median_of(sizes));
    const auto beyond = static_cast<double>(
        std::count_if(sizes.begin(), sizes.end(), [&](double size) { return size > far; }));
    suspects += std::max(by_auto, beyond);
    count += static_cast<double>(sizes.size());
  }
  return count > 0 ? suspects / count : 0;
}

void settle_needs(PriorWork& work, PriorHold hold) {
  if (hold == PriorHold::nothing || suspect_share(work, work.fallback) > crowded_share) {
    work.is_whole = true;
    std::fill(work.needs.begin(), work.needs.end(), 1.0);
  } else if (hold == PriorHold::white_noise && !work.is_white) {
    std::fill(work.needs.begin(), work.needs.end(), 0.0);
    work.why_no_need = "the model takes noise for white, and theirs is not";
  }
}

void release_if_crowded(PriorWork& work, double outliers) {
  if (outliers > crowded_share) work.is_whole = true;
}

void hold_to_needs(PriorWork& work) {
  PoseMatrix& poses = work.channels.poses;
  const std::size_t frames = poses.frames;
  std::vector<double> left_alone;
  for (const double need : work.needs) left_alone.push_back(1 - std::min(need, 1.0));
  add_fall_back(work, work.why_no_need, std::move(left_alone));
  const std::size_t parts = work.needs.size();
  std::vector<double> shares(frames * parts, 1);
  if (!work.is_whole) {
    shares = shares_within_noise(work);
    add_fall_back(work, "they would change by more than their noise", mean_rest(shares, parts));
  }
  std::vector<double> offsets(frames);
  std::vector<std::uint8_t> held(frames);
  for (std::size_t c = 0; c < poses.channels; ++c) {
    const std::size_t part = c / channels_of_part;
    for (std::size_t f = 0; f < frames; ++f) {
      const std::size_t i = f * poses.channels + c;
      const double need = work.needs[part] * shares[f * parts + part];
      if (need < mostly_own && !work.rejected.empty()) work.rejected[i] = work.suspect[i];
      held[f] = work.channels.observed[i];
      offsets[f] = (1 - std::min(need, 1.0)) * (work.fallback(f, c) - poses(f, c));
    }
    bridge_offsets(offsets, held);
    for (std::size_t f = 0; f < frames; ++f) {
      if (offsets[f] != 0) poses(f, c) += offsets[f];
    }
  }
}

std::vector<std::uint8_t> wanted_parts(const PriorWork& work, bool fill) {
  std::vector<std::uint8_t> wanted(work.match->tracks.size(), 0);
  for (std::size_t part = 0; part < wanted.size(); ++part) {
    const bool is_absent =
        work.match->tracks[part] < 0 || (!work.left_out.empty() && work.left_out[part] != 0);
    wanted[part] = !is_absent && !is_left_alone(work, part, fill) ? 1 : 0;
  }
  return wanted;
}

bool is_left_alone(const PriorWork& work, std::size_t part, bool fill) {
  if (work.needs[part] > 0) return false;
  if (!fill) return true;
  const std::size_t channels = work.channels.poses.channels;
  for (std::size_t f = 0; f < work.channels.poses.frames; ++f) {
    if (work.channels.observed[f * channels + channels_of_part * part] == 0) return false;
  }
  return true;
}

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
// at which it has taken over. Chosen by hand, not swept.
constexpr double least_half_window = 7;
constexpr double believable_bias = 1, unbelievable_bias = 2;

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
    for (std::size_t c = channels_of_part * part; c < channels_of_part * (part + 1) && share > 0;
         ++c) {
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
      signal::most_likely_models(rest, variances, grid, channels_of_part);
  std::vector<signal::SmoothingModel> models;
  models.reserve(chosen.size());
  for (const std::size_t model : chosen) models.push_back(grid.models()[model]);
  signal::smooth_adaptively(rest, missing, variances, models, work.channels.frame_rate_hz);
  for (std::size_t i = 0; i < rest.values.size(); ++i) cleaned.values[i] += expressed.values[i];
}

void fall_back(PriorWork& work, double strangeness, PoseMatrix& cleaned) {
  const double share =
      ramp(portable::log(strangeness), portable::log(known_motion), portable::log(unknown_motion));
  for (std::size_t part = 0; channels_of_part * part < cleaned.channels; ++part)
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
  for (std::size_t part = 0; channels_of_part * (part + 1) <= cleaned.channels; ++part) {
    const auto share_at = [&](std::size_t f) {
      double squares = 0;
      for (std::size_t c = channels_of_part * part; c < channels_of_part * (part + 1); ++c)
        squares += bias(f, c) * bias(f, c);
      return ramp(std::sqrt(squares / channels_of_part), believable_bias, unbelievable_bias);
    };
    shares[part] = blend_part(work, part, share_at, cleaned);
  }
  add_fall_back(work, "the filter moves them off what was measured", std::move(shares));
}

}  // namespace kinemend
