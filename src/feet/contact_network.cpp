// Reads the network from a model and runs it, on a whole take and step by step.
#include "feet/contact_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "models/model_reading.hpp"

namespace kinemend::feet {

namespace {

// Limits on sizes in a model file. Chosen by hand.
constexpr std::size_t most_blocks = 32, most_dilation = 1024;

nn::MatrixViewF matrix_of(const std::vector<float>& values, std::size_t rows, std::size_t columns) {
  return {values.data(), rows, columns, columns};
}
nn::MutableMatrixViewF rows_of(std::vector<float>& values, std::size_t rows, std::size_t columns) {
  return {values.data(), rows, columns, columns};
}

}  // namespace

ContactNetwork contact_network_of(const Model& model, Lookahead lookahead) {
  const std::string part = lookahead == Lookahead::whole ? "whole." : "live.";
  const bool is_causal = lookahead == Lookahead::none;
  ContactNetwork network;
  network.encoder = nn::read_convolution(model.tensors, part + "encoder", 1, nn::Activation::relu);
  const std::size_t blocks = whole_number(model, "blocks", 1, most_blocks);
  const std::size_t width = network.encoder.outputs();
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::string name = fmt::format("{}block{}", part, i);
    const std::size_t dilation =
        whole_number(model, fmt::format("block{}.dilation", i), 1, most_dilation);
    network.blocks.push_back(
        {nn::read_convolution(model.tensors, name + ".convolution", dilation, nn::Activation::relu),
         nn::read_dense(model.tensors, name + ".dense")});
    ContactNetwork::Block& block = network.blocks.back();
    block.convolution.is_causal = is_causal;
    check_width(name + ".convolution", block.convolution.inputs(), width);
    check_width(name + ".dense", block.dense.inputs(), block.convolution.outputs());
    check_width(name + ".dense", block.dense.outputs(), width);
  }
  network.encoder.is_causal = is_causal;
  network.output = nn::read_dense(model.tensors, part + "output");
  check_width(part + "encoder", network.encoder.inputs(), contact_features);
  check_width(part + "output", network.output.inputs(), width);
  check_width(part + "output", network.output.outputs(), 2);
  return network;
}

std::shared_ptr<const ContactNetwork> shipped_contact_network(Lookahead lookahead) {
  const auto read = [](Lookahead kind) -> std::shared_ptr<const ContactNetwork> {
    for (const ShippedModel& shipped : shipped_models()) {
      if (shipped.method == contact_models.name)
        return std::make_shared<const ContactNetwork>(
            contact_network_of(*shipped_model_of(contact_models), kind));
    }
    return nullptr;
  };
  if (lookahead == Lookahead::whole) {
    static const std::shared_ptr<const ContactNetwork> whole = read(Lookahead::whole);
    return whole;
  }
  static const std::shared_ptr<const ContactNetwork> live = read(Lookahead::none);
  return live;
}

std::vector<float> run(const ContactNetwork& network, const ContactSteps& steps) {
  std::vector<float> odds(steps.feet * steps.count * 2);
  const std::size_t count = steps.count, width = network.encoder.outputs();
  for_each_index(steps.feet, [&](std::size_t l) {
    std::vector<float> h(count * width), inner, added(h.size());
    const nn::MatrixViewF features{steps.features.data() + l * count * contact_features, count,
                                   contact_features, contact_features};
    nn::run(network.encoder, features, rows_of(h, count, width));
    for (const ContactNetwork::Block& block : network.blocks) {
      const std::size_t inside = block.convolution.outputs();
      inner.resize(count * inside);
      nn::run(block.convolution, matrix_of(h, count, width), rows_of(inner, count, inside));
      nn::run(block.dense, matrix_of(inner, count, inside), rows_of(added, count, width));
      for (std::size_t i = 0; i < h.size(); ++i) h[i] += added[i];
    }
    nn::activate(nn::Activation::relu, h);
    nn::run(network.output, matrix_of(h, count, width), {odds.data() + l * count * 2, count, 2, 2});
  });
  return odds;
}

