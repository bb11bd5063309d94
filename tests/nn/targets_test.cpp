// Every instruction set of this processor gives the same result, also at unaligned addresses.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <vector>

#include "nn/gemm.hpp"
#include "nn/layers.hpp"
#include "random_values.hpp"

namespace kinemend::nn {
namespace {

using kinemend::test::random_values;

// Restricts the kernels to one instruction set during its lifetime.
class OneTarget {
 public:
  explicit OneTarget(std::int64_t target) { use(target); }
  ~OneTarget() { use(0); }
  OneTarget(const OneTarget&) = delete;
  OneTarget& operator=(const OneTarget&) = delete;

 private:
  static void use(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

std::vector<std::int64_t> targets_here() {
  std::vector<std::int64_t> targets;
  for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1)
    targets.push_back(rest & -rest);
  return targets;
}

std::vector<float> product_of(std::size_t columns, std::size_t shift) {
  constexpr std::size_t rows = 7, depth = 11;
  const std::vector<double> a = random_values(rows * depth, 1),
                            b = random_values(depth * columns, 2);
  const std::vector<float> left(a.begin(), a.end()), right(b.begin(), b.end());
  std::vector<float> product(rows * columns + shift, 1.0F);
  multiply(BasicMatrixView<float>{left.data(), rows, depth, depth},
           BasicMatrixView<float>{right.data(), depth, columns, columns},
           {product.data() + shift, rows, columns, columns}, Product::add);
  return product;
}

TEST(Targets, GiveTheSameProducts) {
  const std::vector<std::int64_t> targets = targets_here();
  for (const std::size_t columns : {1, 3, 5, 13, 31, 50}) {
    for (const std::size_t shift : {0, 1, 2, 3}) {
      const std::vector<float> expected = product_of(columns, shift);
      for (const std::int64_t target : targets) {
        const OneTarget one(target);
        EXPECT_EQ(product_of(columns, shift), expected) << target << ", " << columns;
      }
    }
  }
}

}  // namespace
}  // namespace kinemend::nn
