// Outputs never contain NaN or infinity; a value that is not finite in the input is missing.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "io/c3d/c3d_layout.hpp"
#include "io/c3d/c3d_support.hpp"
#include "io/support.hpp"

namespace kinemend {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

TakeResult read_as(const std::string& text, const std::string& format, bool strict = false) {
  ReadOptions options;
  options.format = format;
  options.strict = strict;
  return read_take(text, "take." + format, options);
}

MATCHER(HoldsNoNumberThatIsNotFinite, "") {
  std::string lower = arg;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* word : {"nan", "inf", "1.#", "null", "1e999"}) {
    if (lower.find(word) == lower.npos) continue;
    *result_listener << "holds " << word;
    return false;
  }
  return true;
}

struct TextTake {
  std::string format;
  std::string head;
  char separator;
};

const TextTake text_takes[] = {
    {"trc",
     "PathFileType\t4\t(X/Y/Z)\tm.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
     "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t4\t2\tmm\t100\t1\t4\n"
     "Frame#\tTime\tA\t\t\tB\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n",
     '\t'},
    {"tsv",
     "NO_OF_FRAMES\t4\nNO_OF_MARKERS\t2\nFREQUENCY\t100\nMARKER_NAMES\tA\tB\n"
     "Frame\tTime\tA X\tA Y\tA Z\tB X\tB Y\tB Z\n",
     '\t'},
    {"csv", "# rate_hz: 100\n# units: mm\nframe,time_s,A_x,A_y,A_z,B_x,B_y,B_z\n", ','}};

std::string with_separator(std::string rows, char separator) {
  std::replace(rows.begin(), rows.end(), ',', separator);
  return rows;
}

TEST(NotFinite, MarkersOfATableAreMissingInWhatIsWritten) {
  const std::string rows =
      "1,0.00,11.5,12,13,14,15,16\n2,0.01,nan,12,13,14,15,16\n3,0.02,11,12,13,14,-inf,1e999\n"
      "4,0.03,NaN,NaN,1.#QNAN,14,15,16\n";
  const std::string expected =
      "1,0.00,11.5,12,13,14,15,16\n2,0.01,,,,14,15,16\n3,0.02,11,12,13,,,\n4,0.03,,,,14,15,16\n";
  for (const TextTake& take : text_takes) {
    SCOPED_TRACE(take.format);
    const std::string text = take.head + with_separator(rows, take.separator);
    const TakeResult read = read_as(text, take.format);
    EXPECT_EQ(read.diagnostics.count("value_not_finite"), 6u);
    const std::string written = write_take(read.take);
    EXPECT_THAT(written, HoldsNoNumberThatIsNotFinite());
    EXPECT_EQ(written, take.head + with_separator(expected, take.separator));
    const TakeResult again = read_as(written, take.format);
    EXPECT_TRUE(again.diagnostics.empty());
    EXPECT_EQ(again.take.observed, read.take.observed);
    EXPECT_THAT(message_of([&] { read_as(text, take.format, true); }, ErrorKind::quality_limit),
                HasSubstr("a coordinate is not finite"));
    for (const char* other : {"trc", "tsv", "csv", "c3d", "glb"}) {
      const std::string bytes = write_take(read.take, other);
      if (std::string_view(other) != "c3d") {
        EXPECT_THAT(bytes.substr(0, bytes.find("BIN")), HoldsNoNumberThatIsNotFinite()) << other;
      }
    }
  }
}

TEST(NotFinite, NumbersAndTimesOfRowsAreMended) {
  const std::string rows =
      "7,0.00,1,2,3,4,5,6\nnan,0.01,1,2,3,4,5,6\n9,inf,1,2,3,4,5,6\n10,0.03,1,2,3,4,5,6\n";
  for (const TextTake& take : text_takes) {
    SCOPED_TRACE(take.format);
    const TakeResult read = read_as(take.head + with_separator(rows, take.separator), take.format);
    EXPECT_EQ(read.diagnostics.count("value_not_finite"), 2u);
    EXPECT_EQ(write_take(read.take),
              take.head + with_separator("7,0.00,1,2,3,4,5,6\n8,0.01,1,2,3,4,5,6\n"
                                         "9,,1,2,3,4,5,6\n10,0.03,1,2,3,4,5,6\n",
                                         take.separator));
  }
}

