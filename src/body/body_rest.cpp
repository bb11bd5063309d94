// Chooses a standing pose, turns it upright, and measures the body height from the legs.
#include "body/body_rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/portable.hpp"
#include "kinemend/extend/motion.hpp"
#include "motion/rotation.hpp"

namespace kinemend::representation {

namespace {

constexpr std::array both_sides{Side::left, Side::right};

// Directions close to an axis are meant to lie along it.
Vec3 snapped(Vec3 direction) {
  // Chosen by hand, not swept.
  constexpr double near = 0.87;  // cosine of 30 degrees
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    const Vec3 along = unit_vector(axis);
    const double cosine = dot(along, direction);
    if (std::fabs(cosine) > near) return cosine > 0 ? along : -along;
  }
  return direction;
}

// The common direction of several vectors; none if they disagree.
class Agreement {
 public:
  void add(Vec3 v) {
    sum_ += v;
    length_ += norm(v);
  }
  std::optional<Vec3> direction(double least_agreement) const {
    const double together = norm(sum_);
    if (!(together > least_agreement * length_) || !(together > 0)) return std::nullopt;
    return (1 / together) * sum_;
  }

 private:
  Vec3 sum_;
  double length_ = 0;
};

// Returns the up direction of joints at `positions`: from the feet to the hips and from the pelvis
// to the head.
std::optional<Vec3> standing_direction(const std::vector<Vec3>& positions,
                                       const std::vector<BoneName>& bones) {
  // Required agreement of the directions: the length of their sum over the sum of their lengths.
  // Chosen by hand, not swept.
  constexpr double agreement = 0.8;
  Agreement up;
  const auto add = [&](std::int32_t low, std::int32_t high) {
    if (low < 0 || high < 0) return;
    up.add(positions[static_cast<std::size_t>(high)] - positions[static_cast<std::size_t>(low)]);
  };
  for (const Side side : both_sides)
    add(find_bone(bones, Bone::foot, side), find_bone(bones, Bone::thigh, side));
  if (const auto legs = up.direction(agreement)) return legs;
  up = {};
  add(find_bone(bones, Bone::pelvis, Side::none), find_bone(bones, Bone::head, Side::none));
  return up.direction(agreement);
}

// Returns the facing direction, perpendicular to `up`: from the line across hips and shoulders,
// else from ankles to toes.
std::optional<Vec3> facing_direction(const std::vector<Vec3>& positions,
                                     const std::vector<BoneName>& bones, Vec3 up) {
  // As in `standing_direction`. Chosen by hand, not swept.
  constexpr double agreement = 0.7;
  const auto at = [&](std::int32_t joint) { return positions[static_cast<std::size_t>(joint)]; };
  const auto level = [&](Vec3 v) { return v - dot(v, up) * up; };
  Agreement left;
  for (const Bone bone : {Bone::thigh, Bone::upper_arm}) {
    const std::int32_t l = find_bone(bones, bone, Side::left);
    const std::int32_t r = find_bone(bones, bone, Side::right);
    if (l >= 0 && r >= 0) left.add(level(at(l) - at(r)));
  }
  if (const auto direction = left.direction(agreement)) return cross(*direction, up);
  Agreement ahead;
  for (const Side side : both_sides) {
    const std::int32_t foot = find_bone(bones, Bone::foot, side);
    const std::int32_t toe = find_bone(bones, Bone::toe, side);
    if (foot >= 0 && toe >= 0) ahead.add(level(at(toe) - at(foot)));
  }
  return ahead.direction(agreement);
}

// Returns how straight a body stands: the length of the mean of the unit vectors up its legs and
// its trunk, equally weighted; 1 if bones are not found.
double straightness(const std::vector<Vec3>& positions, const std::vector<BoneName>& bones) {
  Vec3 legs;
  int bones_found = 0;
  const auto up_along = [&](std::int32_t low, std::int32_t high) {
    if (low < 0 || high < 0) return Vec3{};
    const Vec3 v =
        positions[static_cast<std::size_t>(high)] - positions[static_cast<std::size_t>(low)];
    if (!(norm(v) > 0)) return Vec3{};
    ++bones_found;
    return (1 / norm(v)) * v;
  };
  for (const Side side : both_sides) {
    const std::int32_t shin = find_bone(bones, Bone::shin, side);
    legs += up_along(find_bone(bones, Bone::foot, side), shin);
    legs += up_along(shin, find_bone(bones, Bone::thigh, side));
  }
  const Vec3 trunk = up_along(find_bone(bones, Bone::pelvis, Side::none),
                              find_bone(bones, Bone::head, Side::none));
  return bones_found == 5 ? norm(0.25 * legs + trunk) / 2 : 1;
}

std::size_t straightest_frame(const Take& clip, const std::vector<BoneName>& bones) {
  // Frames are evenly spread, for speed; not swept.
  constexpr std::size_t most_frames = 200;
  const std::size_t frames = clip.frame_count(), sampled = std::min(frames, most_frames);
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < sampled; ++i) {
    const std::size_t f = i * frames / sampled;
    const double straight = straightness(forward_kinematics(clip, f).positions, bones);
    if (straight <= most) continue;
    most = straight;
    best = f;
  }
  return best;
}

// Returns one frame of the skeleton with all local rotations identity.
Take unturned_clip(const Take& clip) {
  Take still;
  still.skeleton = clip.skeleton;
  still.frame_rate_hz = clip.frame_rate_hz;
  still.positions.resize(1);
  still.rotations.resize(clip.joint_count());
  return still;
}

