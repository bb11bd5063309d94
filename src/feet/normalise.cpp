// Puts the floor of a take at height 0, and its first frame at the origin, facing forward.
#include "kinemend/extend/normalise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/portable.hpp"
#include "feet/body_points.hpp"
#include "feet/floor.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/feet.hpp"
#include "motion/conversions.hpp"
#include "motion/names.hpp"

namespace kinemend {

namespace {

[[noreturn]] void refuse_to_move(const Take& take, std::string_view why) {
  const std::string_view name = take.source.name;
  throw Error(ErrorKind::usage, fmt::format("{}{}{}", name, name.empty() ? "" : ": ", why));
}

std::vector<std::size_t> position_markers(const Take& take) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < take.marker_count(); ++m) {
    if (take.holds_positions(m)) markers.push_back(m);
  }
  return markers;
}

// Returns the points of the body in file units.
feet::BodyPoints points_of(const Take& take, const KnownNames& names) {
  if (take.has_joints()) return feet::body_points(take, 1, names);
  feet::BodyPoints body = feet::body_points(take, position_markers(take), 1, names);
  body.height = body_height(take);
  return body;
}

feet::Up up_of_take(const Take& take, const feet::BodyPoints& body, std::optional<Axis> wanted) {
  if (wanted) return {*wanted, 1};
  if (const std::optional<feet::Up> found = feet::find_up(body)) return *found;
  refuse_to_move(take, "it is not clear which axis points up; set it with --up");
}

// Returns the vector from the right hip to the left.
Vec3 across_joints(const Take& take, std::size_t frame, const KnownNames& names) {
  Skeleton known = take.skeleton;
  known.names = known_names(take.skeleton.names, names);
  const Pose pose = forward_kinematics(take, frame);
  Vec3 across;
  for (const Leg& leg : find_legs(known)) {
    const Vec3 hip = pose.positions[static_cast<std::size_t>(leg.hip)];
    if (leg.side == "left") across += hip;
    if (leg.side == "right") across += -1.0 * hip;
  }
  return across;
}

// Whether `left` and `right` differ only in the letter of their side: LASI and RASI.
bool are_a_pair(std::string_view left, std::string_view right) {
  const std::string_view subject = subject_part(left);
  if (!right.starts_with(subject) || right.size() != left.size()) return false;
  const std::string_view a = left.substr(subject.size()), b = right.substr(subject.size());
  const bool sides =
      !a.empty() && !b.empty() && (a[0] == 'L' || a[0] == 'l') && (b[0] == 'R' || b[0] == 'r');
  return sides && a.substr(1) == b.substr(1);
}

struct MarkerPair {
  std::size_t left = 0, right = 0;
  double variation = 0;  ///< standard deviation of the distance over its mean
};

double distance_variation(const Take& take, std::size_t left, std::size_t right) {
  constexpr std::size_t looked_at = 400;
  double sum = 0, squares = 0, count = 0;
  for (std::size_t f = 0; f < take.frame_count(); f += 1 + take.frame_count() / looked_at) {
    if (!take.is_observed(f, left) || !take.is_observed(f, right)) continue;
    const double distance = norm(take.position(f, left) - take.position(f, right));
    sum += distance, squares += distance * distance, ++count;
  }
  return sum > 0 ? std::sqrt(std::max(0.0, squares * count - sum * sum)) / sum : 1;
}

std::vector<MarkerPair> pairs_of(const Take& take, const std::vector<std::size_t>& markers,
                                 std::size_t frame) {
  std::vector<MarkerPair> pairs;
  for (const std::size_t left : markers) {
    for (const std::size_t right : markers) {
      const bool is_seen = take.is_observed(frame, left) && take.is_observed(frame, right);
      if (is_seen && are_a_pair(take.names[left], take.names[right]))
        pairs.push_back({left, right, distance_variation(take, left, right)});
    }
  }
  return pairs;
}

// Returns the direction from right to left of the person with the most markers. Pairs with a steady
// distance are on pelvis and shoulders, not on feet and hands.
Vec3 across_markers(const Take& take, std::size_t frame) {
  constexpr double steady = 0.03, times_steadiest = 2;
  const std::vector<MarkerPair> pairs = pairs_of(take, largest_subject(take).markers, frame);
  double most = 1;
  for (const MarkerPair& pair : pairs) most = std::min(most, times_steadiest * pair.variation);
  most = std::max(most, steady);
  Vec3 across;
  for (const auto& [left, right, variation] : pairs) {
    if (variation <= most) across += take.position(frame, left) - take.position(frame, right);
  }
  return across;
}

