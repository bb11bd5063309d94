// Tests of CSV tables of markers and joints, from this project and from other programs.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "io/hostile.hpp"
#include "io/table/support.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;
using testing::ElementsAre;

std::string csv_fixture(const std::string& name) {
  return read_file(std::filesystem::path(KINEMEND_TEST_FIXTURES) / "csv" / name);
}

TakeResult read_table(std::string bytes, ReadOptions options = {}) {
  options.format = "csv";
  return read_take(std::move(bytes), "take.csv", options);
}
Take read_markers(std::string bytes) { return read_table(std::move(bytes)).take; }
Take joints_of(std::string bytes) { return read_table(std::move(bytes)).take; }

std::map<std::string, std::size_t> repairs_of(const std::string& name) {
  std::map<std::string, std::size_t> counts;
  const TakeResult result = read_table(csv_fixture(name));
  for (const auto& entry : result.diagnostics.entries()) counts[entry.name] = entry.count;
  return counts;
}

TEST(CsvReader, ReadsNamesPositionsRateAndUnit) {
  const TakeResult result = read_table(csv_fixture("good/plain.csv"));
  EXPECT_TRUE(result.diagnostics.empty());
  const auto& clip = result.take;
  EXPECT_THAT(clip.names, ElementsAre("LASI", "RASI"));
  EXPECT_THAT(clip.positions,
              ElementsAre(Vec3{-201.25, -116.5, 721.75}, Vec3{129.5, -188.25, 724.125},
                          Vec3{-200.75, -116.75, 721.5}, Vec3{129.25, -188, 724.25},
                          Vec3{-200.5, -117, 721.25}, Vec3{129, -187.75, 724.375}));
  EXPECT_THAT(clip.observed, ElementsAre(1, 1, 1, 1, 1, 1));
  EXPECT_EQ(clip.frame_rate_hz, 100);
  EXPECT_EQ(clip.unit, "mm");
  EXPECT_EQ(clip.first_frame, 1);
}

TEST(CsvReader, LayoutsOfTheSameTakeReadTheSame) {
  const Take plain = read_markers(csv_fixture("good/plain.csv"));
  for (const char* name :
       {"crlf", "bom", "semicolon_comma", "semicolon", "tabs", "quoted_comma", "dotted", "spaced",
        "colons", "no_frame", "no_frame_no_time", "no_rate", "milliseconds", "extra_column",
        "filler_rows", "spreadsheet_separator"}) {
    SCOPED_TRACE(name);
    const Take clip = read_markers(csv_fixture(std::string("good/") + name + ".csv"));
    EXPECT_EQ(clip.names, plain.names);
    EXPECT_EQ(clip.positions, plain.positions);
    EXPECT_EQ(clip.observed, plain.observed);
    EXPECT_EQ(clip.frame_rate_hz, plain.frame_rate_hz);
    EXPECT_EQ(clip.unit, "mm");
  }
}

TEST(CsvReader, RepairsHaveNamesAndCounts) {
  using Counts = std::map<std::string, std::size_t>;
  const std::vector<std::pair<const char*, Counts>> expected{
      {"crlf", {}},
      {"semicolon", {}},
      {"tabs", {}},
      {"dotted", {}},
      {"quoted_names", {}},
      {"no_frame", {}},
      {"no_frame_no_time", {}},
      {"no_rate", {}},
      {"milliseconds", {}},
      {"filler_rows", {}},
      {"vicon", {}},
      {"joints", {{"rotation_missing", 1}}},
      {"semicolon_comma", {{"decimal_comma", 1}}},
      {"quoted_comma", {{"decimal_comma", 1}}},
      {"gaps", {{"value_not_finite", 4}, {"marker_incomplete", 1}, {"row_too_short", 1}}},
      {"zeros", {{"zero_is_missing", 1}}},
      {"nothing_but_markers", {{"frame_rate_assumed", 1}}},
      {"uneven", {{"frame_number_gap", 1}, {"time_uneven", 2}, {"time_mismatch", 1}}},
      {"extra_column", {{"column_ignored", 1}}},
      {"optitrack", {{"column_ignored", 7}}},
      {"joints_without_skeleton",
       {{"skeleton_missing", 1},
        {"rotation_missing", 1},
        {"position_missing", 1},
        {"rotation_not_unit", 1}}}};
  for (const auto& [name, counts] : expected)
    EXPECT_EQ(repairs_of(std::string("good/") + name + ".csv"), counts) << name;
}

