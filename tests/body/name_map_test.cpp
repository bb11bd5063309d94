// Tests of name maps as files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body/body_takes.hpp"
#include "kinemend/error.hpp"

namespace kinemend {
namespace {

using namespace body_test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(NameMap, ReadsPairsAndComments) {
  EXPECT_THAT(parse_name_map("# model,take\n"
                             "LeftArm,lhumerus\r\n"
                             "\n"
                             "  LeftHand = left wrist   # the wrist\n"
                             "LThumb,\n"
                             "Head,Ann:head",
                             "m.csv"),
              ElementsAre(Pair("Head", "Ann:head"), Pair("LThumb", ""), Pair("LeftArm", "lhumerus"),
                          Pair("LeftHand", "left wrist")));
  EXPECT_TRUE(parse_name_map("", "m.csv").empty());
  EXPECT_TRUE(parse_name_map("\xEF\xBB\xBF# nothing", "m.csv").empty());
}

std::string message_of(std::string_view text) {
  try {
    parse_name_map(text, "m.csv");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

TEST(NameMap, SaysWhichLineIsWrong) {
  EXPECT_THAT(message_of("a,b\n\nLeftArm\n"),
              HasSubstr("m.csv:3: expected \"model name,name in the take\", found \"LeftArm\""));
  EXPECT_THAT(message_of(",b\n"), HasSubstr("m.csv:1: expected a name of the model"));
  EXPECT_THAT(message_of("a,b\na,c\n"), HasSubstr("m.csv:2: \"a\" is already in a line above"));
  EXPECT_THAT(message_of("a,b\nc,b\n"), HasSubstr("m.csv:2: \"b\" is already \"a\""));
  EXPECT_THAT(message_of("# x\na,b,c\n"), HasSubstr("m.csv:2: expected one name in the take"));
}

TEST(NameMap, IsWrittenForAPersonToComplete) {
  const Take clip = walk();
  const BodyLayout layout = layout_of(clip);
  const Take other = renamed(clip, {{"LeftArm", "lhumerus"}, {"Head", "Lamp"}});
  const std::string text = name_map_text(layout, other);
  EXPECT_THAT(text, HasSubstr("\nLeftArm,lhumerus\n"));
  EXPECT_THAT(text, HasSubstr("\nHead,\n"));
  EXPECT_THAT(text, HasSubstr("\n# Lamp\n"));
  const NameMap map = parse_name_map(text, "m.csv");
  EXPECT_EQ(map.size(), layout.track_count());
  EXPECT_EQ(match_body(layout, other, map).tracks, match_body(layout, other).tracks);
  // A take that does not match also gets a map.
  const std::string stranger = name_map_text(layout, synthesize({"spin", 1, 60, 1, false}));
  EXPECT_THAT(stranger, HasSubstr("\nHips,\n"));
  EXPECT_THAT(name_map_text(layout, other, {{"Head", "Lamp"}}), HasSubstr("\nHead,Lamp\n"));
  const Take markers = joint_markers(clip);
  EXPECT_THAT(name_map_text(layout_of(markers), markers), HasSubstr("\nLeftArm,LeftArm\n"));
  EXPECT_THROW(name_map_text(layout, markers), Error);
}

}  // namespace
}  // namespace kinemend
