// A live session survives any bytes, in bounded memory.
#include "kinemend/extend/random.hpp"
#include "kinemend/methods.hpp"
#include "live_run.hpp"

namespace kinemend::test {
namespace {

// No bytes stop a stream, and all output frames are finite numbers.
void expect_survives(const std::string& text, std::size_t piece, const LiveOptions& options = {}) {
  const auto median = make_cleaner("median");
  LiveRun run(*median, options);
  run.feed(text, piece);
  run.session.drop_line();
  run.feed(text, piece);
  run.session.end_line();
  run.session.hold();
  run.session.finish();
  const LiveCounts& c = run.counts();
  EXPECT_EQ(c.frames_out, c.frames_in + c.made_up + c.held);
  EXPECT_EQ(run.text.find("nan"), std::string::npos);
  EXPECT_EQ(run.text.find("inf"), std::string::npos);
}

TEST(HostileLive, SurvivesBytesThatAreChanged) {
  const std::string text = stream_text(noisy_clip(6)).text();
  Random random(5);
  for (int round = 0; round < 300; ++round) {
    std::string changed = text;
    for (int i = 0; i < 1 + round % 7; ++i) {
      const auto at =
          static_cast<std::size_t>(random.uniform(0, 1) * static_cast<double>(changed.size() - 1));
      changed[at] = static_cast<char>(random.uniform(0, 1) * 255);
    }
    LiveOptions options;
    options.numbered = round % 3 == 0;
    expect_survives(changed, 1 + static_cast<std::size_t>(round % 50), options);
  }
}

TEST(HostileLive, SurvivesTextThatEndsAnywhere) {
  const std::string text = stream_text(noisy_clip(2)).text();
  for (std::size_t end = 0; end < text.size(); end += 3) expect_survives(text.substr(0, end), 100);
}

TEST(HostileLive, SurvivesHugeValues) {
  StreamText stream = stream_text(noisy_clip(4));
  for (const char* value : {"1e99", "-1e300", "1e400", "nan", "1#INF", "1e-320", "0x10"}) {
    std::string line = value;
    for (int i = 1; i < 22; ++i) line += std::string(" ") + value;
    stream.frames.push_back(line + "\n");
    stream.frames.push_back(stream.frames[0]);
  }
  expect_survives(stream.text(), 64);
}

TEST(HostileLive, BoundsWhatItKeepsOfLinesAndHeadersThatDoNotEnd) {
  LiveOptions options;
  options.most_line_bytes = 100;
  options.most_header_bytes = 1000;
  const auto median = make_cleaner("median");
  LiveRun run(*median, options);
  run.feed(std::string(100000, '1'));
  run.feed("\nHIERARCHY\n");
  for (int i = 0; i < 1000; ++i) run.feed("ROOT Hips\n");
  run.session.finish();
  EXPECT_GE(run.counts().bad_headers, 1);
  EXPECT_GE(run.counts().malformed, 1);
  EXPECT_EQ(run.counts().sessions, 0);
}

}  // namespace
}  // namespace kinemend::test
