// Computes one step of each layer from its kept inputs.
#include "methods/learned/live_motion_network.hpp"

#include <algorithm>
#include <utility>

namespace kinemend {

namespace {

// The number that layers process without memory of their own. For speed, not swept.
constexpr std::size_t rows_together = 32;

template <class Layer>
void run_rows(const Layer& layer, const float* x, std::size_t rows, float* y) {
  for (std::size_t first = 0; first < rows; first += rows_together) {
    const std::size_t count = std::min(rows_together, rows - first);
    nn::run(layer, {x + first * layer.inputs(), count, layer.inputs(), layer.inputs()},
            {y + first * layer.outputs(), count, layer.outputs(), layer.outputs()});
  }
}

// One step of a causal convolution of two taps for each of `rows`.
void run_taps(const nn::Convolution& layer, const float* before, const float* now, std::size_t rows,
              float* y) {
  const std::size_t in = layer.inputs(), out = layer.outputs();
  for (std::size_t first = 0; first < rows; first += rows_together) {
    const std::size_t count = std::min(rows_together, rows - first);
    const nn::MutableMatrixViewF part{y + first * out, count, out, out};
    for (std::size_t r = 0; r < count; ++r)
      std::copy(layer.bias.begin(), layer.bias.end(), part.values + r * out);
    nn::multiply({before + first * in, count, in, in}, layer.taps.front(), part, nn::Product::add);
    nn::multiply({now + first * in, count, in, in}, layer.taps.back(), part, nn::Product::add);
    nn::activate(layer.activation, std::span(part.values, count * out));
  }
}

}  // namespace

LiveMotionNetwork::LiveMotionNetwork(const MotionNetwork& network, std::vector<std::int32_t> slots)
    : network_(network),
      slots_(std::move(slots)),
      no_slots_(slots_.size(), -1),
      features_(network.encoder.dilation, channels() * motion_features),
      first_(network.second_encoder.dilation, channels() * network.encoded()),
      of_take_(channels() * network.encoded()),
      encoded_(of_take_.size()),
      scratch_(of_take_.size()),
      body_(network.body.inputs()),
      pooled_(network.pool.inputs()),
      wide_(network.body.outputs()),
      added_(wide_.size()),
      of_slots_(network.to_slots.outputs()),
      corrections_(network.slot_corrections.outputs()),
      shared_(network.to_all.outputs()),
      input_(channels() * network.head.inputs()),
      hidden_(channels() * network.head.outputs()),
      outputs_(channels() * motion_outputs) {
  std::size_t most_taps = 0;
  for (const MotionNetwork::Block& block : network.blocks) {
    trunk_.emplace_back(block.convolution.dilation, wide_.size());
    most_taps = std::max(most_taps, block.convolution.outputs());
  }
  taps_.resize(most_taps);
}

void LiveMotionNetwork::History::keep(std::span<const float> now) {
  std::copy(now.begin(), now.end(), values.begin() + static_cast<std::ptrdiff_t>(next * size));
  next = (next + 1) % steps;
}

void LiveMotionNetwork::reset() {
  const auto forget = [](History& history) {
    std::fill(history.values.begin(), history.values.end(), 0.0F);
    history.next = 0;
  };
  forget(features_);
  forget(first_);
  for (History& history : trunk_) forget(history);
}

std::span<float> LiveMotionNetwork::run(const MotionSteps& step,
                                        std::span<const std::uint8_t> is_alive) {
  encode(step, is_alive);
  run_trunk(step, is_alive);
  run_head(is_alive);
  return outputs_;
}

void LiveMotionNetwork::encode(const MotionSteps& step, std::span<const std::uint8_t> is_alive) {
  const std::size_t width = network_.encoded();
  run_taps(network_.encoder, features_.oldest(), step.features.data(), channels(), scratch_.data());
  features_.keep(step.features);
  run_rows(network_.of_take, step.take_features.data(), channels(), of_take_.data());
  for (std::size_t i = 0; i < scratch_.size(); ++i)
    scratch_[i] = std::max(0.0F, scratch_[i] + of_take_[i]);
  run_taps(network_.second_encoder, first_.oldest(), scratch_.data(), channels(), encoded_.data());
  first_.keep(scratch_);
  for (std::size_t i = 0; i < encoded_.size(); ++i)
    encoded_[i] = is_alive[i / width] != 0 ? encoded_[i] + scratch_[i] : 0.0F;
}

void LiveMotionNetwork::run_trunk(const MotionSteps& step, std::span<const std::uint8_t> is_alive) {
  fill_body_input(network_, {slots(), is_alive}, step, 0, encoded_, body_);
  fill_pooled(network_, {slots(), is_alive}, encoded_, 1, pooled_);
  run_rows(network_.body, body_.data(), 1, wide_.data());
  run_rows(network_.pool, pooled_.data(), 1, added_.data());
  for (std::size_t i = 0; i < wide_.size(); ++i) wide_[i] = std::max(0.0F, wide_[i] + added_[i]);
  for (std::size_t b = 0; b < trunk_.size(); ++b) {
    const MotionNetwork::Block& block = network_.blocks[b];
    run_taps(block.convolution, trunk_[b].oldest(), wide_.data(), 1, taps_.data());
    trunk_[b].keep(wide_);
    run_rows(block.dense, taps_.data(), 1, added_.data());
    for (std::size_t i = 0; i < wide_.size(); ++i) wide_[i] += added_[i];
  }
  nn::activate(nn::Activation::relu, wide_);
}

void LiveMotionNetwork::run_head(std::span<const std::uint8_t> is_alive) {
  const std::size_t width = network_.encoded(), units = network_.slot_units();
  run_rows(network_.to_slots, wide_.data(), 1, of_slots_.data());
  run_rows(network_.slot_corrections, wide_.data(), 1, corrections_.data());
  run_rows(network_.to_all, wide_.data(), 1, shared_.data());
  const std::size_t row = network_.head.inputs(), head = network_.head.outputs();
  std::fill(input_.begin(), input_.end(), 0.0F);
  for (std::size_t track = 0; track < channels() / 3; ++track) {
    float alive = 0;
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) alive += is_alive[c] != 0 ? 1.0F : 0.0F;
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
      float* const to = input_.data() + c * row;
      std::copy_n(encoded_.data() + c * width, width, to);
      for (std::size_t i = 0; i < width; ++i) {
        float sum = 0;
        for (std::size_t other = 3 * track; other < 3 * track + 3; ++other)
          sum += encoded_[other * width + i];
        to[width + i] = sum / std::max(1.0F, alive);
      }
      if (slots()[c] < 0) continue;
      const float* const of_slot = of_slots_.data() + static_cast<std::size_t>(slots()[c]) * units;
      std::copy_n(of_slot, units, to + 2 * width);
    }
  }
  run_rows(network_.head, input_.data(), channels(), hidden_.data());
  for (std::size_t i = 0; i < hidden_.size(); ++i)
    hidden_[i] = std::max(0.0F, hidden_[i] + shared_[i % head]);
  run_rows(network_.output, hidden_.data(), channels(), outputs_.data());
  for (std::size_t c = 0; c < channels(); ++c) {
    if (slots()[c] < 0) continue;
    const auto slot = static_cast<std::size_t>(slots()[c]);
    for (std::size_t i = 0; i < motion_body_corrections; ++i)
      outputs_[c * motion_outputs + motion_smoothers + first_body_correction + i] +=
          corrections_[slot * motion_body_corrections + i];
  }
}

}  // namespace kinemend
