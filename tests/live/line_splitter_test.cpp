// Tests of lines that arrive in chunks of any size.
#include "live/live_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kinemend::test {
namespace {

using testing::ElementsAre;

std::vector<std::string> lines_of(std::string_view text, std::size_t piece, bool bars = false,
                                  std::size_t most = 100) {
  std::vector<std::string> lines;
  LineSplitter splitter(most);
  std::string_view line;
  const auto take = [&](LineSplitter::Found found) {
    if (found == LineSplitter::Found::line) lines.emplace_back(line);
    if (found == LineSplitter::Found::too_long) lines.emplace_back("too long");
  };
  for (; !text.empty(); text.remove_prefix(std::min(piece, text.size()))) {
    std::string_view bytes = text.substr(0, piece);
    while (!bytes.empty()) take(splitter.next(bytes, bars, line));
  }
  take(splitter.end(line));
  return lines;
}

TEST(LineSplitter, GivesTheSameLinesHoweverTheBytesArrive) {
  for (const std::size_t piece : {1, 2, 3, 5, 100}) {
    EXPECT_THAT(lines_of("ab\ncd e\n\nf", piece), ElementsAre("ab", "cd e", "", "f")) << piece;
    EXPECT_THAT(lines_of("ab\r\ncd\r", piece), ElementsAre("ab", "", "cd")) << piece;
  }
}

TEST(LineSplitter, TakesBarsForTheEndOfALineWhereTheyAre) {
  EXPECT_THAT(lines_of("a b||c d||", 3, true), ElementsAre("a b", "", "c d", ""));
  EXPECT_THAT(lines_of("a b||c d", 3, false), ElementsAre("a b||c d"));
}

TEST(LineSplitter, PassesOverALineThatIsTooLongAndGoesOnBehindIt) {
  for (const std::size_t piece : {1, 4, 100}) {
    EXPECT_THAT(lines_of("abcdef\nab\n", piece, false, 5), ElementsAre("too long", "ab")) << piece;
    EXPECT_THAT(lines_of("abcde\nab", piece, false, 5), ElementsAre("abcde", "ab")) << piece;
  }
}

TEST(LineSplitter, ForgetsWhatStandsOfALine) {
  LineSplitter splitter(100);
  std::string_view bytes = "half of it", line;
  EXPECT_EQ(splitter.next(bytes, false, line), LineSplitter::Found::nothing);
  splitter.drop();
  bytes = "whole\n";
  EXPECT_EQ(splitter.next(bytes, false, line), LineSplitter::Found::line);
  EXPECT_EQ(line, "whole");
}

}  // namespace
}  // namespace kinemend::test
