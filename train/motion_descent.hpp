// The network of the learned cleaner (`learned/corrector/motion_network.hpp`) as it is trained.
// LibTorch is behind this header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sequence_network.hpp"

namespace kinemend::train {

struct MotionShape {
  std::size_t slots = 0;  ///< D, channels of the body
  std::size_t encoded = 24, slot_units = 16, hidden = 192, head = 64;
  std::vector<std::size_t> dilations{1, 2, 4, 8, 1, 2, 16};
  std::size_t second_dilation = 2;  ///< of the encoder's second layer
  bool has_trunk = true;            ///< without one no channel sees another
};

/// B samples of C = D channels and n steps each; as of `MotionSteps`, one sample behind the other,
/// with features of the take at every step.
struct MotionBatch {
  std::size_t samples = 0, channels = 0, steps = 0;
  std::vector<float> features, take_features, levels, changes, scales;
  std::vector<float> truth, truth_changes;  ///< B x C x n
  std::vector<float> alive, known;          ///< B x C, 0 or 1
  std::vector<float> looks_ahead;           ///< B, 0 of samples that are read live
};

/// How errors count.
struct MotionLoss {
  double velocity = 1;         ///< of changes, beside that of values
  double acceleration = 0.25;  ///< of changes of changes
  double likelihood = 0.02;    ///< of the expected variance
  /// Added to the damage that errors are measured by: of values, of changes in 1/120 s, and of how
  /// these change from step to step.
  double floor_deg = 0.15, floor_change_deg = 0.02, floor_bend_deg = 0.02;
};

class MotionDescent {
 public:
  /// `statistics`: mean, deviation and speed of the D channels.
  MotionDescent(const MotionShape& shape, const std::vector<float>& mean,
                const std::vector<float>& deviation, const std::vector<float>& speed,
                const DescentSettings& settings, std::uint64_t seed);
  ~MotionDescent();

  /// One step; returns the loss. Dropout is drawn from `seed`.
  double step(const MotionBatch& batch, const MotionLoss& loss, double rate, std::uint64_t seed);
  /// B x C x n x `motion_outputs`, by the running means of the weights.
  std::vector<float> outputs(const MotionBatch& batch) const;
  /// Of values alone, share of the damage, by the running means.
  double share_left(const MotionBatch& batch, const MotionLoss& loss) const;
  Weights averages() const;
  /// As of `MotionTrainer`.
  void begin_with(const Weights& tensors);
  TensorFile state() const;
  void set_state(const TensorFile& state);

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace kinemend::train