LiveContactNetwork::LiveContactNetwork(const ContactNetwork& network, std::size_t feet)
    : network_(network),
      feet_(feet),
      hidden_(network.encoder.outputs()),
      added_(network.encoder.outputs()),
      odds_(2 * feet) {
  const auto add = [&](const nn::Convolution& convolution) {
    layers_.push_back({&convolution, std::vector<float>(feet * (2 * convolution.dilation + 1) *
                                                        convolution.inputs())});
  };
  add(network.encoder);
  std::size_t widest = 0;
  for (const ContactNetwork::Block& block : network.blocks) {
    add(block.convolution);
    widest = std::max(widest, block.convolution.outputs());
  }
  inner_.resize(widest);
}

void LiveContactNetwork::run(Layer& layer, std::size_t foot, std::span<const float> input,
                             std::span<float> output) {
  const nn::Convolution& convolution = *layer.convolution;
  const std::size_t width = convolution.inputs(), ring = 2 * convolution.dilation + 1;
  float* const past = layer.past.data() + foot * ring * width;
  std::copy(input.begin(), input.end(), past + (steps_ % ring) * width);
  std::copy(convolution.bias.begin(), convolution.bias.end(), output.begin());
  const nn::MutableMatrixViewF sum{output.data(), 1, output.size(), output.size()};
  // The taps read the inputs of two dilations ago, one dilation ago, and now.
  for (std::size_t tap = 0; tap < convolution.taps.size(); ++tap) {
    const std::size_t back = (convolution.taps.size() - 1 - tap) * convolution.dilation;
    if (back > steps_) continue;
    const float* const row = past + ((steps_ - back) % ring) * width;
    nn::multiply({row, 1, width, width}, convolution.taps[tap], sum, nn::Product::add);
  }
  nn::activate(convolution.activation, output);
}

std::span<const float> LiveContactNetwork::run(std::span<const float> rows) {
  const std::size_t width = network_.encoder.outputs();
  for (std::size_t l = 0; l < feet_; ++l) {
    run(layers_[0], l, rows.subspan(l * contact_features, contact_features), hidden_);
    for (std::size_t i = 0; i < network_.blocks.size(); ++i) {
      const ContactNetwork::Block& block = network_.blocks[i];
      const std::size_t inside = block.convolution.outputs();
      run(layers_[i + 1], l, hidden_, std::span(inner_).first(inside));
      nn::run(block.dense, matrix_of(inner_, 1, inside), rows_of(added_, 1, width));
      for (std::size_t k = 0; k < width; ++k) hidden_[k] += added_[k];
    }
    nn::activate(nn::Activation::relu, hidden_);
    nn::run(network_.output, matrix_of(hidden_, 1, width), {odds_.data() + 2 * l, 1, 2, 2});
  }
  ++steps_;
  return odds_;
}

std::vector<float> standing_odds(const ContactNetwork& network, const BodyPoints& soles, Up up,
                                 Lookahead lookahead, std::span<const std::uint8_t> touching) {
  const ContactSteps steps = contact_steps(soles, up, lookahead, touching);
  const std::vector<float> odds = run(network, steps);
  std::vector<float> result(soles.frames * soles.points);
  for (std::size_t f = 0; f < soles.frames; ++f) {
    const double at = static_cast<double>(f) * contact_rate_hz / soles.frame_rate_hz + 1e-9;
    const std::size_t before = std::min(static_cast<std::size_t>(at), steps.count - 1);
    const std::size_t next = std::min(before + 1, steps.count - 1);
    const double after = lookahead == Lookahead::none ? 0 : at - static_cast<double>(before);
    const auto share = static_cast<float>(std::min(1.0, after));
    for (std::size_t p = 0; p < soles.points; ++p) {
      const auto odd = [&](std::size_t s) { return odds[((p / 2) * steps.count + s) * 2 + p % 2]; };
      result[f * soles.points + p] = (1 - share) * odd(before) + share * odd(next);
    }
  }
  return result;
}

}  // namespace kinemend::feet
