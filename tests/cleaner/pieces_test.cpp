// Tests of pieces: gaps are bridged or cut, and pieces are written back into their track.
#include "cleaner/pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

// One marker at constant speed, observed where `seen` is not zero.
Take straight_marker(const std::vector<std::uint8_t>& seen) {
  Take clip = make_marker_take({"LASI"}, seen.size(), 100);
  clip.observed = seen;
  for (std::size_t f = 0; f < seen.size(); ++f) {
    if (seen[f] != 0) clip.position(f, 0) = {2 * static_cast<double>(f), 1, 0};
  }
  return clip;
}

TEST(Pieces, OfMarkersEndAtLongGapsAndBridgeShortOnes) {
  std::vector<std::uint8_t> seen(120, 1);
  std::fill(seen.begin(), seen.begin() + 5, 0);
  std::fill(seen.begin() + 20, seen.begin() + 45, 0);  // 0.25 s
  std::fill(seen.begin() + 70, seen.begin() + 96, 0);
  const Take clip = straight_marker(seen);
  const auto pieces = position_pieces(view_of(clip), 0);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].first_frame, 5U);
  ASSERT_EQ(pieces[0].samples.size(), 65U);
  EXPECT_EQ(pieces[0].observed[14], 1);
  EXPECT_EQ(pieces[0].observed[15], 0);
  EXPECT_LT(norm(pieces[0].samples[30] - Vec3{70, 1, 0}), 1e-9);
  EXPECT_EQ(pieces[1].first_frame, 96U);
  EXPECT_TRUE(pieces[1].observed.empty());
}

TEST(Pieces, OfMarkersGoBackWhereTheyWereObserved) {
  std::vector<std::uint8_t> seen(60, 1);
  for (std::size_t f = 10; f < 20; ++f) seen[f] = 0;
  const Take clip = straight_marker(seen);
  const TakeView take = view_of(clip);
  auto pieces = position_pieces(take, 0);
  for (Vec3& position : pieces[0].samples) position += Vec3{0, 0, 5};
  const CleanedTrack cleaned = assemble(take, 0, pieces);
  EXPECT_EQ(cleaned.positions[9], (Vec3{18, 1, 5}));
  EXPECT_EQ(cleaned.positions[12], clip.position(12, 0));
}

TEST(Pieces, OfJointsBridgeGapsOfAnyLengthAndSayWhatTheyFilled) {
  Take clip = moving_take(100, 100);
  clip.observed.assign(clip.rotations.size(), 1);
  for (std::size_t f = 0; f < 100; ++f) {
    if (f < 20 || (f > 40 && f < 90)) clip.observed[f * clip.joint_count() + 2] = 0;
  }
  const Piece<Quat> piece = rotation_piece(view_of(clip), 2);
  EXPECT_EQ(piece.samples[0], clip.rotation(20, 2));
  const Quat a = clip.rotation(40, 2), b = clip.rotation(90, 2);
  EXPECT_LT(angle_between(piece.samples[65], slerp(a, b, 0.5)), 1e-12);
  const CleanedTrack cleaned = assemble(piece);
  EXPECT_EQ(cleaned.actions[65], Action::filled);
  EXPECT_EQ(cleaned.actions[30], Action::kept);
}

TEST(Pieces, OfPositionsOfJointsBridgeByStraightLines) {
  Take clip = moving_take(50, 100);
  const std::size_t width = 1 + clip.translated_joints.size();
  clip.observed_positions.assign(50 * width, 1);
  for (std::size_t f = 10; f < 20; ++f) {
    clip.observed_positions[f * width] = 0;
    clip.root_position(f) = {1e9, 0, 0};
  }
  const TakeView take = view_of(clip);
  const auto pieces = position_pieces(take, take.root_track());
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(pieces[0].observed.empty());
  const Vec3 expected =
      clip.root_position(9) + (5.0 / 11) * (clip.root_position(20) - clip.root_position(9));
  EXPECT_LT(norm(pieces[0].samples[14] - expected), 1e-9);
}

TEST(Pieces, OfAWholeMarkerRestWhereItWasNotSeenForLong) {
  std::vector<std::uint8_t> seen(300, 1);
  for (std::size_t f = 100; f < 200; ++f) seen[f] = 0;
  const Take clip = straight_marker(seen);
  const std::vector<Vec3> whole = whole_positions(view_of(clip), 0);
  ASSERT_EQ(whole.size(), 300U);
  EXPECT_EQ(whole[250], clip.position(250, 0));
  // Each end is extended by its velocity times 0.1 s.
  EXPECT_NEAR(whole[150].x, (198 + 20 + 400 - 20) / 2.0, 3);
}

}  // namespace
}  // namespace kinemend::test
