// Builds the kernels at a frame rate, extends channels beyond their ends, and smooths them.
#include "methods/learned/smoother_bank.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/portable.hpp"
#include "methods/learned/smoother_kernel.hpp"

namespace kinemend {

namespace {

// Deviations at which a Gaussian ends, 0.4 % of its peak; length of the line fit at an end. Chosen
// by hand; the network has learned with them.
constexpr double cut_deviations = 3.3;
constexpr double line_s = 0.1;

std::vector<float> taps_of(double sigma_frames) {
  const auto reach = static_cast<std::size_t>(std::ceil(cut_deviations * sigma_frames));
  std::vector<double> taps(reach + 1);
  double sum = 0;
  for (std::size_t k = 0; k <= reach; ++k) {
    const double z = static_cast<double>(k) / sigma_frames;
    taps[k] = portable::exp(-0.5 * z * z);
    sum += k == 0 ? taps[k] : 2 * taps[k];
  }
  for (double& tap : taps) tap /= sum;
  return {taps.begin(), taps.end()};
}

// The value at the first of `count` samples of a line fitted to them.
double fitted_end(const float* first, std::ptrdiff_t stride, std::size_t count) {
  double sum = 0, moment = 0;
  const double middle = (static_cast<double>(count) - 1) / 2;
  double spread = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) - middle;
    const double y = first[static_cast<std::ptrdiff_t>(i) * stride];
    sum += y;
    moment += x * y;
    spread += x * x;
  }
  const double slope = spread > 0 ? moment / spread : 0;
  return sum / static_cast<double>(count) - slope * middle;
}

}  // namespace

SmootherBank::SmootherBank(double frame_rate_hz) : frame_rate_hz_(frame_rate_hz) {
  taps_.push_back({1.0F});
  for (const double width : bank_widths_s) taps_.push_back(taps_of(width * frame_rate_hz));
  reach_ = taps_.back().size() - 1;
}

ExtendedChannels SmootherBank::extended(std::span<const float> values, std::size_t channels) const {
  ExtendedChannels result;
  result.channels = channels;
  result.frames = values.size() / channels;
  // Steps pool energies over a few frames beyond the ends.
  result.reach = reach_ + static_cast<std::size_t>(std::ceil(frame_rate_hz_ / 10)) + 2;
  result.values.resize((result.frames + 2 * result.reach) * channels);
  float* const first = result.values.data() + result.reach * channels;
  float* const last = first + (result.frames - 1) * channels;
  std::copy(values.begin(), values.end(), first);
  const auto width = static_cast<std::ptrdiff_t>(channels);
  extend(first, -width, channels, result.frames, result.reach);
  extend(last, width, channels, result.frames, result.reach);
  return result;
}

void SmootherBank::extend(float* end, std::ptrdiff_t row, std::size_t channels, std::size_t frames,
                          std::size_t rows) const {
  const std::size_t fit = std::clamp<std::size_t>(static_cast<std::size_t>(line_s * frame_rate_hz_),
                                                  std::min<std::size_t>(3, frames), frames);
  for (std::size_t c = 0; c < channels; ++c) {
    float* const own = end + c;
    const double twice = 2 * fitted_end(own, -row, fit);
    for (std::size_t k = 1; k <= rows; ++k) {
      const auto from = static_cast<std::ptrdiff_t>(std::min(k, frames - 1));
      own[static_cast<std::ptrdiff_t>(k) * row] =
          static_cast<float>(twice - static_cast<double>(own[-from * row]));
    }
  }
}

void SmootherBank::level(const ExtendedChannels& input, std::size_t level, std::ptrdiff_t first,
                         std::size_t count, std::span<float> result) const {
  const std::vector<float>& taps = taps_[level];
  const std::size_t width = input.channels;
  assert(result.size() == count * width);
  for (std::size_t i = 0; i < count; ++i)
    sum_rows(input.row(first + static_cast<std::ptrdiff_t>(i)), width, taps,
             result.data() + i * width);
}

}  // namespace kinemend
