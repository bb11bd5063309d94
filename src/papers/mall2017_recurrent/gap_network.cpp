// Runs the network at its own rate and makes its additions meet the ends of each gap.
#include "papers/mall2017_recurrent/gap_network.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "kinemend/experimental/signal.hpp"

namespace kinemend {

namespace {

// Axes of a rotation vector; time constant of the correction that makes a filled gap meet its ends.
// Chosen by hand, not swept.
constexpr std::size_t gap_axes = 3;
constexpr double joining_s = 0.1;

std::vector<std::uint8_t> missing_of(const BodyChannels& channels) {
  std::vector<std::uint8_t> missing(channels.observed.size());
  for (std::size_t i = 0; i < missing.size(); ++i) missing[i] = channels.observed[i] == 0 ? 1 : 0;
  return missing;
}

// Resamples the take linearly to frames that are `step` frames apart.
FilterTake at_rate(const FilterTake& take, double step) {
  FilterTake result;
  result.channels = take.channels;
  const auto last = static_cast<double>(take.frames - 1);
  result.frames = static_cast<std::size_t>(std::floor(last / step + 1e-9)) + 1;
  const std::size_t tracks = take.channels / gap_axes;
  for (std::size_t f = 0; f < result.frames; ++f) {
    const double place = static_cast<double>(f) * step;
    const auto before = std::min(static_cast<std::size_t>(place), take.frames - 1);
    const std::size_t after = std::min(before + 1, take.frames - 1);
    const auto share = static_cast<float>(place - static_cast<double>(before));
    const auto mix = [&](const std::vector<float>& from, std::size_t width, std::size_t i) {
      const float start = from[before * width + i];
      return start + share * (from[after * width + i] - start);
    };
    for (std::size_t c = 0; c < take.channels; ++c)
      result.values.push_back(mix(take.values, take.channels, c));
    for (std::size_t a = 0; a < gap_axes; ++a)
      result.turning.push_back(mix(take.turning, gap_axes, a));
    const std::size_t nearest = share < 0.5F ? before : after;
    for (std::size_t n = 0; n < tracks; ++n)
      result.missing.push_back(take.missing[nearest * tracks + n]);
  }
  return result;
}

// The network's additions to the take, F x C, at the take's rate.
std::vector<double> additions(const FilterNetwork& network, const FilterTake& take,
                              double rate_hz) {
  const double step = rate_hz / network.rate_hz;
  const FilterTake seen = at_rate(take, step);
  const std::vector<float> made = filtered(network, seen);
  std::vector<double> result(take.values.size());
  for (std::size_t f = 0; f < take.frames; ++f) {
    const double place = static_cast<double>(f) / step;
    const auto before = std::min(static_cast<std::size_t>(place + 1e-9), seen.frames - 1);
    const std::size_t after = std::min(before + 1, seen.frames - 1);
    const double share = std::clamp(place - static_cast<double>(before), 0.0, 1.0);
    for (std::size_t c = 0; c < take.channels; ++c) {
      const auto at = [&](std::size_t g) {
        return static_cast<double>(made[g * take.channels + c] -
                                   seen.values[g * take.channels + c]);
      };
      result[f * take.channels + c] = at(before) + share * (at(after) - at(before));
    }
  }
  return result;
}

// Adds the additions to one channel in a gap, frames [first, last).
void fill_span(const std::vector<double>& added, std::size_t channels, std::size_t c,
               std::size_t first, std::size_t last, double joining_frames, PoseMatrix& poses) {
  const bool has_start = first > 0, has_end = last < poses.frames;
  const double at_start = has_start ? added[first * channels + c] : 0;
  const double at_end = has_end ? added[(last - 1) * channels + c] : 0;
  for (std::size_t f = first; f < last; ++f) {
    const double from_start = portable::exp(-static_cast<double>(f - first) / joining_frames);
    const double from_end = portable::exp(-static_cast<double>(last - 1 - f) / joining_frames);
    poses(f, gap_axes + c) += added[f * channels + c] - from_start * at_start - from_end * at_end;
  }
}

}  // namespace

PoseMatrix filled_by_network(const FilterNetwork& network, const BodyLayout& layout,
                             const BodyChannels& channels) {
  BodyChannels bridged = channels;
  fill_linear(bridged.poses, missing_of(channels));
  PoseMatrix result = bridged.poses;
  if (result.frames < 2) return result;
  const FilterTake take = filter_take_of(bridged, layout);
  const std::vector<double> added = additions(network, take, channels.frame_rate_hz);
  const std::size_t tracks = take.channels / gap_axes;
  for (std::size_t n = 0; n < tracks; ++n) {
    const auto is_missing = [&](std::size_t f) { return take.missing[f * tracks + n] != 0; };
    for (std::size_t f = 0; f < take.frames; ++f) {
      if (!is_missing(f)) continue;
      std::size_t last = f;
      while (last < take.frames && is_missing(last)) ++last;
      if (last - f == take.frames) break;  // a joint that the take lacks
      for (std::size_t axis = 0; axis < gap_axes; ++axis)
        fill_span(added, take.channels, gap_axes * n + axis, f, last,
                  joining_s * channels.frame_rate_hz, result);
      f = last;
    }
  }
  return result;
}

}  // namespace kinemend