TEST(CsvReader, MissingSamplesAreMasked) {
  EXPECT_THAT(read_markers(csv_fixture("good/gaps.csv")).observed, ElementsAre(0, 1, 0, 0, 1, 0));
  EXPECT_THAT(read_markers(csv_fixture("good/zeros.csv")).observed, ElementsAre(1, 1, 1, 0, 1, 1));
}

TEST(CsvReader, QuotedNamesMayHoldCommasAndQuotes) {
  EXPECT_THAT(read_markers(csv_fixture("good/quoted_names.csv")).names,
              ElementsAre("LASI, left", "R \"A\""));
}

TEST(CsvReader, ViconExportsAreRead) {
  const Take clip = read_markers(csv_fixture("good/vicon.csv"));
  EXPECT_THAT(clip.names, ElementsAre("Ann:LASI", "Ann:RASI"));
  EXPECT_EQ(clip.frame_rate_hz, 100);
  EXPECT_EQ(clip.unit, "mm");
  EXPECT_THAT(clip.observed, ElementsAre(1, 1, 1, 0));
  EXPECT_EQ(clip.position(0, 1), (Vec3{129.5, -188.25, 724.125}));
}

TEST(CsvReader, MarkersOfOptiTrackExportsAreRead) {
  const Take clip = read_markers(csv_fixture("good/optitrack.csv"));
  EXPECT_THAT(clip.names, ElementsAre("Ann:LASI"));
  EXPECT_EQ(clip.frame_rate_hz, 120);
  EXPECT_EQ(metres_per_unit(clip.unit), 1);
  EXPECT_EQ(clip.first_frame, 0);
  EXPECT_THAT(clip.observed, ElementsAre(1, 0, 1));
  EXPECT_EQ(clip.position(2, 0), (Vec3{-0.2005, 0.7215, 0.117}));
}

// Each program's exports are read with the right markers, rate, unit and frames, whatever else they
// hold.
TEST(CsvReader, LaboratoriesTablesAreReadRight) {
  struct Table {
    const char* name;
    std::vector<std::string> markers;
    double rate_hz;
    const char* unit;
    std::int64_t first_frame;
    std::vector<std::uint8_t> observed;
    Vec3 last;  // last observed sample
  };
  const std::vector<Table> tables{
      {"nexus",
       {"Ann:LASI", "Ann:RASI"},
       100,
       "mm",
       1,
       {1, 1, 1, 0, 1, 1},
       {129, -187.75, 724.375}},
      {"vicon_old",
       {"LFHD", "RFHD", "*3"},
       240,
       "mm",
       1,
       {1, 1, 1, 1, 0, 1, 1, 1, 0},
       {-1022.25, -47.17, 1519.66}},
      {"nexus_semicolons", {"Ann:LASI"}, 50, "mm", 7, {1, 1}, {-200.75, -116.75, 721.5}},
      {"nexus_tabs", {"Ann:LASI"}, 100, "m", 1, {1, 1}, {-0.25, -0.5, 0.75}},
      {"motive_125",
       {"Ann:LASI", "Unlabeled 1189"},
       120,
       "Millimeters",
       0,
       {1, 0, 0, 1, 1, 1, 1, 1},
       {1, 2, 3.5}},
      {"motive_unlabelled_rows", {"Shank:Marker1"}, 100, "Meters", 0, {1, 1}, {0.25, 0.5, 0.875}},
      {"motive_bare", {"M1"}, 100, "", 0, {1, 1}, {0.25, 0.5, 0.875}},
      {"head_unknown", {"LASI"}, 120, "", 1, {1, 1}, {-200.75, -116.75, 721.5}}};
  for (const Table& table : tables) {
    SCOPED_TRACE(table.name);
    const std::string bytes = csv_fixture(std::string("good/") + table.name + ".csv");
    // The format is recognised by its content, under any name.
    const Take take = read_take(bytes, "take.txt").take;
    const auto& clip = take;
    EXPECT_EQ(clip.names, table.markers);
    EXPECT_EQ(clip.frame_rate_hz, table.rate_hz);
    EXPECT_EQ(clip.unit, table.unit);
    EXPECT_EQ(clip.first_frame, table.first_frame);
    ASSERT_EQ(clip.observed, table.observed);
    std::size_t last = clip.observed.size() - 1;
    while (clip.observed[last] == 0) --last;
    EXPECT_EQ(clip.positions[last], table.last);
  }
}

