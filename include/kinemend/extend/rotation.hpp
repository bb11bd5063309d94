// Vectors, rotations as unit quaternions, and Euler angles.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace kinemend {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double degrees_per_radian = 180.0 / pi;
inline constexpr double radians_per_degree = pi / 180.0;

/// A vector or a point in three dimensions.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }

/// A quaternion w + xi + yj + zk; a rotation when its norm is 1 (within 1e-9 for every function
/// below that takes a rotation). q and -q are the same rotation. a * b rotates by b first, then by
/// a.
struct Quat {
  double w = 1, x = 0, y = 0, z = 0;
  friend bool operator==(const Quat&, const Quat&) = default;
};

inline Quat operator*(Quat a, Quat b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
inline Quat operator-(Quat q) { return {-q.w, -q.x, -q.y, -q.z}; }
inline Quat operator+(Quat a, Quat b) { return {a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Quat operator*(double s, Quat q) { return {s * q.w, s * q.x, s * q.y, s * q.z}; }
inline double dot(Quat a, Quat b) { return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; }
inline double norm(Quat q) { return std::sqrt(dot(q, q)); }
/// The inverse rotation (of a unit quaternion).
inline Quat conjugate(Quat q) { return {q.w, -q.x, -q.y, -q.z}; }
/// The nearest unit quaternion; identity for the zero quaternion.
Quat normalized(Quat q);
/// R(q) v.
Vec3 rotate(Quat q, Vec3 v);

/// Exp: rotation vector (axis times angle, radians) to rotation. Accurate at and near 0.
Quat exp(Vec3 rotation_vector);
/// Log: rotation to the shortest rotation vector, |Log(q)| in [0, pi]. Log(-q) = Log(q) except at
/// exactly pi, where both signs of the axis are correct. Accurate at and near 0 and pi. Papers that
/// use the logarithm of the quaternion itself (Dean, Courty) mean half of this vector.
Vec3 log(Quat q);
/// |Log(a^-1 b)| in radians, [0, pi]: the length of the geodesic. Exact for small angles.
double angle_between(Quat a, Quat b);
/// a Exp(t Log(a^-1 b)): t = 0 gives a, t = 1 gives b (up to sign).
Quat slerp(Quat a, Quat b, double t);
/// q or -q, whichever is nearer to `reference`.
inline Quat align_hemisphere(Quat q, Quat reference) { return dot(q, reference) < 0 ? -q : q; }
/// Chooses the signs of a whole track so that each sample is nearest to the one before. `stride` is
/// the distance between successive samples in `track`, so that one joint of a frame-major block can
/// be aligned in place.
void align_hemispheres(std::span<Quat> track, std::size_t stride = 1);

/// Karcher mean: the rotation with the least sum of squared geodesic distances, sum_i w_i Log(m^-1
/// q_i) = 0. `weights` is empty (all equal) or has one weight per rotation, not negative, not all
/// zero. Gauss-Newton from the chordal mean; unique when the rotations lie within a ball of radius
/// pi / 2. Identity for no rotations.
Quat karcher_mean(std::span<const Quat> rotations, std::span<const double> weights = {});
/// Log-space mean about a reference: r Exp(sum_i w_i Log(r^-1 q_i) / sum_i w_i), one step of the
/// Karcher iteration.
Quat log_mean(Quat reference, std::span<const Quat> rotations,
              std::span<const double> weights = {});
/// The eigenvector of sum_i w_i q_i q_i^T with the largest eigenvalue: the chordal mean, which does
/// not depend on signs.
Quat chordal_mean(std::span<const Quat> rotations, std::span<const double> weights = {});

enum class Axis : std::uint8_t { x, y, z };

/// The axes of up to three successive rotations about the joint's own (moving) axes, in channel
/// order. `ZXY` means R = Rz(a0) Rx(a1) Ry(a2): the product is written left to right, so the last
/// rotation acts on a vector first. Neighbouring axes differ. Fewer than three axes describe hinges
/// and saddle joints.
struct RotationOrder {
  std::array<Axis, 3> axes{};
  std::uint8_t count = 0;
  friend bool operator==(const RotationOrder&, const RotationOrder&) = default;
};

/// The 12 orders of three axes: six with three different axes, and six whose last axis repeats the
/// first.
std::span<const RotationOrder> all_rotation_orders();
/// Parses one to three letters such as `"ZXY"`, in any case. Errors: `ErrorKind::usage`.
RotationOrder parse_rotation_order(std::string_view text);
std::string to_string(RotationOrder order);

/// R = R_axis0(angles[0]) R_axis1(angles[1]) R_axis2(angles[2]); radians, any size; entries past
/// `count` are ignored.
Quat from_euler(const std::array<double, 3>& angles, RotationOrder order);
/// The angles (radians) of `rotation` in `order` that lie nearest to `previous`, so that a sequence
/// has no 360-degree jumps and no flips. Among the two branches and all whole turns it takes the
/// angles whose largest change is smallest; in gimbal lock it changes the two locked angles least.
/// With one or two axes, the result is the angles of the nearest rotation (in geodesic distance)
/// that the axes can express.
std::array<double, 3> to_euler_near(Quat rotation, RotationOrder order,
                                    const std::array<double, 3>& previous);
/// `to_euler_near` with `previous` all zero, which gives the usual ranges.
std::array<double, 3> to_euler(Quat rotation, RotationOrder order);

/// angle - 360 k (or 2 pi k), in [-half_turn, half_turn).
double wrap_angle(double angle, double half_turn);

}  // namespace kinemend
