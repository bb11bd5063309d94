#include "nn/float_tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinemend/error.hpp"
#include "random_values.hpp"

namespace kinemend::nn {
namespace {

TEST(FloatTensor, IsTheNearestToWhatIsStored) {
  const Tensor tensor{TensorType::f64, {20, 15}, test::random_values(300, 1)};
  const TensorF single = to_float(tensor);
  EXPECT_EQ(single.shape, tensor.shape);
  ASSERT_EQ(single.size(), tensor.size());
  for (std::size_t i = 0; i < tensor.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(single.values[i]), tensor.values[i],
                std::ldexp(std::abs(tensor.values[i]), -24));
  }
}

TEST(FloatTensor, GoesThroughAFileToTheBit) {
  const TensorF written = to_float({TensorType::f64, {40}, test::random_values(40, 2)});
  const std::string bytes = write_tensors({{}, {{"weights", to_tensor(written)}}});
  const TensorF read = to_float(parse_tensors(bytes, "a").tensors.at("weights"));
  EXPECT_EQ(read.shape, written.shape);
  EXPECT_EQ(read.values, written.values);
}

TEST(FloatTensor, RefusesWhatNoFloatHolds) {
  EXPECT_THROW(to_float({TensorType::f64, {1}, {1e39}}), Error);
  EXPECT_EQ(to_float({TensorType::f64, {}, {3.4e38}}).values, std::vector<float>{3.4e38F});
}

TEST(FloatTensor, IsAFactorOfProductsLikeATensor) {
  const Tensor a{TensorType::f64, {3, 8}, test::random_values(24, 3)};
  const Tensor b{TensorType::f64, {8, 5}, test::random_values(40, 4)};
  std::vector<double> c(15);
  multiply(matrix_of(a), matrix_of(b), {c.data(), 3, 5, 5});
  const TensorF a_single = to_float(a), b_single = to_float(b);
  std::vector<float> c_single(15);
  multiply(matrix_of(a_single), matrix_of(b_single), {c_single.data(), 3, 5, 5});
  // Eight terms, and each factor rounded: 12 u times their sizes, which are below 8 x 4 x 4.
  for (std::size_t i = 0; i < c.size(); ++i)
    EXPECT_NEAR(static_cast<double>(c_single[i]), c[i], 12 * 128 * std::ldexp(1, -24));
  EXPECT_THROW(matrix_of(Tensor{TensorType::f64, {24}, a.values}), Error);
}

}  // namespace
}  // namespace kinemend::nn
