// Tests of live streams of markers: lines of numbers come in, and lines of JSON go out.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "kinemend/methods.hpp"
#include "live_run.hpp"
#include "registry/marker_takes.hpp"

namespace kinemend::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double height = 1700;

LiveOptions options_of_markers() {
  LiveOptions options;
  options.body_height = height;
  return options;
}

// A noisy walk with gaps as the lines of a stream.
Take live_take() {
  Take clip = damaged(marker_take("walk", 1), 3, 0.005, 100, 1);
  lose(clip, 0, 20, 25);
  lose(clip, 1, 0, 4);
  lose(clip, 2, 40, 90);
  return clip;
}

StreamText marker_stream_text(const Take& clip) {
  StreamText stream{"MARKERS 120 ", {}};
  for (std::size_t m = 0; m < clip.marker_count(); ++m)
    stream.header += (m > 0 ? "," : "") + clip.names[m];
  stream.header += "\n";
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    std::string line;
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      const Vec3 v = clip.position(f, m);
      line += m > 0 ? "," : "";
      line += clip.is_observed(f, m)
                  ? std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z)
                  : ",,";
    }
    stream.frames.push_back(line + "\n");
  }
  return stream;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\n') {
      cells.back() += c;
    }
  }
  return cells;
}

TEST(LiveMarkers, GivesWhatTheMethodMakesOfTheWholeTake) {
  Take clip = live_take();
  clip.frame_rate_hz = 120;
  const StreamText stream = marker_stream_text(clip);
  for (const char* method : {"median", "one-euro", "bilateral"}) {
    const auto cleaner = make_cleaner(method);
    Take offline = clip;
    Selection selection;
    selection.body_height = height;
    clean_in_place(*cleaner, offline, selection);
    LiveRun run(*cleaner, options_of_markers());
    run.feed(stream.text(), 37);
    run.session.finish();
    ASSERT_EQ(run.lines.size(), clip.frame_count()) << method;
    EXPECT_EQ(run.text.substr(0, stream.header.size()), stream.header);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const std::vector<std::string> cells = cells_of(run.lines[f]);
      ASSERT_EQ(cells.size(), 3 * clip.marker_count());
      for (std::size_t m = 0; m < clip.marker_count(); ++m) {
        ASSERT_EQ(cells[3 * m].empty(), !clip.is_observed(f, m)) << f << " " << m;
        if (!cells[3 * m].empty()) {
          ASSERT_NEAR(std::stod(cells[3 * m]), offline.position(f, m).x, 1e-4) << method << f;
        }
      }
    }
  }
}

TEST(LiveMarkers, WritesLinesOfJson) {
  LiveOptions options = options_of_markers();
  options.format = LiveFormat::jsonl;
  options.numbered = true;
  const auto cleaner = make_cleaner("one-euro");
  LiveRun run(*cleaner, options);
  run.feed("MARKERS 100 LASI, RASI\n7 1,2,3,,,\n9 1,2,3,4,5,6\n");
  run.session.finish();
  const auto header = nlohmann::json::parse(run.text.substr(0, run.text.find('\n')));
  EXPECT_EQ(header["markers"], nlohmann::json({"LASI", "RASI"}));
  EXPECT_EQ(header["frame_rate_hz"], 100);
  ASSERT_EQ(run.lines.size(), 3);
  const auto frame = nlohmann::json::parse(run.lines[1]);
  EXPECT_EQ(frame["frame"], 8);
  EXPECT_EQ(frame["positions"][0], nlohmann::json({1.0, 2.0, 3.0}));
  EXPECT_TRUE(frame["positions"][1].is_null());
  EXPECT_EQ(nlohmann::json::parse(run.lines[2])["positions"][1][2], 6.0);
}

TEST(LiveMarkers, CountsLinesThatAreNoFrame) {
  const auto cleaner = make_cleaner("one-euro");
  LiveRun run(*cleaner, options_of_markers());
  run.feed(
      "MARKERS 100 LASI,RASI\n1,2,3,4,5,6\n1,2,3,4,5\n1,2,3,4,5,6,7\n1,2,x,4,5,6\nhello\n"
      "1,2,3 4,4,5,6\n1,2,3,nan,5,6\n");
  run.session.finish();
  EXPECT_EQ(run.counts().malformed, 5);
  EXPECT_EQ(run.counts().made_up, 4);
  EXPECT_EQ(run.counts().not_finite, 1);
  EXPECT_EQ(cells_of(run.lines.back())[3], "");
  EXPECT_THAT(run.session.take_notes(), Contains(HasSubstr("2 markers at 100 Hz")));
}

TEST(LiveMarkers, BeginsAnewWithOtherMarkersOnly) {
  const auto cleaner = make_cleaner("one-euro");
  LiveRun run(*cleaner, options_of_markers());
  run.feed("MARKERS 100 A\n1,2,3\nMARKERS 100 A\n1,2,3\nMARKERS 100 A,B\n1,2,3,1,2,3\n");
  run.session.finish();
  EXPECT_EQ(run.headers, 2);
  EXPECT_EQ(run.counts().frames_out, 3);
}

TEST(LiveMarkers, PassesOverAHeaderThatIsNone) {
  const auto cleaner = make_cleaner("one-euro");
  LiveRun run(*cleaner, options_of_markers());
  for (const char* header : {"MARKERS\n", "MARKERS LASI,RASI\n", "MARKERS 0 A\n", "MARKERS 100\n",
                             "MARKERS 100 A,,B\n", "MARKERS nan A\n"}) {
    run.feed(header);
  }
  EXPECT_EQ(run.counts().bad_headers, 6);
  EXPECT_FALSE(run.session.has_skeleton());
}

}  // namespace
}  // namespace kinemend::test
