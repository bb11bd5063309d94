// Gaussian means of a take's channels over a range of widths, which the learned cleaner mixes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace kinemend {

/// The channel itself, and its means over Gaussians of these deviations, seconds: each band between
/// two of them is half an octave. Chosen by hand; the network has learned with them.
inline constexpr std::array<double, 10> bank_widths_s{0.0125, 0.0177, 0.025,  0.0354, 0.05,
                                                      0.0708, 0.1,    0.1415, 0.2,    0.283};
inline constexpr std::size_t bank_levels = bank_widths_s.size() + 1;

/// F frames x C channels with `reach` more on either side, where each channel continues as its
/// point reflection about the end of a line fitted to its outermost tenth of a second. Straight
/// lines thus continue, and noise of the last sample does not shift the continuation.
struct ExtendedChannels {
  std::size_t frames = 0, channels = 0, reach = 0;
  std::vector<float> values;  ///< (F + 2 reach) x C

  /// Frame `frame`, from -reach to F + reach - 1.
  const float* row(std::ptrdiff_t frame) const {
    return values.data() +
           (frame + static_cast<std::ptrdiff_t>(reach)) * static_cast<std::ptrdiff_t>(channels);
  }
};

/// The kernels at one frame rate, cut at 3.3 deviations and normalised to sum 1.
class SmootherBank {
 public:
  explicit SmootherBank(double frame_rate_hz);

  std::size_t reach() const noexcept { return reach_; }
  /// `values`: F x C, at least one frame.
  ExtendedChannels extended(std::span<const float> values, std::size_t channels) const;
  /// Continues channels beyond their end: writes `rows` rows, `row` numbers apart, after the one at
  /// `end`, which is the last of `frames`.
  void extend(float* end, std::ptrdiff_t row, std::size_t channels, std::size_t frames,
              std::size_t rows) const;
  /// Level 0 to `bank_levels` - 1 of frames [first, first + count), which may exceed the ends by
  /// `input.reach` less `reach()`: count x C.
  void level(const ExtendedChannels& input, std::size_t level, std::ptrdiff_t first,
             std::size_t count, std::span<float> result) const;

 private:
  double frame_rate_hz_;
  std::size_t reach_ = 0;
  std::vector<std::vector<float>> taps_;  // of each level, from the middle outwards
};

}  // namespace kinemend
