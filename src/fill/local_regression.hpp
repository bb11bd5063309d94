// Predicts a marker from its companions in the frame of reference that moves with them.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "fill/bridge.hpp"
#include "fill/marker_group.hpp"
#include "fill/ridge.hpp"

namespace kinemend::fill {

/// Predicts a marker from its companions: the markers that keep their distance to it. In the frame
/// of reference that moves with the companions, `ridge_regression` predicts the marker's
/// coordinates from theirs, over the frames of the take in which all are seen. Rows hold three
/// coordinates, or those of all companions. With infinite stiffness the companions and the marker
/// are one rigid body.
class LocalRegression {
 public:
  /// Learns from at most 192 frames outside the gap, with the first `most_companions` of the given
  /// ones (`companions_of`).
  LocalRegression(const Samples& samples, const MarkerGap& gap,
                  std::span<const Companion> companions, std::size_t most_companions);

  /// Whether there are companions and enough frames to learn from.
  bool usable() const { return training_.frames.size() >= least_training_frames; }
  const MarkerGroup& group() const { return group_; }

  /// A span of the take to predict: its companions' samples, and the marker's samples beside it.
  struct Scene {
    FrameSpan span = {};
    std::vector<std::size_t> beside;  ///< observed frames near the span, ascending
    std::vector<std::size_t> wanted;  ///< frames of the span
    std::vector<Placement> placed;    ///< placements of the frames beside, then of the wanted ones
    Rows inputs;  ///< in the same order: the companions' coordinates about their shape
    Rows seen;    ///< the marker's own coordinates in the frames beside
  };
  /// `gap`: of the same marker.
  Scene scene_of(const MarkerGap& gap, std::span<const std::size_t> wanted) const;

  /// Returns the marker's coordinates in all frames of the scene for each stiffness (file units;
  /// infinity: rigid), by regression on the frames outside its span.
  std::vector<Rows> predict(const Scene& scene, std::span<const double> stiffness) const;
  /// Returns the bridge that carries errors beside the scene's span into it.
  Bridge bridge_of(const Scene& scene, const Bridge::Settings& settings = {}) const;
  /// Returns positions in the wanted frames: the coordinates, moved so that they meet the ends.
  static std::vector<Vec3> meet_ends(const Scene& scene, const Bridge& bridge,
                                     const Rows& coordinates);

  /// The companions' coordinates about their shape, and the marker's, in the training frames.
  Rows training_inputs() const;
  Rows training_outputs() const;

  // Not swept.
  static constexpr std::size_t least_training_frames = 8;  // fewer cannot test a model

 private:
  Placement put_inputs(std::size_t frame, double* row) const;
  void learn();
  Eigen::Index inputs() const { return static_cast<Eigen::Index>(3 * group_.markers().size()); }

  const Samples& samples_;
  std::size_t marker_;
  MarkerGroup group_;
  TrainingRows training_;  // columns: 1, inputs, outputs
};

/// Returns the stiffnesses as shares of the body's radius; the last is rigid. Chosen on the takes
/// that docs/methods/fill.md names.
inline std::array<double, 3> stiffnesses_of(double radius) {
  return {0.0015 * radius, 0.008 * radius, std::numeric_limits<double>::infinity()};
}

}  // namespace kinemend::fill
