// Runs the live form of the network step by step, with the last inputs of each layer kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/learned/motion_network.hpp"

namespace kinemend {

/// A network in its live form, step by step, with the result of `run` on the same steps at once.
/// Nothing is computed twice.
class LiveMotionNetwork {
 public:
  /// `network` is a `live_form`, and must outlive this. `slots`: C, as of `MotionTake`.
  LiveMotionNetwork(const MotionNetwork& network, std::vector<std::int32_t> slots);

  /// `step`: one step with features of the take. Returns C x `motion_outputs`, valid until the next
  /// call. Does not allocate.
  std::span<float> run(const MotionSteps& step, std::span<const std::uint8_t> is_alive);
  /// Whether the channels are those of the body from the next step on, as at first, or each by
  /// itself.
  void show_body(bool is_shown) { is_body_shown_ = is_shown; }
  void reset();

 private:
  /// The last inputs of a convolution, one row of `width` numbers for each of `rows`.
  struct History {
    std::size_t size = 0;  // rows x width
    std::vector<float> values;
    std::size_t next = 0, steps = 0;

    History(std::size_t steps_back, std::size_t numbers)
        : size(numbers), values(steps_back * numbers), steps(steps_back) {}
    /// The oldest inputs; `keep` overwrites them.
    const float* oldest() const { return values.data() + next * size; }
    void keep(std::span<const float> now);
  };

  void encode(const MotionSteps& step, std::span<const std::uint8_t> is_alive);
  void run_trunk(const MotionSteps& step, std::span<const std::uint8_t> is_alive);
  void run_head(std::span<const std::uint8_t> is_alive);
  std::size_t channels() const { return slots_.size(); }
  const std::vector<std::int32_t>& slots() const { return is_body_shown_ ? slots_ : no_slots_; }

  const MotionNetwork& network_;
  std::vector<std::int32_t> slots_, no_slots_;
  bool is_body_shown_ = true;
  History features_, first_;
  std::vector<History> trunk_;
  std::vector<float> of_take_, encoded_, scratch_, body_, pooled_, wide_, added_, taps_;
  std::vector<float> of_slots_, corrections_, shared_, input_, hidden_, outputs_;
};

}  // namespace kinemend
