// Finds the local frame of each pose and moves points to it and back.
#include "papers/xiao2015_sparse/sparse_local.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <optional>

namespace kinemend {

namespace {

// Sine of the angle at the middle of the hips, and length relative to the distance between them.
// Below these values the points are nearly on a line. Chosen by hand, not swept.
constexpr double least_sine = 0.1;
constexpr double least_length = 1e-9;

Vec3 point(const PoseMatrix& positions, std::size_t frame, std::int32_t number) {
  const auto first = 3 * static_cast<std::size_t>(number);
  return {positions(frame, first), positions(frame, first + 1), positions(frame, first + 2)};
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
