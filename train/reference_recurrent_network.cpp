// A small network of the method recurrent by LibTorch: writes
// tests/fixtures/nn/recurrent.safetensors, which tests/priors/recurrent_network_test.cpp compares
// with. Built where LibTorch is found:
//   cmake --build build/dev --target reference_recurrent_network
//   build/dev/train/reference_recurrent_network FILE
#include <fstream>
#include <iostream>

#include "priors/recurrent_input.hpp"
#include "reference_network.hpp"

using namespace kinemend;

int main(int count, char** values) {
  if (count != 2) {
    std::cerr << "usage: reference_recurrent_network FILE\n";
    return 2;
  }
  constexpr std::size_t channels = 6, steps = 23;
  train::ConvolutionalShape shape;
  shape.inputs = recurrent_feature_count(channels);
  shape.hidden = 10;
  shape.outputs = recurrent_output_count(channels);
  shape.dilations = {1, 4};
  const TensorFile file =
      train::reference_network(shape, steps, 0.3, "train/reference_recurrent_network.cpp");
  std::ofstream(values[1], std::ios::binary) << write_tensors(file);
}
