// The basic operations on rotations: exponential and logarithm, angles, slerp, and signs of tracks.
#include "kinemend/rotation.hpp"

#include <algorithm>
#include <numeric>

#include "base/portable.hpp"

namespace kinemend {

Quat normalized(Quat q) {
  double length = norm(q);
  if (!(length > 1e-150 && length < 1e150)) {
    // The squares may overflow or underflow.
    const double largest =
        std::max({std::fabs(q.w), std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)});
    if (!(largest > 0 && std::isfinite(largest))) return {};
    q = {q.w / largest, q.x / largest, q.y / largest, q.z / largest};
    length = norm(q);
  }
  return length > 0 ? (1.0 / length) * q : Quat{};
}

Vec3 rotate(Quat q, Vec3 v) {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}

Quat exp(Vec3 rotation_vector) {
  const double angle = norm(rotation_vector);
  // sin(angle / 2) / angle, by its series if the quotient would lose digits.
  const auto [sine, cosine] = portable::sine_and_cosine(angle / 2);
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48 : sine / angle;
  return {cosine, scale * rotation_vector.x, scale * rotation_vector.y, scale * rotation_vector.z};
}

Vec3 log(Quat q) {
  if (q.w < 0) q = -q;
  const Vec3 axis{q.x, q.y, q.z};
  const double sine = norm(axis);
  // angle / sin(angle / 2); atan2 keeps all digits at 0 and at pi.
  const double scale = sine < 1e-8 ? 2.0 / q.w : 2 * portable::atan2(sine, q.w) / sine;
  return scale * axis;
}

double angle_between(Quat a, Quat b) {
  // The vector part of a^-1 b, its terms paired so that it is exactly zero for equal quaternions.
  const Vec3 d{(a.w * b.x - a.x * b.w) - (a.y * b.z - a.z * b.y),
               (a.w * b.y - a.y * b.w) - (a.z * b.x - a.x * b.z),
               (a.w * b.z - a.z * b.w) - (a.x * b.y - a.y * b.x)};
  return 2 * portable::atan2(norm(d), std::fabs(dot(a, b)));
}

Quat slerp(Quat a, Quat b, double t) { return a * exp(t * log(conjugate(a) * b)); }

void align_hemispheres(std::span<Quat> track, std::size_t stride) {
  for (std::size_t i = stride; i < track.size(); i += stride) {
    track[i] = align_hemisphere(track[i], track[i - stride]);
  }
}

double wrap_angle(double angle, double half_turn) {
  return angle - 2 * half_turn * std::floor((angle + half_turn) / (2 * half_turn));
}

}  // namespace kinemend
