#include "priors/recurrent_network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "recurrent_support.hpp"

namespace kinemend {
namespace {

using test::small_network_model;

std::string message_of(const Model& model) {
  try {
    recurrent_network_of(model);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RecurrentNetwork, AgreesWithLibTorchOnTheSameWeights) {
  const Model model = small_network_model();
  const RecurrentNetwork network = recurrent_network_of(model);
  const std::vector<float> outputs = run(network, nn::floats_of(model.tensors.at("features")));
  const std::vector<double>& expected = model.tensors.at("outputs").values;
  ASSERT_EQ(outputs.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(outputs[i], expected[i], 1e-4) << "number " << i;
}

TEST(RecurrentNetwork, ThatDoesNotFitItselfOrItsBodyIsRefusedWithTheLayer) {
  Model model = small_network_model();
  model.tensors.erase("block1.dense.bias");
  EXPECT_EQ(message_of(model), "tensor block1.dense.bias is missing");
  model = small_network_model();
  model.numbers["block0.dilation"] = 0;
  EXPECT_EQ(message_of(model), "the model's block0.dilation is not between 1 and 4096");
  model = small_network_model();
  model.tensors["speed"].values[2] = 0;
  EXPECT_EQ(message_of(model), "the model's speed is not positive everywhere");
  model = small_network_model();
  model.tensors["output.weight"] = {TensorType::f32, {5, 10}, std::vector<double>(50)};
  model.tensors["output.bias"] = {TensorType::f32, {5}, std::vector<double>(5)};
  EXPECT_EQ(message_of(model), "the model's layer output: expected 84 numbers, found 5");
}

}  // namespace
}  // namespace kinemend