RestPose pose_of(const Take& still) {
  const Skeleton& skeleton = still.skeleton;
  RestPose rest;
  rest.rotations = forward_kinematics(still, 0).rotations;
  rest.positions = joint_positions(still, true);
  for (std::size_t j = 0; j < still.joint_count(); ++j) {
    const std::int32_t parent = skeleton.parents[j];
    const Quat own = skeleton.rest_rotations[j];
    rest.unturned.push_back(parent < 0 ? own
                                       : rest.rotations[static_cast<std::size_t>(parent)] * own);
  }
  return rest;
}

// Turns the pose upright. `snap`: snap directions to the file's axes.
void stand_upright(const std::vector<BoneName>& bones, bool snap, RestPose& rest) {
  const auto direction = standing_direction(rest.positions, bones).value_or(Vec3{0, 1, 0});
  const Vec3 up = snap ? snapped(direction) : nearest_axis(direction);
  rest.upright = shortest_rotation(up, {0, 1, 0});
  const auto facing = facing_direction(rest.positions, bones, up);
  if (!facing) return;
  const Vec3 ahead = rotate(rest.upright, snap ? snapped(*facing) : *facing);
  const double angle = portable::atan2(ahead.x, ahead.z);
  if (angle != 0) rest.upright = exp({0, -angle, 0}) * rest.upright;
}

// Returns the longest path through a joint at rest, between two of its ends.
double longest_way(const Skeleton& skeleton) {
  std::vector<double> deepest(skeleton.joint_count());
  double longest = 0;
  const auto hang = [&](std::int32_t parent, double depth) {
    if (parent < 0) return;
    double& known = deepest[static_cast<std::size_t>(parent)];
    longest = std::max(longest, known + depth);
    known = std::max(known, depth);
  };
  for (const EndSite& site : skeleton.end_sites) hang(site.parent, norm(site.offset));
  for (std::size_t j = skeleton.joint_count(); j-- > 0;)
    hang(skeleton.parents[j], deepest[j] + norm(skeleton.offsets[j]));
  return longest;
}

}  // namespace

Quat shortest_rotation(Vec3 from, Vec3 to) {
  // No axis is found below this sine, which is rounding.
  constexpr double same = 1e-7;
  const Vec3 axis = cross(from, to);
  const double sine = norm(axis), cosine = dot(from, to);
  if (sine < same && cosine > 0) return {};
  if (sine < same) {
    // Half a turn about any perpendicular axis.
    const Vec3 other = cross(from, std::fabs(from.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 0, 1});
    return exp((pi / norm(other)) * other);
  }
  return exp((portable::atan2(sine, cosine) / sine) * axis);
}

Vec3 nearest_axis(Vec3 v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  if (y >= x && y >= z) return {0, v.y < 0 ? -1.0 : 1.0, 0};
  if (z >= x) return {0, 0, v.z < 0 ? -1.0 : 1.0};
  return {v.x < 0 ? -1.0 : 1.0, 0, 0};
}

RestPose rest_pose(const Take& clip, const std::vector<BoneName>& bones) {
  // A rest pose at least this straight is standing. Chosen by hand, not swept.
  constexpr double straight = 0.9;
  RestPose rest = pose_of(unturned_clip(clip));
  const bool stands = straightness(rest.positions, bones) > straight;
  if (!stands && clip.frame_count() > 0) {
    const std::size_t frame = straightest_frame(clip, bones);
    rest = pose_of(slice(clip, frame, frame + 1));
  }
  stand_upright(bones, stands, rest);
  return rest;
}

Quat upright_world(const Take& clip, const std::vector<BoneName>& bones, const RestPose& rest) {
  // The number of frames, evenly spread, for speed, and their required agreement. Not swept.
  constexpr std::size_t most_frames = 64;
  constexpr double agreement = 0.5;
  const auto rest_up = standing_direction(rest.positions, bones);
  Agreement standing;
  const std::size_t frames = clip.frame_count(), sampled = std::min(frames, most_frames);
  for (std::size_t i = 0; i < sampled; ++i) {
    const Pose pose = forward_kinematics(clip, i * frames / sampled);
    if (const auto up = standing_direction(pose.positions, bones)) standing.add(*up);
  }
  Vec3 up = rest_up.value_or(unit_vector(Axis::y));
  const auto mostly = standing.direction(agreement);
  if (mostly && !(rest_up && dot(snapped(*mostly), snapped(*rest_up)) < -0.5)) up = *mostly;
  if (!mostly && !rest_up) up = unit_vector(guess_up_axis(clip));
  // The nearest axis is used, because a leaning body does not tilt the world.
  return shortest_rotation(nearest_axis(up), {0, 1, 0});
}

double body_height_from_legs(const Skeleton& skeleton, const std::vector<BoneName>& bones) {
  // Thigh and shank are 0.245 and 0.246 of the body height (Drillis and Contini 1966).
  constexpr double leg_share = 0.491;
  // The longest path leads from a hand along the arm and the trunk to a toe.
  constexpr double way_share = 1.45;
  double length = 0;
  int legs = 0;
  for (const Side side : both_sides) {
    const std::int32_t thigh = find_bone(bones, Bone::thigh, side);
    std::int32_t joint = find_bone(bones, Bone::foot, side);
    double leg = 0;
    while (joint >= 0 && joint != thigh) {
      leg += norm(skeleton.offsets[static_cast<std::size_t>(joint)]);
      joint = skeleton.parents[static_cast<std::size_t>(joint)];
    }
    if (thigh < 0 || joint != thigh) continue;
    length += leg;
    ++legs;
  }
  const double body_height =
      length > 0 ? length / (legs * leg_share) : longest_way(skeleton) / way_share;
  return body_height > 0 ? body_height : 1.0;
}

}  // namespace kinemend::representation
