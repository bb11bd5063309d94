// Streams of markers give the same result as the method on the whole take.
#include <gtest/gtest.h>

#include "kinemend/error.hpp"
#include "kinemend/live.hpp"
#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

Take live_take() {
  Take clip = damaged(marker_take("walk", 2), 3, 0.005, 100, 1);
  clip.is_position[9] = 0;
  lose(clip, 0, 50, 60);
  lose(clip, 1, 0, 9);
  lose(clip, 2, 100, 160);
  lose(clip, 3, 200, clip.frame_count() - 1);
  lose(clip, 4, 20, 70);
  for (std::size_t f = 0; f < 40; f += 2) lose(clip, 5, f, f);
  return clip;
}

// Pushes all frames, flushes, and checks that every frame is output at its time.
Take run(Stream& stream, const Take& clip) {
  Take result = clip;
  const std::size_t markers = clip.marker_count();
  std::size_t next = 0;
  Frame in, out;
  const auto take = [&] {
    for (std::size_t m = 0; m < markers; ++m) {
      result.position(next, m) = out.positions[m];
      EXPECT_EQ(out.observed[m], clip.is_observed(next, m));
    }
    ++next;
  };
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    in.positions.clear();
    in.observed.clear();
    for (std::size_t m = 0; m < markers; ++m) {
      in.positions.push_back(clip.position(f, m));
      in.observed.push_back(clip.is_observed(f, m));
    }
    const bool came = stream.push(in, out);
    EXPECT_EQ(came, f >= stream.latency_frames()) << f;
    if (came) take();
  }
  while (stream.flush(out)) take();
  EXPECT_EQ(next, clip.frame_count());
  return result;
}

class LiveOnMarkers : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = [] {
    const std::string& name = GetParam();
    if (name == "kalman") return make_cleaner(name, {{"smoother", false}});
    return make_cleaner(name);
  }();
};

TEST_P(LiveOnMarkers, GivesWhatItGivesForTheWholeTake) {
  const Take clip = live_take();
  Take offline = clip;
  clean_in_place(*cleaner_, offline);
  const auto stream = make_stream(*cleaner_, clip, body_height(clip));
  const Take first = run(*stream, clip);
  EXPECT_LT(max_distance(first, offline), 1e-8);
  stream->reset();
  EXPECT_EQ(run(*stream, clip).positions, first.positions);
}

INSTANTIATE_TEST_SUITE_P(Methods, LiveOnMarkers,
                         testing::Values("kalman", "one-euro", "gaussian", "median", "bilateral",
                                         "weighted-mean"),
                         [](const auto& method) { return camel_case(method.param); });

TEST(MarkerStream, RefusesWhatItCannotDo) {
  const Take clip = marker_take("walk", 0.5);
  EXPECT_THROW(make_stream(*make_cleaner("auto"), clip, 1750), Error);
  EXPECT_THROW(make_stream(*make_cleaner("nonlocal", {{"causal", true}}), clip, 1750), Error);
  Frame frame, out;
  frame.positions.resize(3);
  EXPECT_THROW(make_stream(*make_cleaner("one-euro"), clip, 1750)->push(frame, out), Error);
}

}  // namespace
}  // namespace kinemend::test
