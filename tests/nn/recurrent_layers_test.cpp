// Tests of LSTM layers, against LibTorch and frame by frame.
#include "nn/layers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "layers_support.hpp"

namespace kinemend::nn {
namespace {

using test::expect_near;
using test::expected_of_layers;
using test::FloatMatrix;

TEST(RecurrentLayers, AnLstmAgreesWithLibTorchInBothDirections) {
  const NamedTensors& tensors = expected_of_layers();
  const FloatMatrix x(tensors.at("lstm.x"));
  const Lstm forward = read_lstm(tensors, "lstm.forward");
  const Lstm backward = read_lstm(tensors, "lstm.backward");
  FloatMatrix y(x.rows, 2 * forward.units());
  run(forward, Direction::forward, x.view(), y.mutable_view().block(0, 0, x.rows, forward.units()));
  run(backward, Direction::backward, x.view(),
      y.mutable_view().block(0, forward.units(), x.rows, forward.units()));
  expect_near(y, tensors.at("lstm.y"), 1e-5);
}

TEST(RecurrentLayers, AnLstmGivesFrameByFrameTheBitsOfTheWholeSequence) {
  const NamedTensors& tensors = expected_of_layers();
  const FloatMatrix x(tensors.at("lstm.x"));
  const Lstm layer = read_lstm(tensors, "lstm.forward");
  FloatMatrix y(x.rows, layer.units());
  run(layer, Direction::forward, x.view(), y.mutable_view());
  RecurrentState state = start(layer);
  FloatMatrix gates(1, layer.input.outputs()), hidden(1, layer.units());
  for (std::size_t t = 0; t < x.rows; ++t) {
    run(layer.input, x.view().block(t, 0, 1, x.columns), gates.mutable_view());
    run_on(layer, Direction::forward, gates.view(), state, hidden.mutable_view());
    const std::vector<float> row(
        y.values.begin() + static_cast<std::ptrdiff_t>(t * y.columns),
        y.values.begin() + static_cast<std::ptrdiff_t>((t + 1) * y.columns));
    EXPECT_EQ(hidden.values, row) << "frame " << t;
  }
}

TEST(RecurrentLayers, ALayerWhoseGatesDoNotFitItsUnitsIsRefused) {
  NamedTensors tensors = expected_of_layers();
  for (const char* part : {".weight", ".bias"})
    tensors[std::string("lstm.forward.input") + part] = tensors.at(std::string("dense") + part);
  EXPECT_THROW(read_lstm(tensors, "lstm.forward"), Error);
}

TEST(RecurrentLayers, NoFramesWriteNothing) {
  const Lstm layer = read_lstm(expected_of_layers(), "lstm.forward");
  const MatrixViewF x{nullptr, 0, layer.inputs(), layer.inputs()};
  std::vector<float> beyond(layer.units(), 7.0F);
  for (const Direction direction : {Direction::forward, Direction::backward})
    run(layer, direction, x, {beyond.data(), 0, layer.units(), layer.units()});
  EXPECT_EQ(beyond, std::vector<float>(layer.units(), 7.0F));
}

}  // namespace
}  // namespace kinemend::nn
