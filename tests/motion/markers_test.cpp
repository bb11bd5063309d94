// Tests of takes of markers: names, samples, validity and units.
#include "kinemend/take.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinemend/error.hpp"

namespace kinemend {
namespace {

TEST(Take, FindsAMarkerWithAndWithoutItsSubject) {
  const Take clip = make_marker_take({"Ann:LASI", "LASI", "Ann:RASI"}, 1, 100);
  EXPECT_EQ(clip.find("LASI"), 1);
  EXPECT_EQ(clip.find("Ann:LASI"), 0);
  EXPECT_EQ(clip.find("RASI"), 2);
  EXPECT_EQ(clip.find("SACR"), -1);
}

TEST(Take, CountsOnlyThePointsThatArePositions) {
  Take clip = make_marker_take({"LASI", "LKneeAngles", "RASI", "LHipMoment"}, 3, 100);
  EXPECT_EQ(clip.position_count(), 4u);
  clip.is_position = {1, 0, 1, 0};
  EXPECT_EQ(clip.position_count(), 2u);
  EXPECT_FALSE(clip.holds_positions(1));
  clip.is_position.clear();
  EXPECT_EQ(clip.position_count(), 4u);
}

TEST(Take, StartsWithEverySampleMissing) {
  const Take clip = make_marker_take({"A", "B"}, 3, 100);
  EXPECT_EQ(clip.frame_count(), 3u);
  for (std::size_t f = 0; f < 3; ++f)
    EXPECT_FALSE(clip.is_observed(f, 0) || clip.is_observed(f, 1));
  EXPECT_NO_THROW(clip.validate());
}

TEST(Take, RefusesAPositionThatIsNotFiniteOnlyWhereItIsObserved) {
  Take clip = make_marker_take({"A", "B"}, 2, 100);
  clip.position(1, 1).y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(clip.validate());
  clip.observed[3] = 1;
  try {
    clip.validate();
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "frame 1, marker 1 \"B\": the position is not finite");
  }
}

TEST(Take, RefusesArraysOfTheWrongLength) {
  Take clip = make_marker_take({"A", "B"}, 2, 100);
  clip.observed.pop_back();
  EXPECT_THROW(clip.validate(), Error);
}

TEST(Take, SlicesKeepTheNumberOfTheirFirstFrame) {
  Take clip = make_marker_take({"A"}, 5, 100);
  clip.first_frame = 10;
  clip.position(3, 0) = {1, 2, 3};
  clip.observed[3] = 1;
  const Take part = slice(clip, 2, 5);
  EXPECT_EQ(part.frame_count(), 3u);
  EXPECT_EQ(part.first_frame, 12);
  EXPECT_TRUE(part.is_observed(1, 0));
  EXPECT_EQ(part.position(1, 0).z, 3);
}

TEST(LengthUnits, AreKnownByTheirUsualNames) {
  EXPECT_DOUBLE_EQ(metres_per_unit("mm"), 0.001);
  EXPECT_DOUBLE_EQ(metres_per_unit("M"), 1);
  EXPECT_DOUBLE_EQ(metres_per_unit("inches"), 0.0254);
  EXPECT_DOUBLE_EQ(metres_per_unit("Nmm"), 0);
}

}  // namespace
}  // namespace kinemend