TEST(NotFinite, RatesOfTablesAreNotWritten) {
  const std::string rows = "1,0.00,1,2,3,4,5,6\n2,0.01,1,2,3,4,5,6\n";
  for (const TextTake& take : text_takes) {
    SCOPED_TRACE(take.format);
    std::string head = take.head;
    const std::size_t at = head.find("100", head.find(take.format == "tsv" ? "FREQ" : ""));
    head.replace(at, 3, "nan");
    const TakeResult read = read_as(head + with_separator(rows, take.separator), take.format);
    EXPECT_EQ(read.diagnostics.count("head_not_finite"), 1u);
    const std::string written = write_take(read.take);
    EXPECT_THAT(written, HoldsNoNumberThatIsNotFinite());
    EXPECT_EQ(read_as(written, take.format).take.frame_rate_hz, 100);
  }
}

TEST(NotFinite, TableWithoutSeparatorsGetsThem) {
  std::string text =
      text_takes[0].head + with_separator("1,0.00,1,2,3,4,5,6\n2,0.01,nan,nan,nan,4,5,6\n", ' ');
  const TakeResult read = read_as(text, "trc");
  ASSERT_EQ(read.take.is_observed(1, 0), false);
  const std::string written = write_take(read.take);
  EXPECT_THAT(written, HoldsNoNumberThatIsNotFinite());
  EXPECT_THAT(written, HasSubstr("2\t0.010000\t\t\t\t4\t5\t6\n"));
}

TEST(NotFinite, JointsOfATableAreMissingInWhatIsWritten) {
  const std::string head =
      "# rate_hz: 100\n# joint 0: Hips; parent -1; offset 0 0 0; channels Xposition Yposition "
      "Zposition Zrotation Xrotation Yrotation\nframe,time_s,root_x,root_y,root_z,Hips_w,Hips_x,"
      "Hips_y,Hips_z\n";
  const TakeResult read = read_as(
      head + "1,0.00,1,2,3,1,0,0,0\n2,0.01,nan,2,3,1,0,0,0\n3,0.02,1,2,3,nan,inf,0,0\n", "csv");
  const std::string written = write_take(read.take);
  EXPECT_EQ(written, head + "1,0.00,1,2,3,1,0,0,0\n2,0.01,1,2,3,1,0,0,0\n3,0.02,1,2,3,,,,\n");
}

class C3dFile {
 public:
  explicit C3dFile(const std::string& name) : bytes(good_c3d(name)) {
    const Take clip = read_c3d_bytes(bytes).clip;
    layout = document_of(clip).layout;
    parameters = document_of(clip).parameters;
  }

  std::size_t sample(std::size_t frame, std::size_t point) const {
    return layout.data_begin + frame * layout.frame_bytes() + 16 * point;
  }
  std::size_t analog(std::size_t frame, std::size_t value) const {
    return layout.data_begin + frame * layout.frame_bytes() + layout.point_bytes() + 4 * value;
  }
  void put(std::size_t place, float value) { std::memcpy(&bytes[place], &value, 4); }
  static float at(const std::string& from, std::size_t place) {
    float value = 0;
    std::memcpy(&value, &from[place], 4);
    return value;
  }

  std::string bytes;
  C3dLayout layout;
  C3dParameters parameters;
};

