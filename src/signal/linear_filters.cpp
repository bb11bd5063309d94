// Designs Butterworth low-pass filters, and runs recursive and symmetric FIR filters (the Gaussian
// and the weighted mean) over a matrix, forward and backward or causally.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/portable.hpp"
#include "kinemend/extend/signal.hpp"
#include "signal/extension.hpp"
#include "signal/kernels.hpp"

namespace kinemend {

using signal::require;

std::vector<Biquad> butterworth_lowpass(int order, double cutoff_hz, double rate_hz) {
  require(order >= 1 && order <= 12, fmt::format("Butterworth order {} is outside 1 to 12", order));
  require(std::isfinite(rate_hz) && rate_hz > 0,
          fmt::format("a rate of {} Hz makes no sense", rate_hz));
  require(cutoff_hz > 0 && cutoff_hz < rate_hz / 2,
          fmt::format("cutoff {} Hz is not between 0 and half of the rate of {} Hz", cutoff_hz,
                      rate_hz));

  // The analog poles lie on a half circle of radius w; z = (2 + s) / (2 - s) maps them into the
  // unit circle, with w prewarped for the bilinear transform.
  const double w = 2 * portable::tan(std::numbers::pi * cutoff_hz / rate_hz);
  std::vector<Biquad> sections;
  if (order % 2 == 1) {
    const double pole = (2 - w) / (2 + w);
    const double gain = w / (2 + w);
    sections.push_back({gain, gain, 0, -pole, 0});
  }
  for (int k = order / 2 - 1; k >= 0; --k) {  // pairs of poles, the most damped first
    const double real = -w * portable::sin(std::numbers::pi * (2 * k + 1) / (2.0 * order));
    const double a0 = 4 - 4 * real + w * w;
    const double gain = w * w / a0;
    sections.push_back({gain, 2 * gain, gain, (2 * w * w - 8) / a0, (4 + 4 * real + w * w) / a0});
  }
  return sections;
}

std::size_t default_pad_frames(const std::vector<Biquad>& sections, std::size_t frames) {
  if (frames == 0) return 0;
  std::size_t no_b2 = 0;
  std::size_t no_a2 = 0;
  for (const Biquad& q : sections) {
    no_b2 += q.b2 == 0;
    no_a2 += q.a2 == 0;
  }
  const std::size_t taps = 2 * sections.size() + 1 - std::min(no_b2, no_a2);
  return std::min(3 * taps, frames - 1);
}

std::size_t settling_frames(const std::vector<Biquad>& sections, double tolerance) {
  require(tolerance > 0 && tolerance < 1,
          // The largest number of frames. Chosen by hand, not swept.
          fmt::format("settling tolerance {} is not between 0 and 1", tolerance));
  constexpr double longest = 1e6;
  double radius = 0;
  for (const Biquad& q : sections) {
    const double discriminant = q.a1 * q.a1 - 4 * q.a2;
    radius = std::max(radius, discriminant < 0 ? std::sqrt(q.a2)
                                               : (std::abs(q.a1) + std::sqrt(discriminant)) / 2);
  }
  if (radius >= 1) return static_cast<std::size_t>(longest);
  if (radius == 0) return 2 * sections.size();
  const double decay = std::ceil(portable::log(tolerance) / portable::log(radius));
  return static_cast<std::size_t>(
      std::min(longest, decay + 2.0 * static_cast<double>(sections.size())));
}

namespace {

// The longest padding of a take that is shorter than its padding. It bounds the cost by the frames
// of a take, whatever rate its file states. A cutoff of 6 Hz settles within it at any rate up to
// 1.1 kHz.
constexpr std::size_t most_repeated_frames = 1024;

// The steady state of a filter for the constant input `row`.
void start_at_rest(std::span<const Biquad> sections, const double* row, std::size_t channels,
                   std::vector<double>& memory) {
  memory.resize(2 * sections.size() * channels);
  double gain_before = 1;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    const Biquad& q = sections[s];
    const double gain = (q.b0 + q.b1 + q.b2) / (1 + q.a1 + q.a2);
    const double first = (gain - q.b0) * gain_before;
    const double second = (q.b2 - q.a2 * gain) * gain_before;
    double* state = memory.data() + 2 * s * channels;
    for (std::size_t c = 0; c < channels; ++c) {
      state[c] = first * row[c];
      state[channels + c] = second * row[c];
    }
    gain_before *= gain;
  }
}

std::vector<double> reflected_rows(const PoseMatrix& matrix, std::ptrdiff_t first,
                                   std::size_t count) {
  std::vector<double> rows(count * matrix.channels);
  for (std::size_t k = 0; k < count; ++k) {
    signal::point_reflected_row(matrix, first + static_cast<std::ptrdiff_t>(k),
                                &rows[k * matrix.channels]);
  }
  return rows;
}

}  // namespace

void filter_zero_phase(PoseMatrix& matrix, const std::vector<Biquad>& sections) {
  filter_zero_phase(matrix, sections, default_pad_frames(sections, matrix.frames));
}

