// Computes error figures of positions and their accelerations, and measures how far feet slide
// while they stand.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/metrics.hpp"
#include "metrics/compare.hpp"
#include "motion/rotation.hpp"

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

namespace {

double horizontal(Vec3 v, Axis up) {
  const double height = component(v, up);
  return std::sqrt(std::max(0.0, dot(v, v) - height * height));
}

double floor_height(const std::vector<Vec3>& track, Axis up) {
  std::vector<double> heights;
  heights.reserve(track.size());
  for (const Vec3 p : track) heights.push_back(component(p, up));
  return metrics::percentile_of(std::move(heights), 2);
}

std::vector<Vec3> track_of(const std::vector<Vec3>& positions, std::size_t joints,
                           std::size_t joint, std::size_t first_frame) {
  std::vector<Vec3> track;
  for (std::size_t i = first_frame * joints + joint; i < positions.size(); i += joints) {
    track.push_back(positions[i]);
  }
  return track;
}

}  // namespace

std::vector<std::size_t> foot_joints(const Skeleton& skeleton) {
  static constexpr std::array<std::string_view, 5> fragments{"foot", "ankle", "heel", "toe",
                                                             "ball"};
  std::vector<std::size_t> found;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const std::string name = lower_case(skeleton.names[j]);
    const auto in_name = [&](std::string_view fragment) {
      return name.find(fragment) != std::string::npos;
    };
    if (std::any_of(fragments.begin(), fragments.end(), in_name)) found.push_back(j);
  }
  return found;
}

FootSlide foot_slide(const Take& reference, const Take& other, const FootSlideSettings& settings,
                     std::size_t first_frame) {
  metrics::check_pair(reference, other, first_frame);
  const auto joints = settings.joints.empty() ? foot_joints(reference.skeleton) : settings.joints;
  for (const std::size_t j : joints) {
    if (j >= reference.joint_count()) {
      throw Error(ErrorKind::usage,
                  fmt::format("foot joint {} of {} joints", j, reference.joint_count()));
    }
  }
  const double height = body_height(reference.skeleton);
  const double largest_step =
      settings.contact_speed * height / std::max(reference.frame_rate_hz, 1e-9);
  const auto wanted = joint_positions(reference), found = joint_positions(other);
  FootSlide slide;
  for (const std::size_t j : joints) {
    const auto truth = track_of(wanted, reference.joint_count(), j, first_frame);
    const auto track = track_of(found, reference.joint_count(), j, first_frame);
    const double ceiling = floor_height(truth, settings.up) + settings.contact_height * height;
    for (std::size_t f = 1; f < truth.size(); ++f) {
      const bool low = component(truth[f - 1], settings.up) < ceiling &&
                       component(truth[f], settings.up) < ceiling;
      if (!low || norm(truth[f] - truth[f - 1]) >= largest_step) continue;
      slide.per_frame += horizontal(track[f] - track[f - 1], settings.up);
      ++slide.contact_steps;
    }
  }
  if (slide.contact_steps > 0) slide.per_frame /= static_cast<double>(slide.contact_steps);
  return slide;
}

}  // namespace kinemend
