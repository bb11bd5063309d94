// Turns joints into markers, drops rest rotations from a skeleton, and scales lengths.
#include <algorithm>
#include <string>

#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/kinematics.hpp"
#include "motion/take_change.hpp"

namespace kinemend {

namespace {

// Marks one frame: `turned` is 1 if the joint's own rotation and all above it are observed.
// `placed` omits the joint's own rotation, because its position does not depend on it.
void mark_frame(const Take& clip, std::size_t frame, std::vector<std::uint8_t>& placed,
                std::vector<std::uint8_t>& turned) {
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const std::int32_t parent = clip.skeleton.parents[j];
    placed[j] = parent < 0 || turned[static_cast<std::size_t>(parent)] != 0;
    turned[j] = placed[j] != 0 && clip.is_observed(frame, j);
  }
}

Take scale_joints(const Take& take, double factor) {
  Take result = take;
  result.source.document.reset();
  const auto scale = [factor](Vec3& v) { v = factor * v; };
  std::for_each(result.skeleton.offsets.begin(), result.skeleton.offsets.end(), scale);
  for (EndSite& site : result.skeleton.end_sites) scale(site.offset);
  std::for_each(result.positions.begin(), result.positions.end(), scale);
  for (std::size_t j = 0; j < result.skeleton.limits.size(); ++j) {
    for (std::size_t c = 0; c < result.skeleton.limits[j].size(); ++c) {
      if (is_rotation(result.skeleton.channels[j][c])) continue;
      result.skeleton.limits[j][c].minimum *= factor;
      result.skeleton.limits[j][c].maximum *= factor;
    }
  }
  result.metres_per_unit = take.metres_per_unit / factor;
  return result;
}

Take scale_markers(const Take& take, double factor, std::string_view unit) {
  TakeChange change;
  change.length_factor = factor;
  Take result = take;
  result.source.document = document_after(take.source, change);
  result.unit = unit;
  for (std::size_t i = 0; i < result.positions.size(); ++i) {
    if (!take.holds_positions(i % take.marker_count())) continue;
    result.positions[i] = factor * result.positions[i];
    if (!result.residuals.empty() && result.residuals[i] > 0)
      result.residuals[i] *= static_cast<float>(factor);
  }
  return result;
}

}  // namespace

Take joint_markers(const Take& clip, bool with_end_sites) {
  const Skeleton& skeleton = clip.skeleton;
  std::vector<std::string> names = skeleton.names;
  if (with_end_sites) {
    for (const EndSite& site : skeleton.end_sites) {
      const std::string& joint = skeleton.names[static_cast<std::size_t>(site.parent)];
      names.push_back(site.name.empty() ? joint + "_end" : site.name);
    }
  }
  const std::size_t joints = clip.joint_count(), frames = clip.frame_count();
  Take result = make_marker_take(std::move(names), frames, clip.frame_rate_hz);
  result.unit = unit_name(clip.metres_per_unit);
  result.source.name = clip.source.name;
  result.positions = joint_positions(clip, with_end_sites);
  const std::size_t markers = result.marker_count();
  std::vector<std::uint8_t> placed(joints), turned(joints);
  for (std::size_t f = 0; f < frames; ++f) {
    mark_frame(clip, f, placed, turned);
    for (std::size_t m = 0; m < markers; ++m) {
      const bool seen =
          m < joints ? placed[m] != 0
                     : turned[static_cast<std::size_t>(skeleton.end_sites[m - joints].parent)] != 0;
      result.observed[f * markers + m] = seen;
      if (!seen) result.position(f, m) = {};
    }
  }
  return result;
}

Take without_rest_rotations(const Take& clip) {
  Take result = clip;
  result.source.document.reset();
  Skeleton& skeleton = result.skeleton;
  const std::size_t joints = clip.joint_count();
  std::vector<Quat> rest(joints);  // global rotation of each joint at rest
  const auto rest_of = [&](std::int32_t joint) {
    return joint < 0 ? Quat{} : rest[static_cast<std::size_t>(joint)];
  };
  for (std::size_t j = 0; j < joints; ++j) {
    const Quat parent = rest_of(skeleton.parents[j]);
    rest[j] = normalized(parent * clip.skeleton.rest_rotations[j]);
    skeleton.offsets[j] = rotate(parent, skeleton.offsets[j]);
    skeleton.rest_rotations[j] = {};
    const RotationOrder order = skeleton.rotation_order(j);
    const bool three_axes = order.count == 3 && order.axes[0] != order.axes[2];
    if (order.count > 0 && !three_axes) {
      skeleton.channels[j] =
          make_channels(skeleton.has_position_channels(j), parse_rotation_order("ZYX"));
    }
  }
  // Limits are angles about axes that no longer exist.
  skeleton.limits.clear();
  for (EndSite& site : skeleton.end_sites) {
    site.offset = rotate(rest_of(site.parent), site.offset);
  }
  for (std::size_t i = 0; i < result.rotations.size(); ++i) {
    const Quat frame = rest[i % joints];
    result.rotations[i] = normalized(frame * clip.rotations[i] * conjugate(frame));
  }
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t k = 1; k < clip.point_count(); ++k) {
      const auto joint = static_cast<std::size_t>(clip.translated_joints[k - 1]);
      result.position(f, k) = rotate(rest_of(skeleton.parents[joint]), clip.position(f, k));
    }
  }
  return result;
}

Take scale_lengths(const Take& take, double factor, std::string_view unit) {
  if (factor == 1) return take;
  return take.has_joints() ? scale_joints(take, factor) : scale_markers(take, factor, unit);
}

}  // namespace kinemend
