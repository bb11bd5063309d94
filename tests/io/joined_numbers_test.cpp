// Numbers without a blank before the minus sign, which some programs write, are split.
#include <gmock/gmock.h>

#include "io/acclaim/acclaim.hpp"
#include "io/support.hpp"
#include "io/text/number.hpp"

namespace kinemend {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string head =
    "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition Zrotation "
    "Xrotation Yrotation\n  End Site\n  {\n    OFFSET 0 1 0\n  }\n}\nMOTION\nFrames: 3\n"
    "Frame Time: 0.01\n";

TEST(JoinedNumbers, OfBvhAreSplitAtTheSign) {
  const std::string rows =
      "0.0 95.5 0.0 0.0-7.5094748 3.25\n0.0-95.5-1.5e-05 1.0-2.25+3.0\n1 2 3 4 5 6\n";
  const TakeResult read = read_joints(head + rows, "take.bvh");
  EXPECT_EQ(read.diagnostics.count("numbers_joined"), 5u);
  EXPECT_EQ(read.diagnostics.entries().size(), 1u);
  EXPECT_EQ(read.diagnostics.entries()[0].first_line, 14u);
  ASSERT_EQ(read.take.frame_count(), 3u);
  EXPECT_THAT(read.take.source.document->channel_values(),
              ElementsAre(0, 95.5, 0, 0, -7.5094748, 3.25, 0, -95.5, -1.5e-5, 1, -2.25, 3, 1, 2, 3,
                          4, 5, 6));
  // The written file has the blanks and otherwise the same bytes.
  const std::string mended =
      "0.0 95.5 0.0 0.0 -7.5094748 3.25\n0.0 -95.5 -1.5e-05 1.0 -2.25 +3.0\n1 2 3 4 5 6\n";
  EXPECT_EQ(write_take(read.take), head + mended);
  ReadOptions strict;
  strict.strict = true;
  EXPECT_THAT(read_error(head + rows, strict, ErrorKind::quality_limit),
              HasSubstr("take.bvh:14: two numbers have no blank between them"));
}

TEST(JoinedNumbers, StayApartWhenOneOfThemIsChanged) {
  Take clip = read_text(head + "0.0 95.5-1.5 0.0-7.5 3.25\n0 0 0 0 0 0\n1 2 3 4 5 6\n");
  clip.root_position(0).z = 1.25;
  const Take again = read_text(write_take(clip));
  EXPECT_EQ(again.root_position(0), (Vec3{0, 95.5, 1.25}));
}

TEST(JoinedNumbers, AreNoExponentDateOrWord) {
  EXPECT_EQ(numbers_in_word("0.0-7.5"), 2u);
  EXPECT_EQ(numbers_in_word("-1.5-2.5-3"), 3u);
  EXPECT_EQ(numbers_in_word("1.5e-5"), 1u);
  EXPECT_EQ(numbers_in_word("1.5E+5-2"), 2u);
  EXPECT_EQ(numbers_in_word("2020-01-02"), 1u) << "a date";
  EXPECT_EQ(numbers_in_word("1.5-"), 1u);
  EXPECT_EQ(numbers_in_word("1.5--2.5"), 1u);
  EXPECT_EQ(numbers_in_word("v1.5-2.5"), 1u);
  EXPECT_EQ(read_error(head + "0 95.5-x 0 0 0 0 0\n"),
            "take.bvh:14: expected a number, found \"95.5-x\"");
}

TEST(JoinedNumbers, OfManyInOneWordCostLinearTime) {
  std::string row;
  for (std::size_t i = 0; i < 300000; ++i) row += "-1.5";
  EXPECT_EQ(read_joints(head + row + "\n", "take.bvh").take.frame_count(), 50000u);
}

TEST(JoinedNumbers, OfAmcAreSplitAtTheSign) {
  const std::string asf =
      chain_asf({"id 1\ndirection 0 1 0\nlength 1\naxis 0 0 0 XYZ\ndof rx ry rz"});
  const TakeResult read = read_pair(
      "1\nroot 0 0 0.5-1.5 2 3\na 1.0-2.0-3.5\n2\nroot 0 0 0 1 2 3\n"
      "a 1 2 3\n",
      asf);
  EXPECT_EQ(read.diagnostics.count("numbers_joined"), 3u);
  EXPECT_EQ(write_take(read.take),
            "1\nroot 0 0 0.5 -1.5 2 3\na 1.0 -2.0 -3.5\n2\nroot 0 0 0 1 2 3\na 1 2 3\n");
}

}  // namespace
}  // namespace kinemend
