// Tests of dense and convolutional layers and of activations, against LibTorch and the math
// library.
#include "nn/layers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "layers_support.hpp"
#include "random_values.hpp"

namespace kinemend::nn {
namespace {

using test::expect_near;
using test::expected_of_layers;
using test::FloatMatrix;

TEST(Layers, DenseLayersAgreeWithLibTorchForEachActivation) {
  const NamedTensors& tensors = expected_of_layers();
  const FloatMatrix x(tensors.at("dense.x"));
  const std::vector<std::pair<std::string, Activation>> activations{{"none", Activation::none},
                                                                    {"relu", Activation::relu},
                                                                    {"tanh", Activation::tanh},
                                                                    {"exp", Activation::exp}};
  for (const auto& [name, activation] : activations) {
    const Dense layer = read_dense(tensors, "dense", activation);
    FloatMatrix y(x.rows, layer.outputs());
    run(layer, x.view(), y.mutable_view());
    expect_near(y, tensors.at("dense." + name), 1e-5);
  }
}

TEST(Layers, ConvolutionsAgreeWithLibTorchCausalAndCentred) {
  const NamedTensors& tensors = expected_of_layers();
  for (const std::string name : {"centred", "causal"}) {
    const FloatMatrix x(tensors.at(name + ".x"));
    Convolution layer = read_convolution(tensors, name, 2);
    layer.is_causal = name == "causal";
    FloatMatrix y(x.rows, layer.outputs());
    run(layer, x.view(), y.mutable_view());
    expect_near(y, tensors.at(name + ".y"), 1e-5);
  }
}

TEST(Layers, AConvolutionOfFewerFramesThanItReachesSeesZerosBeyond) {
  const NamedTensors& tensors = expected_of_layers();
  const FloatMatrix x(tensors.at("centred.x"));
  const Convolution layer = read_convolution(tensors, "centred", 2);
  FloatMatrix one(1, layer.inputs()), y(1, layer.outputs());
  std::copy_n(x.values.begin(), layer.inputs(), one.values.begin());
  run(layer, one.view(), y.mutable_view());
  const Tensor& weight = tensors.at("centred.weight");
  for (std::size_t o = 0; o < layer.outputs(); ++o) {
    double sum = tensors.at("centred.bias").values[o];
    for (std::size_t i = 0; i < layer.inputs(); ++i)
      sum += weight.values[(o * 3 + 1) * layer.inputs() + i] * static_cast<double>(one.values[i]);
    EXPECT_NEAR(y.values[o], sum, 1e-5);
  }
}

TEST(Layers, ActivationsAreTheirFunctionsOverTheRangeOfFloatsAndAtAnyLength) {
  for (const std::size_t count : {1UL, 3UL, 8UL, 17UL, 64UL, 201UL}) {
    std::vector<float> x;
    for (std::size_t i = 0; i < count; ++i)
      x.push_back(static_cast<float>(-100.0 + 200.0 * static_cast<double>(i) / 200.0));
    const auto result = [&](Activation activation) {
      std::vector<float> y = x;
      activate(activation, y);
      return y;
    };
    const auto exps = result(Activation::exp), tanhs = result(Activation::tanh);
    const auto relus = result(Activation::relu);
    for (std::size_t i = 0; i < count; ++i) {
      const double v = static_cast<double>(x[i]);
      const double bounded = std::exp(std::min(87.0, std::max(-87.0, v)));
      EXPECT_NEAR(exps[i] / bounded, 1, 3e-7) << v;
      EXPECT_NEAR(tanhs[i], std::tanh(v), 3e-7) << v;
      EXPECT_EQ(relus[i], std::max(0.0F, x[i])) << v;
    }
  }
}

TEST(Layers, ALayerWhoseTensorsAreMissingOrDoNotFitIsRefusedByName) {
  NamedTensors tensors = expected_of_layers();
  const auto message = [&] {
    try {
      read_dense(tensors, "dense");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  tensors["dense.bias"].shape = {8};
  tensors["dense.bias"].values.resize(8);
  EXPECT_EQ(message(), "tensor dense.bias: expected 9 numbers, found 8");
  tensors["dense.weight"].shape = {63};
  EXPECT_EQ(message(), "tensor dense.weight: expected 2 sizes, found [63]");
  tensors.erase("dense.weight");
  EXPECT_EQ(message(), "tensor dense.weight is missing");
}

}  // namespace
}  // namespace kinemend::nn
