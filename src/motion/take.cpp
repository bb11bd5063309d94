// The rules of a take, slices of its frames, and its markers by name.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "kinemend/take.hpp"
#include "motion/take_checks.hpp"

namespace kinemend {

namespace {

template <class T>
std::vector<T> rows(const std::vector<T>& values, std::size_t first, std::size_t last,
                    std::size_t width) {
  if (values.empty()) return {};
  return {values.begin() + static_cast<std::ptrdiff_t>(first * width),
          values.begin() + static_cast<std::ptrdiff_t>(last * width)};
}

void check_mask(const std::vector<std::uint8_t>& mask, std::size_t samples, const char* what) {
  if (!mask.empty()) check_length(mask.size(), samples, what);
}

void check_translated_joints(const Take& take) {
  const auto& translated = take.translated_joints;
  for (std::size_t i = 0; i < translated.size(); ++i) {
    const bool ascending = i == 0 || translated[i] > translated[i - 1];
    const bool is_joint =
        translated[i] >= 1 && translated[i] < static_cast<std::int32_t>(take.joint_count());
    if (!is_joint || !ascending) {
      throw Error(ErrorKind::usage, "translated joints are not ascending joint numbers above 0");
    }
  }
}

void check_joint_samples(const Take& take, std::size_t frame) {
  if (!is_finite(take.root_position(frame)))
    throw Error(ErrorKind::usage, fmt::format("frame {}: root position is not finite", frame));
  for (std::size_t j = 0; j < take.joint_count(); ++j) {
    if (std::fabs(norm(take.rotation(frame, j)) - 1) <= 1e-6) continue;
    throw Error(ErrorKind::usage,
                fmt::format("frame {}, joint \"{}\": rotation is not a unit quaternion", frame,
                            take.skeleton.names[j]));
  }
}

void validate_joints(const Take& take) {
  take.skeleton.validate();
  check_frame_rate(take.frame_rate_hz);
  const std::size_t frames = take.frame_count();
  check_length(take.positions.size(), frames * take.point_count(), "positions");
  check_length(take.rotations.size(), frames * take.joint_count(), "rotations");
  check_mask(take.observed, frames * take.joint_count(), "observed mask");
  check_mask(take.observed_positions, frames * take.point_count(), "mask of observed positions");
  check_translated_joints(take);
  for (std::size_t f = 0; f < frames; ++f) check_joint_samples(take, f);
  if (!std::all_of(take.positions.begin(), take.positions.end(), is_finite))
    throw Error(ErrorKind::usage, "a joint translation is not finite");
}

void validate_markers(const Take& take) {
  check_frame_rate(take.frame_rate_hz);
  const std::size_t markers = take.marker_count(), samples = take.frame_count() * markers;
  check_length(take.positions.size(), samples, "positions");
  check_length(take.observed.size(), samples, "observed mask");
  if (!take.residuals.empty()) check_length(take.residuals.size(), samples, "residuals");
  check_mask(take.is_position, markers, "kinds of points");
  for (std::size_t i = 0; i < samples; ++i) {
    if (take.observed[i] == 0 || is_finite(take.positions[i])) continue;
    throw Error(ErrorKind::usage,
                fmt::format("frame {}, marker {} \"{}\": the position is not finite", i / markers,
                            i % markers, take.names[i % markers]));
  }
}

}  // namespace

std::int32_t Take::find(std::string_view name) const noexcept {
  const auto index_of = [&](auto matches) {
    const auto found = std::find_if(names.begin(), names.end(), matches);
    return found == names.end() ? -1 : static_cast<std::int32_t>(found - names.begin());
  };
  const std::int32_t whole = index_of([&](const std::string& known) { return known == name; });
  if (whole >= 0) return whole;
  return index_of([&](const std::string& known) { return without_subject(known) == name; });
}

std::size_t Take::position_count() const noexcept {
  std::size_t count = 0;
  for (std::size_t m = 0; m < marker_count(); ++m) count += holds_positions(m) ? 1 : 0;
  return count;
}

void Take::validate() const {
  if (has_joints()) {
    validate_joints(*this);
  } else {
    validate_markers(*this);
  }
}

Take slice(const Take& take, std::size_t first, std::size_t last) {
  const std::size_t points = take.point_count();
  const std::size_t owners = take.has_joints() ? take.joint_count() : points;
  Take result;
  result.skeleton = take.skeleton;
  result.names = take.names;
  result.frame_rate_hz = take.frame_rate_hz;
  result.metres_per_unit = take.metres_per_unit;
  result.unit = take.unit;
  result.first_frame = take.first_frame + static_cast<std::int64_t>(first);
  result.rotations = rows(take.rotations, first, last, take.joint_count());
  result.positions = rows(take.positions, first, last, points);
  result.translated_joints = take.translated_joints;
  result.observed = rows(take.observed, first, last, owners);
  result.observed_positions = rows(take.observed_positions, first, last, points);
  result.residuals = rows(take.residuals, first, last, points);
  result.is_position = take.is_position;
  result.events = take.events;
  result.source.name = take.source.name;
  if (!take.has_joints()) result.source.format = take.source.format;
  return result;
}

}  // namespace kinemend
