// Turns tracks of rotations into columns of a matrix without a body, and back.
#include "body/representation.hpp"

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"

namespace kinemend {

namespace {

void encode_tangent(std::span<const Quat> track, Quat reference, PoseMatrix& channels,
                    std::size_t first) {
  Vec3 previous;
  for (std::size_t f = 0; f < track.size(); ++f) {
    const Vec3 v = log(conjugate(reference) * track[f]);
    previous = f == 0 ? v : continue_rotation_vector(v, previous);
    double* row = channels.row(f).data() + first;
    row[0] = previous.x, row[1] = previous.y, row[2] = previous.z;
  }
}

void encode_quaternion(std::span<const Quat> track, PoseMatrix& channels, std::size_t first) {
  SignContinuation sign;
  for (std::size_t f = 0; f < track.size(); ++f) {
    const Quat q = sign.next(track[f]);
    double* row = channels.row(f).data() + first;
    row[0] = q.w, row[1] = q.x, row[2] = q.y, row[3] = q.z;
  }
}

}  // namespace

Quat mean_rotation(std::span<const Quat> track, std::span<const std::uint8_t> observed) {
  if (observed.empty()) return chordal_mean(track);
  std::vector<Quat> seen;
  for (std::size_t f = 0; f < track.size(); ++f) {
    if (observed[f] != 0) seen.push_back(track[f]);
  }
  return seen.empty() && !track.empty() ? track[0] : chordal_mean(seen);
}

Vec3 continue_rotation_vector(Vec3 v, Vec3 previous) {
  const double angle = norm(v);
  // An identity has no axis of its own: any sphere of whole turns represents it, and the nearest
  // point lies along `previous`.
  if (angle == 0) {
    const double length = norm(previous);
    const double turns = std::round(length / (2 * pi));
    return turns == 0 ? v : (turns * 2 * pi / length) * previous;
  }
  const double turns = std::round((dot(previous, v) / angle - angle) / (2 * pi));
  return turns == 0 ? v : ((angle + 2 * pi * turns) / angle) * v;
}

Quat SignContinuation::next(Quat q) {
  constexpr double near = 0.866;  // cosine of half of 60 degrees, `steady_rad`
  if (frames_away_ < 0) {
    frames_away_ = 0;
    return previous_ = steady_ = q;
  }
  const double to_previous = dot(q, previous_), to_steady = dot(q, steady_);
  const double nearest = std::fabs(to_steady) > std::fabs(to_previous) ? to_steady : to_previous;
  previous_ = nearest < 0 ? -q : q;
  if (std::fabs(to_steady) >= near || ++frames_away_ > patience_frames) {
    steady_ = previous_;
    frames_away_ = 0;
  }
  return previous_;
}

Encoding suitable_encoding(std::span<const Quat> track, std::span<const std::uint8_t> observed) {
  const Quat mean = mean_rotation(track, observed);
  double least = 1;
  for (std::size_t f = 0; f < track.size(); ++f) {
    if (observed.empty() || observed[f] != 0)
      least = std::min(least, std::fabs(dot(mean, track[f])));
  }
  return 2 * portable::acos(least) < tangent_limit_rad ? Encoding::tangent : Encoding::quaternion;
}

void encode_rotations(std::span<const Quat> track, Encoding encoding, Quat reference,
                      PoseMatrix& channels, std::size_t first) {
  if (encoding == Encoding::tangent) {
    encode_tangent(track, reference, channels, first);
  } else {
    encode_quaternion(track, channels, first);
  }
}

Quat decode_rotation(const PoseMatrix& channels, Encoding encoding, Quat reference,
                     std::size_t frame, std::size_t first) {
  const double* v = channels.row(frame).data() + first;
  if (encoding == Encoding::tangent) return normalized(reference * exp({v[0], v[1], v[2]}));
  return normalized({v[0], v[1], v[2], v[3]});
}

}  // namespace kinemend
