// Tests of the TRC reader: its dialects, missing samples, rates and repairs.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "io/hostile.hpp"
#include "io/table/support.hpp"

namespace kinemend {
namespace {

using namespace test;
using testing::ElementsAre;

TakeResult read_trc_take(std::string bytes, ReadOptions options = {}) {
  options.format = "trc";
  return read_take(std::move(bytes), "take.trc", options);
}

std::string trc_error(std::string bytes, ErrorKind kind = ErrorKind::unreadable_input,
                      const ReadOptions& options = {}) {
  return message_of([&] { read_trc_take(std::move(bytes), options); }, kind);
}

// Counts the diagnostics by name.
std::map<std::string, std::size_t> trc_repairs_of(const std::string& name) {
  std::map<std::string, std::size_t> counts;
  const TakeResult result = read_trc_take(trc_fixture(name));
  for (const auto& entry : result.diagnostics.entries()) counts[entry.name] = entry.count;
  return counts;
}

std::string observed_text(const Take& clip) {
  std::string text;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t m = 0; m < clip.marker_count(); ++m)
      text += clip.is_observed(f, m) ? '1' : '0';
    text += f + 1 < clip.frame_count() ? " " : "";
  }
  return text;
}

void expect_like_plain(const std::string& name) {
  SCOPED_TRACE(name);
  const Take plain = read_trc(trc_fixture("good/plain.trc"));
  const Take clip = read_trc(trc_fixture(name));
  EXPECT_EQ(clip.names, plain.names);
  EXPECT_EQ(clip.positions, plain.positions);
  EXPECT_EQ(clip.observed, plain.observed);
  EXPECT_EQ(clip.frame_rate_hz, plain.frame_rate_hz);
  EXPECT_EQ(clip.first_frame, plain.first_frame);
}

TEST(TrcReader, ReadsNamesPositionsRateAndUnit) {
  const TakeResult result = read_trc_take(trc_fixture("good/plain.trc"));
  EXPECT_TRUE(result.diagnostics.empty());
  const auto& clip = result.take;
  EXPECT_THAT(clip.names, ElementsAre("LASI", "RASI"));
  EXPECT_THAT(
      clip.positions,
      ElementsAre(Vec3{-201.20056, -116.39728, 721.44098}, Vec3{129.43457, -188.17773, 724.28448},
                  Vec3{-200.70854, -116.63701, 721.52441}, Vec3{129.47598, -188.07799, 724.33362},
                  Vec3{-200.21008, -116.87550, 721.60700}, Vec3{129.51600, -187.97800, 724.38200}));
  EXPECT_EQ(observed_text(clip), "11 11 11");
  EXPECT_EQ(clip.frame_rate_hz, 100);
  EXPECT_EQ(clip.unit, "mm");
  EXPECT_EQ(clip.first_frame, 1);
  EXPECT_EQ(clip.source.format, "trc");
  EXPECT_EQ(clip.source.name, "take.trc");
}

TEST(TrcReader, LayoutsOfTheSameTakeReadTheSame) {
  for (const char* name : {"good/crlf.trc",
                           "good/cr.trc",
                           "good/no_last_line_end.trc",
                           "good/trailing_tabs.trc",
                           "good/no_blank_row.trc",
                           "good/no_axis_row.trc",
                           "good/spaces.trc",
                           "good/decimal_comma.trc",
                           "good/wrong_counts.trc",
                           "good/names_without_gaps.trc",
                           "good/names_thrice.trc",
                           "good/no_first_line.trc",
                           "good/no_rate.trc",
                           "good/no_unit.trc",
                           "good/exponents.trc",
                           "good/bom.trc",
                           "good/trailing_text.trc",
                           "good/no_time.trc",
                           "good/commas.trc",
                           "good/commas_filled.trc",
                           "good/commas_quoted_decimal.trc",
                           "good/semicolons_decimal.trc"}) {
    expect_like_plain(name);
  }
}

