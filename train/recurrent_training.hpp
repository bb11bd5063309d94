#pragma once

#include <cstdint>
#include <string>

#include "kinemend/experimental/model.hpp"
#include "priors/recurrent_samples.hpp"
#include "sequence_network.hpp"

namespace kinemend::train {

/// How the network of the method `recurrent` is trained.
struct RecurrentTraining {
  std::uint64_t seed = 1;
  std::size_t batches = 20'000;  ///< steps of the descent
  std::size_t batch = 8;         ///< samples a step
  std::size_t frames = 512;      ///< of a sample
  std::size_t pool = 256;        ///< samples that are damaged at once
  std::size_t uses = 4;          ///< of a damaged sample: as it is, mirrored, backwards, both
  std::size_t hidden = 192;
  std::vector<std::size_t> dilations{1, 2, 4, 8};
  double offset_deg = 5;    ///< of the bodies that samples are made to be of, a channel
  double most_scale = 1.2;  ///< of their motion
  double rate = 1.5e-3;     ///< of learning, at its highest
  DescentSettings descent;
};

class RecurrentTrainer {
 public:
  RecurrentTrainer(const TrainingSequences& sequences, const RecurrentTraining& settings);

  std::size_t batch() const noexcept { return batch_; }
  /// One step of the descent; its loss.
  double step();
  /// What the network makes of features now (T x outputs).
  std::vector<float> outputs(std::span<const float> features) const {
    return network_.run(features);
  }
  /// Share of the error of `auto` that is left on a sample: root of mean squares.
  double share_left(const RecurrentSample& sample) const;
  /// The model as it is now. Card, takes and seconds are the caller's.
  Model model() const;
  /// Everything that is needed to go on: with the same takes and settings, to the same result.
  std::string checkpoint() const;
  void resume(std::string_view bytes, std::string_view name);

 private:
  void fill_pool(std::size_t round);

  const TrainingSequences& sequences_;
  RecurrentTraining settings_;
  RecurrentStatistics statistics_;
  BodyMirror mirror_;
  SequenceNetwork network_;
  std::vector<RecurrentSample> pool_;
  std::size_t pool_round_ = 0;  // of the pool at hand, plus 1
  std::size_t batch_ = 0;
};

}  // namespace kinemend::train