TEST(NotFinite, PointsOfC3dAreMissingInWhatIsWritten) {
  C3dFile file("intel_real");
  const Take before = read_c3d_bytes(file.bytes).clip;
  ASSERT_TRUE(before.is_observed(0, 0) && before.is_observed(3, 2) && before.is_observed(4, 1));
  file.put(file.sample(0, 0), not_a_number);
  file.put(file.sample(3, 2) + 8, -infinite);
  file.put(file.sample(4, 1) + 12, not_a_number);  // the word that marks the sample as present
  const C3dResult read = read_c3d_bytes(file.bytes);
  EXPECT_EQ(read.diagnostics.count("value_not_finite"), 2u);
  EXPECT_EQ(read.diagnostics.count("missing_not_finite"), 1u);
  for (const auto& [frame, point] : {std::pair<std::size_t, std::size_t>{0, 0}, {3, 2}, {4, 1}})
    EXPECT_FALSE(read.clip.is_observed(frame, point));
  const std::string written = write_take(read.clip);
  ASSERT_EQ(written.size(), file.bytes.size());
  for (std::size_t f = 0; f < file.layout.frame_count; ++f) {
    for (std::size_t i = 0; i < file.layout.frame_bytes() / 4; ++i)
      ASSERT_TRUE(std::isfinite(C3dFile::at(written, file.sample(f, 0) + 4 * i))) << f << " " << i;
  }
  EXPECT_EQ(C3dFile::at(written, file.sample(0, 0) + 12), -1);
  EXPECT_EQ(C3dFile::at(written, file.sample(3, 2) + 12), -1);
  expect_same_samples(read_c3d_bytes(written).clip, read.clip);
  EXPECT_EQ(read_c3d_bytes(written).diagnostics.count("value_not_finite"), 0u);
  // No other byte changes.
  std::size_t changed = 0;
  for (std::size_t i = 0; i < written.size(); ++i) changed += written[i] != file.bytes[i] ? 1 : 0;
  EXPECT_LE(changed, 48u);
  ReadOptions strict;
  strict.strict = true;
  EXPECT_THAT(message_of([&] { read_c3d_bytes(file.bytes, strict); }, ErrorKind::quality_limit),
              HasSubstr("a position is not finite"));
}

TEST(NotFinite, AnalogSamplesOfC3dAreHeld) {
  C3dFile file("intel_real");
  ASSERT_GT(file.layout.analog_values, file.layout.analog_count);
  const std::size_t channels = file.layout.analog_count;
  const float last = C3dFile::at(file.bytes, file.analog(1, file.layout.analog_values - channels));
  file.put(file.analog(0, 0), not_a_number);
  file.put(file.analog(2, 0), infinite);
  file.put(file.analog(2, channels), not_a_number);
  const C3dResult read = read_c3d_bytes(file.bytes);
  EXPECT_EQ(read.diagnostics.count("analog_not_finite"), 3u);
  const std::string written = write_take(read.clip);
  EXPECT_EQ(C3dFile::at(written, file.analog(0, 0)), 0);
  EXPECT_EQ(C3dFile::at(written, file.analog(2, 0)), last);
  EXPECT_EQ(C3dFile::at(written, file.analog(2, channels)), last);
}

TEST(NotFinite, RatesAndScalesOfC3dAreUnknown) {
  C3dFile file("intel_real");
  const Take before = read_c3d_bytes(file.bytes).clip;
  const C3dParameter* const rate = file.parameters.find("POINT", "RATE");
  const C3dParameter* const scale = file.parameters.find("ANALOG", "GEN_SCALE");
  ASSERT_TRUE(rate != nullptr && scale != nullptr);
  file.put(rate->data_begin, not_a_number);
  file.put(scale->data_begin, infinite);
  const C3dResult read = read_c3d_bytes(file.bytes);
  EXPECT_EQ(read.diagnostics.count("parameter_not_finite"), 2u);
  EXPECT_EQ(read.clip.frame_rate_hz, before.frame_rate_hz) << "the header has it too";
  const std::string written = write_take(read.clip);
  EXPECT_EQ(C3dFile::at(written, rate->data_begin), 0);
  EXPECT_EQ(C3dFile::at(written, scale->data_begin), 1);
  for (const double value : analog_of(read_c3d_bytes(written).clip).values)
    ASSERT_TRUE(std::isfinite(value));
}

TEST(NotFinite, LengthsAreRefusedWhereAFormatCannotHoldThem) {
  Take clip = make_marker_take({"A"}, 2, 100);
  clip.observed.assign(2, 1);
  clip.positions[1].x = 1e60;
  EXPECT_EQ(message_of([&] { write_take(clip, "glb"); }, ErrorKind::usage),
            "a length is too large for a glTF file");
  EXPECT_THAT(message_of([&] { write_take(clip, "c3d"); }, ErrorKind::usage),
              HasSubstr("too large for a C3D file"));
}

}  // namespace
}  // namespace kinemend
