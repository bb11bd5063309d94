// Tests of the view of a take as a set of tracks.
#include "kinemend/extend/take_view.hpp"

#include <gtest/gtest.h>

namespace kinemend::test {
namespace {

// Two joints; the second one has positions of its own.
Take small_clip() {
  Take clip;
  clip.skeleton.names = {"Hips", "Spine"};
  clip.skeleton.parents = {-1, 0};
  clip.skeleton.offsets = {{}, {0, 3, 0}};
  clip.skeleton.channels.resize(2);
  clip.frame_rate_hz = 100;
  clip.translated_joints = {1};
  for (int f = 0; f < 4; ++f) {
    const double x = f;
    clip.positions.insert(clip.positions.end(), {{x, 1, 2}, {0, 3, x}});
    clip.rotations.insert(clip.rotations.end(), {exp({0.1 * x, 0, 0}), Quat{}});
  }
  return clip;
}

TEST(TakeView, HasTheTracksOfJointsTheRootsPositionAndTranslations) {
  const Take clip = small_clip();
  const TakeView take = view_of(clip);
  ASSERT_EQ(take.tracks.size(), 4U);
  EXPECT_EQ(take.owners, 2U);
  EXPECT_EQ(take.root_track(), 2U);
  EXPECT_EQ(take.gaps, GapTreatment::bridge);
  EXPECT_EQ(take.tracks[0].space, Space::rotation);
  EXPECT_EQ(take.tracks[0].rotation(3), clip.rotation(3, 0));
  EXPECT_EQ(take.tracks[1].rotation(3), clip.rotation(3, 1));
  EXPECT_EQ(take.tracks[2].owner, -1);
  EXPECT_EQ(take.tracks[2].position(3), (Vec3{3, 1, 2}));
  EXPECT_EQ(take.tracks[3].owner, 1);
  EXPECT_EQ(take.tracks[3].position(2), (Vec3{0, 3, 2}));
  EXPECT_EQ(take.tracks[0].radian, 1);
  EXPECT_EQ(take.tracks[3].radian, 3);
}

TEST(TakeView, CountsSelectionAndMotion) {
  const Take clip = small_clip();
  EXPECT_EQ(changeable_tracks(view_of(clip)), (std::vector<std::size_t>{0, 2, 3}));
  Selection selection;
  selection.owners = {0, 1};
  selection.root_position = false;
  EXPECT_EQ(changeable_tracks(view_of(clip, selection)), (std::vector<std::size_t>{3}));
  selection.translations = false;
  EXPECT_TRUE(changeable_tracks(view_of(clip, selection)).empty());
}

TEST(TakeView, KnowsWhatWasObserved) {
  Take clip = small_clip();
  EXPECT_TRUE(observed_of(view_of(clip).tracks[0]).empty());
  clip.observed = {1, 1, 0, 1, 1, 1, 1, 1};
  clip.observed_positions = {1, 1, 1, 1, 1, 0, 1, 0};
  const TakeView take = view_of(clip);
  EXPECT_EQ(observed_of(take.tracks[0]), (std::vector<std::uint8_t>{1, 0, 1, 1}));
  EXPECT_TRUE(observed_of(take.tracks[1]).empty());
  EXPECT_TRUE(observed_of(take.tracks[2]).empty());
  EXPECT_EQ(observed_of(take.tracks[3]), (std::vector<std::uint8_t>{1, 1, 0, 0}));
  clip.observed = {0, 1, 0, 1, 0, 1, 0, 1};
  EXPECT_EQ(changeable_tracks(view_of(clip)), (std::vector<std::size_t>{2, 3}));
}

TEST(TakeView, WritesEachTrackBackWhereItCameFrom) {
  const Take clip = small_clip();
  Take copy = clip;
  copy.positions.assign(8, {});
  copy.rotations.assign(8, {});
  const TakeView take = view_of(clip);
  for (std::size_t n = 0; n < take.tracks.size(); ++n) {
    set_track(copy, n, rotations_of(take.tracks[n]));
    set_track(copy, n, positions_of(take.tracks[n]));
  }
  EXPECT_EQ(copy.positions, clip.positions);
  EXPECT_EQ(copy.rotations, clip.rotations);
}

TEST(TakeView, OfMarkersLeavesOutWhatIsNoPosition) {
  Take clip = make_marker_take({"LASI", "angle", "never seen"}, 3, 100);
  clip.is_position = {1, 0, 1};
  clip.observed = {1, 1, 0, 0, 1, 0, 1, 1, 0};
  Selection selection;
  selection.body_height = 1600;
  const TakeView take = view_of(clip, selection);
  EXPECT_EQ(take.gaps, GapTreatment::cut);
  EXPECT_EQ(take.body_height, 1600);
  EXPECT_EQ(take.tracks[0].radian, 400);
  EXPECT_EQ(changeable_tracks(take), (std::vector<std::size_t>{0}));
  EXPECT_EQ(observed_of(take.tracks[0]), (std::vector<std::uint8_t>{1, 0, 1}));
}

TEST(TakeView, OfNothingHasNothingToChange) {
  EXPECT_TRUE(changeable_tracks(view_of(Take{})).empty());
  EXPECT_TRUE(changeable_tracks(view_of(Take{})).empty());
  EXPECT_TRUE(changeable_tracks(view_of(Take(slice(small_clip(), 0, 0)))).empty());
}

}  // namespace
}  // namespace kinemend::test