TEST(CsvReader, WhatIsTakenForGrantedOfATableIsSaid) {
  using Counts = std::map<std::string, std::size_t>;
  EXPECT_EQ(repairs_of("good/nexus.csv"), Counts{});
  EXPECT_EQ(repairs_of("good/vicon_old.csv"), (Counts{{"marker_unnamed", 1}, {"unit_assumed", 1}}));
  EXPECT_EQ(repairs_of("good/nexus_semicolons.csv"), (Counts{{"decimal_comma", 1}}));
  EXPECT_EQ(repairs_of("good/motive_125.csv"), (Counts{{"column_ignored", 15}}));
  EXPECT_EQ(repairs_of("good/head_unknown.csv"),
            (Counts{{"head_unknown", 3}, {"frame_rate_assumed", 1}, {"unit_unknown", 1}}));
}

// Forty rows of a marker that moves, with what is before and behind its coordinates.
std::string rows_of(const std::string& labels, double first, double step,
                    const std::string& behind = "") {
  std::string text = labels + "\n";
  for (int f = 0; f < 40; ++f)
    text += fmt::format("{:.10g},{:.4f},1,2{}\n", first + step * f, 0.1 * f, behind);
  return text;
}

TEST(CsvReader, WholeTimesWithoutAUnitAreMilliOrMicroOrNanoseconds) {
  struct Case {
    std::string label;
    double first, step, rate_hz;
    bool is_noted;
  };
  for (const Case& one :
       {Case{"timestamp", 1735689600000, 20, 50, true}, Case{"time", 0, 20, 50, true},
        Case{"time", 0, 10000, 100, true}, Case{"t", 0, 10000000, 100, true},
        Case{"time_us", 0, 20000, 50, false}, Case{"time (ms)", 0, 20, 50, false},
        Case{"timestamp_ns", 0, 20000000, 50, false}, Case{"time", 0, 0.02, 50, false}}) {
    SCOPED_TRACE(one.label);
    const TakeResult read = read_table(rows_of(one.label + ",a_x,a_y,a_z", one.first, one.step));
    EXPECT_NEAR(read.take.frame_rate_hz, one.rate_hz, 1e-6);
    EXPECT_EQ(read.diagnostics.count("time_unit"), one.is_noted ? 1u : 0u);
  }
  // Seconds that are named stay seconds: no capture, but what the file says.
  EXPECT_GT(
      read_table(rows_of("time_s,a_x,a_y,a_z", 0, 20)).diagnostics.count("frame_rate_unusable"),
      0u);
}

