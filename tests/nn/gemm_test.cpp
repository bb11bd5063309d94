// Tests of matrix products in both precisions: any shape, and the same bits on every system.
#include "nn/gemm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kinemend/extend/system.hpp"
#include "random_values.hpp"

namespace kinemend::nn {
namespace {

// Each test runs in both precisions.
template <class Real>
class Gemm : public testing::Test {
 protected:
  static std::vector<Real> random_values(std::size_t count, std::uint64_t seed) {
    const std::vector<double> values = kinemend::test::random_values(count, seed);
    return {values.begin(), values.end()};
  }
};
using Precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(Gemm, Precisions);

template <class Real>
double at(const BasicMatrixView<Real>& m, std::size_t r, std::size_t c) {
  return m.values[r * m.row_stride + c * m.column_stride];
}

// Compares with the definition. The rounding bound is (n + 2) u times the magnitudes of the n
// terms, u = 2^-53 or 2^-24, plus the same for the reference sum in doubles.
template <class Real>
void expect_product(const BasicMatrixView<Real>& a, const BasicMatrixView<Real>& b,
                    const BasicMutableMatrixView<Real>& c) {
  const double share =
      static_cast<double>(b.rows + 2) *
      (0.5 * static_cast<double>(std::numeric_limits<Real>::epsilon()) + std::ldexp(1, -53));
  for (std::size_t i = 0; i < c.rows; ++i) {
    for (std::size_t j = 0; j < c.columns; ++j) {
      double sum = 0, size = 0;
      for (std::size_t k = 0; k < b.rows; ++k) {
        sum += at(a, i, k) * at(b, k, j);
        size += std::abs(at(a, i, k) * at(b, k, j));
      }
      ASSERT_NEAR(c.values[i * c.row_stride + j], sum, share * size) << i << ", " << j;
    }
  }
}

TYPED_TEST(Gemm, MultipliesMatricesOfAnyShape) {
  using View = BasicMatrixView<TypeParam>;
  using MutableView = BasicMutableMatrixView<TypeParam>;
  const std::size_t sizes[] = {1, 2, 7, 8, 9, 24, 25, 63, 193, 400};
  for (const std::size_t rows : sizes) {
    for (const std::size_t depth : sizes) {
      for (const std::size_t columns : {1UL, 5UL, 8UL, 16UL, 24UL, 29UL, 50UL}) {
        if (rows * depth > 40000) continue;
        const auto a = this->random_values(rows * depth, 1),
                   b = this->random_values(depth * columns, 2);
        std::vector<TypeParam> c(rows * columns, 99);
        const View a_view{a.data(), rows, depth, depth};
        const View b_view{b.data(), depth, columns, columns};
        const MutableView c_view{c.data(), rows, columns, columns};
        multiply(a_view, b_view, c_view);
        expect_product(a_view, b_view, c_view);
      }
    }
  }
}

TYPED_TEST(Gemm, ReadsTransposedMatricesInPlace) {
  using View = BasicMatrixView<TypeParam>;
  using MutableView = BasicMutableMatrixView<TypeParam>;
  const auto a = this->random_values(70 * 31, 3), b = this->random_values(45 * 70, 4);
  std::vector<TypeParam> c(31 * 45);
  const View a_view = View{a.data(), 70, 31, 31}.transposed();
  const View b_view = View{b.data(), 45, 70, 70}.transposed();
  const MutableView c_view{c.data(), 31, 45, 45};
  multiply(a_view, b_view, c_view);
  expect_product(a_view, b_view, c_view);
}

TYPED_TEST(Gemm, MakesHalfOfASymmetricProduct) {
  using View = BasicMatrixView<TypeParam>;
  using MutableView = BasicMutableMatrixView<TypeParam>;
  for (const std::size_t size : {1UL, 7UL, 48UL, 49UL, 130UL}) {
    const std::size_t depth = 201;
    const auto a = this->random_values(depth * size, 8);
    std::vector<TypeParam> b = a, c(size * size, 0.5);
    for (TypeParam& value : b) value *= 3;
    const View left = View{a.data(), depth, size, size}.transposed();
    const View right{b.data(), depth, size, size};
    const MutableView product{c.data(), size, size, size};
    multiply_symmetric(left, right, product, Product::add);
    for (TypeParam& value : c) value -= 0.5;
    for (std::size_t r = 0; r < size; ++r) {
      for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(c[r * size + k], c[k * size + r]);
    }
    multiply_symmetric(left, right, product);
    expect_product(left, right, product);
  }
}

TYPED_TEST(Gemm, MultipliesWithAPackedMatrixToTheSameBits) {
  using View = BasicMatrixView<TypeParam>;
  for (const std::size_t depth : {1UL, 191UL, 192UL, 400UL}) {
    for (const std::size_t columns : {1UL, 24UL, 31UL}) {
      const auto a = this->random_values(11 * depth, 1),
                 b = this->random_values(depth * columns, 2);
      std::vector<TypeParam> expected(11 * columns, 7), found(11 * columns, 7);
      const View left{a.data(), 11, depth, depth};
      const View right{b.data(), depth, columns, columns};
      const BasicPackedMatrix<TypeParam> packed(right);
      EXPECT_EQ(packed.rows(), depth);
      EXPECT_EQ(packed.columns(), columns);
      for (const Product product : {Product::overwrite, Product::add}) {
        multiply(left, right, {expected.data(), 11, columns, columns}, product);
        multiply(left, packed, {found.data(), 11, columns, columns}, product);
        EXPECT_EQ(found, expected);
      }
    }
  }
}

TYPED_TEST(Gemm, TakesASequenceForItsTrajectoryMatrix) {
  using View = BasicMatrixView<TypeParam>;
  using MutableView = BasicMutableMatrixView<TypeParam>;
  const std::size_t channels = 5, frames = 40, window = 12;
  const auto sequence = this->random_values(frames * channels, 5);
  const auto b = this->random_values(window * channels * 9, 6);
  const View trajectory{sequence.data(), frames - window + 1, window * channels, channels};
  const View b_view{b.data(), window * channels, 9, 9};
  std::vector<TypeParam> c(trajectory.rows * 9);
  const MutableView c_view{c.data(), trajectory.rows, 9, 9};
  multiply(trajectory, b_view, c_view);
  expect_product(trajectory, b_view, c_view);
}

TYPED_TEST(Gemm, AddsToWhatIsThereAndLeavesTheRestOfTheRowsAlone) {
  using View = BasicMatrixView<TypeParam>;
  const auto a = this->random_values(10 * 4, 7), b = this->random_values(4 * 3, 8);
  std::vector<TypeParam> c(10 * 6, 1.0), product(10 * 3);
  multiply(View{a.data(), 10, 4, 4}, {b.data(), 4, 3, 3}, {product.data(), 10, 3, 3});
  multiply({a.data(), 10, 4, 4}, {b.data(), 4, 3, 3}, {c.data(), 10, 3, 6}, Product::add);
  for (std::size_t r = 0; r < 10; ++r) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(c[r * 6 + j], 1.0 + product[r * 3 + j],
                  4 * std::numeric_limits<TypeParam>::epsilon());
      EXPECT_EQ(c[r * 6 + 3 + j], 1.0);
    }
  }
}

