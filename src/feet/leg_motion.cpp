// Models each leg from the skeleton and computes its pose in every frame.
#include "feet/leg_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "feet/floor.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend::feet {

namespace {

constexpr auto heel = static_cast<std::size_t>(FootPart::heel);
constexpr auto toe = static_cast<std::size_t>(FootPart::toe);
// The heel's distance behind the ankle, as a share of that from ankle to toe
// (docs/details/feet.md). Chosen by hand, not swept.
constexpr double heel_behind = 0.25;

std::size_t index_of(std::int32_t joint) { return static_cast<std::size_t>(joint); }

LegJoint leg_joint(const Skeleton& skeleton, std::int32_t joint) {
  return {index_of(joint), skeleton.rest_rotations[index_of(joint)],
          skeleton.rotation_order(index_of(joint))};
}

// Returns each joint's translation track; -1 if it has a fixed offset.
std::vector<std::int32_t> translation_tracks(const Take& clip) {
  std::vector<std::int32_t> tracks(clip.joint_count(), -1);
  for (std::size_t k = 0; k < clip.translated_joints.size(); ++k)
    tracks[index_of(clip.translated_joints[k])] = static_cast<std::int32_t>(k);
  return tracks;
}

Vec3 mean_translation(const Take& clip, std::size_t track) {
  Vec3 sum;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) sum += clip.position(f, 1 + track);
  return (1.0 / static_cast<double>(std::max<std::size_t>(clip.frame_count(), 1))) * sum;
}

// Returns a joint's place in its parent's frame, averaged over all frames.
Vec3 offset_of(const Take& clip, std::size_t joint) {
  const std::int32_t track = translation_tracks(clip)[joint];
  return track < 0 ? clip.skeleton.offsets[joint] : mean_translation(clip, index_of(track));
}

bool is_named_heel(const std::string& name) {
  return lower_case(name).find("heel") != std::string::npos;
}

void set_sole(const Take& clip, const Leg& leg, LegModel& model) {
  const Skeleton& skeleton = clip.skeleton;
  model.has = {false, leg.toe >= 0};
  if (leg.toe >= 0) model.sole[toe] = offset_of(clip, index_of(leg.toe));
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    if (skeleton.parents[j] != leg.ankle || !is_named_heel(skeleton.names[j])) continue;
    model.sole[heel] = offset_of(clip, j);
    model.has[heel] = true;
  }
  for (const EndSite& site : skeleton.end_sites) {
    if (site.parent != leg.ankle) continue;
    if (is_named_heel(site.name)) {
      model.sole[heel] = site.offset;
      model.has[heel] = true;
    } else if (leg.toe < 0 && norm(site.offset) > 0) {
      model.sole[toe] = site.offset;
      model.has[toe] = true;
    }
  }
}

bool is_above(const Skeleton& skeleton, std::size_t joint, std::int32_t below) {
  for (; below >= 0; below = skeleton.parents[index_of(below)]) {
    if (index_of(below) == joint) return true;
  }
  return false;
}

Carrier find_carrier(const Take& clip, const std::vector<Leg>& legs) {
  Carrier carrier;
  if (legs.empty()) return carrier;
  const std::vector<std::int32_t> tracks = translation_tracks(clip);
  for (std::int32_t j = clip.skeleton.parents[index_of(legs[0].hip)]; j >= 0;
       j = clip.skeleton.parents[index_of(j)]) {
    const std::size_t joint = index_of(j);
    const bool moves = j == 0 ? clip.skeleton.has_position_channels(0) : tracks[joint] >= 0;
    const bool is_common = std::all_of(legs.begin(), legs.end(), [&](const Leg& leg) {
      return is_above(clip.skeleton, joint, leg.hip);
    });
    if (!moves || !is_common) continue;
    carrier.found = true;
    carrier.joint = joint;
    carrier.track = j == 0 ? 0 : index_of(tracks[joint]) + 1;
    return carrier;
  }
  return carrier;
}

