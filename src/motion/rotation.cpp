// Implements the basic operations on rotations: exponential and logarithm, angles, slerp, signs of
// tracks, and means (chordal, Karcher's, and in a tangent space).
#include "motion/rotation.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/portable.hpp"
#include "kinemend/extend/rotation.hpp"

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

namespace {

double weight_of(std::span<const double> weights, std::size_t i) {
  return weights.empty() ? 1.0 : weights[i];
}

// sum_i w_i Log(r^-1 q_i) / sum_i w_i
Vec3 mean_tangent(Quat reference, std::span<const Quat> rotations,
                  std::span<const double> weights) {
  Vec3 sum;
  double total = 0;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const double w = weight_of(weights, i);
    sum += w * log(conjugate(reference) * rotations[i]);
    total += w;
  }
  return total > 0 ? (1 / total) * sum : Vec3{};
}

}  // namespace

Quat chordal_mean(std::span<const Quat> rotations, std::span<const double> weights) {
  if (rotations.empty()) return {};
  rotation::Matrix4 moment{};
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const std::array<double, 4> q{rotations[i].w, rotations[i].x, rotations[i].y, rotations[i].z};
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = 0; c < 4; ++c) moment[r][c] += weight_of(weights, i) * q[r] * q[c];
    }
  }
  return rotation::leading_eigenvector(moment, rotations.front());
}

Quat log_mean(Quat reference, std::span<const Quat> rotations, std::span<const double> weights) {
  return normalized(reference * exp(mean_tangent(reference, rotations, weights)));
}

Quat karcher_mean(std::span<const Quat> rotations, std::span<const double> weights) {
  Quat mean = chordal_mean(rotations, weights);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Vec3 step = mean_tangent(mean, rotations, weights);
    mean = normalized(mean * exp(step));
    if (norm(step) < 1e-14) break;
  }
  return mean;
}

}  // namespace kinemend

namespace kinemend::rotation {

Quat leading_eigenvector(Matrix4 matrix, Quat fallback) {
  // Repeated squaring, with the trace kept at 1, leaves the projection on the leading eigenvector.
  const double size = matrix[0][0] + matrix[1][1] + matrix[2][2] + matrix[3][3];
  if (!(size > 0)) return normalized(fallback);
  for (auto& row : matrix) {
    for (double& entry : row) entry /= size;
  }
  for (int squaring = 0; squaring < 48; ++squaring) {
    Matrix4 square{};
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = r; c < 4; ++c) {
        for (std::size_t k = 0; k < 4; ++k) square[r][c] += matrix[r][k] * matrix[c][k];
      }
    }
    const double trace = square[0][0] + square[1][1] + square[2][2] + square[3][3];
    const double scale = 1 / trace;
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = r; c < 4; ++c) matrix[r][c] = matrix[c][r] = scale * square[r][c];
    }
    if (trace > 1 - 1e-15) break;  // the matrix has rank one
  }
  std::size_t largest = 0;
  for (std::size_t r = 1; r < 4; ++r) {
    if (matrix[r][r] > matrix[largest][largest]) largest = r;
  }
  const auto& row = matrix[largest];
  return normalized({row[0], row[1], row[2], row[3]});
}

}  // namespace kinemend::rotation