TEST(TrcReader, RepairsHaveNamesAndCounts) {
  using Counts = std::map<std::string, std::size_t>;
  const std::vector<std::pair<const char*, Counts>> expected{
      {"crlf.trc", {}},
      {"cr.trc", {}},
      {"bom.trc", {}},
      {"trailing_tabs.trc", {}},
      {"no_last_line_end.trc", {}},
      {"metres.trc", {}},
      {"gaps.trc", {}},
      {"commas.trc", {{"comma_separator", 1}}},
      {"commas_filled.trc", {{"comma_separator", 1}}},
      {"commas_quoted_decimal.trc", {{"comma_separator", 1}, {"decimal_comma", 1}}},
      {"semicolons_decimal.trc", {{"comma_separator", 1}, {"decimal_comma", 1}}},
      {"nan.trc", {{"value_not_finite", 4}, {"marker_incomplete", 1}}},
      {"zeros.trc", {{"zero_is_missing", 1}}},
      {"through_origin.trc", {}},
      {"no_blank_row.trc", {{"blank_row_missing", 1}}},
      {"no_axis_row.trc", {{"axis_row_missing", 1}, {"blank_row_missing", 1}}},
      {"spaces.trc", {{"space_separator", 1}}},
      {"decimal_comma.trc", {{"decimal_comma", 1}}},
      {"short_rows.trc", {{"row_too_short", 2}, {"marker_incomplete", 1}}},
      {"wrong_counts.trc", {{"frame_count_mismatch", 1}, {"marker_count_mismatch", 1}}},
      {"unnamed.trc", {{"row_too_short", 2}, {"marker_unnamed", 2}, {"marker_count_mismatch", 1}}},
      {"names_without_gaps.trc", {{"label_layout", 1}}},
      {"names_thrice.trc", {{"label_layout", 1}}},
      {"no_first_line.trc", {{"header_line_missing", 1}}},
      {"no_rate.trc", {{"frame_rate_assumed", 1}}},
      {"no_unit.trc", {{"unit_unknown", 1}}},
      {"uneven.trc", {{"frame_number_gap", 1}, {"time_uneven", 2}, {"time_mismatch", 1}}},
      {"trailing_text.trc", {{"trailing_text", 1}}},
      {"cut_row.trc", {{"file_cut", 1}}},
      {"later_start.trc", {}},
      {"quoted.trc", {}}};
  for (const auto& [name, counts] : expected) {
    EXPECT_EQ(trc_repairs_of(std::string("good/") + name), counts) << name;
  }
}

TEST(TrcReader, MissingSamplesAreMaskedWhicheverWayTheyAreWritten) {
  EXPECT_EQ(observed_text(read_trc(trc_fixture("good/gaps.trc"))), "01 10 00");
  EXPECT_EQ(observed_text(read_trc(trc_fixture("good/nan.trc"))), "11 00 11");
  EXPECT_EQ(observed_text(read_trc(trc_fixture("good/zeros.trc"))), "11 01 11");
  EXPECT_EQ(observed_text(read_trc(trc_fixture("good/short_rows.trc"))), "11 10 00");
  EXPECT_EQ(observed_text(read_trc(trc_fixture("good/cut_row.trc"))), "11 11 00");
  const Take clip = read_trc(trc_fixture("good/nan.trc"));
  EXPECT_EQ(clip.position(1, 0), Vec3{});
  EXPECT_EQ(clip.position(1, 1), Vec3{});
}

TEST(TrcReader, AMarkerThatPassesTheOriginIsNotMissing) {
  const Take clip = read_trc(trc_fixture("good/through_origin.trc"));
  EXPECT_EQ(observed_text(clip), "11 11 11");
  EXPECT_EQ(clip.position(1, 0), Vec3{});
}

TEST(TrcReader, MetresAreMetres) {
  const Take clip = read_trc(trc_fixture("good/metres.trc"));
  EXPECT_EQ(clip.unit, "m");
  EXPECT_EQ(clip.position(2, 1), (Vec3{0.1295, -0.1880, 0.7244}));
}

TEST(TrcReader, MarkersWithoutNamesAreCountedByTheWidestRow) {
  const Take clip = read_trc(trc_fixture("good/unnamed.trc"));
  EXPECT_THAT(clip.names, ElementsAre("*1", "*2"));
  EXPECT_EQ(observed_text(clip), "00 10 11");
  EXPECT_EQ(clip.position(2, 1), (Vec3{129.51600, -187.97800, 724.38200}));
}

