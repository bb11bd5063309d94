// Tests of the convolution with patterns, against the sum over all windows.
#include "papers/lou2010_example/pattern_penalty.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/parallel.hpp"
#include "random_values.hpp"

namespace kinemend {
namespace {

using test::random_values;

// Sums window by window over a cyclic sequence.
std::vector<double> brute_product(const std::vector<double>& patterns, std::size_t window,
                                  std::size_t values, std::size_t count,
                                  const std::vector<double>& z) {
  const std::size_t rows = z.size() / values;
  std::vector<double> image(z.size());
  for (std::size_t s = 0; s < rows; ++s) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto place = [&](std::size_t i) {
        return (s + i / values) % rows * values + i % values;
      };
      double coefficient = 0;
      for (std::size_t i = 0; i < window * values; ++i)
        coefficient += patterns[i * count + k] * z[place(i)];
      for (std::size_t i = 0; i < window * values; ++i)
        image[place(i)] += patterns[i * count + k] * coefficient;
    }
  }
  return image;
}

TEST(PatternConvolution, IsTheSumOverAllWindowsOfARepeatingSequence) {
  for (const std::size_t window : {1UL, 2UL, 7UL, 12UL}) {
    for (const std::size_t values : {1UL, 3UL, 17UL}) {
      for (const std::size_t count : {1UL, 5UL}) {
        const std::vector<double> patterns = random_values(window * values * count, window);
        PatternConvolution convolution(patterns, window, values, count);
        // One object serves sequences of any length, in any order.
        for (const std::size_t rows : {window, window + 1, 200UL, 41UL}) {
          const std::vector<double> z = random_values(rows * values, rows);
          const std::vector<double> expected = brute_product(patterns, window, values, count, z);
          std::vector<double> found(z.size());
          convolution.multiply(z.data(), rows, found.data());
          for (std::size_t i = 0; i < found.size(); ++i)
            ASSERT_NEAR(found[i], expected[i], 1e-10) << window << ", " << values << ", " << rows;
        }
      }
    }
  }
}

// A product of this size is itself split among threads.
TEST(PatternConvolution, IsTheSameWithAnyNumberOfThreads) {
  const std::size_t window = 12, values = 320, count = 200, rows = 40;
  const std::vector<double> patterns = random_values(window * values * count, 1);
  const std::vector<double> z = random_values(rows * values, 2);
  const auto product_with = [&](std::size_t threads) {
    const StandardThreads pool(threads);
    std::vector<double> image(z.size());
    PatternConvolution convolution(patterns, window, values, count);
    convolution.multiply(z.data(), rows, image.data());
    return image;
  };
  const std::vector<double> expected = product_with(1);
  for (int attempt = 0; attempt < 8; ++attempt) EXPECT_EQ(product_with(4), expected);
}

TEST(PatternConvolution, TakesRowsThatPatternsLackForZeros) {
  std::vector<double> patterns = random_values(4 * 3 * 2, 1);
  std::fill(patterns.end() - 4, patterns.end(), 0.0);
  PatternConvolution whole(patterns, 4, 3, 2);
  patterns.resize(patterns.size() - 4);
  PatternConvolution cut(patterns, 4, 3, 2);
  const std::vector<double> z = random_values(30 * 3, 2);
  std::vector<double> expected(z.size()), found(z.size());
  whole.multiply(z.data(), 30, expected.data());
  cut.multiply(z.data(), 30, found.data());
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace kinemend
