#include "priors/recurrent_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "priors/network_numbers.hpp"

namespace kinemend {

namespace {

constexpr std::size_t most_blocks = 64;
constexpr std::size_t most_dilation = 4096;

}  // namespace

RecurrentNetwork recurrent_network_of(const Model& model) {
  const std::size_t channels = model.layout.channel_count();
  RecurrentNetwork network;
  network.rate_hz = model.rate_hz;
  network.statistics = {network_numbers(model, "mean", channels, false),
                        network_numbers(model, "deviation", channels, true),
                        network_numbers(model, "speed", channels, true)};
  network.mirror = mirror_of(model.layout);
  network.input = nn::read_dense(model.tensors, "input");
  check_width("input", network.input.inputs(), recurrent_feature_count(channels));
  const std::size_t hidden = network.input.outputs();
  const std::size_t blocks = whole_number(model, "blocks", 0, most_blocks);
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::string name = fmt::format("block{}", i);
    const std::size_t dilation = whole_number(model, name + ".dilation", 1, most_dilation);
    RecurrentNetwork::Block block{nn::read_convolution(model.tensors, name + ".convolution",
                                                       dilation, false, nn::Activation::relu),
                                  nn::read_dense(model.tensors, name + ".dense")};
    check_width("convolution", block.convolution.inputs(), hidden);
    check_width("dense", block.dense.inputs(), block.convolution.outputs());
    check_width("dense", block.dense.outputs(), hidden);
    network.blocks.push_back(std::move(block));
  }
  network.output = nn::read_dense(model.tensors, "output");
  check_width("output", network.output.inputs(), hidden);
  check_width("output", network.output.outputs(), recurrent_output_count(channels));
  return network;
}

std::vector<float> run(const RecurrentNetwork& network, std::span<const float> features) {
  const std::size_t width = network.input.inputs(), steps = features.size() / width;
  const std::size_t hidden = network.input.outputs();
  std::vector<float> h(steps * hidden), added(h.size());
  const auto rows = [&](std::vector<float>& values, std::size_t columns) {
    return nn::MutableMatrixViewF{values.data(), steps, columns, columns};
  };
  const auto view = [&](const std::vector<float>& values, std::size_t columns) {
    return nn::MatrixViewF{values.data(), steps, columns, columns};
  };
  nn::run(network.input, {features.data(), steps, width, width}, rows(h, hidden));
  for (const RecurrentNetwork::Block& block : network.blocks) {
    const std::size_t middle = block.convolution.outputs();
    std::vector<float> convolved(steps * middle);
    nn::run(block.convolution, view(h, hidden), rows(convolved, middle));
    nn::run(block.dense, view(convolved, middle), rows(added, hidden));
    for (std::size_t i = 0; i < h.size(); ++i) h[i] += added[i];
  }
  nn::activate(nn::Activation::relu, h);
  std::vector<float> outputs(steps * network.output.outputs());
  nn::run(network.output, view(h, hidden), rows(outputs, network.output.outputs()));
  return outputs;
}

std::vector<float> ensemble_correction(const RecurrentNetwork& network, const RecurrentTake& take) {
  constexpr float share = 0.25F;
  std::vector<float> mean(take.measured.size(), 0.0F), correction(mean.size());
  for (const bool is_mirrored : {false, true}) {
    for (const bool is_reversed : {false, true}) {
      const RecurrentForm form{is_mirrored, is_reversed};
      const RecurrentInput input =
          recurrent_input(in_form(take, form, network.mirror), network.statistics);
      recurrent_correction(input, run(network, input.features), correction);
      const std::vector<float> back = in_form(correction, form, network.mirror);
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += share * back[i];
    }
  }
  return mean;
}

}  // namespace kinemend
