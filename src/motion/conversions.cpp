// Guesses which axis points up, turns axes, scales lengths, turns joints into markers and drops
// rest rotations. The source document of a take follows its conversions.
#include "motion/conversions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "kinemend/extend/motion.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

// The rotation by 90 degrees that moves one axis to another.
struct QuarterTurn {
  Quat rotation;

  QuarterTurn(Axis from, Axis to) {
    constexpr double quarter = 0.5 * pi;
    rotation = from == to ? Quat{} : exp(quarter * cross(unit_vector(from), unit_vector(to)));
  }
  // Rotates by exchanging components, so that coordinates keep their digits.
  Vec3 operator()(Vec3 v) const {
    const Vec3 ex = axis_after(Axis::x), ey = axis_after(Axis::y), ez = axis_after(Axis::z);
    const auto row = [&](std::size_t i) {
      return component(ex, i) * v.x + component(ey, i) * v.y + component(ez, i) * v.z;
    };
    return {row(0), row(1), row(2)};
  }
  Quat operator()(Quat q) const {
    const Vec3 turned = (*this)(Vec3{q.x, q.y, q.z});
    return {q.w, turned.x, turned.y, turned.z};
  }
  Vec3 axis_after(Axis axis) const {
    const Vec3 v = rotate(rotation, unit_vector(axis));
    return {std::round(v.x), std::round(v.y), std::round(v.z)};
  }
};

void turn_channels(const QuarterTurn& turn, Skeleton& skeleton) {
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    for (std::size_t c = 0; c < skeleton.channels[j].size(); ++c) {
      Channel& channel = skeleton.channels[j][c];
      const Vec3 axis = turn.axis_after(axis_of(channel));
      const int index = axis.x != 0 ? 0 : axis.y != 0 ? 1 : 2;
      const bool backwards = axis.x + axis.y + axis.z < 0;
      channel = static_cast<Channel>((is_rotation(channel) ? 3 : 0) + index);
      if (!backwards || skeleton.limits.empty() || skeleton.limits[j].size() <= c) continue;
      ChannelLimit& limit = skeleton.limits[j][c];
      limit = {-limit.maximum, -limit.minimum};
    }
  }
}

// Ranges of the lowest and the highest point of the body along an axis.
struct Wandering {
  std::vector<double> lowest, highest;

  static double spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() * 9 / 10] - values[values.size() / 10];
  }
  double least() const { return std::min(spread(lowest), spread(highest)); }
};

// `visit(frame, use)` calls `use` with every point of a frame.
template <class Visit>
Axis up_axis(std::size_t frames, Axis fallback, Visit visit) {
  // Number of frames, spread evenly over the take: for speed, not swept.
  constexpr std::size_t looked_at = 400;
  std::array<Wandering, 3> axes;
  for (std::size_t f = 0; f < frames; f += 1 + frames / looked_at) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    bool any = false;
    visit(f, [&](Vec3 p) {
      any = true;
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], component(p, a));
        high[a] = std::max(high[a], component(p, a));
      }
    });
    for (std::size_t a = 0; any && a < 3; ++a) {
      axes[a].lowest.push_back(low[a]);
      axes[a].highest.push_back(high[a]);
    }
  }
  if (axes[0].lowest.size() < 2) return fallback;
  std::array<double, 3> least{};
  for (std::size_t a = 0; a < 3; ++a) least[a] = axes[a].least();
  const auto best = std::min_element(least.begin(), least.end()) - least.begin();
  // A body that does not move gives no evidence.
  const double most = *std::max_element(least.begin(), least.end());
  return most > 0 ? static_cast<Axis>(best) : fallback;
}

void turn_skeleton(const QuarterTurn& turn, Skeleton& skeleton) {
  for (Vec3& offset : skeleton.offsets) offset = turn(offset);
  for (Quat& rest : skeleton.rest_rotations) rest = turn(rest);
  for (EndSite& site : skeleton.end_sites) site.offset = turn(site.offset);
  turn_channels(turn, skeleton);
}

}  // namespace

Axis guess_up_axis(const Take& take) {
  if (!take.has_joints()) {
    return up_axis(take.frame_count(), Axis::z, [&](std::size_t frame, auto use) {
      for (std::size_t m = 0; m < take.marker_count(); ++m) {
        if (take.is_observed(frame, m) && take.holds_positions(m)) use(take.position(frame, m));
      }
    });
  }
  const std::size_t width = take.joint_count() + take.skeleton.end_sites.size();
  const std::vector<Vec3> points = joint_positions(take, true);
  return up_axis(take.frame_count(), Axis::y, [&](std::size_t frame, auto use) {
    for (std::size_t i = 0; i < width; ++i) use(points[frame * width + i]);
  });
}

Take turn_axes(const Take& take, Axis from, Axis to) {
  if (from == to) return take;
  const QuarterTurn turn(from, to);
  Take result = take;
  if (take.has_joints()) {
    result.source.document.reset();
    turn_skeleton(turn, result.skeleton);
    for (Quat& rotation : result.rotations) rotation = turn(rotation);
  } else {
    TakeChange change;
    change.axes = {turn.axis_after(Axis::x), turn.axis_after(Axis::y), turn.axis_after(Axis::z)};
    result.source.document = document_after(take.source, change);
  }
  for (std::size_t i = 0; i < result.positions.size(); ++i) {
    if (take.has_joints() || take.holds_positions(i % take.marker_count()))
      result.positions[i] = turn(result.positions[i]);
  }
  return result;
}

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

TakeChange both(const TakeChange& first, const TakeChange& second) {
  TakeChange result;
  result.length_factor = first.length_factor * second.length_factor;
  for (std::size_t i = 0; i < result.axes.size(); ++i)
    result.axes[i] = second.turned(first.axes[i]);
  result.shift = second.moved(first.shift);
  result.resampled = first.resampled || second.resampled;
  result.drops_layout = first.drops_layout || second.drops_layout;
  return result;
}

std::shared_ptr<const SourceDocument> document_after(const SourceInfo& source,
                                                     const TakeChange& change) {
  const auto* const document = dynamic_cast<const FollowingDocument*>(source.document.get());
  return document == nullptr ? nullptr : document->after(change);
}

void drop_layout(SourceInfo& source) {
  TakeChange change;
  change.drops_layout = true;
  source.document = document_after(source, change);
}

}  // namespace kinemend
