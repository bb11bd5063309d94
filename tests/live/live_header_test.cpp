// Tests of the headers of live streams: their end, their maximum length, and their errors.
#include "live/live_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinemend/error.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Next = HeaderLines::Next;

const std::string hierarchy =
    "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 1 0\n"
    "  CHANNELS 3 Zrotation Xrotation Yrotation\n  End Site\n  {\n    OFFSET 0 1 0\n  }\n}";

std::vector<Next> taken(const std::string& text, HeaderLines& lines) {
  std::vector<Next> all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    all.push_back(lines.take(std::string_view(text).substr(at, end - at)));
    at = end + 1;
  }
  return all;
}

TEST(LiveHeader, IsCompleteWithItsLastLine) {
  for (const char* motion :
       {"\nMOTION\nFrames: 0\nFrame Time: 0.01", "\nMOTION\nFrame Time: .01\nFrames: 0",
        "\nmotion\n\nframes: 7\nFrame Time: 0.01"}) {
    HeaderLines lines(10000);
    const std::vector<Next> all = taken(hierarchy + motion, lines);
    EXPECT_EQ(all.back(), Next::complete) << motion;
    EXPECT_EQ(std::count(all.begin(), all.end(), Next::more),
              static_cast<std::ptrdiff_t>(all.size()) - 1);
    EXPECT_EQ(read_live_header(lines.text(), "header", 0).frame_rate_hz, 100);
  }
}

TEST(LiveHeader, IsOverBeforeAFrameWhereALineIsMissing) {
  HeaderLines lines(10000);
  EXPECT_EQ(taken(hierarchy + "\nMOTION\nFrames: 0\n1 2 3", lines).back(), Next::over);
  const LiveHeader header = read_live_header(lines.text(), "header", 0);
  EXPECT_EQ(header.frame_rate_hz, 30);
  EXPECT_THAT(header.repairs, ElementsAre(HasSubstr("30 Hz assumed")));
  EXPECT_TRUE(read_live_header(lines.text(), "header", 50).repairs.empty());
}

TEST(LiveHeader, HasABound) {
  HeaderLines lines(hierarchy.size());
  EXPECT_EQ(taken(hierarchy, lines).back(), Next::too_long);
}

TEST(LiveHeader, KeepsTheHierarchyAsItCame) {
  const LiveHeader header =
      read_live_header(hierarchy + "\nMOTION\nFrames: 12\nFrame Time: 0.0083333\n", "header", 0);
  EXPECT_EQ(header.hierarchy, hierarchy);
  EXPECT_EQ(header.frames, 12);
  EXPECT_EQ(header.frame_rate_hz, 120);
  EXPECT_EQ(header.frame_time, "0.0083333");
  EXPECT_EQ(header.skeleton.names[0], "Hips");
}

TEST(LiveHeader, NamesTheLineOfAnError) {
  const auto error_of = [](const std::string& text) {
    try {
      read_live_header(text, "header", 0);
      return std::string("no error");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
      return std::string(error.what());
    }
  };
  EXPECT_THAT(error_of("HIERARCHY\nROOT Hips\n{\n  OFFSET 0 x 0\n"), HasSubstr("header:4: "));
  EXPECT_THAT(error_of("HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n}\nMOTION\n"),
              HasSubstr("no joint has a channel"));
}

}  // namespace
}  // namespace kinemend::test
