// Real TRC files are read to the last sample and written back byte for byte.
#include "io/support.hpp"

namespace kinemend {
namespace {

using namespace test;

const std::filesystem::path folder = std::filesystem::path(KINEMEND_DATA_FOLDER) / "trc";

std::vector<std::filesystem::path> real_trc_files() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".trc") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

// Counts the markers with three non-empty columns over all rows, without the reader.
std::size_t full_triples(const std::string& text) {
  std::size_t count = 0, line_number = 0;
  for (std::size_t at = 0; at < text.size(); ++line_number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::vector<std::string> cells{""};
    for (std::size_t i = at; i < end; ++i) {
      if (text[i] == '\t') {
        cells.emplace_back();
      } else if (text[i] != '\r') {
        cells.back() += text[i];
      }
    }
    at = end + 1;
    if (line_number < 5) continue;
    for (std::size_t i = 2; i + 2 < cells.size(); i += 3)
      count += !cells[i].empty() && !cells[i + 1].empty() && !cells[i + 2].empty() ? 1 : 0;
  }
  return count;
}

TEST(RealTrc, EveryFileIsReadToTheLastSampleAndComesBackToTheByte) {
  std::size_t read = 0;
  for (const auto& path : real_trc_files()) {
    if (path.stem() == "Empty" || path.stem() == "Truncated") continue;
    SCOPED_TRACE(path.filename());
    const std::string bytes = read_file(path);
    const TakeResult result = read_take(path);
    const auto& clip = result.take;
    clip.validate();
    EXPECT_EQ(static_cast<std::size_t>(
                  std::count(clip.observed.begin(), clip.observed.end(), std::uint8_t{1})),
              full_triples(bytes) - result.diagnostics.count("zero_is_missing"));
    EXPECT_EQ(write_take(clip, "trc"), bytes);
    ++read;
  }
  EXPECT_EQ(read, 10u);
}

TEST(RealTrc, EmptyAndTruncatedFilesAreOneClearLine) {
  EXPECT_EQ(message_of([] { read_take(folder / "Empty.trc"); }, ErrorKind::unreadable_input),
            (folder / "Empty.trc").string() + ":1: the file is empty");
  EXPECT_EQ(message_of([] { read_take(folder / "Truncated.trc"); }, ErrorKind::unreadable_input),
            (folder / "Truncated.trc").string() +
                ":3: expected the row of labels (Frame#, Time, names of markers), found the end of "
                "the file");
}

TEST(RealTrc, KnownFactsHold) {
  const auto read = [](const char* name) { return read_take(folder / name).take; };
  const Take gait = read("Gait.trc");
  // 33 markers have names, the header says 66, and the widest row holds 105.
  EXPECT_EQ(gait.marker_count(), 105u);
  EXPECT_EQ(gait.names[32], "PX");
  EXPECT_EQ(gait.names[33], "*34");
  EXPECT_EQ(gait.frame_count(), 487u);
  EXPECT_EQ(gait.frame_rate_hz, 100);
  EXPECT_EQ(gait.names[0], "R.Shoulder");
  const Take motek = read("MOTEK/ballet_reduced.trc");
  EXPECT_EQ(motek.marker_count(), 41u);
  EXPECT_EQ(motek.frame_rate_hz, 30);
  EXPECT_EQ(motek.position(99, 0), (Vec3{-68.85837, 1595.47900, -80.09546}));
  const Take unnamed = read("10002-20130731010438-Unnamed.trc");
  EXPECT_EQ(unnamed.names[0], "*1");
  EXPECT_EQ(unnamed.frame_count(), 1313u);
  EXPECT_EQ(unnamed.frame_rate_hz, 400);
}

}  // namespace
}  // namespace kinemend
