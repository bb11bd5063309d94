// Splits matrices into translation, rotation and scale.
#include "io/gltf/gltf_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kinemend {

namespace {

// Returns the rotation of three orthonormal columns by Shepperd's method, which starts from the
// largest of the four parts.
Quat rotation_of_axes(const std::array<Vec3, 3>& c) {
  const double xx = c[0].x, yy = c[1].y, zz = c[2].z;
  const std::array<double, 4> parts{xx + yy + zz, xx, yy, zz};
  const auto largest = std::max_element(parts.begin(), parts.end()) - parts.begin();
  const double xy = c[0].y + c[1].x, yz = c[1].z + c[2].y, zx = c[2].x + c[0].z;
  const Vec3 odd{c[1].z - c[2].y, c[2].x - c[0].z, c[0].y - c[1].x};
  switch (largest) {
    case 0:
      return normalized({1 + parts[0], odd.x, odd.y, odd.z});
    case 1:
      return normalized({odd.x, 1 + xx - yy - zz, xy, zx});
    case 2:
      return normalized({odd.y, xy, 1 + yy - xx - zz, yz});
    default:
      return normalized({odd.z, zx, yz, 1 + zz - xx - yy});
  }
}

// Orthonormalises by Gram-Schmidt; an axis of length 0 gets a substitute direction.
std::array<Vec3, 3> orthonormal(const std::array<Vec3, 3>& columns) {
  const auto unit = [](Vec3 v, Vec3 otherwise) {
    const double length = norm(v);
    return length > 0 && std::isfinite(length) ? (1 / length) * v : otherwise;
  };
  const Vec3 x = unit(columns[0], {1, 0, 0});
  const Vec3 aside = std::fabs(x.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 y = unit(columns[1] - dot(x, columns[1]) * x, unit(cross(x, aside), {0, 1, 0}));
  return {x, y, cross(x, y)};
}

}  // namespace

Quat unit_rotation_of_any(Quat q) {
  const double largest = std::max({std::fabs(q.w), std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  return normalized((1 / largest) * q);
}

GltfPlacement placement_of_matrix(std::span<const double> m) {
  // Chosen by hand, not swept.
  constexpr double least_shear = 1e-4;  // share of the lengths of the axes
  const std::array<Vec3, 3> columns{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}};
  const bool mirrors = dot(cross(columns[0], columns[1]), columns[2]) < 0;
  const double sign = mirrors ? -1 : 1;
  const std::array<Vec3, 3> turned{{sign * columns[0], sign * columns[1], sign * columns[2]}};
  const std::array<Vec3, 3> axes = orthonormal(turned);
  GltfPlacement placement;
  placement.translation = {m[12], m[13], m[14]};
  placement.rotation = rotation_of_axes(axes);
  placement.scale = sign * Vec3{norm(columns[0]), norm(columns[1]), norm(columns[2])};
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = norm(columns[i]);
    placement.is_sheared |= norm(turned[i] - length * axes[i]) > least_shear * length;
  }
  return placement;
}

}  // namespace kinemend
