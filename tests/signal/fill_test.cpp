// Tests of filling missing samples of channels, against SciPy and NumPy.
#include <gtest/gtest.h>

#include "kinemend/error.hpp"
#include "signal/support.hpp"

namespace kinemend::test {
namespace {

std::vector<std::uint8_t> reference_marks() {
  const auto& numbers = reference().at("missing");
  return {numbers.begin(), numbers.end()};
}

TEST(Fill, GivesTheNumbersOfSciPysNaturalSplineAndOfNumPysInterp) {
  const auto marks = reference_marks();
  for (const bool cubic : {false, true}) {
    PoseMatrix take = column(reference().at("input/long"));
    const PoseMatrix input = take;
    for (std::size_t t = 0; t < take.frames; ++t) {
      if (marks[t]) take(t, 0) = 1e6;  // missing values are ignored
    }
    (cubic ? fill_cubic : fill_linear)(take, marks);
    EXPECT_LT(largest_difference(take.values, reference().at(cubic ? "fill_cubic" : "fill_linear")),
              1e-10);
    for (std::size_t t = 0; t < take.frames; ++t) {
      if (!marks[t]) {
        EXPECT_EQ(take(t, 0), input(t, 0));
      }
    }
  }
}

TEST(Fill, HoldsTheNearestValueBeyondTheSamples) {
  for (const auto fill : {fill_linear, fill_cubic}) {
    PoseMatrix take(6, 1);
    take.values = {9, 9, 1, 3, 9, 9};
    fill(take, std::vector<std::uint8_t>{1, 1, 0, 0, 1, 1});
    EXPECT_EQ(take.values, (std::vector<double>{1, 1, 1, 3, 3, 3}));
  }
}

TEST(Fill, KnowsEachChannelsOwnMarks) {
  for (const auto fill : {fill_linear, fill_cubic}) {
    PoseMatrix take(3, 3);
    take.values = {0, 5, 7, 9, 9, 7, 4, 9, 7};
    fill(take, std::vector<std::uint8_t>{0, 0, 1, 1, 1, 1, 0, 1, 1});
    EXPECT_EQ(take.values, (std::vector<double>{0, 5, 7, 2, 5, 7, 4, 5, 7}));
  }
}

TEST(Fill, PutsALineBackExactlyWhateverIsMissing) {
  PoseMatrix take(60, 1);
  for (std::size_t t = 0; t < 60; ++t) take(t, 0) = 0.5 * static_cast<double>(t) - 3;
  const PoseMatrix clean = take;
  Random random(9);
  std::vector<std::uint8_t> marks(60, 0);
  for (std::size_t t = 1; t < 59; ++t) marks[t] = random.chance(0.6);
  for (const auto fill : {fill_linear, fill_cubic}) {
    fill(take, marks);
    EXPECT_LT(largest_difference(take.values, clean.values), 1e-12);
  }
}

TEST(Fill, RefusesMarksOfAnotherSizeAndTakesNone) {
  PoseMatrix take = noisy_sines(5, 2, 1);
  const PoseMatrix input = take;
  EXPECT_THROW(fill_linear(take, std::vector<std::uint8_t>(9, 0)), Error);
  fill_cubic(take, {});
  EXPECT_EQ(take.values, input.values);
  PoseMatrix none(0, 0);
  fill_linear(none, {});
}

}  // namespace
}  // namespace kinemend::test
