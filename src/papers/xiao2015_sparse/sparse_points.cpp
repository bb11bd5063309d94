// Places joints and free ends of bones, and turns joints so that bones point at given points. Finds
// the local frame of each pose and moves points to it and back.
#include "papers/xiao2015_sparse/sparse_points.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/parallel.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/motion.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The arc of a channel's degree: one radian is a quarter of the body height. By definition
// (docs/details/bodies.md). The lengths are chosen by hand, not swept.
constexpr double degrees_per_height = 4 * degrees_per_radian;
constexpr double least_bone = 1e-4;                      // body heights
constexpr double shortest_end = 0.02, usual_end = 0.05;  // for bones of unknown length

void put(PoseMatrix& values, std::size_t frame, std::size_t part, Vec3 v) {
  values(frame, 3 * part) = v.x;
  values(frame, 3 * part + 1) = v.y;
  values(frame, 3 * part + 2) = v.z;
}

Quat local_rotation(const BodyLayout& layout, const PoseMatrix& channels, std::size_t frame,
                    std::size_t track) {
  return layout.references[track] * exp(radians_per_degree * vector_at(channels, frame, track));
}

// Rotations of all tracks in the body's frame.
std::vector<Quat> global_rotations(const BodyLayout& layout, const PoseMatrix& channels,
                                   std::size_t frame) {
  std::vector<Quat> global(layout.track_count());
  for (std::size_t i = 0; i < global.size(); ++i) {
    const Quat local = local_rotation(layout, channels, frame, i);
    global[i] =
        i == 0 ? local : normalized(global[static_cast<std::size_t>(layout.parents[i])] * local);
  }
  return global;
}

Vector3d eigen(Vec3 v) { return {v.x, v.y, v.z}; }

Matrix3d matrix_of(Quat q) {
  Matrix3d m;
  m << eigen(rotate(q, {1, 0, 0})), eigen(rotate(q, {0, 1, 0})), eigen(rotate(q, {0, 0, 1}));
  return m;
}

// The rotation nearest to a matrix.
Quat nearest_rotation(const Matrix3d& m) {
  const Eigen::JacobiSVD<Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  const Eigen::Quaterniond q(Matrix3d(u * svd.matrixV().transpose()));
  return normalized(Quat{q.w(), q.x(), q.y(), q.z()});
}

}  // namespace

SparsePointsBuilder::SparsePointsBuilder(const BodyLayout& layout)
    : layout_(layout), sums_(layout.track_count()), counts_(layout.track_count(), 0) {}

void SparsePointsBuilder::add(const Take& clip) {
  if (clip.frame_count() == 0) return;
  const BodyMatch match = match_body(layout_, clip);
  const BodyChannels channels = encode_body(clip, layout_, match);
  const std::vector<Quat> global = global_rotations(layout_, channels.poses, 0);
  const std::vector<Vec3> positions = joint_positions(clip, false);
  const Quat ahead = exp({0, -channels.headings[0], 0});
  const auto position = [&](std::size_t track) {
    return rotate(ahead * match.upright, positions[static_cast<std::size_t>(match.tracks[track])]);
  };
  for (std::size_t i = 1; i < sums_.size(); ++i) {
    const auto parent = static_cast<std::size_t>(layout_.parents[i]);
    if (match.tracks[i] < 0 || match.tracks[parent] < 0) continue;
    const Vec3 bone = (1 / match.body_height) * (position(i) - position(parent));
    sums_[i] += rotate(conjugate(global[parent]), bone);
    counts_[i] += 1;
  }
}

SparsePoints SparsePointsBuilder::finish() const {
  SparsePoints points;
  points.parents = layout_.parents;
  std::vector<bool> carries(sums_.size(), false);
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    points.offsets.push_back((1 / std::max(counts_[i], 1.0)) * sums_[i]);
    if (i > 0) carries[static_cast<std::size_t>(layout_.parents[i])] = true;
  }
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    if (carries[i] || norm(layout_.bones[i]) < 0.5) continue;
    const double length = norm(points.offsets[i]);
    points.parents.push_back(static_cast<std::int32_t>(i));
    points.offsets.push_back((length > shortest_end ? length : usual_end) * layout_.bones[i]);
  }
  return points;
}

