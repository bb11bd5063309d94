// The method `learned` on a stream equals its live form on the whole take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/live.hpp"
#include "kinemend/methods.hpp"
#include "methods/learned/motion_support.hpp"
#include "registry/marker_takes.hpp"

namespace kinemend::test {
namespace {

constexpr std::size_t gaussian_of_50_ms = 5;

Take noisy_walking(double duration_s, double rate_hz = 120) {
  Take clip = synthesize({.motion = "walk", .duration_s = duration_s, .frame_rate_hz = rate_hz});
  Random random(5);
  apply_damage(clip, "gaussian", {{"std_deg", 2.0}}, random);
  return clip;
}

std::unique_ptr<Cleaner> live_learned(Model model = small_motion_model()) {
  return make_learned({.live = true}, std::make_shared<const Model>(std::move(model)));
}

std::vector<Frame> live_frames(Stream& stream, const Take& clip) {
  const TakeView view = view_of(clip);
  std::vector<Frame> result;
  Frame out;
  for (std::size_t f = 0; f < view.frames; ++f) {
    const bool came = stream.push(frame_of(view, f), out);
    EXPECT_EQ(came, f >= stream.latency_frames());
    if (came) result.push_back(out);
  }
  while (stream.flush(out)) result.push_back(out);
  return result;
}

TEST(LearnedStream, GivesWhatItsLiveFormGivesForTheWholeTake) {
  for (const double rate_hz : {30.0, 120.0, 200.0}) {
    const Take clip = noisy_walking(2, rate_hz);
    const auto cleaner = live_learned();
    const auto stream = make_stream(*cleaner, clip);
    EXPECT_LE(stream->latency_frames(), 14u);
    const std::vector<Frame> live = live_frames(*stream, clip);
    Take whole = clip;
    clean_in_place(*cleaner, whole);
    ASSERT_EQ(live.size(), clip.frame_count());
    double change = 0;
    for (std::size_t f = 0; f < live.size(); ++f) {
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        ASSERT_EQ(live[f].rotations[j], whole.rotation(f, j)) << "frame " << f << ", joint " << j;
        change += angle_between(whole.rotation(f, j), clip.rotation(f, j));
      }
      EXPECT_EQ(live[f].positions[0], whole.root_position(f));
    }
    EXPECT_GT(change, 0);
  }
}

TEST(LearnedStream, SmoothsJointsThatItKnowsAndOthersAlikeAndHasNoDelayInTime) {
  const Take truth = synthesize({.motion = "walk", .duration_s = 4, .frame_rate_hz = 120});
  const Take noisy = noisy_walking(4);
  Take known = noisy, unknown = noisy;
  for (std::size_t j = 0; j < unknown.skeleton.joint_count(); ++j)
    unknown.skeleton.names[j] = "Q" + std::to_string(j);
  const auto cleaner = live_learned(one_smoother_model(gaussian_of_50_ms));
  clean_in_place(*cleaner, known);
  clean_in_place(*cleaner, unknown);
  EXPECT_LT(rms_deg(truth, known), 0.7 * rms_deg(truth, noisy));
  unknown.skeleton.names = known.skeleton.names;
  EXPECT_LT(rms_deg(known, unknown), 0.15);
}

TEST(LearnedStream, SmoothsMarkersAndLeavesThoseThatAreNotSeen) {
  Take clip = damaged(marker_take("walk", 3), 3, 0, 1, 1);
  for (std::size_t f = 100; f < 130; ++f) {
    clip.observed[f * clip.marker_count() + 4] = 0;
    clip.positions[f * clip.marker_count() + 4] = {};
  }
  const auto cleaner = live_learned(one_smoother_model(gaussian_of_50_ms));
  const auto stream = make_stream(*cleaner, clip, 1700);
  const std::vector<Frame> live = live_frames(*stream, clip);
  std::size_t changed = 0, unseen = 0;
  for (std::size_t f = 0; f < live.size(); ++f) {
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      const Vec3 before = clip.positions[f * clip.marker_count() + m];
      if (clip.observed[f * clip.marker_count() + m] != 0) {
        changed += norm(live[f].positions[m] - before) > 0.01 ? 1 : 0;
      } else {
        ++unseen;
        EXPECT_EQ(live[f].positions[m], before);
      }
    }
  }
  EXPECT_GT(unseen, 0u);
  EXPECT_GT(changed, live.size() * clip.marker_count() / 2);
}

TEST(LearnedStream, RefusesTakesBelow20HzAndTellsWhatRunsLive) {
  const Take slow = noisy_walking(3, 15);
  const auto reason_of = [](auto&& work) -> std::string {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(reason_of([&] { make_stream(*live_learned(), slow); }), testing::HasSubstr("20 Hz"));
  const auto whole = make_learned({}, std::make_shared<const Model>(small_motion_model()));
  EXPECT_THAT(reason_of([&] { make_stream(*whole, noisy_walking(1)); }),
              testing::HasSubstr("--live"));
}

}  // namespace
}  // namespace kinemend::test