TEST(CsvReader, ColumnsBehindTheLastCoordinateAreIgnoredAndStay) {
  const std::string bytes = rows_of("time_s,a_x,a_y,a_z,a_visibility,note", 0, 0.01, ",0.9,ok");
  TakeResult read = read_table(bytes);
  EXPECT_EQ(read.take.names, std::vector<std::string>{"a"});
  EXPECT_EQ(read.diagnostics.count("column_ignored"), 2u);
  EXPECT_EQ(write_take(read.take), bytes);
  read.take.positions[3].x += 1;
  std::string expected = bytes;
  expected.replace(expected.find("0.3000,1,2,0.9"), 6, "1.3000");
  EXPECT_EQ(write_take(read.take), expected);
  // Rows may end before columns that are ignored.
  EXPECT_EQ(
      read_table(rows_of("time_s,a_x,a_y,a_z,note", 0, 0.01)).diagnostics.count("row_too_short"),
      0u);
}

TEST(CsvReader, ATableWithARowForEachThingIsRefusedByWhatItIs) {
  EXPECT_EQ(
      message_of(
          [] {
            read_table(
                "joint,parent,offset.x,offset.y,offset.z\nHips,,0,90,0\nSpine,Hips,0,12,0\n"
                "Head,Spine,0,45,0\n");
          },
          ErrorKind::unreadable_input),
      "take.csv:1: a table with a row for each \"joint\", not for each frame: it has no column of "
      "frames or times");
  // Words beside frames are notes.
  EXPECT_EQ(read_table("frame,what,a_x,a_y,a_z\n1,step,0,1,2\n2,step,1,1,2\n").take.frame_count(),
            2u);
}

TEST(CsvReader, AViconExportMayHaveLinesAboveItsFirstSection) {
  const TakeResult read = read_table(
      "Title\nDate:\nNotes:,\"\"\n\nTRAJECTORIES\n100,Hz\n,LASI,,\nField #,X,Y,Z\n1,0,30,900\n"
      "2,1,30,900\n3,2,30,900\n");
  EXPECT_EQ(read.take.frame_rate_hz, 100);
  EXPECT_EQ(read.take.unit, "mm");
  EXPECT_EQ(read.take.names, std::vector<std::string>{"LASI"});
}

TEST(CsvReader, TheRateMayBeGiven) {
  ReadOptions options;
  options.frame_rate_hz = 250;
  const TakeResult result = read_table(csv_fixture("good/nothing_but_markers.csv"), options);
  EXPECT_EQ(result.take.frame_rate_hz, 250);
  EXPECT_TRUE(result.diagnostics.empty());
}

TEST(CsvReader, JointsHaveTheSkeletonOfTheLinesAbove) {
  const Take clip = joints_of(csv_fixture("good/joints.csv"));
  const Skeleton& skeleton = clip.skeleton;
  EXPECT_THAT(skeleton.names, ElementsAre("root", "Left; \"Hip\"", "Slider"));
  EXPECT_THAT(skeleton.parents, ElementsAre(-1, 0, 1));
  EXPECT_EQ(skeleton.offsets[1], (Vec3{8, -4, 0}));
  EXPECT_EQ(skeleton.rest_rotations[1], (Quat{0.8, 0.6, 0, 0}));
  EXPECT_EQ(to_string(skeleton.rotation_order(0)), "ZYX");
  EXPECT_THAT(skeleton.channels[2], ElementsAre(Channel::x_position, Channel::y_position,
                                                Channel::z_position, Channel::x_rotation));
  ASSERT_EQ(skeleton.end_sites.size(), 1u);
  EXPECT_EQ(skeleton.end_sites[0].offset, (Vec3{0, -10, 2.5}));
  ASSERT_EQ(skeleton.limits.size(), 3u);
  EXPECT_EQ(skeleton.limits[1][0].maximum, 90);
  EXPECT_TRUE(std::isinf(skeleton.limits[1][1].minimum));
  EXPECT_EQ(clip.metres_per_unit, 0.01);
  EXPECT_EQ(clip.frame_rate_hz, 120);
  EXPECT_THAT(clip.translated_joints, ElementsAre(2));
  EXPECT_EQ(clip.position(1, 1), (Vec3{0, -40.5, 0}));
  EXPECT_EQ(clip.root_position(2), (Vec3{0.5, 91, 1}));
  EXPECT_EQ(clip.rotation(1, 0), (Quat{0.6, 0, 0.8, 0}));
  EXPECT_EQ(clip.rotation(2, 1), (Quat{0.8, 0, 0, 0.6})) << "held";
  EXPECT_FALSE(clip.is_observed(2, 1));
}

