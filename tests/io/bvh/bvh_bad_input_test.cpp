// A bad BVH file is refused with a one-line message that names the position.
#include <map>

#include "io/motion/motion_rows.hpp"
#include "io/support.hpp"

namespace kinemend {
namespace {

using namespace test;

// The expected message for each file: the line and the error.
const std::map<std::string, std::string>& expected_messages() {
  static const std::map<std::string, std::string> messages{
      {"all_nan.bvh", "19: every channel value is not finite"},
      {"ambiguous_commas.bvh",
       "19: expected 9 channel values; commas may be decimal points or separate values"},
      {"binary.bvh",
       "1: expected HIERARCHY, found \")r..M..(q..L..'p..K..&o..J..%n..I..$m..H...\""},
      {"blank.bvh", "1: the file is empty"},
      {"channel_count_word.bvh", "9: expected a number of channels from 0 to 6, found \"three\""},
      {"channel_twice.bvh", "9: a rotation channel follows itself"},
      {"empty.bvh", "1: the file is empty"},
      {"end_of_something.bvh", "10: expected Site after End, found \"Effector\""},
      {"end_site_channels.bvh", "12: an end site has no channels"},
      {"extra_brace.bvh", "16: expected MOTION, found \"}\""},
      {"four_rotations.bvh", "9: more than 3 rotation channels"},
      {"frames_word.bvh", "17: expected the number of frames, found \"many\""},
      {"huge_count.bvh", "17: 4000000000 frames of 9 channel values cannot be in 211 bytes"},
      {"huger_count.bvh", "17: 99999999999999 frames of 9 channel values cannot be in 211 bytes"},
      {"hugest_count.bvh",
       "17: 9007199254740992 frames of 9 channel values cannot be in 211 bytes"},
      {"joint_in_end_site.bvh", "12: expected OFFSET or } of an end site, found \"JOINT\""},
      {"joint_without_root.bvh", "2: expected ROOT, found \"JOINT\""},
      {"long_line.bvh", "22: expected 9 channel values, found 10"},
      {"missing_closing_brace.bvh",
       "15: expected OFFSET, CHANNELS, JOINT, End Site or }, found \"MOTION\""},
      {"missing_opening_brace.bvh", "8: expected {, found \"OFFSET\""},
      {"no_root.bvh", "2: expected ROOT, found \"MOTION\""},
      {"offset_nan.bvh", "8: expected a number of OFFSET, found \"nan\""},
      {"offset_short.bvh", "9: expected a number of OFFSET, found \"CHANNELS\""},
      {"offset_twice.bvh", "8: a second OFFSET"},
      {"offset_word.bvh", "8: expected a number of OFFSET, found \"ten\""},
      {"other_channel_count.bvh", "19: expected 9 channel values, found 12"},
      {"position_twice.bvh", "5: a position channel occurs twice"},
      {"short_and_long.bvh", "20: expected 9 channel values, found 8"},
      {"short_first_line.bvh", "19: expected 9 channel values, found 8"},
      {"short_line.bvh", "22: expected 9 channel values, found 8"},
      {"text_after_hierarchy.bvh", "16: expected MOTION, found \"MOTIONS\""},
      {"text_before_end.bvh", "20: expected a number, found \"the\""},
      {"time_word.bvh", "18: expected the frame time in seconds, found \"fast\""},
      {"too_few_channel_names.bvh", "5: expected 6 channel names, found 5"},
      {"too_many_channel_names.bvh", "9: expected 2 channel names, found more"},
      {"truncated_before_data.bvh", "19: expected 3 frames, found none"},
      {"truncated_hierarchy.bvh", "8: expected a number of OFFSET, found the end of the file"},
      {"truncated_keyword.bvh", "12: expected OFFSET or } of an end site, found \"OF\""},
      {"twice_the_channels.bvh", "19: expected 9 channel values, found 18"},
      {"unknown_channel.bvh", "5: unknown channel \"Xscale\""},
      {"utf16.bvh", "1: the text is UTF-16; save it as UTF-8"},
      {"word_in_data.bvh", "20: expected a number, found \"6.3x00\""},
  };
  return messages;
}

TEST(BadBvh, EachFileGetsOneLineThatNamesThePlace) {
  std::size_t seen = 0;
  for (const auto& path : fixtures_in("bad")) {
    const auto expected = expected_messages().find(path.filename().string());
    ASSERT_NE(expected, expected_messages().end()) << path;
    EXPECT_EQ(message_of([&] { read_joints(path); }, ErrorKind::unreadable_input),
              path.string() + ":" + expected->second);
    ++seen;
  }
  EXPECT_EQ(seen, expected_messages().size());
}

TEST(BadBvh, LinesAreCountedAlikeWhateverEndsThem) {
  for (const char* name : {"short_line.bvh", "word_in_data.bvh", "unknown_channel.bvh",
                           "missing_opening_brace.bvh", "end_of_something.bvh", "all_nan.bvh"}) {
    for (const char* line_end : {"\r\n", "\r", "\n"}) {
      std::string text;
      for (const char c : read_file(fixture(std::string("bad/") + name))) {
        c == '\n' ? text += line_end : text += c;
      }
      EXPECT_EQ(read_error(text), "take.bvh:" + expected_messages().at(name));
    }
  }
}

TEST(BadBvh, AMessageIsOnePrintableLine) {
  const std::string message = read_error("HIERARCHY\nROOT a\n{\n\x01\x1b[31m\xff");
  EXPECT_EQ(message,
            "take.bvh:4: expected OFFSET, CHANNELS, JOINT, End Site or }, found \"..[31m.\"");
}

TEST(BadBvh, ANumberEndsWithWhiteSpaceOnly) {
  const std::string text = read_file(fixture("good/plain.bvh"));
  for (const char after : {'\x03', '\x1b', '\0', '\x80'}) {
    std::string bad = text;
    bad[text.find("21.0000") + 7] = after;
    EXPECT_EQ(read_error(bad).substr(0, 48), "take.bvh:20: expected a number, found \"-21.0000.")
        << int{after};
  }
}

TEST(BadBvh, AFileThatCannotBeOpenedIsNamed) {
  EXPECT_EQ(message_of([] { read_joints(std::filesystem::path("no/such/take.bvh")); },
                       ErrorKind::unreadable_input),
            "no/such/take.bvh: No such file or directory");
  EXPECT_EQ(message_of([] { read_joints(std::filesystem::path(KINEMEND_TEST_FIXTURES)); },
                       ErrorKind::unreadable_input),
            std::string(KINEMEND_TEST_FIXTURES) + ": Is a directory");
}

// Finds the erroneous line from the layout alone: each digit is the number of values in a line.
std::string blame(const std::string& values_per_line, std::size_t channels,
                  std::optional<std::size_t> declared = {}) {
  std::string text;
  for (const char digit : values_per_line) {
    for (int i = 0; i < digit - '0'; ++i) text += "1 ";
    text += '\n';
  }
  const char* begin = text.data();
  const auto fault =
      find_line_fault(begin, begin + text.size(), CommaStyle::none, channels, declared);
  if (!fault) return "none";
  return std::to_string(1 + std::count(begin, fault->place, '\n')) + ": " + to_string(*fault);
}

TEST(LineFault, IsTheShortOrLongLineWhereLinesAreFrames) {
  EXPECT_EQ(blame("33333", 3), "none");
  EXPECT_EQ(blame("33233", 3), "3: expected 3 channel values, found 2");
  EXPECT_EQ(blame("33433", 3), "3: expected 3 channel values, found 4");
  EXPECT_EQ(blame("33332", 3), "5: expected 3 channel values, found 2");
  EXPECT_EQ(blame("3323334", 3), "3: expected 3 channel values, found 2");
}

TEST(LineFault, IsNotAFrameWrappedOverLines) {
  EXPECT_EQ(blame("3321333", 3), "none");
  EXPECT_EQ(blame("333111333", 3), "none");
  EXPECT_EQ(blame("212121", 3), "none");
  EXPECT_EQ(blame("54", 3), "none");
  EXPECT_EQ(blame("6333", 3), "none");
}

TEST(LineFault, IsTheFirstLineWhereAllHoldAnotherNumber) {
  EXPECT_EQ(blame("4444", 3, 4), "1: expected 3 channel values, found 4");
  EXPECT_EQ(blame("6666", 3, 4), "1: expected 3 channel values, found 6");
  EXPECT_EQ(blame("6666", 3, 8), "none");
}

}  // namespace
}  // namespace kinemend
