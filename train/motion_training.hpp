// Trains the network of the method `learned`.
#pragma once

#include <cstdint>
#include <future>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/experimental/model.hpp"
#include "learned/corrector/motion_samples.hpp"
#include "motion_descent.hpp"

namespace kinemend::train {

/// How the network of the method `learned` is trained.
struct MotionTraining {
  std::uint64_t seed = 1;
  std::size_t batches = 12'000;  ///< steps of the descent
  std::size_t batch = 8;         ///< samples a step
  double rate = 2e-3;            ///< of learning, at its highest
  MotionSampling sampling;
  MotionShape shape;  ///< its slots are those of the takes
  MotionLoss loss;
  DescentSettings descent;
};

/// Samples of `channels` channels and `steps` steps, as a batch.
MotionBatch batch_of(const std::vector<MotionSample>& samples, std::size_t steps);

/// Samples are drawn and damaged beside each step, on a thread of their own, and never again: the
/// takes give as many as are asked for.
class MotionTrainer {
 public:
  MotionTrainer(const TrainingSequences& sequences, std::vector<MotionPair> pairs,
                std::vector<MarkerMotion> markers, std::vector<RigMotion> rigs,
                const MotionTraining& settings);
  ~MotionTrainer();

  std::size_t batch() const noexcept { return batch_; }
  /// One step of the descent; its loss.
  double step();
  /// Share of the damage that is left on samples that are not learned from, drawn by `seed`.
  double share_left(const MotionSources& sources, const MotionSampling& sampling,
                    std::size_t samples, std::uint64_t seed) const;
  const BodyMirror& mirror() const noexcept { return mirror_; }
  /// What the network makes of a batch (`MotionDescent::outputs`).
  std::vector<float> outputs(const MotionBatch& batch) const { return descent_.outputs(batch); }
  /// The model as it is now. Card, takes and seconds are the caller's.
  Model model() const;
  /// Begins with the weights of a model; inputs that it lacks count for nothing, and blocks that it
  /// lacks add nothing. Errors: `ErrorKind::unreadable_input` where its shape is another otherwise.
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