// Returns the axis about which the knee bends, in its parent's frame: the mean over the clip, or,
// if it never bends, the one that swings the shank away from the toes.
Vec3 usual_hinge(const LegMotion& motion, std::size_t leg) {
  Vec3 sum, ahead;
  for (std::size_t f = 0; f < motion.frames; ++f) {
    const LegPose& pose = motion.pose(f, leg);
    const Vec3 thigh = pose.knee_at - pose.hip_at, shank = pose.ankle_at - pose.knee_at;
    sum += rotate(conjugate(pose.knee_parent), cross(thigh, shank));
    const Vec3 foot = rotate(pose.ankle, motion.models[leg].sole[toe]);
    ahead += rotate(conjugate(pose.knee_parent), cross(foot, thigh));
  }
  const auto frames = static_cast<double>(std::max<std::size_t>(motion.frames, 1));
  const double least = 1e-3 * motion.height * motion.height * frames * 0.06;
  if (norm(sum) < least) sum = ahead;
  if (!(norm(sum) > 0)) return {1, 0, 0};
  return (1 / norm(sum)) * sum;
}

// Returns the joints that determine the legs' positions: the ankles and their ancestors, parents
// first.
std::vector<std::size_t> needed_joints(const Skeleton& skeleton, const std::vector<Leg>& legs) {
  std::vector<std::size_t> joints;
  for (const Leg& leg : legs) {
    for (std::int32_t j = leg.ankle; j >= 0; j = skeleton.parents[index_of(j)])
      joints.push_back(index_of(j));
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

// Returns the heel in the ankle's frame from the mean height of the toe below the ankle and the
// mean vector from ankle to toe, over the frames in which both are at their usual level.
std::optional<Vec3> heel_of_flat_foot(const LegMotion& motion, std::size_t leg, Up up) {
  // The least time with a flat foot. Chosen by hand, not swept.
  constexpr double least_s = 0.1;
  BodyPoints body;
  body.frames = motion.frames;
  body.points = 2;
  body.frame_rate_hz = motion.frame_rate_hz;
  body.height = motion.height;
  for (std::size_t f = 0; f < motion.frames; ++f) {
    const LegPose& pose = motion.pose(f, leg);
    body.positions.push_back(pose.ankle_at);
    body.positions.push_back(pose.sole_at(motion.models[leg], FootPart::toe));
  }
  const ContactThresholds thresholds;
  std::array<std::vector<std::uint8_t>, 2> down;
  for (std::size_t p = 0; p < 2; ++p) {
    const SolePoint point = sole_point(body, p, up, thresholds);
    down[p] = touches(point, {point.level}, body.height, thresholds);
  }
  Vec3 sum;
  double count = 0;
  for (std::size_t f = 0; f < motion.frames; ++f) {
    if (down[0][f] == 0 || down[1][f] == 0) continue;
    const Vec3 ahead = body.at(f, 1) - body.at(f, 0);
    const Vec3 drop = ahead - level_part(ahead, up);
    sum += rotate(conjugate(motion.pose(f, leg).ankle), drop - heel_behind * level_part(ahead, up));
    ++count;
  }
  if (count < least_s * motion.frame_rate_hz) return std::nullopt;
  return (1 / count) * sum;
}

// Returns the heel from the rest pose, if its toes point ahead; else the ankle itself.
Vec3 heel_at_rest(const Take& clip, const LegModel& model, Up up) {
  // The horizontal share of the vector from ankle to toe in a foot that points ahead. Chosen by
  // hand, not swept.
  constexpr double least_ahead = 0.5;
  Take rest;
  rest.skeleton = clip.skeleton;
  rest.positions.resize(1);
  rest.rotations.resize(clip.joint_count());
  const Quat ankle = forward_kinematics(rest, 0).rotations[model.ankle.index];
  const Vec3 ahead = rotate(ankle, model.sole[toe]);
  const Vec3 level = level_part(ahead, up);
  if (norm(level) < least_ahead * norm(ahead)) return {};
  return rotate(conjugate(ankle), ahead - level - heel_behind * level);
}

}  // namespace

Vec3 LegMotion::hips_at(std::size_t frame) const {
  Vec3 mean;
  for (std::size_t l = 0; l < legs(); ++l)
    mean += (1.0 / static_cast<double>(legs())) * pose(frame, l).hip_at;
  return mean;
}

void update_poses(const Take& clip, const std::vector<Leg>& legs, LegMotion& motion) {
  const Skeleton& skeleton = clip.skeleton;
  const std::vector<std::size_t> joints = needed_joints(skeleton, legs);
  const std::vector<std::int32_t> tracks = translation_tracks(clip);
  motion.poses.resize(motion.frames * legs.size());
  motion.carrier.frames_of.assign(motion.frames, Quat{});
  motion.carrier.at.assign(motion.frames, Vec3{});
  const auto update = [&](std::size_t f, std::vector<Quat>& rotations,
                          std::vector<Vec3>& positions) {
    for (const std::size_t j : joints) {
      const Quat local = skeleton.rest_rotations[j] * clip.rotation(f, j);
      const Vec3 offset = j == 0          ? clip.root_position(f)
                          : tracks[j] < 0 ? skeleton.offsets[j]
                                          : clip.position(f, 1 + index_of(tracks[j]));
      if (skeleton.parents[j] < 0) {
        rotations[j] = local;
        positions[j] = offset;
        continue;
      }
      const std::size_t parent = index_of(skeleton.parents[j]);
      rotations[j] = rotations[parent] * local;
      positions[j] = positions[parent] + rotate(rotations[parent], offset);
    }
    const auto parent_rotation = [&](std::size_t joint) {
      const std::int32_t parent = skeleton.parents[joint];
      return parent < 0 ? Quat{} : rotations[index_of(parent)];
    };
    if (motion.carrier.found) {
      motion.carrier.frames_of[f] = parent_rotation(motion.carrier.joint);
      motion.carrier.at[f] = positions[motion.carrier.joint];
    }
    for (std::size_t l = 0; l < legs.size(); ++l) {
      const std::size_t h = index_of(legs[l].hip), k = index_of(legs[l].knee),
                        a = index_of(legs[l].ankle);
      motion.pose(f, l) = {parent_rotation(h), rotations[h],       parent_rotation(k),
                           rotations[k],       parent_rotation(a), rotations[a],
                           positions[h],       positions[k],       positions[a]};
    }
  };
  for_blocks(0, motion.frames, [&](std::size_t first, std::size_t end) {
    std::vector<Quat> rotations(clip.joint_count());
    std::vector<Vec3> positions(clip.joint_count());
    for (std::size_t f = first; f < end; ++f) update(f, rotations, positions);
  });
}

LegMotion leg_motion(const Take& clip, const std::vector<Leg>& legs) {
  LegMotion motion;
  motion.frames = clip.frame_count();
  motion.frame_rate_hz = clip.frame_rate_hz;
  motion.height = body_height(clip.skeleton);
  for (const Leg& leg : legs) {
    LegModel model{leg_joint(clip.skeleton, leg.hip),
                   leg_joint(clip.skeleton, leg.knee),
                   leg_joint(clip.skeleton, leg.ankle),
                   {},
                   {},
                   {}};
    set_sole(clip, leg, model);
    motion.models.push_back(model);
  }
  motion.carrier = find_carrier(clip, legs);
  update_poses(clip, legs, motion);
  for (std::size_t l = 0; l < legs.size(); ++l) motion.models[l].hinge = usual_hinge(motion, l);
  return motion;
}

std::optional<Up> up_of(const LegMotion& motion, std::optional<Axis> wanted) {
  if (wanted) return Up{*wanted, 1};
  BodyPoints body;
  body.frames = motion.frames;
  body.points = motion.legs();
  for (std::size_t f = 0; f < motion.frames; ++f) {
    for (std::size_t l = 0; l < motion.legs(); ++l)
      body.positions.push_back(motion.pose(f, l).ankle_at);
    body.centres.push_back(motion.hips_at(f));
  }
  for (std::size_t l = 0; l < motion.legs(); ++l) body.feet.push_back({"", {l}});
  return find_up(body);
}

void set_heels(const Take& clip, Up up, LegMotion& motion) {
  for (std::size_t l = 0; l < motion.legs(); ++l) {
    LegModel& model = motion.models[l];
    if (model.has[heel]) continue;
    model.has[heel] = true;
    if (!model.has[toe]) continue;  // the ankle itself
    const std::optional<Vec3> found = heel_of_flat_foot(motion, l, up);
    model.sole[heel] = found ? *found : heel_at_rest(clip, model, up);
  }
}

BodyPoints sole_points(const LegMotion& motion) {
  BodyPoints body;
  body.frames = motion.frames;
  body.points = 2 * motion.legs();
  body.frame_rate_hz = motion.frame_rate_hz;
  body.height = motion.height;
  body.positions.reserve(body.frames * body.points);
  for (std::size_t f = 0; f < motion.frames; ++f) {
    body.centres.push_back(motion.hips_at(f));
    for (std::size_t l = 0; l < motion.legs(); ++l) {
      const LegPose& pose = motion.pose(f, l);
      const LegModel& model = motion.models[l];
      body.positions.push_back(pose.sole_at(model, FootPart::heel));
      body.positions.push_back(
          pose.sole_at(model, model.has[toe] ? FootPart::toe : FootPart::heel));
    }
  }
  return body;
}

}  // namespace kinemend::feet