TYPED_TEST(Gemm, OverwritesWithZerosWhereNothingIsSummed) {
  std::vector<TypeParam> c(6, 3.0);
  multiply({nullptr, 2, 0, 0}, {nullptr, 0, 3, 3}, {c.data(), 2, 3, 3});
  EXPECT_THAT(c, testing::Each(0.0));
}

TYPED_TEST(Gemm, GivesTheSameBitsWithAnyNumberOfThreads) {
  const auto a = this->random_values(300 * 250, 9), b = this->random_values(250 * 90, 10);
  std::vector<TypeParam> several(300 * 90), one(300 * 90);
  const auto product = [&](std::vector<TypeParam>& c) {
    multiply({a.data(), 300, 250, 250}, {b.data(), 250, 90, 90}, {c.data(), 300, 90, 90});
  };
  product(several);
  const ThreadLimit single(1);
  product(one);
  EXPECT_EQ(several, one);
}

// Every instruction set must sum in the order of the depth, block by block.
TYPED_TEST(Gemm, SumsInOneOrderOnEveryProcessor) {
  const std::size_t depth = 500;
  const auto a = this->random_values(3 * depth, 11), b = this->random_values(depth * 11, 12);
  std::vector<TypeParam> c(3 * 11);
  multiply({a.data(), 3, depth, depth}, {b.data(), depth, 11, 11}, {c.data(), 3, 11, 11});
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 11; ++j) {
      TypeParam total = 0;
      for (std::size_t first = 0; first < depth; first += 192) {
        TypeParam block = 0;
        for (std::size_t k = first; k < std::min(depth, first + 192); ++k) {
          const TypeParam term = a[i * depth + k] * b[k * 11 + j];
          block += term;
        }
        total += block;
      }
      EXPECT_EQ(c[i * 11 + j], total);
    }
  }
}

}  // namespace
}  // namespace kinemend::nn
