// Designs Butterworth low-pass filters as second-order sections.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/portable.hpp"
#include "kinemend/experimental/signal.hpp"
#include "signal/checks.hpp"

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

}  // namespace kinemend
