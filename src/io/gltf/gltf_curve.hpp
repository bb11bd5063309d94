// Holds the keys of an animation's channel, gives its value at any time, and finds the frames of an
// animation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "io/gltf/gltf_data.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// A channel of an animation, decoded. Keys that are not finite hold a neighbour.
struct GltfCurve {
  GltfInterpolation interpolation = GltfInterpolation::linear;
  std::size_t width = 0;                             ///< 3, or 4 for a rotation (x, y, z, w)
  std::shared_ptr<const std::vector<double>> clock;  ///< times of the keys; curves may share them
  std::vector<double> values;  ///< keys x width; for splines keys x 3 x width, as in the file
  /// 1 for a key whose value was not finite; empty: all were finite.
  std::vector<std::uint8_t> held;

  std::size_t keys() const { return clock == nullptr ? 0 : clock->size(); }
  /// Seconds, ascending; at least one key.
  const std::vector<double>& times() const { return *clock; }
  std::size_t parts() const {
    return interpolation == GltfInterpolation::cubic_spline ? 3 * width : width;
  }
  /// Returns the value of a key, after its in-tangent.
  const double* value(std::size_t key) const {
    return values.data() + key * parts() + (parts() == width ? 0 : width);
  }
  Vec3 vector(std::size_t key) const { return {value(key)[0], value(key)[1], value(key)[2]}; }
  Quat rotation(std::size_t key) const;
};

/// Times of keys that were read, by accessor.
using GltfClocks = std::map<std::size_t, std::shared_ptr<const std::vector<double>>>;

/// Reads a curve. Errors: `unreadable_input` for times that are not finite or descend, and if the
/// numbers of values and keys differ.
GltfCurve read_gltf_curve(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                          const GltfSampler& sampler, GltfPath path, GltfClocks& clocks);

/// Whether all keys have the same value, bit by bit.
bool is_constant(const GltfCurve& curve);

/// The times `start_s` + i / rate of `count` values. Times within `tolerance_s` of a key have the
/// key's value. Before the first key and after the last the curve is constant.
struct GltfTimes {
  double start_s = 0, rate_hz = 30;
  std::size_t count = 0;
  double tolerance_s = 0;

  double at(std::size_t frame) const { return start_s + static_cast<double>(frame) / rate_hz; }
};
std::vector<Vec3> vectors_at(const GltfCurve& curve, const GltfTimes& times);
std::vector<Quat> rotations_at(const GltfCurve& curve, const GltfTimes& times);

/// Whether key i is frame i, for all keys and all frames.
bool has_key_each_frame(const GltfCurve& curve, const GltfTimes& times);

struct GltfGrid {
  GltfTimes times;
  bool is_of_keys = true;  ///< every key of a moving channel lies on a frame
  /// The keys do not define a rate, because there are fewer than two times.
  bool is_assumed = false;
};

/// Returns the coarsest grid of frames that contains all keys of the curves: the keys' own spacing
/// if they are evenly spaced (half of the frames may lack keys), else a usual rate. Keys may
/// deviate by a tenth of a frame and a millisecond, because decimals and single precision round
/// them. Without such a grid the rate is `rate_hz`, or 30 Hz if it is 0. Constant curves are used
/// only if all curves are constant.
GltfGrid grid_of_curves(const std::vector<const GltfCurve*>& curves, double rate_hz);

}  // namespace kinemend
