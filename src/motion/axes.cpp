// Guesses which axis points up, and rotates a take so that another axis points up.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/kinematics.hpp"
#include "motion/take_change.hpp"

namespace kinemend {

namespace {

double coordinate(Vec3 v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3 unit_vector(Axis axis) {
  return {axis == Axis::x ? 1.0 : 0.0, axis == Axis::y ? 1.0 : 0.0, axis == Axis::z ? 1.0 : 0.0};
}

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
      return coordinate(ex, i) * v.x + coordinate(ey, i) * v.y + coordinate(ez, i) * v.z;
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
        low[a] = std::min(low[a], coordinate(p, a));
        high[a] = std::max(high[a], coordinate(p, a));
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

}  // namespace kinemend
