// Tests of marking gaps of joints by name.
#include "kinemend/take.hpp"

#include <gmock/gmock.h>

#include "kinemend/error.hpp"
#include "motion/clips.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MarkGaps, OfAJointMarksItsRotation) {
  Take clip = test::chain_clip(3, 20);
  mark_gaps(clip, std::vector<NamedGap>{{"joint1", 4, 6}, {"joint2", 0, 0}, {"joint1", 7, 8}});
  clip.validate();
  EXPECT_THAT(find_gaps(clip), ElementsAre(Gap{1, 4, 8}, Gap{2, 0, 0}));
  EXPECT_THAT(find_position_gaps(clip), IsEmpty());
}

TEST(MarkGaps, OfTheRootMarksItsPositionToo) {
  Take clip = test::chain_clip(3, 20);
  mark_gaps(clip, std::vector<NamedGap>{{"root", 4, 6}});
  EXPECT_THAT(find_gaps(clip), ElementsAre(Gap{0, 4, 6}));
  EXPECT_THAT(find_position_gaps(clip), ElementsAre(Gap{0, 4, 6}));
  clip.validate();
  EXPECT_THAT(find_position_gaps(slice(clip, 5, 20)), ElementsAre(Gap{0, 0, 1}));
  clip.observed_positions.pop_back();
  EXPECT_THROW(clip.validate(), Error);
}

TEST(MarkGaps, LeavesThePositionOfARootThatHasNoChannelsForIt) {
  Skeleton skeleton;
  skeleton.add_joint("root", -1, {}, make_channels(false, parse_rotation_order("ZXY")));
  Take clip = test::resting_clip(skeleton, 9, 100);
  mark_gaps(clip, std::vector<NamedGap>{{"root", 4, 6}});
  EXPECT_THAT(find_position_gaps(clip), IsEmpty());
}

TEST(MarkGaps, OfATranslatedJointMarksItsTranslation) {
  Take clip = test::chain_clip(4, 10);
  test::add_translations(clip, {1, 3}, Vec3{1, 0, 0});
  mark_gaps(clip, std::vector<NamedGap>{{"joint3", 2, 3}, {"joint2", 5, 5}});
  EXPECT_THAT(find_position_gaps(clip), ElementsAre(Gap{2, 2, 3}));
  mark_gaps(clip, std::vector<NamedGap>{{"*", 9, 9}});
  EXPECT_THAT(find_position_gaps(clip),
              ElementsAre(Gap{0, 9, 9}, Gap{1, 9, 9}, Gap{2, 2, 3}, Gap{2, 9, 9}));
  clip.validate();
}

TEST(MarkGaps, KnowsNamesAsEveryOptionDoesButTheExactNameFirst) {
  Take clip = test::chain_clip(4, 10);
  clip.skeleton.names = {"Ann:Hips", "Ann:LArm", "*1", "11"};
  mark_gaps(clip, std::vector<NamedGap>{{"hips", 1, 1}, {"L*", 2, 3}, {"*1", 5, 5}});
  EXPECT_THAT(find_gaps(clip), ElementsAre(Gap{0, 1, 1}, Gap{1, 2, 3}, Gap{2, 5, 5}));
}

TEST(MarkGaps, SaysWhatTheTakeDoesNotHave) {
  Take clip = test::chain_clip(2, 10);
  const auto complaint = [&](const NamedGap& gap) -> std::string {
    try {
      mark_gaps(clip, std::vector<NamedGap>{gap});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint({"tail", 0, 1}), HasSubstr("has no such joint (it has root, joint1)"));
  EXPECT_THAT(complaint({"root", 8, 10}),
              HasSubstr("frames 9 to 11 are not in a take of frames 1 to 10"));
}

}  // namespace
}  // namespace kinemend
