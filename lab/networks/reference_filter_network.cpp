// Writes small LibTorch networks of Mall et al. 2017 to tests/fixtures/nn/filter_<kind>.safetensors
// (ebf, bf, nn, ebd), which tests/papers/mall2017_recurrent/filter_network_test.cpp compares with.
// Built where LibTorch is found:
//   cmake --build build/release --target reference_filter_network
//   build/release/lab/networks/reference_filter_network FOLDER
#include <fstream>
#include <iostream>
#include <string>

#include "papers/mall2017_recurrent/filter_network.hpp"
#include "reference_network.hpp"

using namespace kinemend;

namespace {

train::BidirectionalShape shape_of(const std::string& kind) {
  constexpr std::size_t channels = 6;
  const bool is_ebd = kind == "ebd";
  train::BidirectionalShape shape;
  shape.inputs = filter_feature_count(channels, {false, is_ebd});
  shape.outputs = channels;
  shape.encoder = {9, 7, 6, 5};
  shape.units = is_ebd ? 4 : 6;
  shape.decoder = {8, 7, 7};
  if (kind == "bf" || kind == "nn") shape.encoder.clear();
  if (kind == "nn") {
    shape.layers = 0;
    shape.reach = 3;
    shape.decoder = {8, 7, 7, 6, 5};
  }
  return shape;
}

void write_network(const std::string& folder, const std::string& kind) {
  const TensorFile file = train::reference_network(shape_of(kind), 19, 0.4,
                                                   "lab/networks/reference_filter_network.cpp");
  std::ofstream(folder + "/filter_" + kind + ".safetensors", std::ios::binary)
      << write_tensors(file);
}

}  // namespace

int main(int count, char** values) {
  if (count != 2) {
    std::cerr << "usage: reference_filter_network FOLDER\n";
    return 2;
  }
  for (const char* kind : {"ebf", "bf", "nn", "ebd"}) write_network(values[1], kind);
}
