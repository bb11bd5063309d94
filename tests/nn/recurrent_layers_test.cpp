#include "nn/recurrent_layers.hpp"

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

Lstm read(const NamedTensors& tensors, const std::string& name, const Lstm*) {
  return read_lstm(tensors, name);
}
Gru read(const NamedTensors& tensors, const std::string& name, const Gru*) {
  return read_gru(tensors, name);
}

template <class Layer>
void expect_as_libtorch(const std::string& name) {
  const NamedTensors& tensors = expected_of_layers();
  const FloatMatrix x(tensors.at(name + ".x"));
  const Layer forward = read(tensors, name + ".forward", static_cast<const Layer*>(nullptr));
  const Layer backward = read(tensors, name + ".backward", static_cast<const Layer*>(nullptr));
  FloatMatrix y(x.rows, 2 * forward.units());
  run(forward, Direction::forward, x.view(), y.mutable_view().block(0, 0, x.rows, forward.units()));
  run(backward, Direction::backward, x.view(),
      y.mutable_view().block(0, forward.units(), x.rows, forward.units()));
  expect_near(y, tensors.at(name + ".y"), 1e-5);
}

template <class Layer>
void expect_steps_as_sequence(const std::string& name) {
  const NamedTensors& tensors = expected_of_layers();
  const FloatMatrix x(tensors.at(name + ".x"));
  const Layer layer = read(tensors, name + ".forward", static_cast<const Layer*>(nullptr));
  FloatMatrix y(x.rows, layer.units());
  run(layer, Direction::forward, x.view(), y.mutable_view());
  RecurrentState state = start(layer);
  for (std::size_t t = 0; t < x.rows; ++t) {
    step(layer, std::span(x.values).subspan(t * x.columns, x.columns), state);
    const std::vector<float> row(
        y.values.begin() + static_cast<std::ptrdiff_t>(t * y.columns),
        y.values.begin() + static_cast<std::ptrdiff_t>((t + 1) * y.columns));
    EXPECT_EQ(state.hidden, row) << "frame " << t;
  }
}

TEST(RecurrentLayers, AnLstmAgreesWithLibTorchInBothDirections) {
  expect_as_libtorch<Lstm>("lstm");
}
TEST(RecurrentLayers, AGruAgreesWithLibTorchInBothDirections) { expect_as_libtorch<Gru>("gru"); }

TEST(RecurrentLayers, AnLstmGivesFrameByFrameTheBitsOfTheWholeSequence) {
  expect_steps_as_sequence<Lstm>("lstm");
}
TEST(RecurrentLayers, AGruGivesFrameByFrameTheBitsOfTheWholeSequence) {
  expect_steps_as_sequence<Gru>("gru");
}

TEST(RecurrentLayers, ALayerWhoseGatesDoNotFitItsUnitsIsRefused) {
  EXPECT_THROW(read_gru(expected_of_layers(), "lstm.forward"), Error);
  EXPECT_THROW(read_lstm(expected_of_layers(), "gru.forward"), Error);
}

TEST(RecurrentLayers, NoFramesGiveNone) {
  const Lstm layer = read_lstm(expected_of_layers(), "lstm.forward");
  const MatrixViewF x{nullptr, 0, layer.inputs(), layer.inputs()};
  run(layer, Direction::forward, x, {nullptr, 0, layer.units(), layer.units()});
}

}  // namespace
}  // namespace kinemend::nn
