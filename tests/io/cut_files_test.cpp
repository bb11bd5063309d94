// A text file cut in its last line, as by a full disk, is read up to the cut; other short lines are
// still errors.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "io/acclaim/acclaim.hpp"
#include "io/support.hpp"
#include "io/text/text.hpp"

namespace kinemend {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr std::size_t rows = 12;

double value_of(std::size_t row, std::size_t column) {
  return 10.0 * static_cast<double>(column + 1) + std::sin(static_cast<double>(7 * row + column));
}

std::string bvh_text() {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition "
      "Zrotation Xrotation Yrotation\n  End Site\n  {\n    OFFSET 0 1 0\n  }\n}\nMOTION\nFrames: "
      "12\n"
      "Frame Time: 0.01\n";
  for (std::size_t f = 0; f < rows; ++f) {
    for (std::size_t c = 0; c < 6; ++c)
      text += fmt::format("{}{:.6f}", c == 0 ? "" : " ", value_of(f, c));
    text += "\n";
  }
  return text;
}

// Rows with a number, a time and two markers.
std::string table_rows(char separator) {
  std::string text;
  for (std::size_t f = 0; f < rows; ++f) {
    text += fmt::format("{}{}{:.5f}", f + 1, separator, 0.01 * static_cast<double>(f));
    for (std::size_t c = 0; c < 6; ++c) text += fmt::format("{}{:.5f}", separator, value_of(f, c));
    text += "\n";
  }
  return text;
}

std::string trc_text() {
  return "PathFileType\t4\t(X/Y/Z)\tm.trc\n"
         "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
         "OrigNumFrames\n100\t100\t12\t2\tmm\t100\t1\t12\n"
         "Frame#\tTime\tA\t\t\tB\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n" +
         table_rows('\t');
}
std::string tsv_text() {
  return "NO_OF_FRAMES\t12\nNO_OF_MARKERS\t2\nFREQUENCY\t100\nMARKER_NAMES\tA\tB\n"
         "Frame\tTime\tA X\tA Y\tA Z\tB X\tB Y\tB Z\n" +
         table_rows('\t');
}
std::string csv_text() {
  return "# rate_hz: 100\n# units: mm\nframe,time_s,A_x,A_y,A_z,B_x,B_y,B_z\n" + table_rows(',');
}

std::size_t last_line(const std::string& text) { return text.rfind('\n', text.size() - 2) + 1; }

TEST(CutFile, OfBvhIsReadUpToTheLastWholeFrame) {
  const std::string text = bvh_text();
  const Take whole = read_text(text);
  for (std::size_t length = last_line(text) + 1; length + 1 < text.size(); ++length) {
    SCOPED_TRACE(length);
    const TakeResult read = read_joints(text.substr(0, length), "take.bvh");
    ASSERT_EQ(read.take.frame_count(), rows - 1);
    EXPECT_EQ(read.diagnostics.count("file_cut"), 1u);
    EXPECT_EQ(read.diagnostics.entries().size(), 1u);
    expect_same_motion(read.take, slice(whole, 0, rows - 1), 0);
    // The written file is complete.
    const std::string written = write_take(read.take);
    const TakeResult again = read_joints(written, "take.bvh");
    EXPECT_TRUE(again.diagnostics.empty());
    EXPECT_EQ(again.take.frame_count(), rows - 1);
    EXPECT_EQ(write_take(again.take), written);
  }
  ReadOptions strict;
  strict.strict = true;
  EXPECT_THAT(read_error(text.substr(0, text.size() - 9), strict, ErrorKind::quality_limit),
              HasSubstr("take.bvh:25: the file ends in the middle of frame 12"));
}

TEST(CutFile, ThatLacksOnlyTheLastLineEndIsWhole) {
  for (const std::string& text : {bvh_text(), trc_text(), tsv_text(), csv_text()}) {
    TakeResult read = read_take(text.substr(0, text.size() - 1), "take");
    EXPECT_EQ(read.diagnostics.count("file_cut"), 0u) << text.substr(0, 12);
    EXPECT_EQ(write_take(read.take), text.substr(0, text.size() - 1));
  }
}

TEST(CutFile, OfBvhWithAShortLineIsStillAnError) {
  std::string text = bvh_text();
  text.erase(text.rfind(' '), text.size());
  EXPECT_THAT(read_error(text + "\n"), HasSubstr("expected 6 channel values, found 5"));
  const std::size_t inner = text.find(' ', text.find("Frame Time") + 40);
  std::string twice = text;
  twice.erase(inner, text.find(' ', inner + 1) - inner);
  EXPECT_THAT(read_error(twice), HasSubstr("expected 6 channel values, found 5"));
}

// The text of a take with 6 channels and these rows.
std::string bvh_with_rows(const std::string& rows_text, std::size_t declared) {
  const std::string text = bvh_text();
  std::string head = text.substr(0, text.find("0.01\n") + 5);
  head.replace(head.find("Frames: 12"), 10, fmt::format("Frames: {}", declared));
  return head + rows_text;
}

TEST(CutFile, OfBvhThatIsCutInAWordOfTwoNumbersIsWrittenWhole) {
  const std::string rows_text =
      "1.25 2.25 3.25 4.25 5.25 6.25\n1.25 2.25 3.25 4.25 5.25 6.25\n"
      "1.25 2.25 3.25 4.25 5.25 6.25\n1.25 2.25 3.25 4.25 5.25 7.8-0.751";
  const TakeResult read = read_joints(bvh_with_rows(rows_text, 9), "take.bvh");
  EXPECT_EQ(read.diagnostics.count("file_cut"), 1u);
  ASSERT_EQ(read.take.frame_count(), 4u);
  const std::string written = write_take(read.take);
  EXPECT_THAT(written, testing::EndsWith(" 7.8\n"));
  const TakeResult again = read_joints(written, "take.bvh");
  EXPECT_TRUE(again.diagnostics.empty());
  EXPECT_EQ(write_take(again.take), written);
}

// Two frames wrapped over the same number of lines are not read as frames of 5 channels.
TEST(CutFile, OfBvhWithWrappedFramesIsWrittenReadably) {
  const std::string rows_text = "1 2 3 4 5\n6 1 2 3 4 5 6\n1 2 3 4 5";
  const TakeResult read = read_joints(bvh_with_rows(rows_text + " 6 1 2 3 4\n", 1), "take.bvh");
  ASSERT_EQ(read.take.frame_count(), 3u);
  const std::string written = write_take(read.take);
  EXPECT_EQ(write_take(read_text(written)), written);
  EXPECT_EQ(read_text(bvh_with_rows("1 2 3 4 5\n6 1 2 3 4 5\n6 1 2 3 4 5\n6\n", 3)).frame_count(),
            3u);
}

TEST(CutFile, OfBvhThatComesOutEvenOnlyByTheCutIsStillAnError) {
  const std::string rows_text =
      "1.25 2.25 3.25 4.25 5.25 6.25 9.25\n1.25 2.25 3.25 4.25 5.25 6.25\n"
      "1.25 2.25 3.25 4.25 5.25 6.25\n1.25 2.25 3.25 4.25 5.25 6.25\n"
      "1.25 2.25 3.25 4.25 5.25 6.25\n1.25 2.25 3.25 4.25 7.8";
  EXPECT_THAT(read_error(bvh_with_rows(rows_text, 6)),
              HasSubstr("expected 6 channel values, found 7"));
}

TEST(CutFile, OfAmcIsReadUpToTheLastWholeFrame) {
  const std::string frame = figure_amc();
  const std::size_t begin = frame.find("\n1\n") + 1;
  const Take figure = read_figure();
  ASSERT_GT(figure.frame_count(), 1u);
  const std::string number = fmt::format("\n{}\n", figure.frame_count());
  const std::size_t last = frame.rfind(number) + 1;
  ASSERT_GT(last, begin);
  for (std::size_t length = last + 1; length + 2 < frame.size(); ++length) {
    SCOPED_TRACE(length);
    if (frame[length - 1] == '\n') {
      // A cut at the end of a line: bones are missing for an unknown reason.
      EXPECT_THROW(read_pair(frame.substr(0, length), figure_asf()), Error);
      continue;
    }
    const TakeResult read = read_pair(frame.substr(0, length), figure_asf());
    const std::string left = frame.substr(last, length - last);
    if (read.diagnostics.count("file_cut") == 0) {
      // Only digits of the last number are missing, so the line count cannot reveal the cut.
      EXPECT_GT(length + 12, frame.size());
      continue;
    }
    ASSERT_EQ(read.take.frame_count(), figure.frame_count() - 1) << left;
    const std::string written = write_take(read.take);
    EXPECT_EQ(written, frame.substr(0, last));
    EXPECT_EQ(read_pair(written, figure_asf()).diagnostics.count("file_cut"), 0u);
  }
}

TEST(CutFile, OfMarkersIsReadUpToTheLastWholeNumber) {
  for (const auto& [format, text] : {std::pair<std::string, std::string>{"trc", trc_text()},
                                     {"tsv", tsv_text()},
                                     {"csv", csv_text()}}) {
    const auto whole = read_take(text, "take." + format).take;
    const std::size_t line = last_line(text);
    for (std::size_t length = line + 1; length + 1 < text.size(); ++length) {
      SCOPED_TRACE(format + " " + text.substr(line, length - line));
      const TakeResult read = read_take(text.substr(0, length), "take." + format);
      const auto& clip = read.take;
      const char end = text[length - 1];
      if (end != '\t' && end != ',') {
        EXPECT_EQ(read.diagnostics.count("file_cut") + read.diagnostics.count("marker_incomplete"),
                  1u);
      }
      ASSERT_GE(clip.frame_count(), rows - 1);
      for (std::size_t f = 0; f < clip.frame_count(); ++f) {
        for (std::size_t m = 0; m < 2; ++m) {
          ASSERT_TRUE(clip.is_observed(f, m) || f == rows - 1);
          ASSERT_TRUE(!clip.is_observed(f, m) || clip.position(f, m) == whole.position(f, m));
        }
      }
      ASSERT_EQ(clip.frame_rate_hz, 100);
      // A marker with all three numbers is used.
      const std::string left = text.substr(line, length - line);
      const auto cells = std::count(left.begin(), left.end(), format == "csv" ? ',' : '\t');
      EXPECT_TRUE(cells < 5 || clip.is_observed(rows - 1, 0));
    }
    ReadOptions strict;
    strict.strict = true;
    const std::string cut = text.substr(0, text.size() - 9);
    const std::string name = "take." + format;
    EXPECT_THAT(message_of([&] { read_take(cut, name, strict); }, ErrorKind::quality_limit),
                HasSubstr(name + ":"));
  }
}

TEST(CutText, TellsALastNumberThatHasFewerDigitsThanAllBefore) {
  const auto cut = [](const char* text) { return last_number_may_be_cut(text, CommaStyle::none); };
  EXPECT_TRUE(cut("1.25 2.50\n1.25 2.51\n1.25 2.52\n1.25 2.5"));
  EXPECT_TRUE(cut("1.25 2.50\n1.25 2.51\n1.25 2.52\n1.25 2"));
  EXPECT_FALSE(cut("1.25 2.50\n1.25 2.51\n1.25 2.52\n1.25 2.53")) << "as many";
  EXPECT_FALSE(cut("1.25 2.50\n1.25 2.51\n1.25 2.52\n1.25 2.5\n")) << "the line ends";
  EXPECT_FALSE(cut("1.25 2.50\n1.25 2.5\n1.25 2.52\n1.25 2.5")) << "others have as few";
  EXPECT_FALSE(cut("1.25 2.50\n1.25 2.51\n1.25 2.5")) << "too few lines to tell";
  EXPECT_FALSE(cut("100\n101\n102\n99")) << "whole numbers";
}

}  // namespace
}  // namespace kinemend
