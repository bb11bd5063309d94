// Tests of measured values as text: their units and digits.
#include "base/text.hpp"

#include <gtest/gtest.h>

namespace kinemend {
namespace {

TEST(Measure, ShortLengthsInMetresAreShownInMillimetres) {
  EXPECT_EQ(measure_text(0.00695, "m"), "6.95 mm");
  EXPECT_EQ(measure_text(1.78, "m"), "1.78 m");
  EXPECT_EQ(measure_text(0, "m"), "0 mm");
}

TEST(Measure, EveryValueHasAUnitAndNoExponent) {
  EXPECT_EQ(measure_text(3940, "mm"), "3940 mm");
  EXPECT_EQ(measure_text(1.5, "deg"), "1.50 deg");
  EXPECT_EQ(measure_text(12.5, ""), "12.5 units");
}

}  // namespace
}  // namespace kinemend
