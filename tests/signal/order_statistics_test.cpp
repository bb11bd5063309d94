// Tests of selection by rank on each instruction set, against sorting.
#include "signal/median.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "signal/kernels.hpp"
#include "signal/support.hpp"

namespace kinemend::test {
namespace {

std::vector<double> some_values(std::size_t count, int kind, Random& random) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double position = static_cast<double>(i);
    if (kind == 0) values[i] = random.normal();
    if (kind == 1) values[i] = static_cast<double>(random.below(4));                   // many equal
    if (kind == 2) values[i] = position;                                               // rising
    if (kind == 3) values[i] = -position;                                              // falling
    if (kind == 4) values[i] = 7;                                                      // all equal
    if (kind == 5) values[i] = std::abs(position - 0.5 * static_cast<double>(count));  // a valley
  }
  return values;
}

TEST(SelectRank, FindsWhatSortingFindsOnEachInstructionSet) {
  Random random(1);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    for (const std::size_t count : {1u, 2u, 15u, 48u, 49u, 50u, 77u, 200u, 1001u}) {
      for (int kind = 0; kind < 6; ++kind) {
        const std::vector<double> values = some_values(count, kind, random);
        std::vector<double> sorted = values;
        std::sort(sorted.begin(), sorted.end());
        for (const std::size_t rank : {std::size_t{0}, count / 3, (count - 1) / 2, count - 1}) {
          std::vector<double> copy = values;
          std::vector<double> scratch(count);
          const auto found = signal::select_rank(copy.data(), count, rank, scratch.data());
          ASSERT_EQ(found.value, sorted[rank])
              << count << " values of kind " << kind << ", rank " << rank;
          if (rank + 1 < count) {
            ASSERT_EQ(found.next, sorted[rank + 1]) << count << " values of kind " << kind;
          }
        }
      }
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(Median, OfNumbersIsTheMiddleOneOrTheMeanOfTheTwoMiddleOnes) {
  Random random(2);
  for (std::size_t count = 0; count < 150; ++count) {
    std::vector<double> values = some_values(count, 0, random);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const double expected = count == 0 ? 0 : (sorted[(count - 1) / 2] + sorted[count / 2]) / 2;
    EXPECT_EQ(signal::median(values), expected) << count;
  }
}

TEST(Columns, ComeOneByOneInOrder) {
  const PoseMatrix matrix = noisy_sines(30, 19, 3);
  std::size_t next = 0;
  signal::for_each_column(matrix.row(4).data(), 20, 19,
                          [&](std::size_t c, std::span<double> values) {
                            ASSERT_EQ(c, next++);
                            ASSERT_EQ(values.size(), 20u);
                            for (std::size_t t = 0; t < 20; ++t)
                              ASSERT_EQ(values[t], matrix(t + 4, c));
                          });
  EXPECT_EQ(next, 19u);
}

}  // namespace
}  // namespace kinemend::test
