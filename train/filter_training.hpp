// Trains the networks of Mall et al. 2017 on whole takes, damaged as in their tests.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/random.hpp"
#include "kinemend/options.hpp"
#include "kinemend/take.hpp"
#include "learned/core/motion_forms.hpp"
#include "learned/papers/filter_network.hpp"
#include "sequence_network.hpp"

namespace kinemend::train {

struct FilterDamage {
  std::string name;  ///< of `apply_damage`; empty: none
  OptionValues values;
};

/// How they are trained.
struct FilterTraining {
  std::uint64_t seed = 1;
  std::string kind = "ebf";       ///< ebf, bf, nn, ebd
  std::string head = "gaussian";  ///< gaussian, biased, shape, residual, pose
  std::size_t epochs = 200;
  std::size_t batch = 16;           ///< chunks a step
  std::size_t frames = 128;         ///< of a chunk that count
  std::size_t uses = 4;             ///< epochs of one damage of the takes
  bool sees_roughness = true;       ///< beside the paper's inputs (`FilterInputs`)
  bool is_augmented = true;         ///< chunks in a mirror and backwards too
  std::vector<FilterDamage> noise;  ///< one of these is drawn for each take
  std::vector<FilterDamage> bias;   ///< and one of these on top of it; empty: none
  std::vector<FilterDamage> gaps;   ///< and one of these; empty: none
  double weight_bound = 0;          ///< `BidirectionalShape`; the paper's is 0.5
  double rate = 5e-4;               ///< of learning, at its highest; at 2e-3 layers saturate
  DescentSettings descent;
};

class FilterTrainer {
 public:
  /// Clean takes at one rate. Errors: `ErrorKind::usage` as of `BodyLayoutBuilder`, for takes of
  /// different rates, an unknown kind or head, and an EBD that filters.
  FilterTrainer(std::vector<Take> takes, const FilterTraining& settings);

  std::size_t batch() const noexcept { return batch_; }
  std::size_t batches() const noexcept {
    return settings_.epochs * chunks_of_epoch_ / settings_.batch;
  }
  /// One step of the descent; the error that is left over that before.
  double step();
  /// Mean error over takes that are not learned from, damaged in a fixed way, over that of the
  /// Gaussian of 58 ms; of EBD over that of the straight lines in the gaps.
  double share_left(const std::vector<Take>& takes) const;
  /// The model as it is now. The card is the caller's.
  Model model() const;
  std::string checkpoint() const;
  void resume(std::string_view bytes, std::string_view name);
  /// Begins with the weights of another training's model.
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
    std::vector<float> truth;   // as many
    std::vector<float> weight;  // of each row: 0 of padding
  };

  bool fills() const noexcept { return !settings_.gaps.empty(); }
  FilterInputs inputs() const noexcept { return {settings_.sees_roughness, fills()}; }
  Sample sample_of(const Take& clip, Random random) const;
  void damage_takes(std::size_t round);
  FilterSignal signal_of(const FilterTake& take) const;
  /// Whether the loss counts a sample: those that are missing, of all where a pose is made anew.
  bool counts(const FilterTake& take, std::size_t sample) const;
  /// What there is of a sample before anything is learned.
  float before_training(const FilterTake& take, std::size_t sample) const;
  /// Logarithms of the widths that would be best as constants, one a channel.
  std::vector<double> best_constants();
  std::vector<Chunk> chunks_of(std::size_t epoch) const;
  Rows rows_of(const Chunk& chunk) const;
  std::vector<float> apply(const FilterTake& take) const;

  std::vector<Take> takes_;
  FilterTraining settings_;
  BodyLayout layout_;
  BodyMirror mirror_;  // of the joints but the root
  double rate_hz_ = 0, seconds_ = 0;
  FilterStatistics statistics_;
  FilterHead head_ = FilterHead::gaussian;
  BidirectionalShape shape_;
  std::size_t stride_ = 1, margin_ = predicted_filter_reach, chunks_of_epoch_ = 0;
  std::unique_ptr<SequenceNetwork> network_;
  std::vector<Sample> samples_;
  std::size_t round_ = 0;  // of the samples at hand, plus 1
  std::size_t batch_ = 0;
};

}  // namespace kinemend::train