SparsePoints marker_points(const BodyLayout& layout) {
  SparsePoints points;
  points.kind = BodyKind::markers;
  points.parents.assign(layout.track_count(), -1);
  points.offsets = layout.means;
  return points;
}

PoseMatrix points_of(const SparsePoints& points, const BodyLayout& layout,
                     const PoseMatrix& channels) {
  PoseMatrix positions(channels.frames, 3 * points.count());
  for_each_parallel(channels.frames, channels.values.size(), [&](std::size_t f) {
    if (points.kind == BodyKind::markers) {
      for (std::size_t p = 0; p < points.count(); ++p)
        put(positions, f, p,
            points.offsets[p] + (1 / degrees_per_height) * vector_at(channels, f, p));
      return;
    }
    const std::vector<Quat> global = global_rotations(layout, channels, f);
    for (std::size_t p = 1; p < points.count(); ++p) {
      const auto parent = static_cast<std::size_t>(points.parents[p]);
      put(positions, f, p,
          vector_at(positions, f, parent) + rotate(global[parent], points.offsets[p]));
    }
  });
  return positions;
}

std::vector<std::uint8_t> observed_points(const SparsePoints& points, const BodyLayout& layout,
                                          const std::vector<std::uint8_t>& observed) {
  const std::size_t width = layout.channel_count(), frames = observed.size() / width;
  std::vector<std::uint8_t> result(frames * 3 * points.count(), 1);
  std::vector<std::uint8_t> turned(layout.track_count());
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t i = 0; i < turned.size(); ++i) {
      turned[i] = observed[f * width + 3 * i];
      if (points.kind == BodyKind::joints && i > 0 &&
          turned[static_cast<std::size_t>(layout.parents[i])] == 0)
        turned[i] = 0;
    }
    for (std::size_t p = 0; p < points.count(); ++p) {
      const std::int32_t parent = points.parents[p];
      const bool is_root = points.kind == BodyKind::joints && parent < 0;
      const std::size_t track = parent < 0 ? p : static_cast<std::size_t>(parent);
      const std::uint8_t seen = is_root ? 1 : turned[track];
      for (std::size_t axis = 0; axis < 3; ++axis)
        result[(f * points.count() + p) * 3 + axis] = seen;
    }
  }
  return result;
}

namespace {

// Restores the joints of one frame.
class FrameTurning {
 public:
  FrameTurning(const SparsePoints& points, const BodyLayout& layout, double stiffness)
      : points_(points), layout_(layout), stiffness_(stiffness), below_(layout.track_count()) {
    for (std::size_t p = 1; p < points.count(); ++p) {
      if (norm(points.offsets[p]) > least_bone)
        below_[static_cast<std::size_t>(points.parents[p])].push_back(p);
    }
  }

  void turn(const PoseMatrix& positions, const PoseMatrix& guide, std::size_t frame,
            PoseMatrix& channels) const {
    std::vector<Quat> global(layout_.track_count());
    for (std::size_t i = 0; i < global.size(); ++i) {
      const Quat above = i == 0 ? Quat{} : global[static_cast<std::size_t>(layout_.parents[i])];
      global[i] = normalized(above * local_rotation(layout_, guide, frame, i));
      if (below_[i].empty()) continue;
      Matrix3d wanted = stiffness_ * stiffness_ * matrix_of(global[i]);
      for (const std::size_t p : below_[i]) {
        const Vec3 bone = vector_at(positions, frame, p) - vector_at(positions, frame, i);
        wanted += eigen(bone) * eigen(points_.offsets[p]).transpose();
      }
      global[i] = nearest_rotation(wanted);
      const Quat local = conjugate(above) * global[i];
      const Vec3 v = log(normalized(conjugate(layout_.references[i]) * local));
      put(channels, frame, i,
          degrees_per_radian *
              continue_rotation_vector(v, radians_per_degree * vector_at(guide, frame, i)));
    }
  }

