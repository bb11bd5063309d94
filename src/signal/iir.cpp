// Runs recursive filters forward and backward over a matrix, or causally frame by frame.
#include <algorithm>

#include "kinemend/experimental/signal.hpp"
#include "signal/checks.hpp"
#include "signal/extension.hpp"
#include "signal/kernels.hpp"

namespace kinemend {

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

}  // namespace kinemend
