// Smooths the reference of a chart by a Gaussian mean and sums up its path.
#include "methods/auto/smooth_chart.hpp"

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "kinemend/experimental/frame_rate.hpp"

namespace kinemend {

namespace {

std::vector<Quat> smooth_reference(std::vector<Quat> track, double width_frames) {
  align_hemispheres(track);
  const std::size_t frames = track.size();
  const auto reach = static_cast<std::size_t>(std::ceil(2.5 * width_frames));
  std::vector<double> weights(reach + 1);
  for (std::size_t k = 0; k <= reach; ++k) {
    const double z = static_cast<double>(k) / width_frames;
    weights[k] = portable::exp(-0.5 * z * z);
  }
  std::vector<Quat> reference(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    Quat sum = track[t];
    // Both sides extend as far as the shorter one: an asymmetric mean would lag behind a turn at
    // the ends.
    for (std::size_t k = 1; k <= std::min({reach, t, frames - 1 - t}); ++k) {
      sum = sum + weights[k] * (track[t - k] + track[t + k]);
    }
    reference[t] = norm(sum) > 1e-3 ? normalized(sum) : track[t];
  }
  return reference;
}

}  // namespace

RotationChart smooth_chart(std::span<const Quat> track, double frame_rate_hz,
                           const ChartTuning& tuning) {
  RotationChart chart;
  chart.reference = smooth_reference({track.begin(), track.end()},
                                     tuning.width_s * window_rate_hz(frame_rate_hz));
  chart.path.resize(track.size());
  for (std::size_t t = 1; t < track.size(); ++t) {
    chart.path[t] = chart.path[t - 1] + log(conjugate(chart.reference[t - 1]) * chart.reference[t]);
  }
  return chart;
}

}  // namespace kinemend