 private:
  const SparsePoints& points_;
  const BodyLayout& layout_;
  double stiffness_;
  std::vector<std::vector<std::size_t>> below_;
};

}  // namespace

PoseMatrix channels_of(const SparsePoints& points, const BodyLayout& layout,
                       const PoseMatrix& positions, const PoseMatrix& guide, double stiffness) {
  PoseMatrix channels = guide;
  if (points.kind == BodyKind::markers) {
    for (std::size_t f = 0; f < guide.frames; ++f) {
      for (std::size_t p = 0; p < points.count(); ++p)
        put(channels, f, p, degrees_per_height * (vector_at(positions, f, p) - points.offsets[p]));
    }
    return channels;
  }
  const FrameTurning turning(points, layout, stiffness);
  for_each_parallel(guide.frames, positions.values.size(),
                    [&](std::size_t f) { turning.turn(positions, guide, f, channels); });
  return channels;
}

namespace {

// Sine of the angle at the middle of the hips, and length relative to the distance between them.
// Below these values the points are nearly on a line. Chosen by hand, not swept.
constexpr double least_sine = 0.1;
constexpr double least_length = 1e-9;

Vec3 point(const PoseMatrix& positions, std::size_t frame, std::int32_t number) {
  return vector_at(positions, frame, static_cast<std::size_t>(number));
}

// The turn that brings the axes of a pose to those of the world; none if the points do not
// determine it.
std::optional<Quat> turn_of(const PoseMatrix& positions, const LocalPoints& points,
                            std::size_t frame) {
  const Vec3 left = point(positions, frame, points.left_hip);
  const Vec3 right = point(positions, frame, points.right_hip);
  const Vec3 up = point(positions, frame, points.neck) - 0.5 * (left + right);
  const Vec3 across = left - right;
  const double height = norm(up), width = norm(across);
  const Vec3 ahead = cross(across, up);
  const double size = norm(ahead);
  if (!(height > least_length) || !(width > least_length) || !(size > least_sine * height * width))
    return std::nullopt;
  const Vec3 y = (1 / height) * up, z = (1 / size) * ahead, x = cross(y, z);
  Eigen::Matrix3d rows;
  rows << x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z;
  const Eigen::Quaterniond q(rows);
  return normalized(Quat{q.w(), q.x(), q.y(), q.z()});
}

template <class Change>
void change_all(const std::vector<LocalFrame>& frames, PoseMatrix& positions,
                const Change& change) {
  for (std::size_t f = 0; f < positions.frames; ++f) {
    for (std::size_t c = 0; c + 2 < positions.channels; c += 3) {
      const Vec3 v =
          change(frames[f], Vec3{positions(f, c), positions(f, c + 1), positions(f, c + 2)});
      positions(f, c) = v.x, positions(f, c + 1) = v.y, positions(f, c + 2) = v.z;
    }
  }
}

}  // namespace

std::vector<LocalFrame> local_frames(const PoseMatrix& positions, const LocalPoints& points) {
  std::vector<LocalFrame> frames(positions.frames);
  if (points.root < 0) return frames;
  std::optional<std::size_t> known;  // last frame whose turn is determined
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].origin = point(positions, f, points.root);
    if (points.left_hip < 0 || points.right_hip < 0 || points.neck < 0) continue;
    if (const std::optional<Quat> turn = turn_of(positions, points, f)) {
      frames[f].turn = *turn;
      for (std::size_t g = 0; g < f && !known; ++g) frames[g].turn = *turn;
      known = f;
    } else if (known) {
      frames[f].turn = frames[*known].turn;
    }
  }
  return frames;
}

void to_local(const std::vector<LocalFrame>& frames, PoseMatrix& positions) {
  change_all(frames, positions,
             [](const LocalFrame& frame, Vec3 v) { return rotate(frame.turn, v - frame.origin); });
}

void from_local(const std::vector<LocalFrame>& frames, PoseMatrix& positions) {
  change_all(frames, positions, [](const LocalFrame& frame, Vec3 v) {
    return rotate(conjugate(frame.turn), v) + frame.origin;
  });
}

}  // namespace kinemend