TEST(CsvReader, JointsWithoutSkeletonHangOnTheFirst) {
  const Take clip = joints_of(csv_fixture("good/joints_without_skeleton.csv"));
  EXPECT_THAT(clip.skeleton.names, ElementsAre("Hips", "Knee"));
  EXPECT_THAT(clip.skeleton.parents, ElementsAre(-1, 0));
  EXPECT_EQ(clip.rotation(1, 1), Quat{}) << "w stands last, and is not 1";
  EXPECT_EQ(clip.root_position(2), (Vec3{0, 1, 0}));
  EXPECT_NEAR(norm(clip.rotation(1, 0)), 1, 1e-15);
}

TEST(CsvReader, FaultsNameTheLine) {
  const std::pair<const char*, const char*> expected[] = {
      {"empty", "take.csv:1: the file is empty"},
      {"other_table",
       "take.csv:1: expected a row of labels such as frame,time_s,LASI_x,LASI_y,LASI_z, found "
       "none"},
      {"text_in_row", "take.csv:5: expected a number, found \"7x\""},
      {"no_rows", "take.csv:4: expected a row for each frame, found none"},
      {"wide_row", "take.csv:5: expected 8 cells as in the row of labels, found more"},
      {"other_joint", "take.csv:7: expected the rotation of joint \"Slider\", found \"Other\""},
      {"joint_count", "take.csv:5: expected rotations of the 2 joints stated above, found 3"},
      {"parent_below", "take.csv:4: expected the number of a joint above as parent, found \"2\""},
      {"channel", "take.csv:5: expected a channel such as Xrotation, found \"Qposition\""},
      {"offset", "take.csv:4: expected 3 numbers behind \"offset\""},
      {"nexus_without_trajectories",
       "take.csv:2: a Vicon export of \"Devices, Model Outputs\", without Trajectories: no markers "
       "to clean"},
      {"nexus_rows_behind", "take.csv:8: expected another section after the blank line"},
      {"nexus_two_units",
       "take.csv:5: expected one unit for all trajectories, found \"mm\" and \"m\""},
      {"motive_rigid_bodies",
       "take.csv:1: a Motive export of \"Rigid Body, Rigid Body Marker\", without measured "
       "markers: "
       "no markers to clean"}};
  for (const auto& [name, message] : expected) {
    const std::string table = csv_fixture(std::string("bad/") + name + ".csv");
    EXPECT_EQ(message_of([&] { read_table(table); }, ErrorKind::unreadable_input), message);
  }
}

TEST(CsvReader, OtherTextIsNotTakenForATable) {
  const auto claims = [](const std::string& text) {
    for (const Format& format : formats()) {
      if (format.name == "csv") return format.sniff(text) > 0;
    }
    return false;
  };
  EXPECT_TRUE(claims(csv_fixture("good/plain.csv")));
  EXPECT_TRUE(claims(csv_fixture("good/joints.csv")));
  EXPECT_TRUE(claims(csv_fixture("good/vicon.csv")));
  EXPECT_TRUE(claims(csv_fixture("good/optitrack.csv")));
  EXPECT_FALSE(claims(csv_fixture("bad/other_table.csv")));
  EXPECT_FALSE(claims("joint,first,last\nHips,3,9\n"));
  EXPECT_FALSE(claims("# notes\nA sentence, with commas, and x, y, z.\n"));
  EXPECT_FALSE(claims("{\"a_x\": 1, \"a_y\": 2}"));
  for (const char* format : {"bvh", "trc"}) {
    for (const auto& path : fixture_paths(format)) EXPECT_FALSE(claims(read_file(path))) << path;
  }
}

