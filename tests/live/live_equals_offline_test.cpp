// A live session gives the same result as the method on the whole file, however the bytes arrive.
#include "kinemend/live.hpp"
#include "kinemend/methods.hpp"
#include "live_run.hpp"

#include <ostream>

namespace kinemend {
inline void PrintTo(const LiveMethod& method, std::ostream* out) { *out << method.name; }
}  // namespace kinemend

namespace kinemend::test {
namespace {

class LiveText : public testing::TestWithParam<LiveMethod> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = make_cleaner(GetParam().name, GetParam().options);

  // The cleaner's offline result for the same text.
  Take offline(const std::string& text) const {
    Take clip = read_bvh_text(text);
    clean_in_place(*cleaner_, clip);
    clip.source = {};
    return read_bvh_text(write_take(clip));
  }
};

TEST_P(LiveText, GivesWhatTheMethodMakesOfTheWholeFile) {
  const std::string text = stream_text(noisy_clip(150)).text();
  LiveRun run(*cleaner_);
  run.feed(text);
  run.session.finish();
  const auto [turn, way] = difference(read_bvh_text(run.text), offline(text));
  EXPECT_LT(turn, digits_rad);
  EXPECT_LT(way, digits_units);
  EXPECT_EQ(run.counts().frames_in, 150);
  EXPECT_EQ(run.counts().frames_out, 150);
}

TEST_P(LiveText, IsTheSameHoweverTheBytesArrive) {
  const std::string text = stream_text(noisy_clip(40)).text();
  LiveRun whole(*cleaner_);
  whole.feed(text, text.size());
  whole.session.finish();
  for (const std::size_t piece : {1, 7, 64, 500}) {
    LiveRun run(*cleaner_);
    run.feed(text, piece);
    run.session.finish();
    EXPECT_EQ(run.text, whole.text) << piece;
  }
}

TEST_P(LiveText, DelaysByItsWindowAndNoMore) {
  const StreamText stream = stream_text(noisy_clip(150));
  LiveRun run(*cleaner_);
  run.feed(stream.header);
  const std::size_t delay = run.session.latency_frames();
  for (std::size_t f = 0; f < stream.frames.size(); ++f) {
    run.feed(stream.frames[f]);
    EXPECT_EQ(run.lines.size(), f + 1 - std::min(f + 1, delay)) << f;
  }
  run.session.finish();
  EXPECT_EQ(run.lines.size(), stream.frames.size());
}

TEST_P(LiveText, HoldsWhatIsNoFiniteNumberAsAFileDoes) {
  StreamText stream = stream_text(noisy_clip(60));
  for (const std::size_t f : {20, 21, 22, 40}) {
    std::string& line = stream.frames[f];
    const std::size_t tenth = [&] {
      std::size_t at = 0;
      for (int i = 0; i < 9; ++i) at = line.find(' ', at) + 1;
      return at;
    }();
    line.replace(tenth, line.find(' ', tenth) - tenth, "nan");
  }
  LiveRun run(*cleaner_);
  run.feed(stream.text());
  run.session.finish();
  EXPECT_EQ(run.counts().not_finite, 4);
  EXPECT_EQ(run.counts().malformed, 0);
  // A window that begins or ends within a gap does not see both of its sides.
  const double near_rad =
      make_stream(*cleaner_, noisy_clip(1))->latency_frames() > 0 ? 0.02 : digits_rad;
  const auto [turn, way] = difference(read_bvh_text(run.text), offline(stream.text()));
  EXPECT_LT(turn, near_rad);
  EXPECT_LT(way, digits_units);
}

INSTANTIATE_TEST_SUITE_P(Methods, LiveText, testing::ValuesIn(live_methods()),
                         [](const auto& method) { return camel_case(method.param.name); });

TEST(LiveMethods, AreAllThatRunLiveWithWhatMakesThem) {
  std::vector<std::string> names;
  for (const LiveMethod& method : live_methods()) {
    names.push_back(method.name);
    EXPECT_TRUE(make_cleaner(method.name, method.options)->live_support(120).runs());
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"bilateral", "nonlocal", "gaussian", "median",
                                            "weighted-mean", "kalman", "one-euro", "learned"}));
  for (const char* method : {"wavelet", "butterworth", "hampel"})
    EXPECT_THAT(names, testing::Not(testing::Contains(method)));
}

}  // namespace
}  // namespace kinemend::test
