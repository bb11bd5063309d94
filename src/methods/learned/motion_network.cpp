// Reads the network from a model, makes its live form, and runs both.
#include "methods/learned/motion_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "models/model_reading.hpp"

namespace kinemend {

namespace {

// Limits on sizes in a model file. Chosen by hand.
constexpr std::size_t most_motion_blocks = 64, most_motion_dilation = 4096;

using nn::MatrixViewF;
using nn::MutableMatrixViewF;

MatrixViewF matrix_of(const std::vector<float>& values, std::size_t rows, std::size_t columns) {
  return {values.data(), rows, columns, columns};
}
MutableMatrixViewF rows_of(std::vector<float>& values, std::size_t rows, std::size_t columns) {
  return {values.data(), rows, columns, columns};
}

std::size_t step_reach_of(const nn::Convolution& layer) {
  return layer.dilation * (layer.taps.size() / 2);
}

// One run of the network on the steps of a take.
struct Pass {
  const MotionNetwork& network;
  const MotionChannels& told;
  const MotionSteps& steps;
  std::size_t channels = told.slots.size(), count = steps.count;

  bool is_alive(std::size_t channel) const { return told.is_alive[channel] != 0; }

  // Parts of the network that only a known body needs are skipped for other takes.
  bool knows_body() const {
    for (std::size_t c = 0; c < channels; ++c) {
      if (told.slots[c] >= 0 && is_alive(c)) return true;
    }
    return false;
  }

  // C x steps x encoded; zero for channels that are not alive.
  std::vector<float> encoded() const {
    const std::size_t width = network.encoded();
    std::vector<float> result(channels * count * width, 0.0F), first(count * width);
    const std::size_t rows = steps.take_features.size() / motion_take_features;
    const std::size_t rows_of_channel = rows / channels;  // one, or one per step
    std::vector<float> of_take(rows * width);
    nn::run(network.of_take, matrix_of(steps.take_features, rows, motion_take_features),
            rows_of(of_take, rows, width));
    for (std::size_t c = 0; c < channels; ++c) {
      if (!is_alive(c)) continue;
      const MatrixViewF features{steps.features.data() + c * count * motion_features, count,
                                 motion_features, motion_features};
      nn::run(network.encoder, features, rows_of(first, count, width));
      for (std::size_t s = 0; s < count; ++s) {
        for (std::size_t i = 0; i < width; ++i) {
          float& value = first[s * width + i];
          const std::size_t row = c * rows_of_channel + s % rows_of_channel;
          value = std::max(0.0F, value + of_take[row * width + i]);
        }
      }
      float* const own = result.data() + c * count * width;
      nn::run(network.second_encoder, matrix_of(first, count, width), {own, count, width, width});
      for (std::size_t i = 0; i < first.size(); ++i) own[i] += first[i];
    }
    return result;
  }

  std::vector<float> trunk(const std::vector<float>& encoded) const {
    const std::size_t width = network.body.outputs();
    std::vector<float> h(count * width), pool(h.size()), taps, added(h.size());
    if (knows_body()) {
      std::vector<float> body(count * network.body.inputs());
      for (std::size_t s = 0; s < count; ++s)
        fill_body_input(network, told, steps, s, encoded,
                        std::span(body).subspan(s * network.body.inputs(), network.body.inputs()));
      nn::run(network.body, matrix_of(body, count, network.body.inputs()),
              rows_of(h, count, width));
    } else {
      for (std::size_t s = 0; s < count; ++s)
        std::copy(network.body.bias.begin(), network.body.bias.end(), h.data() + s * width);
    }
    std::vector<float> means(count * network.pool.inputs());
    fill_pooled(network, told, encoded, count, means);
    nn::run(network.pool, matrix_of(means, count, network.pool.inputs()),
            rows_of(pool, count, width));
    for (std::size_t i = 0; i < h.size(); ++i) h[i] = std::max(0.0F, h[i] + pool[i]);
    for (const MotionNetwork::Block& block : network.blocks) {
      taps.resize(count * block.convolution.outputs());
      nn::run(block.convolution, matrix_of(h, count, width),
              rows_of(taps, count, block.convolution.outputs()));
      nn::run(block.dense, matrix_of(taps, count, block.dense.inputs()),
              rows_of(added, count, width));
      for (std::size_t i = 0; i < h.size(); ++i) h[i] += added[i];
    }
    nn::activate(nn::Activation::relu, h);
    return h;
  }