TEST(TrcReader, FramesMayStartLater) {
  const Take clip = read_trc(trc_fixture("good/later_start.trc"));
  EXPECT_EQ(clip.first_frame, 103);
  EXPECT_EQ(clip.frame_rate_hz, 100);
}

TEST(TrcReader, QuotesAreNoPartOfNamesAndNumbers) {
  const Take clip = read_trc(trc_fixture("good/quoted.trc"));
  EXPECT_THAT(clip.names, ElementsAre("L ASI", "R ASI"));
  EXPECT_EQ(clip.position(0, 0).x, -201.20056);
}

TEST(TrcReader, TimesGiveTheRateWhereTheHeaderHasNone) {
  const std::string head =
      "PathFileType\t4\t(X/Y/Z)\ta\nUnits\tDataRate\nmm\t\nFrame#\tTime\ta\n\n";
  const auto rate_of_rows = [&](double step_s, int decimals, int frames) {
    std::string text = head;
    for (int f = 0; f < frames; ++f)
      text += fmt::format("{}\t{:.{}f}\t1\t2\t3\n", f + 1, f * step_s, decimals);
    return read_trc(text).frame_rate_hz;
  };
  EXPECT_EQ(rate_of_rows(1 / 120.0, 3, 2), 120);
  EXPECT_EQ(rate_of_rows(1 / 120.0, 3, 50), 120);
  EXPECT_EQ(rate_of_rows(1 / 400.0, 3, 882), 400);
  EXPECT_EQ(rate_of_rows(1 / 59.94, 6, 5000), 59.94);
  EXPECT_EQ(rate_of_rows(1 / 128.0, 7, 300), 128);
  EXPECT_NEAR(rate_of_rows(1 / 33.3, 9, 300), 33.3, 1e-6);
  ReadOptions options;
  options.frame_rate_hz = 250;
  options.format = "trc";
  const auto result = read_take(head + "1\t\t1\t2\t3\n2\t\t1\t2\t3\n", "a.trc", options);
  EXPECT_EQ(result.take.frame_rate_hz, 250);
  EXPECT_EQ(result.diagnostics.count("frame_rate_assumed"), 1);
}

TEST(TrcReader, FaultsNameTheLine) {
  const std::pair<const char*, const char*> expected[] = {
      {"bad/empty.trc", "take.trc:1: the file is empty"},
      {"bad/blank.trc", "take.trc:1: the file is empty"},
      {"bad/header_only.trc",
       "take.trc:2: expected the row of labels (Frame#, Time, names of markers), found the end of "
       "the file"},
      {"bad/no_rows.trc", "take.trc:7: expected a row for each frame, found none"},
      {"bad/no_labels.trc",
       "take.trc:4: expected Frame#, Time and names of markers, found "
       "\"1.0.000.-201.20056.-116.39728"
       ".721.44098....\""},
      {"bad/text_in_row.trc", "take.trc:8: expected a number, found \"7x1.52441\""},
      {"bad/commas_of_two_kinds.trc",
       "take.trc:7: decimal commas and commas between cells cannot be told apart"},
      {"bad/no_markers.trc", "take.trc:4: the file has no markers"},
      {"bad/other_text.trc", "take.trc:1: expected PathFileType, found \"time,force\""}};
  for (const auto& [name, message] : expected) EXPECT_EQ(trc_error(trc_fixture(name)), message);
}

TEST(TrcReader, StrictRefusesRepairs) {
  ReadOptions strict;
  strict.strict = true;
  EXPECT_EQ(trc_error(trc_fixture("good/zeros.trc"), ErrorKind::quality_limit, strict),
            "take.trc:8: a marker is at 0 0 0 but was not near before or after: it is missing");
  EXPECT_EQ(trc_error(trc_fixture("good/plain.trc"), ErrorKind::quality_limit, strict), "no error");
}

TEST(TrcReader, IsFoundByItsFirstWord) {
  const Take take = read_take(trc_fixture("good/bom.trc"), "no extension", {}).take;
  EXPECT_EQ(take.source.format, "trc");
}

}  // namespace
}  // namespace kinemend
