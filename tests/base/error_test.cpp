// Tests of errors and diagnostics: messages name their place and escape control characters.
#include "kinemend/error.hpp"

#include <gmock/gmock.h>

#include <string>

#include "kinemend/extend/system.hpp"

namespace kinemend {
namespace {

TEST(Error, NamesFileAndLine) {
  const Error error = Error::at_line("walk.bvh", 212, "expected 63 channel values, found 62");
  EXPECT_STREQ(error.what(), "walk.bvh:212: expected 63 channel values, found 62");
  EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
}

TEST(Error, NamesFileAndByte) {
  const Error error = Error::at_byte("walk.c3d", 512, "no parameter section");
  EXPECT_STREQ(error.what(), "walk.c3d: byte 512: no parameter section");
  EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
}

TEST(Error, KeepsItsKind) {
  EXPECT_EQ(Error(ErrorKind::cannot_write, "full").kind(), ErrorKind::cannot_write);
  // The program's exit codes.
  EXPECT_EQ(static_cast<int>(ErrorKind::quality_limit), 1);
  EXPECT_EQ(static_cast<int>(ErrorKind::usage), 2);
  EXPECT_EQ(static_cast<int>(ErrorKind::unreadable_input), 3);
  EXPECT_EQ(static_cast<int>(ErrorKind::cannot_write), 4);
}

TEST(Error, HoldsNothingThatCommandsATerminal) {
  const std::string name("a\0b\x1b[2J", 7);
  EXPECT_STREQ(Error(ErrorKind::usage, name + ": unknown").what(), "a\\x00b\\x1b[2J: unknown");
  EXPECT_STREQ(Error::at_line(name, 1, "x").what(), "a\\x00b\\x1b[2J:1: x");
  EXPECT_LT(std::string(Error(ErrorKind::usage, std::string(1 << 20, ' ') + "x").what()).size(),
            2001u);
  Diagnostics diagnostics;
  diagnostics.add("odd", name);
  EXPECT_EQ(diagnostics.entries().front().message, "a\\x00b\\x1b[2J");
}

TEST(Diagnostics, CountRepeatsAndKeepTheFirst) {
  Diagnostics diagnostics;
  EXPECT_TRUE(diagnostics.empty());
  diagnostics.add("frame_count_mismatch", "the file says 5 frames and holds 4", 7);
  diagnostics.add("not_a_number", "frame 3 holds nan", 10);
  diagnostics.add("not_a_number", "frame 4 holds nan", 11);
  EXPECT_FALSE(diagnostics.empty());
  ASSERT_EQ(diagnostics.entries().size(), 2u);
  EXPECT_EQ(diagnostics.entries()[0].name, "frame_count_mismatch");
  EXPECT_EQ(diagnostics.entries()[1].message, "frame 3 holds nan");
  EXPECT_EQ(diagnostics.entries()[1].first_line, 10u);
  EXPECT_EQ(diagnostics.count("not_a_number"), 2u);
  EXPECT_EQ(diagnostics.count("frame_count_mismatch"), 1u);
  EXPECT_EQ(diagnostics.count("other"), 0u);
}

TEST(Version, HasThreeNumbers) {
  EXPECT_THAT(std::string(version()), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

}  // namespace
}  // namespace kinemend
