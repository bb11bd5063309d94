// Trains the network of the learned cleaner (`methods/learned/motion_network.hpp`). LibTorch is
// hidden behind this header.
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
  bool has_trunk = true;            ///< false: channels do not see one another
};

/// B samples of C = D channels and n steps each, in the form of `MotionSteps`, one sample after the
/// other, with features of the take at every step.
struct MotionBatch {
  std::size_t samples = 0, channels = 0, steps = 0;
  std::vector<float> features, take_features, levels, changes, scales;
  std::vector<float> truth, truth_changes;  ///< B x C x n
  std::vector<float> alive, known;          ///< B x C, 0 or 1
  std::vector<float> looks_ahead;           ///< B, 0 for samples read live
};

/// Weights of the errors.
struct MotionLoss {
  double velocity = 1;         ///< weight of changes; values have 1
  double acceleration = 0.25;  ///< weight of changes of changes
  double likelihood = 0.02;    ///< weight of the expected variance
  /// Added to the damage by which errors are scaled: for values, for changes in 1/120 s, and for
  /// changes of these between steps.
  double floor_deg = 0.15, floor_change_deg = 0.02, floor_bend_deg = 0.02;
};

class MotionDescent {
 public:
  /// `mean`, `deviation` and `speed` are statistics of the D channels.
  MotionDescent(const MotionShape& shape, const std::vector<float>& mean,
                const std::vector<float>& deviation, const std::vector<float>& speed,
                const DescentSettings& settings, std::uint64_t seed);
  ~MotionDescent();

  /// Makes one step and returns the loss. `seed` determines dropout.
  double step(const MotionBatch& batch, const MotionLoss& loss, double rate, std::uint64_t seed);
  /// B x C x n x `motion_outputs`, with the running means of the weights.
  std::vector<float> outputs(const MotionBatch& batch) const;
  /// Remaining share of the damage of values only, with the running means.
  double share_left(const MotionBatch& batch, const MotionLoss& loss) const;
  Weights averages() const;
  /// As `MotionTrainer::begin_with`.
  void begin_with(const Weights& tensors);
  TensorFile state() const;
  void set_state(const TensorFile& state);

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace kinemend::train
