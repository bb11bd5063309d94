// Trains the networks of Mall et al. 2017 on whole takes, damaged as in their tests.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "kinemend/extend/options.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/take.hpp"
#include "lab/samples/motion_forms.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"
#include "sequence_network.hpp"

namespace kinemend::train {

struct FilterDamage {
  std::string name;  ///< name for `apply_damage`; empty: none
  OptionValues values;
};

/// Settings of a training.
struct FilterTraining {
  std::uint64_t seed = 1;
  std::string kind = "ebf";       ///< ebf, bf, nn, ebd
  std::string head = "gaussian";  ///< gaussian, biased, shape, residual, pose
  std::size_t epochs = 200;
  std::size_t batch = 16;           ///< chunks per step
  std::size_t frames = 128;         ///< frames of a chunk included in the loss
  std::size_t uses = 4;             ///< epochs that use the same damage of the takes
  bool sees_roughness = true;       ///< adds roughness to the paper's inputs (`FilterInputs`)
  bool is_augmented = true;         ///< also trains on mirrored and reversed chunks
  std::vector<FilterDamage> noise;  ///< one of these is drawn for each take
  std::vector<FilterDamage> bias;   ///< one of these is added on top; empty: none
  std::vector<FilterDamage> gaps;   ///< one of these is added; empty: none
  double weight_bound = 0;          ///< `BidirectionalShape`; the paper's is 0.5
  /// The paper has none of these. Filters begin at the best constant width of each channel, with a
  /// last layer of zeros; the loss of a take is divided by its noise; inputs have mean 0 and
  /// deviation 1, else they are radians.
  bool has_head_start = true, scales_loss = true, standardises = true;
  double rate = 5e-4;  ///< peak learning rate; at 2e-3 layers saturate
  DescentSettings descent;
};

class FilterTrainer {
 public:
  /// Takes clean takes at one rate. Errors: `ErrorKind::usage` as in `BodyLayoutBuilder`, for takes
  /// of different rates, an unknown kind or head, and an EBD that filters.
  FilterTrainer(std::vector<Take> takes, const FilterTraining& settings);

  std::size_t batch() const noexcept { return batch_; }
  std::size_t batches() const noexcept {
    return settings_.epochs * chunks_of_epoch_ / settings_.batch;
  }
  /// Makes one step; returns the ratio of the remaining error to the initial one.
  double step();
  /// Mean error on takes outside the training, with fixed damage, relative to the Gaussian of 58
  /// ms; for EBD relative to straight lines in the gaps.
  double share_left(const std::vector<Take>& takes) const;
  /// The current model. The caller sets the card.
  Model model() const;
  std::string checkpoint() const;
  void resume(std::string_view bytes, std::string_view name);
  /// Starts with the weights of another training's model.
  void begin_with(const Model& model);

 private:
  struct Sample {
    FilterTake take;
    std::vector<float> truth;  // F x C
    double scale = 1;          // mean error before training, degrees
  };
  struct Chunk {
    std::size_t take = 0;
    std::ptrdiff_t first = 0;  // frame of the first row, which may lie before the take
    MotionForm form;
  };
  struct Rows {
    FilterTake take;            // rows of a chunk
    std::vector<float> truth;   // same size as the take's values
    std::vector<float> weight;  // per row; 0 for padding
  };

  bool fills() const noexcept { return !settings_.gaps.empty(); }
  FilterInputs inputs() const noexcept { return {settings_.sees_roughness, fills()}; }
  Sample sample_of(const Take& clip, Random random) const;
  void damage_takes(std::size_t round);
  FilterSignal signal_of(const FilterTake& take) const;
  /// Returns whether the loss includes a sample: only missing samples when gaps are filled without
  /// predicting poses, else all.
  bool counts(const FilterTake& take, std::size_t sample) const;
  /// The value of a sample before training: the input, or the mean if poses are predicted.
  float before_training(const FilterTake& take, std::size_t sample) const;
  /// Logarithms of the best constant widths, one per channel.
  std::vector<double> best_constants();
  std::vector<Chunk> chunks_of(std::size_t epoch) const;
  Rows rows_of(const Chunk& chunk) const;
  std::vector<float> apply(const FilterTake& take) const;

  std::vector<Take> takes_;
  FilterTraining settings_;
  BodyLayout layout_;
  BodyMirror mirror_;  // mirror of the joints below the root
  double rate_hz_ = 0, seconds_ = 0;
  FilterStatistics statistics_;
  FilterHead head_ = FilterHead::gaussian;
  BidirectionalShape shape_;
  std::size_t stride_ = 1, margin_ = predicted_filter_reach, chunks_of_epoch_ = 0;
  std::unique_ptr<SequenceNetwork> network_;
  std::vector<Sample> samples_;
  std::size_t round_ = 0;  // round of the current samples, plus 1
  std::size_t batch_ = 0;
};

}  // namespace kinemend::train
