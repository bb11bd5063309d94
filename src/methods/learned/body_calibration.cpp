// Finds the mean rotation of each joint in the body's frame, and converts channels with it.
#include "methods/learned/body_calibration.hpp"

#include <cstddef>
#include <span>

#include "body/body_rotations.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

namespace {

Vec3 vector_at(const PoseMatrix& poses, std::size_t frame, std::size_t joint) {
  const std::size_t c = 3 * joint;
  return radians_per_degree * Vec3{poses(frame, c), poses(frame, c + 1), poses(frame, c + 2)};
}

// Multiplies the rotations of joints by `left` and `right`.
PoseMatrix turned(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                  std::span<const Quat> left, std::span<const Quat> right) {
  PoseMatrix result = poses;
  std::vector<Vec3> vectors(poses.frames);
  for (std::size_t j = 0; j < layout.track_count(); ++j) {
    const Quat reference = layout.references[j];
    const Quat before = conjugate(reference) * left[j] * reference;
    for (std::size_t f = 0; f < poses.frames; ++f)
      vectors[f] = log(normalized(before * exp(vector_at(poses, f, j)) * right[j]));
    representation::continue_vectors(vectors, rate_hz);
    for (std::size_t f = 0; f < poses.frames; ++f) {
      const Vec3 v = degrees_per_radian * vectors[f];
      double* const to = &result(f, 3 * j);
      to[0] = v.x, to[1] = v.y, to[2] = v.z;
    }
  }
  return result;
}

Quat parent_turn(const BodyLayout& layout, const BodyCalibration& calibration, std::size_t joint) {
  const std::int32_t parent = layout.parents[joint];
  return parent < 0 ? Quat{} : calibration.turns[static_cast<std::size_t>(parent)];
}

}  // namespace

BodyCalibration calibration_of(const PoseMatrix& poses, const BodyLayout& layout) {
  const std::size_t joints = layout.track_count();
  std::vector<Quat> sums(joints, Quat{0, 0, 0, 0}), globals(joints), learned(joints);
  const auto follow = [&](std::size_t j, Quat local, const std::vector<Quat>& of) {
    const std::int32_t parent = layout.parents[j];
    return parent < 0 ? local : of[static_cast<std::size_t>(parent)] * local;
  };
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      globals[j] = follow(j, layout.references[j] * exp(vector_at(poses, f, j)), globals);
      const Quat q = f == 0 ? globals[j] : align_hemisphere(globals[j], sums[j]);
      sums[j] = {sums[j].w + q.w, sums[j].x + q.x, sums[j].y + q.y, sums[j].z + q.z};
    }
  }
  BodyCalibration calibration;
  for (std::size_t j = 0; j < joints; ++j) {
    learned[j] = follow(j, layout.references[j], learned);
    calibration.turns.push_back(normalized(conjugate(normalized(sums[j])) * learned[j]));
  }
  return calibration;
}

PoseMatrix calibrated(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                      const BodyCalibration& calibration) {
  std::vector<Quat> left;
  for (std::size_t j = 0; j < layout.track_count(); ++j)
    left.push_back(conjugate(parent_turn(layout, calibration, j)));
  return turned(poses, rate_hz, layout, left, calibration.turns);
}

PoseMatrix uncalibrated(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                        const BodyCalibration& calibration) {
  std::vector<Quat> left, right;
  for (std::size_t j = 0; j < layout.track_count(); ++j) {
    left.push_back(parent_turn(layout, calibration, j));
    right.push_back(conjugate(calibration.turns[j]));
  }
  return turned(poses, rate_hz, layout, left, right);
}

}  // namespace kinemend
