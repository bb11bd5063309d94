// After warm-up, a live filter of any method allocates no memory.
#include "counting_allocation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <ostream>

#include "kinemend/extend/method_options.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/live.hpp"
#include "methods/learned/motion_support.hpp"
#include "papers/mall2017_recurrent/random_filter_model.hpp"
#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

struct Live {
  std::string method;
  OptionValues options;

  friend void PrintTo(const Live& live, std::ostream* out) { *out << live.method; }
};

std::vector<Live> every_live_method() {
  return {{"bilateral", {}},     {"nonlocal", {{"causal", true}}},
          {"gaussian", {}},      {"butterworth", {{"causal", true}}},
          {"median", {}},        {"hampel", {}},
          {"weighted-mean", {}}, {"kalman", {{"smoother", false}}},
          {"one-euro", {}}};
}

std::vector<Frame> frames_of(const Take& clip) {
  const TakeView view = view_of(clip);
  std::vector<Frame> frames;
  for (std::size_t f = 0; f < view.frames; ++f) frames.push_back(frame_of(view, f));
  return frames;
}

class LiveMemory : public testing::TestWithParam<Live> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = make_cleaner(GetParam().method, GetParam().options);
};

#if !defined(KINEMEND_SANITIZED) && defined(__GLIBC__)

// Bytes allocated in the second half of the frames.
std::size_t taken_when_warm(Stream& stream, const std::vector<Frame>& frames) {
  Frame out;
  std::size_t came = 0;
  const std::size_t half = frames.size() / 2, outset = memory_taken;
  for (std::size_t f = 0; f < half; ++f) came += stream.push(frames[f], out) ? 1 : 0;
  const std::size_t warm = memory_taken;
  for (std::size_t f = half; f < frames.size(); ++f) came += stream.push(frames[f], out) ? 1 : 0;
  const std::size_t taken = memory_taken - warm;
  EXPECT_GT(warm, outset) << "nothing counts what a cold stream takes";
  EXPECT_EQ(came, frames.size() - stream.latency_frames());
  EXPECT_LT(stream.latency_frames(), half) << "the second half begins before the stream is warm";
  return taken;
}

TEST_P(LiveMemory, TakesNoneOnceItIsWarm) {
  Take clip = moving_take(700, 120);
  add_noise(clip, 1.5, 0.5, 1);
  EXPECT_EQ(taken_when_warm(*make_stream(*cleaner_, clip), frames_of(clip)), 0);
}

TEST_P(LiveMemory, TakesNoneForMarkersOnceItIsWarm) {
  if (GetParam().method == "nonlocal") GTEST_SKIP() << "runs live on joints only";
  const Take clip = damaged(marker_take("walk", 6), 3, 0.005, 100, 1);
  EXPECT_EQ(taken_when_warm(*make_stream(*cleaner_, clip, 1700), frames_of(clip)), 0);
}

TEST(RecurrentMemory, TakesNoneOnceItIsWarm) {
  const Take clip = synthesize({.motion = "walk", .duration_s = 3, .frame_rate_hz = 120});
  BodyLayoutBuilder builder;
  builder.add(clip);
  const BodyLayout layout = builder.finish();
  std::vector<Frame> frames = frames_of(clip);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].observed.assign(clip.joint_count(), 1);
    frames[f].observed[f % clip.joint_count()] = 0;
  }
  for (const RandomNetwork kind : {RandomNetwork{.layers = 2, .has_roughness = true},
                                   RandomNetwork{.layers = 0, .reach = 15}}) {
    auto model = std::make_shared<const Model>(random_filter_model(kind, &layout));
    const auto cleaner = make_recurrent({.live = true}, model);
    EXPECT_EQ(taken_when_warm(*make_stream(*cleaner, clip), frames), 0u);
  }
}

TEST(LearnedMemory, TakesNoneOnceItIsWarm) {
  const Take clip = synthesize({.motion = "walk", .duration_s = 6, .frame_rate_hz = 120});
  const auto cleaner =
      make_learned({.live = true}, std::make_shared<const Model>(small_motion_model()));
  EXPECT_EQ(taken_when_warm(*make_stream(*cleaner, clip), frames_of(clip)), 0u);
}

#endif

// Sample values never cause an error.
TEST_P(LiveMemory, ThrowsForNoValue) {
  Take clip = moving_take(200, 120);
  std::vector<Frame> frames = frames_of(clip);
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(), 1e300, -1e300, 0.0};
  for (std::size_t f = 100; f < 130; ++f) {
    const double value = odd[f % 5];
    frames[f].rotations[f % 7] = {value, value, value, 1};
    frames[f].positions[f % 2] = {value, 0, value};
  }
  const auto stream = make_stream(*cleaner_, clip);
  Frame out;
  std::size_t came = 0;
  for (const Frame& frame : frames) EXPECT_NO_THROW(came += stream->push(frame, out) ? 1 : 0);
  while (stream->flush(out)) ++came;
  EXPECT_EQ(came, frames.size());
}

INSTANTIATE_TEST_SUITE_P(Methods, LiveMemory, testing::ValuesIn(every_live_method()),
                         [](const auto& method) { return camel_case(method.param.method); });

}  // namespace
}  // namespace kinemend::test
