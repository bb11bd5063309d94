// Tests of contact files: reading, writing, and errors with their line.
#include <gmock/gmock.h>

#include "feet/support.hpp"
#include "kinemend/error.hpp"

namespace kinemend {
namespace {

using test::synthetic_clip;

std::string error_of(std::string_view text, const Take& clip) {
  try {
    parse_contacts(text, "walk.contacts", clip);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    return error.what();
  }
  return "none";
}

TEST(ContactFile, ReadsBackWhatItWrote) {
  const Take clip = synthetic_clip("walk");
  const std::vector<FootContact> contacts = find_contacts(clip);
  ASSERT_GT(contacts.size(), 10u);
  EXPECT_EQ(parse_contacts(contacts_text(clip, contacts), "x", clip), contacts);
}

TEST(ContactFile, TakesCommentsBlankLinesTabsAndAnyLineEnd) {
  const Take clip = synthetic_clip("walk", 1);
  const std::vector<FootContact> found = parse_contacts(
      "\xEF\xBB\xBF# by hand\r\n\r\n  right\ttoe 5 9 # here\r\nleft heel 1 3", "x", clip);
  const std::vector<FootContact> expected = {{0, FootPart::heel, 0, 2}, {1, FootPart::toe, 4, 8}};
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(parse_contacts("", "x", clip).empty());
}

TEST(ContactFile, SaysWhichLineIsWrongAndWhatItExpected) {
  const Take clip = synthetic_clip("walk", 1);  // 120 frames
  EXPECT_EQ(error_of("left heel 1 3\nmiddle heel 1 2\n", clip),
            "walk.contacts:2: expected left or right, found \"middle\"");
  EXPECT_EQ(error_of("left sole 1 3\n", clip),
            "walk.contacts:1: expected heel or toe, found \"sole\"");
  EXPECT_EQ(error_of("left heel 0 3\n", clip),
            "walk.contacts:1: expected a first frame of 1 to 120, found \"0\"");
  EXPECT_EQ(error_of("left heel 3 121\n", clip),
            "walk.contacts:1: expected a last frame of 1 to 120, found \"121\"");
  EXPECT_EQ(error_of("left heel 5 4\n", clip),
            "walk.contacts:1: expected a last frame from 5 on, found 4");
  EXPECT_EQ(error_of("left heel 5 9 held\n", clip),
            "walk.contacts:1: expected the end of the line, found \"held\"");
  EXPECT_EQ(error_of("left heel 5 9\nright heel 5 9\n\nleft heel 9 12\n", clip),
            "walk.contacts:4: expected frames of their own, found some of 5 to 9 again");
}

TEST(ContactFile, RefusesWhatIsNoContactFile) {
  const Take clip = synthetic_clip("walk", 1);
  for (const std::string& text :
       {std::string("left heel 1"), std::string("left"), std::string("left heel -1 3"),
        std::string("left heel 1e3 2"), std::string("left heel 99999999999999999999999 3"),
        std::string("left heel 1.5 3"), std::string("\0\0\0\0", 4), std::string(100000, 'x'),
        std::string("HIERARCHY\nROOT Hips\n")}) {
    EXPECT_THAT(error_of(text, clip), testing::StartsWith("walk.contacts:1: expected "));
  }
  EXPECT_THAT(error_of("left heel 1 2", synthetic_clip("spin", 1)),
              testing::HasSubstr("the skeleton has no legs"));
}

TEST(ContactFile, PutsWhatWasNotHeldIntoComments) {
  const Take clip = synthetic_clip("walk", 1);
  FeetReport report;
  report.contacts = {{0, FootPart::heel, 0, 9}, {1, FootPart::toe, 4, 30}};
  report.sides = {"left", "right"};
  report.held = {1, 0};
  report.still = {0, 0};
  report.reasons = {"", "slides 9 cm while the other foot stands: intended"};
  const std::string text = contacts_text(clip, report);
  EXPECT_THAT(text, testing::HasSubstr("\n# right toe 5 31  # 1.00  slides 9 cm while"));
  const std::vector<FootContact> left = {report.contacts[0]};
  EXPECT_EQ(parse_contacts(text, "x", clip), left);
}

}  // namespace
}  // namespace kinemend