TEST(CsvWriter, EveryFixtureComesBackToTheByte) {
  for (const auto& path : fixture_paths("csv")) {
    if (path.parent_path().filename() != "good") continue;
    const std::string bytes = read_file(path);
    const TakeResult read = read_table(bytes);
    const std::string written = write_take(read.take, "csv");
    EXPECT_TRUE(was_mended(read.diagnostics) || written == bytes) << path;
    EXPECT_EQ(write_take(read_table(written).take, "csv"), written) << path;
  }
}

TEST(CsvWriter, QuotesAroundNothingAreAnEmptyCellThatComesBack) {
  for (const char* name : {"good/joints.csv", "good/plain.csv"}) {
    const std::string bytes = csv_fixture(name);
    const std::size_t row = bytes.rfind('\n', bytes.size() - 2) + 1;
    const auto cells =
        std::count(bytes.begin() + static_cast<std::ptrdiff_t>(row), bytes.end(), ',');
    std::size_t begin = bytes.find(',', bytes.find(',', row) + 1) + 1;  // after frame and time
    for (std::ptrdiff_t cell = 2; cell <= cells; ++cell) {
      SCOPED_TRACE(fmt::format("{}, cell {}", name, cell));
      const std::size_t end = std::min(bytes.find(',', begin), bytes.find_first_of("\r\n", begin));
      for (const char* nothing : {"\"\"", "\" \t\"", "\"\f\""}) {
        std::string quoted = bytes;
        quoted.replace(begin, end - begin, nothing);
        const TakeResult result = read_table(quoted);
        EXPECT_EQ(result.diagnostics.count("value_not_finite"), 0u);
        EXPECT_EQ(write_take(result.take), quoted);
      }
      begin = end + 1;
    }
  }
}

TEST(CsvWriter, OnlyChangedSamplesGetNewDigits) {
  const std::string bytes = csv_fixture("good/gaps.csv");
  Take clip = read_markers(bytes);
  clip.position(0, 1) = {129.5, -188.3759, 724.125};
  clip.position(0, 0) = {1, 2, 3};
  clip.observed[0] = 1;
  EXPECT_EQ(write_take(clip, "csv"), with(with(bytes, "1,0.00,,,,129.5,-188.25,",
                                               "1,0.00,1.000,2.000,3.000,129.5,-188.376,"),
                                          "-200.75,NaN,721.5,nan,nan,nan", ",,,,,"));
  const std::string quoted = csv_fixture("good/quoted_comma.csv");
  clip = read_markers(quoted);
  clip.position(0, 0).x = 5;
  clip.observed[1] = 0;
  EXPECT_EQ(write_take(clip, "csv"), with(with(quoted, "\"-201,25\"", "\"5,000\""),
                                          "\"129,5\",\"-188,25\",\"724,125\"", ",,"));
}

TEST(CsvWriter, OnlyChangedJointsGetNewDigits) {
  const std::string bytes = csv_fixture("good/joints.csv");
  Take clip = joints_of(bytes);
  clip.rotation(0, 1) = {0.8, 0, 0.6, 0};
  clip.root_position(1).x = 0.125;
  clip.position(2, 1).y = -42;
  std::string expected =
      with(with(bytes, "0.6,0.8,0,0,1,", "0.8,0,0.6,0,1,"), ",0.25,91", ",0.125,91");
  expected = with(expected, "0,-41,0", "0,-42,0");
  EXPECT_EQ(write_take(clip, "csv"), expected);
  clip.rotation(2, 1) = {0.6, 0, 0, 0.8};
  clip.observed[2 * 3 + 1] = 1;
  EXPECT_EQ(write_take(clip, "csv"), with(expected, "0.8,0,,,,,", "0.8,0,0.6,0,0,0.8,"));
}

