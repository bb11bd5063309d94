// Takes the curves of a track from takes before and after.
#include "kinemend/experimental/curves.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "kinemend/error.hpp"
#include "kinemend/experimental/frame_numbers.hpp"

namespace kinemend {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

void check_lengths(const Take& before, const Take& after) {
  if (before.frame_count() != after.frame_count()) {
    throw Error(ErrorKind::usage, fmt::format("curves: {} frames before and {} after",
                                              before.frame_count(), after.frame_count()));
  }
}

void check_track(std::size_t track, std::size_t before, std::size_t after) {
  if (track >= before || track >= after)
    throw Error(ErrorKind::usage, fmt::format("curves: there is no track {}", track));
}

TrackCurves empty_curves(std::vector<std::string> axes, std::size_t frames) {
  TrackCurves curves;
  curves.before.assign(axes.size(), std::vector<double>(frames, missing));
  curves.after = curves.before;
  curves.difference.assign(frames, missing);
  curves.axes = std::move(axes);
  return curves;
}

void put(Vec3 position, std::size_t frame, std::vector<std::vector<double>>& curves) {
  curves[0][frame] = position.x;
  curves[1][frame] = position.y;
  curves[2][frame] = position.z;
}

}  // namespace

TrackCurves rotation_curves(const Take& before, const Take& after, std::size_t joint) {
  check_lengths(before, after);
  check_track(joint, before.joint_count(), after.joint_count());
  RotationOrder order = before.skeleton.rotation_order(joint);
  if (order.count == 0) order = parse_rotation_order("ZXY");
  const std::string letters = to_string(order);
  std::vector<std::string> axes;
  for (const char letter : letters) axes.emplace_back(1, letter);
  TrackCurves curves = empty_curves(std::move(axes), before.frame_count());
  curves.name = before.skeleton.names[joint];
  curves.quantity = "rotation";
  curves.unit = "deg";
  curves.first_frame = first_frame_number(before);
  curves.frame_rate_hz = before.frame_rate_hz;
  std::array<double, 3> angles{};
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    const bool has_before = before.is_observed(f, joint), has_after = after.is_observed(f, joint);
    if (has_before) angles = to_euler_near(before.rotation(f, joint), order, angles);
    const auto other = has_after ? to_euler_near(after.rotation(f, joint), order, angles) : angles;
    for (std::size_t a = 0; a < order.count; ++a) {
      if (has_before) curves.before[a][f] = angles[a] * degrees_per_radian;
      if (has_after) curves.after[a][f] = other[a] * degrees_per_radian;
    }
    if (!has_before) angles = other;
    if (has_before && has_after) {
      curves.difference[f] =
          angle_between(before.rotation(f, joint), after.rotation(f, joint)) * degrees_per_radian;
    }
  }
  return curves;
}

TrackCurves root_curves(const Take& before, const Take& after) {
  check_lengths(before, after);
  check_track(0, before.joint_count(), after.joint_count());
  TrackCurves curves = empty_curves({"X", "Y", "Z"}, before.frame_count());
  curves.name = before.skeleton.names[0];
  curves.quantity = "position";
  curves.unit = take_facts(before).unit;
  curves.first_frame = first_frame_number(before);
  curves.frame_rate_hz = before.frame_rate_hz;
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    const bool has_before = before.is_position_observed(f, 0);
    const bool has_after = after.is_position_observed(f, 0);
    if (has_before) put(before.root_position(f), f, curves.before);
    if (has_after) put(after.root_position(f), f, curves.after);
    if (has_before && has_after)
      curves.difference[f] = norm(after.root_position(f) - before.root_position(f));
  }
  return curves;
}

TrackCurves marker_curves(const Take& before, const Take& after, std::size_t marker) {
  check_lengths(before, after);
  check_track(marker, before.marker_count(), after.marker_count());
  TrackCurves curves = empty_curves({"X", "Y", "Z"}, before.frame_count());
  curves.name = before.names[marker];
  curves.quantity = "position";
  curves.unit = before.unit;
  curves.first_frame = first_frame_number(before);
  curves.frame_rate_hz = before.frame_rate_hz;
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    const bool has_before = before.is_observed(f, marker);
    const bool has_after = after.is_observed(f, marker);
    if (has_before) put(before.position(f, marker), f, curves.before);
    if (has_after) put(after.position(f, marker), f, curves.after);
    if (has_before && has_after)
      curves.difference[f] = norm(after.position(f, marker) - before.position(f, marker));
  }
  return curves;
}

}  // namespace kinemend
