// Tests of processing only the frames after a calibration pose.
#include "motion/take.hpp"

#include <gtest/gtest.h>

#include "kinemend/error.hpp"
#include "motion/clips.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

constexpr std::size_t joints = 4, frames = 10, tracks = 3;

// Four joints, two of them translated; all samples differ.
Take moving_clip() {
  Take clip = test::chain_clip(joints, frames);
  test::add_translations(clip, {1, 3}, Vec3{});
  for (std::size_t f = 0; f < frames; ++f) {
    const double at = static_cast<double>(f);
    clip.root_position(f) = {at, 0, 0};
    for (std::size_t j = 0; j < joints; ++j)
      clip.rotation(f, j) = test::about_z(0.01 * at + 0.1 * static_cast<double>(j));
    clip.position(f, 1) = {at, 1, 0};
    clip.position(f, 2) = {at, 3, 0};
  }
  return clip;
}

void damage(Take& motion) {
  for (std::size_t f = 0; f < motion.frame_count(); ++f) {
    motion.root_position(f).y += 1;
    for (std::size_t track = 1; track < tracks; ++track) motion.position(f, track).z += 2;
  }
  for (Quat& rotation : motion.rotations) rotation = rotation * test::about_z(1);
  motion.observed.assign(motion.rotations.size(), 0);
  motion.observed_positions.assign(motion.frame_count() * tracks, 0);
}

void expect_same(const Take& a, const Take& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.rotations, b.rotations);
  EXPECT_EQ(a.observed, b.observed);
  EXPECT_EQ(a.observed_positions, b.observed_positions);
}

TEST(OnMotion, ChangesWhatItsWorkChangesAndNothingBefore) {
  const Take clip = moving_clip();
  for (const std::size_t first : {0u, 1u, 3u}) {
    Take alone = slice(clip, first, frames);
    damage(alone);
    Take whole = clip;
    on_motion(whole, first, [&](Take& motion) {
      EXPECT_EQ(motion.frame_count(), frames - first);
      expect_same(motion, slice(clip, first, frames));
      damage(motion);
    });
    whole.validate();
    expect_same(slice(whole, first, frames), alone);
    Take front = slice(clip, 0, first);
    front.observed.assign(first * joints, 1);
    front.observed_positions.assign(first * tracks, 1);
    expect_same(slice(whole, 0, first), front);
  }
}

TEST(OnMotion, KeepsWhatIsMissingBeforeTheMotion) {
  Take clip = moving_clip();
  clip.observed.assign(frames * joints, 1);
  clip.observed_positions.assign(frames * tracks, 1);
  clip.observed[1] = clip.observed_positions[2] = 0;
  const Take before = clip;
  on_motion(clip, 1, [](Take&) {});
  expect_same(clip, before);
  on_motion(clip, 1, [](Take& motion) {
    motion.observed.clear();
    motion.observed_positions.clear();
  });
  expect_same(clip, before);
}

TEST(OnMotion, PutsTheFramesBackWhereItsWorkFails) {
  const Take before = moving_clip();
  Take clip = before;
  const auto fail = [](Take&) { throw Error(ErrorKind::usage, "no"); };
  EXPECT_THROW(on_motion(clip, 2, fail), Error);
  expect_same(clip, before);
}

TEST(FramesFrom, AreTheClipItselfWhereNothingStandsBefore) {
  const Take clip = moving_clip();
  std::optional<Take> part;
  EXPECT_EQ(&frames_from(clip, 0, part), &clip);
  EXPECT_FALSE(part);
  expect_same(frames_from(clip, 3, part), slice(clip, 3, frames));
}

}  // namespace
}  // namespace kinemend
