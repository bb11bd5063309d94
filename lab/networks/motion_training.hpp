// Trains the network of the method `learned`.
#pragma once

#include <cstdint>
#include <future>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "lab/samples/motion_samples.hpp"
#include "motion_descent.hpp"

namespace kinemend::train {

/// Settings of training the network of the method `learned`.
struct MotionTraining {
  std::uint64_t seed = 1;
  std::size_t batches = 12'000;  ///< steps of the descent
  std::size_t batch = 8;         ///< samples per step
  double rate = 2e-3;            ///< peak learning rate
  MotionSampling sampling;
  MotionShape shape;  ///< its slots are set by the takes
  MotionLoss loss;
  DescentSettings descent;
};

/// Samples of `channels` channels and `steps` steps, as a batch.
MotionBatch batch_of(const std::vector<MotionSample>& samples, std::size_t steps);

/// Samples are drawn and damaged on a separate thread during each step and never reused; the takes
/// give any number of samples.
class MotionTrainer {
 public:
  MotionTrainer(const TrainingSequences& sequences, std::vector<MotionPair> pairs,
                std::vector<MarkerMotion> markers, std::vector<RigMotion> rigs,
                const MotionTraining& settings);
  ~MotionTrainer();

  std::size_t batch() const noexcept { return batch_; }
  /// Makes one step and returns its loss.
  double step();
  /// Remaining share of the damage on samples outside the training, drawn with `seed`.
  double share_left(const MotionSources& sources, const MotionSampling& sampling,
                    std::size_t samples, std::uint64_t seed) const;
  const BodyMirror& mirror() const noexcept { return mirror_; }
  /// Outputs of the network for a batch (`MotionDescent::outputs`).
  std::vector<float> outputs(const MotionBatch& batch) const { return descent_.outputs(batch); }
  /// The current model. The caller sets card, takes and seconds.
  Model model() const;
  /// Starts with the weights of a model. Inputs and blocks that it lacks have no effect at first.
  /// Errors: `ErrorKind::unreadable_input` if its shape differs otherwise.
  void begin_with(const Model& model) { descent_.begin_with(model.tensors); }
  std::string checkpoint() const;
  void resume(std::string_view bytes, std::string_view name);

 private:
  MotionBatch drawn(std::size_t batch) const;

  const TrainingSequences& sequences_;
  std::vector<MotionPair> pairs_;
  std::vector<MarkerMotion> markers_;
  std::vector<RigMotion> rigs_;
  MotionTraining settings_;
  MotionStatistics statistics_;
  BodyMirror mirror_;
  MotionDescent descent_;
  std::future<MotionBatch> next_;
  std::size_t next_number_ = 0, batch_ = 0;
};

/// `kinemend-train learned ...`. Returns the exit code.
int motion_program(int count, char** values);

}  // namespace kinemend::train
