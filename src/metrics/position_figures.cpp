// Error figures of positions and their accelerations.
#include <fmt/format.h>

#include <cmath>

#include "kinemend/error.hpp"
#include "kinemend/experimental/kinematics.hpp"
#include "kinemend/metrics.hpp"
#include "metrics/pairing.hpp"

namespace kinemend {

namespace {

// Returns the joint positions from `first_frame` on.
std::vector<Vec3> positions_from(const Take& clip, std::size_t first_frame) {
  std::vector<Vec3> positions = joint_positions(clip);
  positions.erase(positions.begin(), positions.begin() + static_cast<std::ptrdiff_t>(
                                                             first_frame * clip.joint_count()));
  return positions;
}

MeanAndDeviation mean_and_deviation(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  MeanAndDeviation result;
  for (const double value : values) result.mean += value / count;
  for (const double value : values) {
    result.deviation += (value - result.mean) * (value - result.mean) / count;
  }
  result.deviation = std::sqrt(result.deviation);
  return result;
}

}  // namespace

double mpjpe(const Take& reference, const Take& other, std::size_t first_frame, double scale) {
  metrics::check_pair(reference, other, first_frame);
  const auto wanted = positions_from(reference, first_frame);
  const auto found = positions_from(other, first_frame);
  double sum = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) sum += norm(found[i] - wanted[i]);
  return scale * sum / static_cast<double>(wanted.size());
}

double accel_error(const Take& reference, const Take& other, std::size_t first_frame) {
  metrics::check_pair(reference, other, first_frame);
  if (reference.frame_count() - first_frame < 3) return 0;
  std::vector<Vec3> difference = positions_from(other, first_frame);
  const auto wanted = positions_from(reference, first_frame);
  for (std::size_t i = 0; i < wanted.size(); ++i) difference[i] = difference[i] - wanted[i];
  const std::size_t joints = reference.joint_count();
  const std::size_t inner = difference.size() - 2 * joints;
  double sum = 0;
  for (std::size_t i = 0; i < inner; ++i) {
    sum += norm(difference[i] - 2.0 * difference[i + joints] + difference[i + 2 * joints]);
  }
  return sum / static_cast<double>(inner) * reference.frame_rate_hz * reference.frame_rate_hz;
}

MeanAndDeviation rmse_per_marker(std::span<const Vec3> reference, std::span<const Vec3> other,
                                 std::size_t markers, std::span<const std::uint8_t> noisy) {
  if (reference.size() != other.size() || (!noisy.empty() && noisy.size() != reference.size())) {
    throw Error(ErrorKind::usage, fmt::format("marker arrays differ in length: {}, {} and {}",
                                              reference.size(), other.size(), noisy.size()));
  }
  if (markers == 0 || reference.size() % markers != 0) {
    throw Error(ErrorKind::usage, fmt::format("{} positions are no whole frames of {} markers",
                                              reference.size(), markers));
  }
  std::vector<double> figures;
  for (std::size_t start = 0; start < reference.size(); start += markers) {
    double sum = 0;
    std::size_t counted = 0;
    for (std::size_t i = start; i < start + markers; ++i) {
      const Vec3 d = other[i] - reference[i];
      sum += dot(d, d);
      if (noisy.empty() || noisy[i]) ++counted;
    }
    if (counted > 0) figures.push_back(std::sqrt(sum / static_cast<double>(counted)));
  }
  return mean_and_deviation(figures);
}

MeanAndDeviation rmse_per_marker_m(const Take& reference, const Take& other, double metres_per_unit,
                                   std::size_t first_frame) {
  metrics::check_pair(reference, other, first_frame);
  const auto figure = rmse_per_marker(positions_from(reference, first_frame),
                                      positions_from(other, first_frame), reference.joint_count());
  return {figure.mean * metres_per_unit, figure.deviation * metres_per_unit};
}

}  // namespace kinemend
