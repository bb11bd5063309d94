// The method `recurrent` on a stream equals its live form on the whole take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/live.hpp"
#include "kinemend/metrics.hpp"
#include "papers/mall2017_recurrent/random_filter_model.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

Take noisy_walk(double duration_s, double rate_hz = 120) {
  Take clip = synthesize({.motion = "walk", .duration_s = duration_s, .frame_rate_hz = rate_hz});
  Random random(5);
  apply_damage(clip, "gaussian", {{"std_deg", 2.0}}, random);
  return clip;
}

BodyLayout layout_of(const Take& clip) {
  BodyLayoutBuilder builder;
  builder.add(clip);
  return builder.finish();
}

std::shared_ptr<const Model> model_of(const Take& clip, RandomNetwork kind) {
  const BodyLayout layout = layout_of(clip);
  return std::make_shared<const Model>(random_filter_model(kind, &layout));
}

std::unique_ptr<Cleaner> live_cleaner(const Take& clip, RandomNetwork kind = {}) {
  return make_recurrent({.live = true}, model_of(clip, kind));
}

std::vector<Frame> streamed(Stream& stream, const Take& clip) {
  const TakeView view = view_of(clip);
  std::vector<Frame> result;
  Frame out;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const bool came = stream.push(frame_of(view, f), out);
    EXPECT_EQ(came, f >= stream.latency_frames());
    if (came) result.push_back(out);
  }
  while (stream.flush(out)) result.push_back(out);
  return result;
}

Take offline(const Cleaner& cleaner, Take clip) {
  clean_in_place(cleaner, clip);
  return clip;
}

void expect_live_equals_offline(const Cleaner& cleaner, const Take& clip) {
  const auto stream = make_stream(cleaner, clip);
  EXPECT_EQ(stream->latency_frames(), 15u);
  const std::vector<Frame> live = streamed(*stream, clip);
  const Take whole = offline(cleaner, clip);
  ASSERT_EQ(live.size(), clip.frame_count());
  for (std::size_t f = 0; f < live.size(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j)
      ASSERT_EQ(live[f].rotations[j], whole.rotation(f, j)) << "frame " << f << ", joint " << j;
    EXPECT_EQ(live[f].positions[0], clip.root_position(f));
  }
}

TEST(RecurrentStream, GivesWhatItsLiveFormGivesForTheWholeTake) {
  const Take clip = noisy_walk(1.2);
  for (const RandomNetwork kind :
       {RandomNetwork{.layers = 2, .has_roughness = true}, RandomNetwork{.layers = 0, .reach = 15}})
    expect_live_equals_offline(*live_cleaner(clip, kind), clip);
}

TEST(RecurrentStream, GivesTheSameForTakesShorterThanItsDelay) {
  const Take whole = noisy_walk(1);
  for (const std::size_t frames : {1u, 2u, 9u, 15u, 17u})
    expect_live_equals_offline(*live_cleaner(whole), slice(whole, 0, frames));
}

TEST(RecurrentStream, FiltersTheJointsThatItsModelKnowsAndLeavesTheRoot) {
  const Take clip = noisy_walk(1.2);
  const Take cleaned = offline(*live_cleaner(clip), clip);
  const auto knee = static_cast<std::size_t>(clip.skeleton.find("LeftLeg"));
  double change = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_EQ(cleaned.rotation(f, 0), clip.rotation(f, 0));
    change += angle_between(cleaned.rotation(f, knee), clip.rotation(f, knee));
  }
  EXPECT_GT(change / static_cast<double>(clip.frame_count()), 0.005);
}

TEST(RecurrentStream, GivesTheSameWhereSamplesAreMissingWhateverStandsThere) {
  Take clip = noisy_walk(1.2);
  const auto knee = static_cast<std::size_t>(clip.skeleton.find("LeftLeg"));
  clip.observed.assign(clip.frame_count() * clip.joint_count(), 1);
  const auto hide = [&](std::size_t joint, std::size_t first, std::size_t last) {
    for (std::size_t f = first; f <= last; ++f) clip.observed[f * clip.joint_count() + joint] = 0;
  };
  hide(knee, 30, 40);
  hide(knee, 60, 90);
  hide(0, 50, 70);
  hide(1, 0, 8);
  const auto cleaner = live_cleaner(clip);
  expect_live_equals_offline(*cleaner, clip);
  Take other = clip;
  for (std::size_t i = 0; i < other.observed.size(); ++i) {
    if (other.observed[i] == 0) other.rotations[i] = exp(Vec3{1, -2, 0.5});
  }
  EXPECT_EQ(offline(*cleaner, other).rotations, offline(*cleaner, clip).rotations);
}

TEST(RecurrentStream, StartsAfreshWhenReset) {
  const Take clip = noisy_walk(0.7);
  const auto cleaner = live_cleaner(clip);
  const auto stream = make_stream(*cleaner, clip);
  const std::vector<Frame> first = streamed(*stream, clip);
  stream->reset();
  const std::vector<Frame> again = streamed(*stream, clip);
  ASSERT_EQ(again.size(), first.size());
  for (std::size_t f = 0; f < first.size(); ++f) EXPECT_EQ(again[f].rotations, first[f].rotations);
}

// NaN and infinity must not enter the network's state.
TEST(RecurrentStream, ForgetsValuesThatAreNoNumbers) {
  const Take clip = noisy_walk(2);
  const auto cleaner = live_cleaner(clip);
  std::vector<Frame> frames;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) frames.push_back(frame_of(view_of(clip), f));
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(), 1e300, -1e300, 0.0};
  for (std::size_t f = 50; f < 70; ++f) {
    const double value = odd[f % 5];
    for (std::size_t j = 0; j < clip.joint_count(); j += 2)
      frames[f].rotations[j] = {value, value, value, value};
  }
  const auto stream = make_stream(*cleaner, clip), plain = make_stream(*cleaner, clip);
  const std::vector<Frame> wanted = streamed(*plain, clip);
  Frame out;
  std::size_t given = 0;
  double farthest = 0;
  for (const Frame& frame : frames) {
    if (!stream->push(frame, out)) continue;
    for (std::size_t j = 0; given > 180 && j < clip.joint_count(); ++j)
      farthest = std::max(farthest, angle_between(out.rotations[j], wanted[given].rotations[j]));
    ++given;
  }
  EXPECT_GT(given, 200u);
  EXPECT_LT(farthest, 0.01);
}

std::string reason_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "nothing was refused";
}

TEST(RecurrentStream, RefusesWhatDoesNotRunLiveAndSaysWhatDoes) {
  const Take clip = noisy_walk(0.5);
  EXPECT_THAT(reason_of([&] { make_stream(*make_recurrent(), clip); }), HasSubstr("--live"));
  const auto live = live_cleaner(clip);
  EXPECT_THAT(reason_of([&] { make_stream(*live, noisy_walk(0.5, 60)); }),
              HasSubstr("the network filters 120 Hz"));
  EXPECT_THAT(reason_of([&] { make_stream(*live, Take(make_marker_take({"a"}, 0, 120)), 1); }),
              HasSubstr("markers"));
}

}  // namespace
}  // namespace kinemend::test
