// Speed of the method `recurrent`: the EBF of Mall et al. at the paper's size, and LibTorch with
// the same weights where available.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "frame_times.hpp"
#include "kinemend/extend/model.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"
#include "papers/mall2017_recurrent/live_filter_network.hpp"
#ifdef KINEMEND_HAS_TRAINING
#include "lab/networks/sequence_network.hpp"
#endif

namespace {

// 10 s of the paper's 126 channels.
constexpr std::size_t ebf_frames = 1200, ebf_channels = 126;

kinemend::FilterTake ebf_take() {
  kinemend::FilterTake take;
  take.frames = ebf_frames;
  take.channels = ebf_channels;
  for (std::size_t i = 0; i < ebf_frames * ebf_channels; ++i)
    take.values.push_back(20 * std::sin(0.37F * static_cast<float>(i)));
  take.turning.assign(3 * ebf_frames, 1.0F);
  take.missing.assign(ebf_frames * ebf_channels / 3, 0);
  return take;
}

// Weights that do not depend on the machine: 0.1 sin(k).
kinemend::Tensor ebf_tensor(const std::vector<std::size_t>& shape) {
  kinemend::Tensor tensor{kinemend::TensorType::f32, shape, {}};
  std::size_t count = 1;
  for (const std::size_t size : shape) count *= size;
  for (std::size_t i = 0; i < count; ++i)
    tensor.values.push_back(
        static_cast<double>(static_cast<float>(0.1 * std::sin(1.7 * static_cast<double>(i)))));
  return tensor;
}

kinemend::nn::NamedTensors ebf_weights(std::size_t features = ebf_channels + 3) {
  kinemend::nn::NamedTensors tensors;
  const auto dense = [&](const std::string& name, std::size_t inputs, std::size_t outputs) {
    tensors[name + ".weight"] = ebf_tensor({outputs, inputs});
    tensors[name + ".bias"] = ebf_tensor({outputs});
  };
  const std::vector<std::size_t> encoder{features, 128, 96, 80, 64};
  const std::vector<std::size_t> decoder{252, 192, 160, 128, ebf_channels};
  for (std::size_t i = 0; i < 4; ++i) {
    dense("encoder" + std::to_string(i), encoder[i], encoder[i + 1]);
    dense("decoder" + std::to_string(i), decoder[i], decoder[i + 1]);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    for (const char* way : {"forward", "backward"}) {
      dense(way + std::to_string(i) + ".input", i == 0 ? 64 : 252, 4 * 126);
      dense(way + std::to_string(i) + ".state", 126, 4 * 126);
    }
  }
  return tensors;
}

kinemend::FilterNetwork ebf(bool has_roughness = false) {
  using kinemend::nn::Activation;
  kinemend::FilterNetwork network;
  network.inputs.has_roughness = has_roughness;
  const kinemend::nn::NamedTensors tensors =
      ebf_weights(filter_feature_count(ebf_channels, network.inputs));
  network.statistics = {std::vector<float>(ebf_channels, 0.0F),
                        std::vector<float>(ebf_channels, 20.0F),
                        {50, 50, 50}};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string number = std::to_string(i);
    network.encoder.push_back(
        kinemend::nn::read_dense(tensors, "encoder" + number, Activation::tanh));
    network.decoder.push_back(kinemend::nn::read_dense(
        tensors, "decoder" + number, i < 3 ? Activation::tanh : Activation::none));
  }
  for (std::size_t i = 0; i < 2; ++i)
    network.recurrent.push_back({kinemend::nn::read_lstm(tensors, "forward" + std::to_string(i)),
                                 kinemend::nn::read_lstm(tensors, "backward" + std::to_string(i))});
  return network;
}

void count_frames(benchmark::State& state) {
  state.counters["ms per frame"] =
      benchmark::Counter(1e-3 * ebf_frames, benchmark::Counter::kIsIterationInvariantRate |
                                                benchmark::Counter::kInvert);
}

void ebf_whole_clip(benchmark::State& state) {
  const kinemend::FilterNetwork network = ebf();
  const kinemend::FilterTake take = ebf_take();
  for (auto _ : state) benchmark::DoNotOptimize(filtered(network, take).data());
  count_frames(state);
}
BENCHMARK(ebf_whole_clip)->Name("recurrent/ebf_whole_clip")->Unit(benchmark::kMillisecond);

void ebf_network_alone(benchmark::State& state) {
  const kinemend::FilterNetwork network = ebf();
  const std::vector<float> features =
      filter_features(ebf_take(), network.statistics, network.inputs);
  for (auto _ : state) benchmark::DoNotOptimize(run(network, features).data());
  count_frames(state);
}
BENCHMARK(ebf_network_alone)->Name("recurrent/ebf_network_alone")->Unit(benchmark::kMillisecond);

// Runs frame by frame with a delay of 15 frames; with argument 1, the network also sees roughness.
void ebf_live(benchmark::State& state) {
  const kinemend::FilterNetwork network = ebf(state.range(0) != 0);
  const kinemend::FilterTake take = ebf_take();
  kinemend::LiveFilterNetwork live(network, 120);
  std::vector<float> row(ebf_channels);
  std::size_t next = 0;
  kinemend::bench::FrameTimes times;
  for (auto _ : state) {
    const kinemend::LiveFilterNetwork::Input input{
        {take.values.data() + next * ebf_channels, ebf_channels},
        {take.missing.data(), ebf_channels / 3},
        {}};
    times.measure([&] { live.push(input, row); });
    benchmark::DoNotOptimize(row.data());
    next = (next + 1) % ebf_frames;
  }
  times.tell(state);
  state.counters["products_per_frame"] = live.products_per_frame();
}
BENCHMARK(ebf_live)
    ->Name("recurrent/ebf_live")
    ->ArgName("roughness")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMicrosecond);

#ifdef KINEMEND_HAS_TRAINING
void ebf_network_alone_by_libtorch(benchmark::State& state) {
  const kinemend::FilterNetwork network = ebf();
  const std::vector<float> features =
      filter_features(ebf_take(), network.statistics, network.inputs);
  kinemend::train::BidirectionalShape shape;
  shape.inputs = ebf_channels + 3;
  shape.outputs = ebf_channels;
  kinemend::train::SequenceNetwork torch(shape, {}, 1);
  kinemend::TensorFile weights = torch.state();
  for (const auto& [name, tensor] : ebf_weights()) weights.tensors["means." + name] = tensor;
  torch.set_state(weights);
  for (auto _ : state) benchmark::DoNotOptimize(torch.run(features).data());
  count_frames(state);
}
BENCHMARK(ebf_network_alone_by_libtorch)
    ->Name("recurrent/ebf_network_alone_by_libtorch")
    ->Unit(benchmark::kMillisecond);
#endif

}  // namespace