  // steps x encoded: the mean over the three channels of a track.
  void track_mean(const std::vector<float>& encoded, std::size_t track,
                  std::vector<float>& result) const {
    const std::size_t size = count * network.encoded();
    std::fill(result.begin(), result.end(), 0.0F);
    float alive = 0;
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
      if (!is_alive(c)) continue;
      alive += 1;
      for (std::size_t i = 0; i < size; ++i) result[i] += encoded[c * size + i];
    }
    for (float& value : result) value /= std::max(1.0F, alive);
  }

  std::vector<float> outputs(const std::vector<float>& encoded,
                             const std::vector<float>& trunk) const {
    const std::size_t width = network.encoded(), units = network.slot_units();
    const std::size_t wide = network.body.outputs(), head = network.head.outputs();
    const std::size_t all = network.to_slots.outputs(), row = 2 * width + units;
    const std::size_t corrections = network.slot_corrections.outputs();
    std::vector<float> slots, body, shared(count * head);
    if (knows_body()) {
      slots.resize(count * all);
      body.resize(count * corrections);
      nn::run(network.to_slots, matrix_of(trunk, count, wide), rows_of(slots, count, all));
      nn::run(network.slot_corrections, matrix_of(trunk, count, wide),
              rows_of(body, count, corrections));
    }
    nn::run(network.to_all, matrix_of(trunk, count, wide), rows_of(shared, count, head));
    std::vector<float> result(channels * count * motion_outputs, 0.0F);
    std::vector<float> input(count * row), hidden(count * head), mean(count * width);
    for (std::size_t c = 0; c < channels; ++c) {
      if (c % 3 == 0) track_mean(encoded, c / 3, mean);
      if (!is_alive(c)) continue;
      const std::int32_t slot = told.slots[c];
      const auto at = static_cast<std::size_t>(std::max(0, slot));
      for (std::size_t s = 0; s < count; ++s) {
        float* const to = input.data() + s * row;
        const float* const own = encoded.data() + (c * count + s) * width;
        std::copy(own, own + width, to);
        std::copy(mean.data() + s * width, mean.data() + (s + 1) * width, to + width);
        if (slot >= 0) std::copy_n(slots.data() + s * all + at * units, units, to + 2 * width);
        if (slot < 0) std::fill(to + 2 * width, to + row, 0.0F);
      }
      nn::run(network.head, matrix_of(input, count, row), rows_of(hidden, count, head));
      for (std::size_t i = 0; i < hidden.size(); ++i)
        hidden[i] = std::max(0.0F, hidden[i] + shared[i]);
      float* const own = result.data() + c * count * motion_outputs;
      nn::run(network.output, matrix_of(hidden, count, head),
              {own, count, motion_outputs, motion_outputs});
      for (std::size_t s = 0; s < count && slot >= 0; ++s) {
        for (std::size_t i = 0; i < motion_body_corrections; ++i)
          own[s * motion_outputs + motion_smoothers + first_body_correction + i] +=
              body[s * corrections + at * motion_body_corrections + i];
      }
    }
    return result;
  }
};

}  // namespace

std::size_t MotionNetwork::reach() const {
  std::size_t sum = step_reach_of(encoder) + step_reach_of(second_encoder);
  for (const Block& block : blocks) sum += step_reach_of(block.convolution);
  return sum;
}

