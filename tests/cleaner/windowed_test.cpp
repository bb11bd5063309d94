// Tests of live methods with a window, with the simplest such method.
#include "cleaner/live.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

constexpr std::size_t two = 2;

// The simplest method with a window: returns the sample of two frames before, or the first one of
// the piece.
struct TwoBefore {
  template <class Sample>
  void operator()(Piece<Sample>& piece) const {
    const std::vector<Sample> samples = piece.samples;
    for (std::size_t i = 0; i < samples.size(); ++i)
      piece.samples[i] = samples[i - std::min(i, two)];
  }
};

template <class Sample>
class TwoBeforeStep {
 public:
  Sample step(const Sample& newest) {
    window_.push(newest);
    return window_.samples().front();
  }

 private:
  SlidingWindow<Sample> window_{2 * two + 1};
};

std::unique_ptr<LiveFilter> live_two_before(const TakeView& like) {
  return windowed_filter<TwoBeforeStep>(
      like, two,
      [](const Track&, const auto& sample) {
        return TwoBeforeStep<std::remove_cvref_t<decltype(sample)>>();
      },
      TwoBefore{});
}

Take offline_two_before(Take clip) {
  const Take source = clip;
  const TakeView take = view_of(source);
  filter_pieces(
      take,
      [&](std::size_t n, const CleanedTrack& cleaned) {
        if (clip.has_joints()) set_track(clip, n, cleaned.rotations);
        set_track(clip, n, cleaned.positions);
      },
      {}, TwoBefore{});
  return clip;
}

std::vector<Frame> streamed_frames(LiveFilter& filter, const TakeView& take) {
  std::vector<Frame> frames;
  Frame out;
  for (std::size_t f = 0; f < take.frames; ++f) {
    const bool came = filter.push(frame_of(take, f), out);
    EXPECT_EQ(came, f >= filter.lookahead()) << f;
    if (came) frames.push_back(out);
  }
  while (filter.flush(out)) frames.push_back(out);
  return frames;
}

TEST(Frame, HasSeenAllIfItMarksNone) {
  Frame frame;
  frame.positions.resize(two);
  EXPECT_TRUE(frame.is_observed(0) && frame.is_observed(1));
  frame.observed = {1, 0};
  EXPECT_TRUE(frame.is_observed(0));
  EXPECT_FALSE(frame.is_observed(1));
}

TEST(Windowed, GivesWhatPiecesGiveForTheWholeTake) {
  for (const std::size_t frames : {0, 1, 2, 3, 4, 5, 6, 40}) {
    const Take clip = moving_take(frames, 100), expected = offline_two_before(clip);
    const auto filter = live_two_before(view_of(clip));
    EXPECT_EQ(filter->lookahead(), 2U);
    const std::vector<Frame> live = streamed_frames(*filter, view_of(clip));
    ASSERT_EQ(live.size(), frames);
    for (std::size_t f = 0; f < frames; ++f) {
      EXPECT_EQ(live[f].rotations, frame_of(view_of(expected), f).rotations) << f;
      EXPECT_EQ(live[f].positions, frame_of(view_of(expected), f).positions) << f;
    }
  }
}

TEST(Windowed, BridgesShortGapsOfMarkersAndEndsAtLongOnes) {
  Take clip = marker_take("walk", 2);
  lose(clip, 0, 50, 60);
  lose(clip, 1, 0, 9);
  lose(clip, 2, 100, 160);
  lose(clip, 3, 150, clip.frame_count() - 1);
  for (std::size_t f = 0; f < 40; f += 2) lose(clip, 5, f, f);
  const Take expected = offline_two_before(clip);
  const TakeView take = view_of(clip);
  const auto filter = live_two_before(take);
  EXPECT_EQ(filter->lookahead(),
            2 + longest_bridge(take.frame_rate_hz) + bridge_support(take.frame_rate_hz) + 1);
  const std::vector<Frame> live = streamed_frames(*filter, take);
  ASSERT_EQ(live.size(), clip.frame_count());
  for (std::size_t f = 0; f < live.size(); ++f) {
    EXPECT_EQ(live[f].observed, frame_of(take, f).observed) << f;
    for (std::size_t m = 0; m < clip.marker_count(); ++m)
      EXPECT_EQ(live[f].positions[m], expected.position(f, m)) << f << " " << m;
  }
}

TEST(Windowed, LeavesAloneWhatIsNotSelected) {
  Selection selection;
  const Take clip = moving_take(20, 100);
  selection.owners.assign(clip.joint_count(), 1);
  selection.owners[1] = 0;
  selection.root_position = false;
  const auto filter = live_two_before(view_of(clip, selection));
  const std::vector<Frame> live = streamed_frames(*filter, view_of(clip));
  for (std::size_t f = 0; f < live.size(); ++f) {
    EXPECT_EQ(live[f].rotations[1], clip.rotation(f, 1));
    EXPECT_EQ(live[f].positions[0], clip.root_position(f));
    EXPECT_EQ(live[f].rotations[2], clip.rotation(f - std::min(f, two), 2));
  }
}

}  // namespace
}  // namespace kinemend::test
