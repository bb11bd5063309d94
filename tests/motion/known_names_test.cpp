// Tests of names and patterns, of subjects, and of frame numbers.
#include "kinemend/take.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "motion/names.hpp"

namespace kinemend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(SubjectPart, EndsWithTheLastColon) {
  EXPECT_EQ(subject_part("Ann:LASI"), "Ann:");
  EXPECT_EQ(subject_part("Ann:left:LASI"), "Ann:left:");
  EXPECT_EQ(subject_part(":LASI"), ":");
  EXPECT_EQ(subject_part("LASI"), "");
}

using Strings = std::vector<std::string>;
const Strings arms = {"LeftArm", "leftarm", "RightArm", "Ann:LHAND"};

TEST(NamePattern, MeansTheVeryNameFirst) {
  EXPECT_THAT(names_meant(arms, "LeftArm"), ElementsAre(1, 0, 0, 0));
  EXPECT_THAT(names_meant(arms, "leftarm"), ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(names_meant(arms, "Left*"), ElementsAre(1, 0, 0, 0));
}

TEST(NamePattern, MeansWhatIsInOtherCapitalsWhereNothingElseIsMeant) {
  EXPECT_THAT(names_meant(arms, "LEFTARM"), ElementsAre(1, 1, 0, 0));
  EXPECT_THAT(names_meant(arms, "RIGHT???"), ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(names_meant(arms, "lhand"), ElementsAre(0, 0, 0, 1));
  EXPECT_THAT(names_meant(arms, "Tail"), ElementsAre(0, 0, 0, 0));
}

TEST(NamePattern, KnowsStarsAndQuestionMarks) {
  const auto means = [](const std::string& pattern, const std::string& name) {
    return names_meant(Strings{name}, pattern).front() != 0;
  };
  EXPECT_TRUE(means("Left*Arm", "LeftForeArm"));
  EXPECT_TRUE(means("Left*Arm", "LeftArmArm"));
  EXPECT_TRUE(means("*", "a"));
  EXPECT_TRUE(means("?", "a"));
  EXPECT_TRUE(means("a*b*c", "aXbXc"));
  EXPECT_TRUE(means("L*", "Ann:LHAND"));
  EXPECT_TRUE(means("*1", "*1")) << "a marker without a label";
  EXPECT_FALSE(means("Left*Arm", "LeftArms"));
  EXPECT_FALSE(means("?", "ab"));
  EXPECT_FALSE(means("", "abc"));
}

TEST(NamePattern, OfAListIsRefusedWhereItMeansNothing) {
  EXPECT_THAT(names_meant(arms, Strings{"right*", "LHAND"}, "joint"), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(names_meant(arms, Strings{}, "joint"), ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(
      [] {
        names_meant(arms, Strings{"RightArm", "Tail"}, "marker");
      },
      ThrowsMessage<Error>(HasSubstr("no marker matches \"Tail\"")));
}

TEST(KnownNames, StandForThoseOfTheTake) {
  EXPECT_THAT(known_names({"a", "b", "c"}, {{"LeftFoot", "b"}}), ElementsAre("a", "LeftFoot", "c"));
  EXPECT_THAT(known_names({"Ann:M1", "Bob:M2"}, {{"LTOE", "Ann:M1"}, {"Cid:RTOE", "Bob:M2"}}),
              ElementsAre("Ann:LTOE", "Cid:RTOE"));
  EXPECT_THAT(known_names({"Ann:M1"}, {{"LTOE", "m1"}}), ElementsAre("Ann:LTOE"));
}

TEST(KnownNames, AreTakenFromWhatBoreThemWrongly) {
  EXPECT_THAT(known_names({"LeftFoot", "b"}, {{"LeftFoot", "b"}}),
              ElementsAre("part 1", "LeftFoot"));
  EXPECT_THAT(known_names({"LeftFoot", "b"}, {{"LeftFoot", ""}}), ElementsAre("part 1", "b"));
  EXPECT_THAT(known_names({"LeftFoot", "RightFoot"},
                          {{"LeftFoot", "RightFoot"}, {"RightFoot", "LeftFoot"}}),
              ElementsAre("RightFoot", "LeftFoot"));
}

TEST(KnownNames, OfWhatIsNotThereAreRefused) {
  EXPECT_THAT(
      [] {
        known_names({"a"}, {{"LeftFoot", "b"}});
      },
      ThrowsMessage<Error>(HasSubstr("names: the take has no \"b\" (it has a)")));
  EXPECT_THAT(
      [] {
        known_names({"Ann:M1", "Bob:M1"}, {{"LTOE", "M1"}});
      },
      ThrowsMessage<Error>(HasSubstr("\"M1\" is the name of 2 parts")));
}

TEST(Subjects, AreToldApartByWhatStandsBeforeTheColon) {
  Take clip = make_marker_take({"Ann:A", "Bob:A", "wand", "Ann:B", "Bob:angle"}, 2, 100);
  clip.is_position = {1, 1, 1, 1, 0};
  const std::vector<Subject> subjects = subjects_of(clip);
  ASSERT_EQ(subjects.size(), 3u);
  EXPECT_EQ(subjects[0].name, "Ann");
  EXPECT_THAT(subjects[0].markers, ElementsAre(0, 3));
  EXPECT_EQ(subjects[1].name, "Bob");
  EXPECT_THAT(subjects[1].markers, ElementsAre(1));
  EXPECT_EQ(subjects[2].name, "");
  EXPECT_THAT(subjects[2].markers, ElementsAre(2));
  EXPECT_EQ(largest_subject(clip).name, "Ann");
}

TEST(LargestSubject, HasTheMostMarkersAndComesFirstOfEquals) {
  EXPECT_EQ(largest_subject(make_marker_take({"Ann:A", "Bob:A", "Bob:B"}, 2, 100)).name, "Bob");
  EXPECT_EQ(largest_subject(make_marker_take({"Bob:A", "Ann:A"}, 2, 100)).name, "Bob");
  EXPECT_TRUE(largest_subject(make_marker_take({}, 0, 100)).markers.empty());
}

TEST(Subjects, AreOneWhereNobodyElseIsThere) {
  const std::vector<Subject> subjects =
      subjects_of(make_marker_take({"Ann:A", "wand", "Ann:B"}, 2, 100));
  ASSERT_EQ(subjects.size(), 1u);
  EXPECT_EQ(subjects[0].name, "");
  EXPECT_THAT(subjects[0].markers, ElementsAre(0, 1, 2));
  EXPECT_TRUE(subjects_of(make_marker_take({}, 0, 100)).empty());
}

TEST(FrameNumbers, OfSideFilesStartWhereTheTakeDoes) {
  for (const std::int64_t first : {-7, 0, 1, 300}) {
    const std::string text = gaps_text(std::vector<NamedGap>{{"Head", 3, 5}}, first);
    EXPECT_THAT(text, HasSubstr("Head," + std::to_string(first + 3) + "," +
                                std::to_string(first + 5) + "\n"));
    const std::vector<NamedGap> gaps = parse_gaps(text, "gaps.csv", first);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_EQ(gaps[0].first_frame, 3u);
    EXPECT_EQ(gaps[0].last_frame, 5u);
    EXPECT_THROW(parse_gaps("Head," + std::to_string(first - 1) + ",400\n", "", first), Error);
  }
}

TEST(FrameNumbers, OfClipsAreThoseOfTheirFiles) {
  Take markers = make_marker_take({"A"}, 2, 100);
  EXPECT_EQ(first_frame_number(markers), 1);
  markers.first_frame = 300;
  EXPECT_EQ(first_frame_number(markers), 300);
  Take clip;
  clip.skeleton.names = {"Hips"};
  EXPECT_EQ(first_frame_number(clip), 1);
  clip.source.facts = {{"skeleton", "35.asf"}, {"first frame", "37"}};
  EXPECT_EQ(first_frame_number(clip), 37);
}

}  // namespace
}  // namespace kinemend
