#include "kinemend/experimental/text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace kinemend::test {
namespace {

TEST(Text, FiguresHaveThreeDigitsThatCount) {
  EXPECT_EQ(figure(0), "0");
  EXPECT_EQ(figure(1234.5), "1234");
  EXPECT_EQ(figure(12.345), "12.3");
  EXPECT_EQ(figure(1.2345), "1.23");
  EXPECT_EQ(figure(0.0012345), "0.00123");
  EXPECT_EQ(figure(0.1), "0.10");
  EXPECT_EQ(figure(std::numeric_limits<double>::infinity()), "infinite");
}

TEST(Text, CountsAreGroupedAndHaveANoun) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(counted(1, "frame"), "1 frame");
  EXPECT_EQ(counted(2404, "frame"), "2,404 frames");
  EXPECT_EQ(length_text(240, 120), "240 frames at 120 Hz (2.00 s)");
  EXPECT_EQ(length_text(240, 0), "240 frames at 0 Hz (0.00 s)");
}

TEST(Text, TablesAreAsWideAsTheirCells) {
  Table table({Align::left, Align::right});
  EXPECT_TRUE(table.empty());
  table.add({"a", "10"});
  table.add({"M\xC3\xBCller", "9"});
  EXPECT_EQ(table.text(), "  a       10\n  M\xC3\xBCller   9\n");
}

TEST(Text, NamesCannotCommandATerminal) {
  EXPECT_EQ(printable("a\nb\x1b[31m"), "a\\x0ab\\x1b[31m");
  EXPECT_EQ(printable(std::string(200, 'x')), std::string(80, 'x') + "...");
  EXPECT_EQ(painted(Paint::bold, "a"), "\033[1ma\033[0m");
  EXPECT_EQ(painted(Paint::bold, "a", false), "a");
  EXPECT_EQ(painted(Paint::bold, ""), "");
}

}  // namespace
}  // namespace kinemend::test
