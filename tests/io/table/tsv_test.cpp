// Tests of TSV tables: reading, writing, and bytes that are cut, patched or moved.
#include <gmock/gmock.h>

#include <map>

#include "io/hostile.hpp"
#include "io/support.hpp"

namespace kinemend {
namespace {

using namespace test;
using testing::ElementsAre;

std::string tsv_fixture(const std::string& name) {
  return read_file(std::filesystem::path(KINEMEND_TEST_FIXTURES) / "tsv" / name);
}

TakeResult read_tsv(std::string bytes, ReadOptions options = {}) {
  options.format = "tsv";
  return read_take(std::move(bytes), "take.tsv", options);
}

Take tsv_markers(const std::string& name) { return read_tsv(tsv_fixture(name)).take; }

TEST(TsvReader, ReadsNamesPositionsRateAndUnit) {
  const TakeResult result = read_tsv(tsv_fixture("good/plain.tsv"));
  EXPECT_TRUE(result.diagnostics.empty());
  const auto& clip = result.take;
  EXPECT_THAT(clip.names, ElementsAre("Wrist_L", "Hip_L"));
  EXPECT_EQ(clip.frame_count(), 3u);
  EXPECT_EQ(clip.position(0, 0), (Vec3{-473.521, 191.980, 613.382}));
  EXPECT_EQ(clip.position(2, 1), (Vec3{-677.045, 164.794, 615.445}));
  EXPECT_EQ(clip.frame_rate_hz, 120);
  EXPECT_EQ(clip.unit, "mm");
  EXPECT_EQ(clip.source.format, "tsv");
}

TEST(TsvReader, LayoutsOfTheSameTakeReadTheSame) {
  const Take plain = tsv_markers("good/plain.tsv");
  for (const char* const name : {"crlf", "no_types", "frame_time", "labels", "trailing_tabs",
                                 "events", "external_rate", "decimal_comma", "wrong_counts"}) {
    SCOPED_TRACE(name);
    const Take clip = tsv_markers(std::string("good/") + name + ".tsv");
    EXPECT_EQ(clip.names, plain.names);
    EXPECT_EQ(clip.positions, plain.positions);
    EXPECT_EQ(clip.observed, plain.observed);
    EXPECT_EQ(clip.frame_rate_hz, plain.frame_rate_hz);
    EXPECT_EQ(clip.first_frame, 1);
  }
}

TEST(TsvReader, EmptyCellsOrElseZerosAreMissing) {
  EXPECT_THAT(tsv_markers("good/empty_cells.tsv").observed, ElementsAre(1, 1, 1, 0, 1, 1));
  EXPECT_EQ(tsv_markers("good/empty_cells.tsv").first_frame, 20);
  EXPECT_THAT(tsv_markers("good/empty_cells_bare.tsv").observed, ElementsAre(1, 1, 1, 0, 1, 1));
  EXPECT_THAT(tsv_markers("good/zeros.tsv").observed, ElementsAre(1, 1, 1, 0, 1, 1));
  EXPECT_THAT(tsv_markers("good/never_seen.tsv").observed, ElementsAre(1, 0, 1, 0, 1, 0));
}

TEST(TsvReader, EventsAreRead) {
  const Take clip = tsv_markers("good/events.tsv");
  ASSERT_EQ(clip.events.size(), 1u);
  EXPECT_EQ(clip.events[0].label, "Foot strike");
  EXPECT_EQ(clip.events[0].time_s, 0.00833);
}

TEST(TsvReader, RepairsHaveNames) {
  const std::map<std::string, std::string> expected{
      {"plain", ""},
      {"labels", ""},
      {"zeros", ""},
      {"external_rate", "frame_rate_assumed"},
      {"decimal_comma", "decimal_comma"},
      {"wrong_counts", "frame_count_mismatch marker_count_mismatch"},
      {"unnamed", "marker_unnamed marker_count_mismatch"}};
  for (const auto& [name, repairs] : expected) {
    const TakeResult result = read_tsv(tsv_fixture("good/" + name + ".tsv"));
    std::string found;
    for (const Diagnostic& entry : result.diagnostics.entries())
      found += (found.empty() ? "" : " ") + entry.name;
    EXPECT_EQ(found, repairs) << name;
  }
}

TEST(TsvReader, TablesOfOtherThingsAreRefusedByName) {
  const std::pair<const char*, const char*> expected[] = {
      {"empty", "take.tsv:1: the file is empty"},
      {"rigid_bodies",
       "take.tsv:1: a Qualisys table of \"6D\" data without MARKER_NAMES: no markers to clean"},
      {"analog",
       "take.tsv:1: a Qualisys table of \"ANALOG\" data without MARKER_NAMES: no markers to clean"},
      {"skeleton", "take.tsv:1: a Qualisys table without MARKER_NAMES: no markers to clean"},
      {"no_rows", "take.tsv:12: expected a row for each frame, found none"},
      {"wide_row", "take.tsv:13: expected 6 cells, found 9"},
      {"labels_of_others",
       "take.tsv:12: expected labels of 2 markers as in MARKER_NAMES, found 5 cells"},
      {"text_in_row", "take.tsv:13: expected a number, found \"7x\""}};
  for (const auto& [name, message] : expected) {
    const std::string table = tsv_fixture(std::string("bad/") + name + ".tsv");
    EXPECT_EQ(message_of([&] { read_tsv(table); }, ErrorKind::unreadable_input), message);
  }
}

TEST(TsvReader, IsFoundByContent) {
  for (const auto& path : fixture_paths("tsv")) {
    const std::string bytes = read_file(path);
    if (bytes.empty()) continue;
    try {
      EXPECT_EQ(read_take(bytes, "take.txt").take.source.format, "tsv") << path;
    } catch (const Error& error) {
      EXPECT_EQ(path.parent_path().filename(), "bad") << error.what();
    }
  }
}

TEST(TsvWriter, EveryFixtureComesBackToTheByte) {
  for (const auto& path : fixture_paths("tsv")) {
    if (path.parent_path().filename() != "good") continue;
    const std::string bytes = read_file(path);
    EXPECT_EQ(write_take(read_tsv(bytes).take, "tsv"), bytes) << path;
  }
}

TEST(TsvWriter, OnlyChangedSamplesGetNewDigits) {
  const std::string bytes = tsv_fixture("good/labels.tsv");
  Take clip = tsv_markers("good/labels.tsv");
  clip.position(1, 1).y = 165;
  std::string expected = bytes;
  const std::size_t at = expected.find("164.822");
  expected.replace(at, 7, "165.000");
  EXPECT_EQ(write_take(clip, "tsv"), expected);
}

// Once a cell is empty, zeros no longer mean that a sample is missing.
TEST(TsvWriter, MissingSamplesStayMissingBesideNewOnes) {
  Take clip = tsv_markers("good/zeros.tsv");
  clip.observed[0] = 0;
  const Take again = read_tsv(write_take(clip, "tsv")).take;
  EXPECT_EQ(again.observed, clip.observed);
}

TEST(TsvWriter, TakesOfOtherFormatsReadBack) {
  Take clip = make_marker_take({"Ann:LASI", "B"}, 3, 59.94);
  clip.unit = "mm";
  clip.first_frame = 7;
  clip.events = {{"Foot strike", "Left", 0.25}};
  for (std::size_t i = 0; i < 5; ++i) {
    clip.positions[i] = {0.5 * static_cast<double>(i), -1.25, 0.0625};
    clip.observed[i] = 1;
  }
  const TakeResult result = read_tsv(write_take(clip, "tsv"));
  EXPECT_TRUE(result.diagnostics.empty());
  const auto& again = result.take;
  EXPECT_EQ(again.names, clip.names);
  EXPECT_EQ(again.observed, clip.observed);
  EXPECT_EQ(again.positions, clip.positions);
  EXPECT_EQ(again.frame_rate_hz, clip.frame_rate_hz);
  EXPECT_EQ(again.first_frame, 7);
  ASSERT_EQ(again.events.size(), 1u);
  EXPECT_EQ(again.events[0].label, "Left Foot strike");
  EXPECT_TRUE(lost_in_writing(clip, "tsv").empty());
  clip.observed[5] = 1;
  EXPECT_EQ(
      lost_in_writing(clip, "tsv").entries()[0].message,
      "tsv files cannot hold measured samples at 0 0 0 (1), which it uses for missing markers");
  clip.unit = "m";
  EXPECT_EQ(message_of([&] { write_take(clip, "tsv"); }, ErrorKind::usage),
            "TSV files are in millimetres, the take is in \"m\"");
}

// Without number and time, a row whose only marker is missing would be a blank line.
TEST(TsvWriter, ARowWithoutAnySampleStaysAFrame) {
  const std::string text =
      "NO_OF_FRAMES\t3\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nMARKER_NAMES\tA\n"
      "1\t2\t3\n4\t5\t6\n7\t8\t9\n";
  auto clip = read_tsv(text).take;
  ASSERT_EQ(clip.frame_count(), 3u);
  clip.observed[1] = 0;
  const auto again = read_tsv(write_take(clip, "tsv")).take;
  EXPECT_THAT(again.observed, ElementsAre(1, 0, 1));
  EXPECT_EQ(again.position(2, 0), (Vec3{7, 8, 9}));
}

TEST(TsvWriter, NamesWithQuotesBlanksAndTabsReadBack) {
  Take clip = make_marker_take({"a\"b", "\"c\"", " d ", "\"e\tf\"g"}, 1, 100);
  clip.unit = "mm";
  for (std::size_t m = 0; m < 4; ++m) clip.positions[m] = {1, 2, static_cast<double>(m)};
  clip.observed.assign(4, 1);
  const std::string written = write_take(clip, "tsv");
  const TakeResult result = read_tsv(written);
  EXPECT_TRUE(result.diagnostics.empty());
  EXPECT_EQ(result.take.names, clip.names);
  EXPECT_EQ(result.take.positions, clip.positions);
  clip.names[0] = "a\nb";
  EXPECT_EQ(message_of([&] { write_take(clip, "tsv"); }, ErrorKind::usage),
            "TSV cannot hold the name \"a.b\"");
}

TEST(HostileTsv, EveryFixtureIsReadOrRefused) {
  ASSERT_FALSE(fixture_bytes("tsv").empty());
  for (const std::string& bytes : fixture_bytes("tsv")) expect_take_or_error(bytes, "tsv");
}

TEST(HostileTsv, CutAtAnyLength) { expect_sane_when_cut_at_any_length("tsv"); }

TEST(HostileTsv, PatchedAtAnyByte) {
  expect_sane_when_patched_at_any_byte("tsv", "\t\n\r 0.,-eXYZ\"N_");
}

TEST(HostileTsv, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("tsv"); }

TEST(HostileTsv, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  const std::string start = "NO_OF_FRAMES\t1\nFREQUENCY\t100\nMARKER_NAMES\tA\n";
  expect_quick_verdicts("tsv", {{"zero bytes", std::string(1 << 20, '\0')},
                                {"keys", repeated("NO_OF_FRAMES\t1\n", 100000)},
                                {"names", "MARKER_NAMES" + repeated("\tA", 1 << 19)},
                                {"zeros", start + repeated("0\t0\t0\n", 100000)},
                                {"tabs", start + std::string(1 << 20, '\t')},
                                {"many frames", "NO_OF_FRAMES\t1e14\n" + start + "1\t2\t3\n"}});
}

}  // namespace
}  // namespace kinemend
