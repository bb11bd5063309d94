// Tests of text for people: figures, tables, names that hold terminal control codes, and colours.
#include "kinemend/extend/text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "base/text.hpp"

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
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  // C1 controls as characters and as bytes, invalid UTF-8, and a truncated sequence.
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J \x9B"
                      "2J \xFF \xC0\x80 \xE2\x82"),
            "\\x9b2J \\x9b2J \\xff \\xc0\\x80 \\xe2\\x82");
  // Bidirectional marks, and line and paragraph separators.
  EXPECT_EQ(printable("a\xE2\x80\xAE"
                      "b\xE2\x81\xA6 \xE2\x80\xA8"),
            "a\\u202eb\\u2066 \\u2028");
}

TEST(Text, LettersOfAnyScriptSurvive) {
  const std::string name =
      "Sch\xC3\xA4"
      "del \xE9\xAA\xA8 \xF0\x9F\xA6\xB4";
  EXPECT_EQ(printable(name), name);
  EXPECT_EQ(printable_name(name), name);
  EXPECT_EQ(quote(name), "\"" + name + "\"");
  EXPECT_EQ(quote("\x1b[31m\xC3\xA4\xFF"), "\".[31m\xC3\xA4.\"");
}

TEST(Text, LongTextsAreCutAtWholeCharacters) {
  EXPECT_EQ(printable(std::string(200, 'x')), std::string(80, 'x') + "...");
  EXPECT_EQ(printable("/" + std::string(200, 'x')), "/" + std::string(200, 'x')) << "a path";
  std::string blanks, letters, cut;
  for (int i = 0; i < 100000; ++i) blanks += "ab ";
  for (int i = 0; i < 100; ++i) letters += "\xC3\xA4";
  cut = letters.substr(0, 160) + "...";
  EXPECT_EQ(printable_name(blanks), blanks.substr(0, 80) + "...");
  EXPECT_EQ(printable_name(letters), cut);
  EXPECT_EQ(printable(letters), cut);
  const std::string message = "side.csv:1: no column is called " + blanks + " in the take";
  EXPECT_LE(printable(message).size(), 2000u);
  EXPECT_EQ(printable(message).substr(0, 20), message.substr(0, 20));
  EXPECT_EQ(printable(message).substr(printable(message).size() - 12), " in the take");
  // Escaping is idempotent.
  for (const std::string& text : {blanks, letters, message, std::string(200, '\x1b')}) {
    EXPECT_EQ(printable(printable(text)), printable(text));
    EXPECT_EQ(printable_name(printable_name(text)), printable_name(text));
  }
}

TEST(Text, TablesAndParagraphsAreEscaped) {
  Table table({Align::left, Align::left});
  table.add({"LASI\x1b[2J", "1"});
  EXPECT_EQ(table.text(), "  LASI\\x1b[2J  1\n");
  EXPECT_EQ(wrap("LASI\x1b[2J\nRASI", 0), "LASI\\x1b[2J\\x0aRASI\n");
}

TEST(Text, AByteOrderMarkIsThreeBytesAtTheStart) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(byte_order_mark_size(mark + "a"), 3u);
  EXPECT_EQ(without_byte_order_mark(mark + "a"), "a");
  EXPECT_EQ(without_byte_order_mark(mark + mark), mark) << "only the first is a mark";
  for (const std::string& text : {std::string(), mark.substr(0, 2), "a" + mark}) {
    EXPECT_EQ(byte_order_mark_size(text), 0u);
    EXPECT_EQ(without_byte_order_mark(text), text);
  }
}

TEST(Text, ColoursAreCodesOfATerminal) {
  EXPECT_EQ(painted(Paint::bold, "a"), "\033[1ma\033[0m");
  EXPECT_EQ(painted(Paint::bold, "a", false), "a");
  EXPECT_EQ(painted(Paint::bold, ""), "");
}

}  // namespace
}  // namespace kinemend::test