// Only the trajectories of an export change; the text above and below them is kept.
TEST(CsvWriter, SectionsAndColumnsOfOtherThingsStay) {
  const std::string nexus = csv_fixture("good/nexus.csv");
  Take clip = read_markers(nexus);
  clip.position(2, 1) = {129, -187.5, 724.375};
  EXPECT_EQ(write_take(clip, "csv"), with(nexus, "-187.75", "-187.500"));
  EXPECT_TRUE(lost_in_writing(clip, "csv").empty());
  const std::string motive = csv_fixture("good/motive_125.csv");
  clip = read_markers(motive);
  clip.observed[2] = 1;
  clip.position(1, 0) = {1, 2, 3};
  EXPECT_EQ(write_take(clip, "csv"), with(motive, "1.0,,,,1,2,3", "1.0,1.00,2.00,3.00,1,2,3"));
}

TEST(CsvWriter, WhatATableLosesInANewLayoutIsNamed) {
  const auto lost = [](const Take& clip, const char* format) {
    const Diagnostics losses = lost_in_writing(clip, format);
    return losses.empty() ? "" : losses.entries()[0].message;
  };
  const Take nexus = read_markers(csv_fixture("good/nexus.csv"));
  const std::string sections = "the sections Devices, Model Outputs, Events are left out";
  EXPECT_EQ(lost(nexus, "c3d"), sections);
  EXPECT_EQ(lost(scale_lengths(nexus, 0.001, "m"), "csv"), sections);
  EXPECT_EQ(lost(read_markers(csv_fixture("good/motive_125.csv")), "trc"),
            "the columns of Bone, Bone Marker, Rigid Body Marker are left out");
  EXPECT_EQ(lost(read_markers(csv_fixture("good/plain.csv")), "trc"), "");
}

TEST(CsvWriter, BvhComesBackFromCsvToTheDigit) {
  std::size_t compared = 0;
  for (const auto& path : fixtures_in("good")) {
    SCOPED_TRACE(path.filename());
    Take clip = read_joints(path).take;
    if (clip.joint_count() == 0 || clip.frame_count() == 0 || !clip.observed.empty()) continue;
    clip.source = {};
    const TakeResult result = read_table(write_take(clip, "csv"));
    Take again = result.take;
    EXPECT_EQ(again.rotations, clip.rotations);
    EXPECT_EQ(again.positions, clip.positions);
    EXPECT_EQ(again.frame_rate_hz, clip.frame_rate_hz);
    again.source = {};
    EXPECT_EQ(write_take(again, "bvh"), write_take(clip, "bvh"));
    ++compared;
  }
  EXPECT_GT(compared, 5u);
}

TEST(CsvWriter, MarkersMadeInMemoryReadBackExactly) {
  Take clip = make_marker_take({"A", "B, b", "Ann:C"}, 40, 30000 / 1001.0);
  clip.unit = "m";
  clip.first_frame = 7;
  Random random(3);
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (random.chance(0.2)) continue;
    clip.observed[i] = 1;
    clip.positions[i] = {random.normal(), 1e-3 * random.normal(), -5};
  }
  const TakeResult result = read_take(write_take(clip, "csv"), "no extension", {});
  EXPECT_TRUE(result.diagnostics.empty());
  const auto& again = result.take;
  EXPECT_EQ(again.names, clip.names);
  EXPECT_EQ(again.positions, clip.positions);
  EXPECT_EQ(again.observed, clip.observed);
  EXPECT_EQ(again.unit, "m");
  EXPECT_EQ(again.first_frame, 7);
  EXPECT_EQ(again.frame_rate_hz, clip.frame_rate_hz);
}

TEST(CsvWriter, RefusesWhatTheFormatCannotHold) {
  const auto error = [](const Take& clip) {
    return message_of([&] { write_take(clip, "csv"); }, ErrorKind::usage);
  };
  EXPECT_EQ(error(make_marker_take({"a\nb"}, 1, 100)), "CSV cannot hold the name \"a.b\"");
  EXPECT_EQ(error(make_marker_take({}, 0, 100)), "CSV cannot hold a clip without markers");
}

}  // namespace
}  // namespace kinemend
