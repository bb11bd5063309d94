// Decides how much of the filter each part needs and blends the rest with `auto`'s result.
#include "methods/prior/prior_hold.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "methods/prior/prior_fall_backs.hpp"

namespace kinemend {

namespace {

// The rows `hold` of docs/methods/wiener-details.md state what other values do.
constexpr std::size_t channels_of_part = 3;  // a rotation vector
constexpr double mostly_own = 0.5;           // need
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

}  // namespace kinemend