MotionNetwork motion_network_of(const Model& model) {
  MotionNetwork network;
  network.slots = model.layout.channel_count();
  network.mean = network_numbers(model, "mean", network.slots, false);
  network.deviation = network_numbers(model, "deviation", network.slots, true);
  network.speed = network_numbers(model, "speed", network.slots, true);
  const auto& tensors = model.tensors;
  // `outputs`: 0 for any number.
  const auto dense = [&](const char* name, std::size_t inputs, std::size_t outputs) {
    nn::Dense layer = nn::read_dense(tensors, name);
    check_width(name, layer.inputs(), inputs);
    if (outputs > 0) check_width(name, layer.outputs(), outputs);
    return layer;
  };
  network.encoder = nn::read_convolution(tensors, "encoder");
  check_width("encoder", network.encoder.inputs(), motion_features);
  const std::size_t width = network.encoded();
  network.second_encoder =
      nn::read_convolution(tensors, "second_encoder",
                           whole_number(model, "second_encoder.dilation", 1, most_motion_dilation),
                           nn::Activation::relu);
  check_width("second_encoder", network.second_encoder.inputs(), width);
  check_width("second_encoder", network.second_encoder.outputs(), width);
  network.of_take = dense("of_take", motion_take_features, width);
  network.body = dense("body", network.slots * (width + 2), 0);
  const std::size_t hidden = network.body.outputs();
  network.pool = dense("pool", 2 * width, hidden);
  const std::size_t blocks = whole_number(model, "blocks", 0, most_motion_blocks);
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::string name = fmt::format("block{}", i);
    MotionNetwork::Block block{
        nn::read_convolution(tensors, name + ".convolution",
                             whole_number(model, name + ".dilation", 1, most_motion_dilation),
                             nn::Activation::relu),
        nn::read_dense(tensors, name + ".dense")};
    check_width(name, block.convolution.inputs(), hidden);
    check_width(name, block.dense.inputs(), block.convolution.outputs());
    check_width(name, block.dense.outputs(), hidden);
    network.blocks.push_back(std::move(block));
  }
  network.to_slots = dense("to_slots", hidden, 0);
  check_width("to_slots", network.to_slots.outputs() % network.slots, 0);
  network.slot_corrections =
      dense("slot_corrections", hidden, network.slots * motion_body_corrections);
  network.head = dense("head", 2 * width + network.slot_units(), 0);
  network.to_all = dense("to_all", hidden, network.head.outputs());
  network.output = dense("output", network.head.outputs(), motion_outputs);
  return network;
}

void fill_body_input(const MotionNetwork& network, const MotionChannels& channels,
                     const MotionSteps& steps, std::size_t step, std::span<const float> encoded,
                     std::span<float> result) {
  const std::size_t width = network.encoded();
  std::fill(result.begin(), result.end(), 0.0F);
  for (std::size_t c = 0; c < channels.slots.size(); ++c) {
    if (channels.slots[c] < 0 || channels.is_alive[c] == 0) continue;
    const auto slot = static_cast<std::size_t>(channels.slots[c]);
    const std::size_t at = c * steps.count + step;
    std::copy_n(encoded.data() + at * width, width, result.data() + slot * width);
    const float* const levels = steps.levels.data() + at * motion_levels;
    const float* const changes = steps.changes.data() + at * motion_levels;
    const std::size_t poses = network.slots * width, paces = poses + network.slots;
    result[poses + slot] = std::clamp((levels[3] - network.mean[slot]) / network.deviation[slot],
                                      -most_pose, most_pose);
    result[paces + slot] = std::clamp(changes[4] / network.speed[slot], -most_pace, most_pace);
  }
}

void fill_pooled(const MotionNetwork& network, const MotionChannels& channels,
                 std::span<const float> encoded, std::size_t steps, std::span<float> result) {
  const std::size_t width = network.encoded();
  std::fill(result.begin(), result.end(), 0.0F);
  float alive = 0;
  for (std::size_t c = 0; c < channels.slots.size(); ++c) {
    if (channels.is_alive[c] == 0) continue;
    alive += 1;
    for (std::size_t s = 0; s < steps; ++s) {
      const float* const own = encoded.data() + (c * steps + s) * width;
      float* const sums = result.data() + s * 2 * width;
      for (std::size_t i = 0; i < width; ++i) {
        sums[i] += own[i];
        sums[width + i] += own[i] * own[i];
      }
    }
  }
  for (float& value : result) value /= std::max(1.0F, alive);
}

MotionNetwork live_form(const MotionNetwork& network) {
  MotionNetwork live = network;
  const auto look_back = [](nn::Convolution& layer) {
    layer.taps.resize(layer.taps.size() / 2 + 1);
    layer.is_causal = true;
  };
  look_back(live.encoder);
  look_back(live.second_encoder);
  for (MotionNetwork::Block& block : live.blocks) look_back(block.convolution);
  return live;
}

std::vector<float> run(const MotionNetwork& network, const MotionChannels& channels,
                       const MotionSteps& steps) {
  const Pass pass{network, channels, steps};
  const std::vector<float> encoded = pass.encoded();
  return pass.outputs(encoded, pass.trunk(encoded));
}

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
