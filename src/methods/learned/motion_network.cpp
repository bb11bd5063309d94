// Reads the network from a model, makes its live form, and runs it on steps.
#include "methods/learned/motion_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "models/network_numbers.hpp"

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
  network.encoder = nn::read_convolution(tensors, "encoder");
  check_width("encoder", network.encoder.inputs(), motion_features);
  const std::size_t width = network.encoded();
  network.second_encoder =
      nn::read_convolution(tensors, "second_encoder",
                           whole_number(model, "second_encoder.dilation", 1, most_motion_dilation),
                           nn::Activation::relu);
  check_width("second_encoder", network.second_encoder.inputs(), width);
  check_width("second_encoder", network.second_encoder.outputs(), width);
  network.of_take = nn::read_dense(tensors, "of_take");
  check_width("of_take", network.of_take.inputs(), motion_take_features);
  check_width("of_take", network.of_take.outputs(), width);
  network.body = nn::read_dense(tensors, "body");
  check_width("body", network.body.inputs(), network.slots * (width + 2));
  network.pool = nn::read_dense(tensors, "pool");
  check_width("pool", network.pool.inputs(), 2 * width);
  const std::size_t hidden = network.body.outputs();
  check_width("pool", network.pool.outputs(), hidden);
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
  network.to_slots = nn::read_dense(tensors, "to_slots");
  check_width("to_slots", network.to_slots.inputs(), hidden);
  check_width("to_slots", network.to_slots.outputs() % network.slots, 0);
  network.slot_corrections = nn::read_dense(tensors, "slot_corrections");
  check_width("slot_corrections", network.slot_corrections.inputs(), hidden);
  check_width("slot_corrections", network.slot_corrections.outputs(),
              network.slots * motion_body_corrections);
  network.to_all = nn::read_dense(tensors, "to_all");
  network.head = nn::read_dense(tensors, "head");
  network.output = nn::read_dense(tensors, "output");
  check_width("to_all", network.to_all.inputs(), hidden);
  check_width("to_all", network.to_all.outputs(), network.head.outputs());
  check_width("head", network.head.inputs(), 2 * width + network.slot_units());
  check_width("output", network.output.inputs(), network.head.outputs());
  check_width("output", network.output.outputs(), motion_outputs);
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

}  // namespace kinemend