void filter_zero_phase(PoseMatrix& matrix, const std::vector<Biquad>& sections,
                       std::size_t pad_frames) {
  if (matrix.frames == 0 || matrix.channels == 0 || sections.empty()) return;
  const std::size_t channels = matrix.channels;
  const std::size_t pad =
      matrix.frames > 1 ? std::min(pad_frames, std::max(matrix.frames - 1, most_repeated_frames))
                        : 0;
  const auto stride = static_cast<std::ptrdiff_t>(channels);
  std::vector<double> head = reflected_rows(matrix, -static_cast<std::ptrdiff_t>(pad), pad);
  std::vector<double> tail =
      reflected_rows(matrix, static_cast<std::ptrdiff_t>(matrix.frames), pad);
  double* values = matrix.values.data();
  double* last_row = values + (matrix.frames - 1) * channels;

  std::vector<double> memory;
  start_at_rest(sections, pad > 0 ? head.data() : values, channels, memory);
  signal::filter_rows({head.data(), stride, pad, channels}, sections, memory.data());
  signal::filter_rows({values, stride, matrix.frames, channels}, sections, memory.data());
  signal::filter_rows({tail.data(), stride, pad, channels}, sections, memory.data());

  double* last_tail_row = pad > 0 ? tail.data() + (pad - 1) * channels : last_row;
  start_at_rest(sections, last_tail_row, channels, memory);
  signal::filter_rows({last_tail_row, -stride, pad, channels}, sections, memory.data());
  signal::filter_rows({last_row, -stride, matrix.frames, channels}, sections, memory.data());
}

void CausalState::step(std::span<double> frame) {
  if (!started_) {
    channels_ = frame.size();
    start_at_rest(sections_, frame.data(), channels_, memory_);
    started_ = true;
  }
  // Only a frame of the wrong size may cost an allocation, for the message.
  if (frame.size() != channels_)
    throw Error(ErrorKind::usage, "a frame with another number of channels than the first");
  signal::filter_rows({frame.data(), static_cast<std::ptrdiff_t>(channels_), 1, channels_},
                      sections_, memory_.data());
}

namespace {

void symmetric_fir(PoseMatrix& matrix, const std::vector<double>& half_weights) {
  signal::for_each_chunk(matrix, half_weights.size() - 1,
                         [&](const double* centre, std::size_t first, std::size_t count) {
                           signal::symmetric_fir_rows(centre, count, matrix.channels, half_weights,
                                                      &matrix.values[first * matrix.channels]);
                         });
}

// By definition: Smooth Keys of Blender.
constexpr double mean_weights[] = {2.0 / 12, 3.0 / 12, 2.0 / 12};  // at distance 0, 1 and 2

// The frames next to the ends as in Blender. The second neighbour before frame 2 is frame 0, but
// Blender's test for it (index - 2 > 0) leaves it out.
struct BlenderEnds {
  std::vector<std::pair<std::size_t, std::vector<double>>> rows;

  explicit BlenderEnds(const PoseMatrix& matrix) {
    const std::size_t last = matrix.frames - 1;
    std::array<std::size_t, 5> wanted = {0, 1, 2, last - 1, last};
    std::sort(wanted.begin(), wanted.end());
    const auto end = std::unique(wanted.begin(), wanted.end());
    for (auto frame = wanted.begin(); frame != end; ++frame)
      rows.emplace_back(*frame, row(matrix, *frame));
  }

  static std::vector<double> row(const PoseMatrix& matrix, std::size_t t) {
    const std::size_t last = matrix.frames - 1;
    std::vector<double> result(matrix.row(t).begin(), matrix.row(t).end());
    if (t == 0 || t == last) return result;
    const std::size_t second_before = t > 2 ? t - 2 : t - 1;
    const std::size_t second_behind = t + 2 <= last ? t + 2 : t + 1;
    for (std::size_t c = 0; c < matrix.channels; ++c) {
      result[c] = mean_weights[0] * matrix(t, c) +
                  mean_weights[1] * (matrix(t - 1, c) + matrix(t + 1, c)) +
                  mean_weights[2] * (matrix(second_before, c) + matrix(second_behind, c));
    }
    return result;
  }

  void put_into(PoseMatrix& matrix) const {
    for (const auto& [frame, values] : rows) {
      std::copy(values.begin(), values.end(), matrix.row(frame).begin());
    }
  }
};

}  // namespace

void gaussian_filter(PoseMatrix& matrix, double sigma_frames) {
  signal::require(
      sigma_frames >= 0 && sigma_frames <= 1e5,
      fmt::format("a Gaussian width of {} frames is outside 0 to 100000", sigma_frames));
  const auto radius = static_cast<std::size_t>(std::lround(4 * sigma_frames));
  if (radius == 0) return;
  std::vector<double> weights(radius + 1);
  double sum = 0;
  for (std::size_t k = radius + 1; k-- > 0;) {
    const double z = static_cast<double>(k) / sigma_frames;
    weights[k] = portable::exp(-0.5 * z * z);
    sum += k == 0 ? weights[k] : 2 * weights[k];
  }
  for (double& weight : weights) weight /= sum;
  symmetric_fir(matrix, weights);
}

void weighted_mean_filter(PoseMatrix& matrix, int passes, WeightedMeanEnds ends) {
  signal::require(passes >= 0, fmt::format("{} passes make no sense", passes));
  if (matrix.frames < 3 || matrix.channels == 0) return;
  const std::vector<double> weights(std::begin(mean_weights), std::end(mean_weights));
  for (int pass = 0; pass < passes; ++pass) {
    if (ends == WeightedMeanEnds::blender) {
      const BlenderEnds end_rows(matrix);
      symmetric_fir(matrix, weights);
      end_rows.put_into(matrix);
    } else {
      symmetric_fir(matrix, weights);
    }
  }
}

}  // namespace kinemend
