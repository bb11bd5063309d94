// The layer fixture from LibTorch, and float matrices for tests.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "nn/layers.hpp"

namespace kinemend::nn::test {

/// Random weights and inputs with LibTorch's results (tools/reference/layers.cpp).
inline const NamedTensors& expected_of_layers() {
  static const NamedTensors tensors = [] {
    const std::string path = KINEMEND_TEST_FIXTURES "/nn/layers.safetensors";
    std::ifstream file(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    return parse_tensors(bytes, path).tensors;
  }();
  return tensors;
}

struct FloatMatrix {
  std::size_t rows, columns;
  std::vector<float> values;

  FloatMatrix(std::size_t row_count, std::size_t column_count)
      : rows(row_count), columns(column_count), values(row_count * column_count) {}
  explicit FloatMatrix(const Tensor& tensor)
      : rows(tensor.shape[0]), columns(tensor.shape[1]), values(floats_of(tensor)) {}

  MatrixViewF view() const { return {values.data(), rows, columns, columns}; }
  MutableMatrixViewF mutable_view() { return {values.data(), rows, columns, columns}; }
};

/// Expects each number within `share` of its size, or of 1 if that is larger.
inline void expect_near(const FloatMatrix& found, const Tensor& expected, double share) {
  ASSERT_EQ(found.values.size(), expected.values.size());
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    const double size = std::max(1.0, std::abs(expected.values[i]));
    EXPECT_NEAR(found.values[i], expected.values[i], share * size) << "number " << i;
  }
}

}  // namespace kinemend::nn::test
