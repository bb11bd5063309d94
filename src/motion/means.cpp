// Computes means of rotations: chordal, Karcher's, and in a tangent space.
#include "motion/leading_eigenvector.hpp"

#include <array>

#include "kinemend/rotation.hpp"

namespace kinemend {

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