// Returns the angle about `up`, in radians, that turns the body of the frame to face forward.
double turn_to_forward(const Take& take, std::size_t frame, feet::Up up, const KnownNames& names) {
  const Vec3 across = feet::level_part(
      take.has_joints() ? across_joints(take, frame, names) : across_markers(take, frame), up);
  if (!(norm(across) > 0))
    refuse_to_move(take, "left and right are not told apart, so its heading is unknown");
  const Vec3 facing = cross(across, up.direction()),
             forward = feet::Up{forward_axis(up.axis), 1}.direction();
  return portable::atan2(dot(cross(facing, forward), up.direction()), dot(facing, forward));
}

void check_root(const Take& take, bool turns) {
  const std::vector<Channel>& channels = take.skeleton.channels[0];
  const auto rotations = std::count_if(channels.begin(), channels.end(), is_rotation);
  const auto positions = static_cast<std::ptrdiff_t>(channels.size()) - rotations;
  if (positions < 3)
    refuse_to_move(take, "its root has no three position channels, so it cannot be moved");
  if (turns && rotations < 3)
    refuse_to_move(take, "its root has no three rotation channels, so it cannot be turned");
  const auto roots =
      std::count(take.skeleton.parents.begin(), take.skeleton.parents.end(), std::int32_t{-1});
  if (roots > 1) refuse_to_move(take, "it has several roots, so it cannot be moved as a whole");
}

void turn_root(Take& take, Quat turn) {
  const Quat rest = take.skeleton.rest_rotations[0];
  const Quat local = conjugate(rest) * turn * rest;
  for (std::size_t f = 0; f < take.frame_count(); ++f)
    take.rotation(f, 0) = normalized(local * take.rotation(f, 0));
}

// Maps each point p to turn p + shift.
void move(Take& take, Quat turn, Vec3 shift) {
  const bool turns = !(turn == Quat{});
  if (take.has_joints()) {
    check_root(take, turns);
    if (turns) turn_root(take, turn);
    for (std::size_t f = 0; f < take.frame_count(); ++f)
      take.root_position(f) =
          (turns ? rotate(turn, take.root_position(f)) : take.root_position(f)) + shift;
    return;
  }
  TakeChange change;
  change.axes = {rotate(turn, {1, 0, 0}), rotate(turn, {0, 1, 0}), rotate(turn, {0, 0, 1})};
  change.shift = shift;
  take.source.document = document_after(take.source, change);
  for (std::size_t f = 0; f < take.frame_count(); ++f) {
    for (std::size_t m = 0; m < take.marker_count(); ++m) {
      if (!take.is_observed(f, m) || !take.holds_positions(m)) continue;
      take.position(f, m) =
          (turns ? rotate(turn, take.position(f, m)) : take.position(f, m)) + shift;
    }
  }
}

}  // namespace

Axis forward_axis(Axis up) { return up == Axis::x ? Axis::y : up == Axis::y ? Axis::z : Axis::x; }

Normalised normalise(Take& take, const NormaliseSettings& settings) {
  Normalised done;
  if (!settings.floor_at_zero && !settings.face_forward) return done;
  if (take.frame_count() == 0) refuse_to_move(take, "it has no frames");
  const feet::BodyPoints body = points_of(take, settings.names);
  if (body.feet.empty())
    refuse_to_move(take, "no feet found; --map FILE gives the names of the feet");
  const feet::Up up = up_of_take(take, body, settings.up);
  done.up = up.axis;
  Quat turn;
  Vec3 shift;
  if (settings.face_forward) {
    const std::size_t first = take.has_joints() ? leading_calibration_frames(take) : 0;
    const double angle = turn_to_forward(take, first, up, settings.names);
    turn = exp(angle * up.direction());
    shift = -1.0 * feet::level_part(rotate(turn, body.centres[first]), up);
    done.turned_deg = up.sign * degrees_per_radian * angle;
    done.moved = shift;
  }
  if (settings.floor_at_zero) {
    const double height = feet::floor_height(body, up);
    shift += -height * up.direction();
    done.raised = -up.sign * height;
  }
  move(take, turn, shift);
  return done;
}

}  // namespace kinemend
