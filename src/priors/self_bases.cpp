#include "priors/self_bases.hpp"

#include <algorithm>
#include <cmath>

#include "priors/mssa.hpp"

namespace kinemend {

namespace {

constexpr double usual_rate_hz = 30;
constexpr double window_s = 20.0 / 30;
constexpr std::size_t most_window_values = 4096;
constexpr std::size_t most_bases = 150;
constexpr double fewest_windows = 15;    // that the take is long: patterns have to come back
constexpr double least_residual = 0.02;  // variance outside the bases, relative to the noise's

std::size_t hop_frames(double clip_rate_hz) {
  return std::max<std::size_t>(1,
                               static_cast<std::size_t>(std::lround(clip_rate_hz / usual_rate_hz)));
}

// Every `hop`-th frame from `phase` on, in units of each channel's noise.
PoseMatrix whitened(const PoseMatrix& poses, std::size_t phase, std::size_t hop,
                    std::span<const double> noise) {
  PoseMatrix part((poses.frames - phase + hop - 1) / hop, poses.channels);
  for (std::size_t f = 0; f < part.frames; ++f) {
    for (std::size_t c = 0; c < part.channels; ++c) {
      part(f, c) = poses(phase + f * hop, c) / noise[c];
    }
  }
  return part;
}

// Windows overlap, so that chance has fewer to average over than there are frames.
constexpr double overlap_penalty = 2;

// Variance of a pattern of which noise of variance 1 makes `seen`; 0 where noise alone would do.
double without_noise(double seen, double values_per_frame) {
  const double edge = std::pow(1 + std::sqrt(values_per_frame), 2);
  if (seen <= edge) return 0;
  const double b = seen + 1 - values_per_frame;
  return (b + std::sqrt(std::max(b * b - 4 * seen, 0.0))) / 2 - 1;
}

void keep_leading(FilterBases& bases, std::size_t count) {
  std::vector<double> kept;
  kept.reserve(bases.window_frames * bases.channels * count);
  for (std::size_t row = 0; row < bases.window_frames * bases.channels; ++row) {
    const auto from = bases.bases.begin() + static_cast<std::ptrdiff_t>(row * bases.count);
    kept.insert(kept.end(), from, from + static_cast<std::ptrdiff_t>(count));
  }
  for (std::size_t k = count; k < bases.count; ++k) {
    for (std::size_t row = 0; row < bases.window_frames * bases.channels; ++row) {
      const double entry = bases.bases[row * bases.count + k];
      bases.residual[row % bases.channels] +=
          entry * entry * bases.eigenvalues[k] / static_cast<double>(bases.window_frames);
    }
  }
  bases.bases = std::move(kept);
  bases.eigenvalues.resize(count);
  bases.count = count;
}

void to_degrees(FilterBases& bases, std::span<const double> noise, double noise_in_residual) {
  for (std::size_t row = 0; row < bases.window_frames * bases.channels; ++row) {
    for (std::size_t k = 0; k < bases.count; ++k) {
      bases.bases[row * bases.count + k] *= noise[row % bases.channels];
    }
  }
  for (std::size_t c = 0; c < bases.channels; ++c) {
    bases.mean[c] *= noise[c];
    bases.residual[c] =
        std::max(bases.residual[c] - noise_in_residual, least_residual) * noise[c] * noise[c];
  }
}

}  // namespace

double self_rate_hz(double clip_rate_hz) {
  return clip_rate_hz / static_cast<double>(hop_frames(clip_rate_hz));
}

ExamplePrior self_bases(const PoseMatrix& poses, double clip_rate_hz, std::span<const double> noise,
                        std::size_t clean) {
  ExamplePrior prior;
  prior.rate_hz = self_rate_hz(clip_rate_hz);
  const std::size_t hop = hop_frames(clip_rate_hz);
  const auto usual = static_cast<std::size_t>(std::max(2L, std::lround(window_s * prior.rate_hz)));
  const std::size_t window =
      std::min(usual, most_window_values / std::max<std::size_t>(poses.channels, 1));
  prior.bases.channels = poses.channels;
  const double frames = static_cast<double>(poses.frames) / static_cast<double>(hop);
  if (window < 2 || frames < fewest_windows * static_cast<double>(window)) return prior;

  LagCovariance covariance(window, poses.channels);
  for (std::size_t phase = 0; phase < hop; ++phase) {
    covariance.add(whitened(poses, phase, hop, noise), 1 / static_cast<double>(hop));
  }
  prior.bases = filter_bases(covariance, {.count = clean > 0 ? clean : most_bases});
  FilterBases& bases = prior.bases;
  std::size_t kept = bases.count;
  if (clean == 0) {
    const double values_per_frame =
        overlap_penalty * static_cast<double>(window * poses.channels) / frames;
    kept = 0;
    while (kept < bases.count && without_noise(bases.eigenvalues[kept], values_per_frame) > 0) {
      ++kept;
    }
    keep_leading(bases, kept);
    for (double& value : bases.eigenvalues) value = without_noise(value, values_per_frame);
  }
  to_degrees(bases, noise, clean == 0 ? 1 : 0);
  return prior;
}

}  // namespace kinemend
