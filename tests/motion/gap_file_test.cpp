// Tests of side files of gaps.
#include <gmock/gmock.h>

#include <string>

#include "kinemend/error.hpp"
#include "kinemend/take.hpp"
#include "motion/clips.hpp"

namespace kinemend {

bool operator==(const NamedGap& a, const NamedGap& b) {
  return a.name == b.name && a.first_frame == b.first_frame && a.last_frame == b.last_frame;
}
void PrintTo(const NamedGap& gap, std::ostream* out) {
  *out << '"' << gap.name << "\" " << gap.first_frame << " to " << gap.last_frame;
}

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string complaint(const std::string& text) {
  try {
    parse_gaps(text, "gaps.csv", 1);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    return error.what();
  }
  return "no complaint";
}

TEST(GapFile, GivesAFrameTheNumberThatItsTakeGivesIt) {
  EXPECT_THAT(parse_gaps("LeftArm,1,1\nHead,10,24\n", "", 1),
              ElementsAre(NamedGap{"LeftArm", 0, 0}, NamedGap{"Head", 9, 23}));
  Take clip = make_marker_take({"LASI", "RASI"}, 10, 100);
  clip.observed.assign(20, 1);
  clip.first_frame = 300;
  const std::vector<NamedGap> gaps =
      parse_gaps("RASI,302,304\n", "gaps.csv", first_frame_number(clip));
  EXPECT_THAT(gaps, ElementsAre(NamedGap{"RASI", 2, 4}));
  mark_gaps(clip, gaps);
  EXPECT_THAT(find_gaps(clip), ElementsAre(Gap{1, 2, 4}));
  EXPECT_EQ(gaps_text(gaps, first_frame_number(clip)),
            "name,first_frame,last_frame\nRASI,302,304\n");
}

TEST(GapFile, UnderstandsHeadingsCommentsBlankLinesAndEveryLineEnd) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "# found by eye" + end + end + "joint,first,last" + end +
                             "  LeftArm , 3 ,\t9  " + end + "# more" + end + "*,12,15";
    EXPECT_THAT(parse_gaps(text, "", 1),
                ElementsAre(NamedGap{"LeftArm", 2, 8}, NamedGap{"*", 11, 14}));
  }
  EXPECT_THAT(parse_gaps("\xEF\xBB\xBFname,first_frame,last_frame\nHead,2,3", "", 1),
              ElementsAre(NamedGap{"Head", 1, 2}));
}

TEST(GapFile, ReadsQuotedNames) {
  EXPECT_THAT(
      parse_gaps("\"Arm, left\",1,2\n\"the \"\"big\"\" toe\",3,4\n\"#1\",5,6\n\"\",7,8\n", "", 1),
      ElementsAre(NamedGap{"Arm, left", 0, 1}, NamedGap{"the \"big\" toe", 2, 3},
                  NamedGap{"#1", 4, 5}, NamedGap{"", 6, 7}));
}

TEST(GapFile, HoldsNothingWhereThereIsNothing) {
  EXPECT_THAT(parse_gaps("", "", 1), IsEmpty());
  EXPECT_THAT(parse_gaps("name,first,last\n", "", 1), IsEmpty());
  EXPECT_THAT(parse_gaps("# nothing", "", 1), IsEmpty());
}

TEST(GapFile, SaysWhichLineIsWrong) {
  EXPECT_EQ(complaint("Head,1,2\nHead,1\n"), "gaps.csv:2: expected name,first,last, found 2 cells");
  EXPECT_EQ(complaint("Head\n"), "gaps.csv:1: expected name,first,last, found 1 cell");
  EXPECT_EQ(complaint("Head,1,2,3\n"), "gaps.csv:1: expected name,first,last, found 4 cells");
  EXPECT_EQ(complaint("\n# x\nHead,0,2"),
            "gaps.csv:3: expected a frame number from 1, found \"0\"");
  EXPECT_EQ(complaint("Head,1,2x"), "gaps.csv:1: expected a frame number from 1, found \"2x\"");
  EXPECT_EQ(complaint("Head,1,2\nHead,-4,2"),
            "gaps.csv:2: expected a frame number from 1, found \"-4\"");
  EXPECT_EQ(complaint("Head,99999999999999999999999,2"),
            "gaps.csv:1: expected a frame number from 1, found \"99999999999999999999999\"");
  EXPECT_EQ(complaint("Head,7,3"), "gaps.csv:1: the last frame, 3, is before the first, 7");
  EXPECT_EQ(complaint("\"Head,7,3"),
            "gaps.csv:1: expected a closing quote at the end of a quoted name");
  EXPECT_EQ(complaint("\"Head\"x,7,8"),
            "gaps.csv:1: expected a closing quote at the end of a quoted name");
}

TEST(GapFile, OnlyTheFirstLineMayBeAHeading) {
  EXPECT_EQ(complaint("name,first,last\njoint,first,last\n"),
            "gaps.csv:2: expected a frame number from 1, found \"first\"");
}

TEST(GapFile, IsReadBackAsItIsWritten) {
  const std::vector<NamedGap> gaps = {
      {"Head", 0, 0},  {"Arm, left", 3, 7}, {"\"", 1, 2}, {" leading blank", 4, 4},
      {"#hash", 5, 6}, {"", 8, 9},          {"*", 10, 12}};
  EXPECT_EQ(parse_gaps(gaps_text(gaps, 1), "", 1), gaps);
  EXPECT_EQ(gaps_text(std::vector<NamedGap>{{"Head", 0, 4}}, 1),
            "name,first_frame,last_frame\nHead,1,5\n");
}

}  // namespace
}  // namespace kinemend
