// Tests of the small tables that people edit.
#include "base/cells.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace kinemend::test {
namespace {

TEST(Cells, TrimmingKeepsBlanksInside) {
  EXPECT_EQ(trimmed(" \tleft wrist \t\r"), "left wrist");
  EXPECT_EQ(trimmed("hand"), "hand");
  EXPECT_EQ(trimmed(" \t\r"), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed("\nhand\v"), "\nhand\v") << "other white space stays";
}

TEST(Cells, LinesEndAsOnAnySystem) {
  std::string_view text = "a\r\nb\rc\n\nd";
  for (const std::string_view line : {"a", "b", "c", "", "d"}) {
    ASSERT_FALSE(text.empty());
    EXPECT_EQ(take_line(text), line);
  }
  EXPECT_TRUE(text.empty());
}

}  // namespace
}  // namespace kinemend::test
