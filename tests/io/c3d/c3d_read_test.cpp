// Tests of the C3D reader on fixtures of every encoding, with their faults.
#include <cmath>
#include <map>

#include "c3d_support.hpp"
#include "io/c3d/c3d_source.hpp"

namespace kinemend {
namespace {

using namespace test;

// A line of tests/fixtures/c3d/expected, which the script for the fixtures writes.
using Row = std::vector<std::string>;

std::vector<Row> expected_rows(const std::string& name) {
  std::ifstream file(c3d_folder() / "expected" / (name + ".csv"));
  EXPECT_TRUE(file) << name;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

// Cell `i`; empty if the row is shorter.
std::string cell(const Row& row, std::size_t i) { return i < row.size() ? row[i] : ""; }

void expect_sample(const Take& clip, const Row& row) {
  const std::size_t i = std::stoul(row[1]) * clip.marker_count() + std::stoul(row[2]);
  ASSERT_LT(i, clip.observed.size());
  EXPECT_EQ(clip.observed[i], std::stoi(row[3]));
  EXPECT_EQ(clip.residuals[i], std::stof(row[7]));
  if (clip.observed[i] == 0) return;
  EXPECT_EQ(clip.positions[i].x, std::stod(row[4]));
  EXPECT_EQ(clip.positions[i].y, std::stod(row[5]));
  EXPECT_EQ(clip.positions[i].z, std::stod(row[6]));
}

void expect_fixture(const std::string& name) {
  const C3dResult result = read_c3d_bytes(good_c3d(name));
  const Take& clip = result.clip;
  clip.validate();
  const C3dAnalog analog = analog_of(clip);
  std::vector<std::string> names;
  std::vector<std::uint8_t> kinds;
  std::vector<MarkerEvent> events;
  std::map<std::string, std::size_t> repairs;
  std::size_t samples = 0, analog_values = 0;
  for (const Row& row : expected_rows(name)) {
    if (row[0] == "rate") {
      EXPECT_EQ(clip.frame_rate_hz, std::stod(row[1]));
    }
    if (row[0] == "first_frame") {
      EXPECT_EQ(clip.first_frame, std::stoll(row[1]));
    }
    if (row[0] == "unit") {
      EXPECT_EQ(clip.unit, cell(row, 1));
    }
    if (row[0] == "frames") {
      EXPECT_EQ(clip.frame_count(), std::stoul(row[1]));
    }
    if (row[0] == "name") names.push_back(cell(row, 1));
    if (row[0] == "kind") kinds.push_back(row[1] == "1" ? 1 : 0);
    if (row[0] == "event") events.push_back({row[1], row[2], std::stod(row[3])});
    if (row[0] == "diagnostic") repairs[row[1]] = std::stoul(row[2]);
    if (row[0] == "sample") {
      ++samples;
      ASSERT_NO_FATAL_FAILURE(expect_sample(clip, row)) << row[1] << " " << row[2];
    }
    if (row[0] == "analog") {
      ++analog_values;
      const std::size_t i = std::stoul(row[1]) * analog.names.size() + std::stoul(row[2]);
      ASSERT_LT(i, analog.values.size());
      EXPECT_EQ(analog.values[i], std::stod(row[3]));
    }
  }
  EXPECT_EQ(clip.names, names);
  EXPECT_EQ(clip.is_position, kinds);
  EXPECT_EQ(clip.observed.size(), samples);
  EXPECT_EQ(analog.values.size(), analog_values);
  ASSERT_EQ(clip.events.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(clip.events[i].label, events[i].label);
    EXPECT_EQ(clip.events[i].context, events[i].context);
    EXPECT_EQ(clip.events[i].time_s, events[i].time_s);
  }
  std::map<std::string, std::size_t> found;
  for (const Diagnostic& entry : result.diagnostics.entries()) found[entry.name] = entry.count;
  EXPECT_EQ(found, repairs);
}

TEST(C3dReader, FindsWhatTheFixturesScriptPutIn) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(c3d_folder() / "good")) {
    SCOPED_TRACE(entry.path());
    expect_fixture(entry.path().stem());
    ++count;
  }
  EXPECT_GE(count, 40u);
}

TEST(C3dReader, EveryRepairIsAnErrorUnderStrict) {
  ReadOptions strict;
  strict.strict = true;
  for (const auto& entry : std::filesystem::directory_iterator(c3d_folder() / "good")) {
    SCOPED_TRACE(entry.path());
    const std::string bytes = read_file(entry.path());
    const bool repaired = !read_c3d_bytes(bytes).diagnostics.empty();
    try {
      read_c3d_bytes(bytes, strict);
      EXPECT_FALSE(repaired);
    } catch (const Error& error) {
      EXPECT_TRUE(repaired);
      EXPECT_EQ(error.kind(), ErrorKind::quality_limit);
      EXPECT_EQ(std::string(error.what()).substr(0, 15), "take.c3d: byte ") << error.what();
    }
  }
}

TEST(C3dReader, SaysWhichByteIsWrong) {
  const std::map<std::string, std::string> messages{
      {"empty", "byte 0: the file is empty"},
      {"zeros", "byte 600: expected a C3D header of 512 bytes, found the end of the file"},
      {"short_header", "byte 300: expected a C3D header of 512 bytes, found the end of the file"},
      {"no_key", "byte 1: expected 80, the mark of a C3D file, found 81"},
      {"no_parameters", "byte 0: block 2 does not hold parameters"},
      {"parameters_elsewhere", "byte 0: block 9 does not hold parameters"},
      {"no_processor_no_rate",
       "byte 515: expected processor type 84 (Intel), 85 (DEC) or 86 (MIPS), found 7"},
      {"data_beyond_the_end",
       "byte 16: the data would start in block 4000, which is not in the file"},
  };
  std::size_t count = 0;
  ReadOptions options;
  options.format = "c3d";
  for (const auto& entry : std::filesystem::directory_iterator(c3d_folder() / "bad")) {
    SCOPED_TRACE(entry.path());
    const auto expected = messages.find(entry.path().stem());
    ASSERT_NE(expected, messages.end());
    try {
      read_c3d_bytes(read_file(entry.path()), options);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), "take.c3d: " + expected->second);
      EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    }
    ++count;
  }
  EXPECT_EQ(count, messages.size());
}

