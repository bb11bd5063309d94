// Checks that two takes have the same joints and frames, and measures their angles.
#include "metrics/pairing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/quantiles.hpp"
#include "kinemend/error.hpp"

namespace kinemend::metrics {

void check_pair(const Take& reference, const Take& other, std::size_t first_frame) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorKind::usage, message); };
  if (reference.joint_count() != other.joint_count()) {
    refuse(fmt::format("the clips differ in joints: {} and {}", reference.joint_count(),
                       other.joint_count()));
  }
  for (std::size_t j = 0; j < reference.joint_count(); ++j) {
    if (reference.skeleton.names[j] != other.skeleton.names[j]) {
      refuse(fmt::format("the clips differ in joints: joint {} is \"{}\" and \"{}\"", j,
                         reference.skeleton.names[j], other.skeleton.names[j]));
    }
  }
  if (reference.frame_count() != other.frame_count()) {
    refuse(fmt::format("the clips differ in frames: {} and {}", reference.frame_count(),
                       other.frame_count()));
  }
  if (first_frame >= reference.frame_count()) {
    refuse(fmt::format("no frames to compare: {} frames, starting at frame {}",
                       reference.frame_count(), first_frame));
  }
}

std::vector<double> geodesic_angles(const Take& reference, const Take& other,
                                    std::size_t first_frame) {
  std::vector<double> angles;
  const std::size_t first = first_frame * reference.joint_count();
  angles.reserve(reference.rotations.size() - first);
  for (std::size_t i = first; i < reference.rotations.size(); ++i) {
    angles.push_back(angle_between(reference.rotations[i], other.rotations[i]));
  }
  return angles;
}

double percentile_of(std::vector<double> values, double percentile) {
  if (values.empty()) return 0;
  const double position = percentile / 100 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double low = of_rank(values, below);
  const auto above = values.begin() + static_cast<std::ptrdiff_t>(below) + 1;
  if (above == values.end()) return low;
  const double high = *std::min_element(above, values.end());
  return low + (position - static_cast<double>(below)) * (high - low);
}

}  // namespace kinemend::metrics
