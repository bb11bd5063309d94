#include "kinemend/clip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_length(std::size_t actual, std::size_t expected, const char* what) {
  if (actual != expected) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: {} values, expected {}", what, actual, expected));
  }
}

double largest_turn_between(const Clip& clip, std::size_t first, std::size_t second) {
  double largest = 0;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    largest = std::max(largest, angle_between(clip.rotation(first, j), clip.rotation(second, j)));
  }
  return largest;
}

}  // namespace

void Clip::validate() const {
  skeleton.validate();
  if (!(std::isfinite(frame_rate_hz) && frame_rate_hz > 0)) {
    throw Error(ErrorKind::usage, fmt::format("frame rate {} Hz is not positive", frame_rate_hz));
  }
  const std::size_t frames = frame_count(), joints = joint_count();
  check_length(local_rotations.size(), frames * joints, "local rotations");
  check_length(joint_translations.size(), frames * translated_joints.size(), "joint translations");
  if (!observed.empty()) check_length(observed.size(), frames * joints, "observed mask");
  for (std::size_t i = 0; i < translated_joints.size(); ++i) {
    const bool ascending = i == 0 || translated_joints[i] > translated_joints[i - 1];
    if (translated_joints[i] < 1 || translated_joints[i] >= static_cast<std::int32_t>(joints) ||
        !ascending) {
      throw Error(ErrorKind::usage, "translated joints are not ascending joint numbers above 0");
    }
  }
  for (std::size_t f = 0; f < frames; ++f) {
    if (!finite(root_positions[f]))
      throw Error(ErrorKind::usage, fmt::format("frame {}: root position is not finite", f));
    for (std::size_t j = 0; j < joints; ++j) {
      if (!(std::fabs(norm(rotation(f, j)) - 1) <= 1e-6)) {
        throw Error(ErrorKind::usage,
                    fmt::format("frame {}, joint \"{}\": rotation is not a unit quaternion", f,
                                skeleton.names[j]));
      }
    }
  }
  if (!std::all_of(joint_translations.begin(), joint_translations.end(), finite)) {
    throw Error(ErrorKind::usage, "a joint translation is not finite");
  }
}

Clip slice(const Clip& clip, std::size_t first, std::size_t last) {
  const auto rows = [&](const auto& values, std::size_t width) {
    using Values = std::decay_t<decltype(values)>;
    if (values.empty()) return Values{};
    return Values(values.begin() + static_cast<std::ptrdiff_t>(first * width),
                  values.begin() + static_cast<std::ptrdiff_t>(last * width));
  };
  Clip part;
  part.skeleton = clip.skeleton;
  part.frame_rate_hz = clip.frame_rate_hz;
  part.root_positions = rows(clip.root_positions, 1);
  part.local_rotations = rows(clip.local_rotations, clip.joint_count());
  part.translated_joints = clip.translated_joints;
  part.joint_translations = rows(clip.joint_translations, clip.translated_joints.size());
  part.observed = rows(clip.observed, clip.joint_count());
  part.source.name = clip.source.name;
  return part;
}

std::size_t leading_calibration_frames(const Clip& clip) {
  constexpr std::size_t compared_frames = 240;
  constexpr double nearly_rest = 1.0 * radians_per_degree;
  constexpr double clear_jump = 5.0 * radians_per_degree;
  if (clip.frame_count() < 3) return 0;
  // The pose of a calibration frame is the rest pose: at most the root is turned.
  for (std::size_t j = 1; j < clip.joint_count(); ++j) {
    if (angle_between(clip.rotation(0, j), Quat{}) > nearly_rest) return 0;
  }
  const double jump = largest_turn_between(clip, 0, 1);
  double largest_step = 0;
  for (std::size_t f = 2; f < std::min(clip.frame_count(), compared_frames); ++f) {
    largest_step = std::max(largest_step, largest_turn_between(clip, f - 1, f));
  }
  return jump > clear_jump && jump > 1.5 * largest_step ? 1 : 0;
}

}  // namespace kinemend