TEST(C3dReader, TellsWhatElseAFileHolds) {
  const Take clip = read_good_c3d("dec_integer");
  EXPECT_EQ(fact_of(clip, "encoding"), "DEC integers in steps of 0.125");
  EXPECT_EQ(fact_of(clip, "analog"), "2 channels at 100 Hz");
  EXPECT_EQ(fact_of(clip, "events"), "2");
  EXPECT_EQ(fact_of(clip, "force plates"), "1 (type 2)");
  // 0x0A and 0x7F set all seven bits; the sentinel of a missing point adds none.
  EXPECT_EQ(fact_of(clip, "cameras"), "7 saw a marker");
  EXPECT_EQ(fact_of(clip, "subjects"), "Ann");
  EXPECT_EQ(fact_of(clip, "software"), "make_fixtures");
  EXPECT_EQ(fact_of(read_good_c3d("mips_real"), "encoding"), "MIPS reals");
  EXPECT_EQ(fact_of(read_good_c3d("rotation_section"), "rotations"), "2 segments");
  EXPECT_EQ(fact_of(read_good_c3d("analog_only"), "analog"), "2 channels at 50 Hz");
}

TEST(C3dReader, TakesTheRateThatIsAskedForWhereTheFileHasNone) {
  ReadOptions options;
  options.frame_rate_hz = 240;
  EXPECT_EQ(read_c3d_bytes(good_c3d("no_rate"), options).clip.frame_rate_hz, 240);
  EXPECT_EQ(read_c3d_bytes(good_c3d("intel_real"), options).clip.frame_rate_hz, 50);
}

TEST(C3dReader, IsFoundByContent) {
  for (const char* const name : {"intel_real", "bytes_before_header", "no_processor"}) {
    const Take take = read_take(good_c3d(name), "walk").take;
    EXPECT_EQ(take.source.format, "c3d");
  }
}

TEST(C3dWords, VaxFloatsAreThoseOfTheManual) {
  // VAX F format: 1 is 0x4080 and -2.5 is 0xC120, in the first word.
  EXPECT_EQ(from_vax(0x40800000), 1.0f);
  EXPECT_EQ(from_vax(0xC1200000), -2.5f);
  EXPECT_EQ(from_vax(0x00000000), 0.0f);
  EXPECT_EQ(from_vax(0x007FFFFF), 0.0f);
  EXPECT_EQ(from_vax(0x00800000), std::ldexp(1.0f, -128));
  EXPECT_EQ(from_vax(0x01000000), std::ldexp(1.0f, -127));
  EXPECT_EQ(from_vax(0x7FFFFFFF), std::ldexp(1.0f - std::ldexp(1.0f, -24), 127));
  for (const float value : {1.0f, -2.5f, 0.1f, 3.0e38f / 2, 1.2e-38f, 0.0f, -1.0e-20f}) {
    EXPECT_EQ(from_vax(to_vax(value)), value) << value;
  }
  EXPECT_EQ(to_vax(INFINITY), 0x7FFFFFFFu);
  EXPECT_EQ(to_vax(NAN), 0u);
}

}  // namespace
}  // namespace kinemend
