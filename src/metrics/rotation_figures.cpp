// Error figures of rotations, and peak speeds of joints.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/portable.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "metrics/compare.hpp"

namespace kinemend {

namespace {

using Angles = std::array<double, 3>;

// Channels that turn less over a take are constant except for rounding. Chosen by hand, not swept.
constexpr double moving_range = 0.001 * radians_per_degree;

bool counts_in_rms(const Skeleton& skeleton, std::size_t joint) {
  return skeleton.parents[joint] >= 0 && skeleton.rotation_order(joint).count > 0;
}

// Adds the squared differences of one joint's moving channels to `sums` frame by frame; each uses
// the other clip's nearest equivalent angles. Returns the channels.
std::size_t add_channel_errors(const Take& reference, const Take& other, std::size_t joint,
                               std::size_t first_frame, std::vector<double>& sums) {
  const RotationOrder order = reference.skeleton.rotation_order(joint);
  const std::size_t frames = sums.size();
  std::vector<Angles> wanted(frames);
  Angles previous{}, least, most;
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < frames; ++f) {
    previous = to_euler_near(reference.rotation(first_frame + f, joint), order, previous);
    wanted[f] = previous;
    for (std::size_t c = 0; c < order.count; ++c) {
      least[c] = std::min(least[c], previous[c]);
      most[c] = std::max(most[c], previous[c]);
    }
  }
  std::array<bool, 3> moves{};
  for (std::size_t c = 0; c < order.count; ++c) moves[c] = most[c] - least[c] > moving_range;
  const auto channels = static_cast<std::size_t>(std::count(moves.begin(), moves.end(), true));
  if (channels == 0) return 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const Angles found = to_euler_near(other.rotation(first_frame + f, joint), order, wanted[f]);
    for (std::size_t c = 0; c < order.count; ++c) {
      if (!moves[c]) continue;
      const double difference = degrees_per_radian * (found[c] - wanted[f][c]);
      sums[f] += difference * difference;
    }
  }
  return channels;
}

double mean_of(const std::vector<double>& values) {
  return values.empty() ? 0.0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

double sum_of_squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

}  // namespace

std::vector<double> rms_deg_per_frame(const Take& reference, const Take& other,
                                      std::size_t first_frame) {
  metrics::check_pair(reference, other, first_frame);
  std::vector<double> figures(reference.frame_count() - first_frame, 0.0);
  std::size_t channels = 0;
  for (std::size_t j = 0; j < reference.joint_count(); ++j) {
    if (counts_in_rms(reference.skeleton, j)) {
      channels += add_channel_errors(reference, other, j, first_frame, figures);
    }
  }
  if (channels == 0) return figures;
  for (double& figure : figures) figure = std::sqrt(figure / static_cast<double>(channels));
  return figures;
}

double rms_deg(const Take& reference, const Take& other, std::size_t first_frame) {
  return mean_of(rms_deg_per_frame(reference, other, first_frame));
}

double geodesic_rms_deg(const Take& reference, const Take& other, std::size_t first_frame) {
  metrics::check_pair(reference, other, first_frame);
  const auto angles = metrics::geodesic_angles(reference, other, first_frame);
  if (angles.empty()) return 0;
  return degrees_per_radian *
         std::sqrt(sum_of_squares(angles) / static_cast<double>(angles.size()));
}

std::vector<double> geodesic_rms_deg_per_joint(const Take& reference, const Take& other,
                                               std::size_t first_frame) {
  metrics::check_pair(reference, other, first_frame);
  const auto angles = metrics::geodesic_angles(reference, other, first_frame);
  const std::size_t joints = reference.joint_count();
  std::vector<double> figures(joints, 0.0);
  for (std::size_t i = 0; i < angles.size(); ++i) figures[i % joints] += angles[i] * angles[i];
  const auto frames = static_cast<double>(reference.frame_count() - first_frame);
  for (double& figure : figures) figure = degrees_per_radian * std::sqrt(figure / frames);
  return figures;
}

double geodesic_percentile_deg(const Take& reference, const Take& other, double percentile,
                               std::size_t first_frame) {
  metrics::check_pair(reference, other, first_frame);
  if (!(percentile >= 0 && percentile <= 100)) {
    throw Error(ErrorKind::usage, fmt::format("percentile {} is outside 0 to 100", percentile));
  }
  return degrees_per_radian *
         metrics::percentile_of(metrics::geodesic_angles(reference, other, first_frame),
                                percentile);
}

double psnr_db(const Take& reference, const Take& other, std::size_t first_frame, double peak) {
  metrics::check_pair(reference, other, first_frame);
  if (!(peak > 0)) {
    throw Error(ErrorKind::usage, fmt::format("PSNR peak {} is not positive", peak));
  }
  const auto angles = metrics::geodesic_angles(reference, other, first_frame);
  // The logarithm of the quaternion is half the rotation vector and has three channels.
  const double mean_square = sum_of_squares(angles) / 4 / (3 * static_cast<double>(angles.size()));
  // NaN is kept: a clip with such values is not the same as the reference.
  return mean_square == 0 ? std::numeric_limits<double>::infinity()
                          : 10 * portable::log10(peak * peak / mean_square);
}

double mse_rad2(std::span<const Quat> reference, std::span<const Quat> other) {
  if (reference.size() != other.size()) {
    throw Error(ErrorKind::usage,
                fmt::format("signals differ in length: {} and {}", reference.size(), other.size()));
  }
  double sum = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double angle = angle_between(reference[i], other[i]);
    sum += angle * angle;
  }
  return reference.size() > 1 ? sum / static_cast<double>(reference.size() - 1) : sum;
}

double mse_rad2(const Take& reference, const Take& other, std::size_t first_frame) {
  metrics::check_pair(reference, other, first_frame);
  const std::size_t frames = reference.frame_count() - first_frame;
  const double terms = static_cast<double>(std::max<std::size_t>(frames - 1, 1)) *
                       static_cast<double>(reference.joint_count());
  return sum_of_squares(metrics::geodesic_angles(reference, other, first_frame)) / terms;
}

std::vector<double> peak_angular_speed_deg_s(const Take& clip, std::size_t first_frame) {
  std::vector<double> peaks(clip.joint_count(), 0.0);
  for (std::size_t f = first_frame + 1; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      peaks[j] = std::max(peaks[j], angle_between(clip.rotation(f - 1, j), clip.rotation(f, j)));
    }
  }
  for (double& peak : peaks) peak *= degrees_per_radian * clip.frame_rate_hz;
  return peaks;
}

}  // namespace kinemend
