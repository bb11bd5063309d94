// Tests of the C3D writer: in place if the bytes can represent the change, or else as a new file.
#include <cmath>
#include <cstring>

#include "c3d_support.hpp"
#include "io/c3d/c3d_parameters.hpp"
#include "io/mended.hpp"

namespace kinemend {
namespace {

using namespace test;

const char* const encodings[] = {"intel_integer", "intel_real",   "dec_integer",
                                 "dec_real",      "mips_integer", "mips_real"};

std::vector<std::size_t> changed_bytes(const std::string& a, const std::string& b) {
  std::vector<std::size_t> changed;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] != b[i]) changed.push_back(i);
  }
  return changed;
}

TEST(C3dWriter, UnchangedClipsComeBackToTheByte) {
  for (const auto& entry : std::filesystem::directory_iterator(c3d_folder() / "good")) {
    const std::string bytes = read_file(entry.path());
    const C3dResult read = read_c3d_bytes(bytes);
    const std::string written = write_take(read.clip, "c3d");
    EXPECT_TRUE(was_mended(read.diagnostics) || written == bytes) << entry.path();
    EXPECT_TRUE(write_take(read_c3d_bytes(written).clip, "c3d") == written) << entry.path();
  }
}

TEST(C3dWriter, OnlyTheBytesOfChangedSamplesChange) {
  for (const char* const name : encodings) {
    SCOPED_TRACE(name);
    const std::string bytes = good_c3d(name);
    Take clip = read_c3d_bytes(bytes).clip;
    const C3dLayout layout = document_of(clip).layout;
    clip.position(4, 1).y += 2.5;
    const std::string out = write_take(clip, "c3d");
    const std::size_t value = layout.value_bytes();
    const std::size_t place = layout.data_begin + 4 * layout.frame_bytes() + (4 + 1) * value;
    for (const std::size_t i : changed_bytes(bytes, out)) {
      EXPECT_GE(i, place);
      EXPECT_LT(i, place + value);
    }
    const Take again = read_c3d_bytes(out).clip;
    expect_same_samples(clip, again);
    EXPECT_EQ(again.residuals, clip.residuals);
  }
}

TEST(C3dWriter, FilledSamplesLoseTheirResidualOfMinusOne) {
  for (const char* const name : encodings) {
    SCOPED_TRACE(name);
    Take clip = read_good_c3d(name);
    ASSERT_FALSE(clip.is_observed(2, 1));
    ASSERT_FALSE(clip.is_observed(5, 2));
    for (const auto& [frame, marker] : {std::pair<std::size_t, std::size_t>{2, 1}, {5, 2}}) {
      const std::size_t i = frame * clip.marker_count() + marker;
      clip.positions[i] = {12.5, 0.625, -7};
      clip.observed[i] = 1;
      clip.residuals[i] = 0;
    }
    const Take again = read_c3d_bytes(write_take(clip, "c3d")).clip;
    expect_same_samples(clip, again);
    EXPECT_EQ(again.residuals, clip.residuals);
    // The cameras that saw other samples are kept.
    EXPECT_EQ(fact_of(again, "cameras"), "7 saw a marker");
  }
}

TEST(C3dWriter, SamplesThatAreNowMissingBecomeZerosWithMinusOne) {
  for (const char* const name : encodings) {
    SCOPED_TRACE(name);
    Take clip = read_good_c3d(name);
    clip.observed[0] = 0;
    clip.residuals[0] = -1;
    const std::string out = write_take(clip, "c3d");
    expect_same_samples(clip, read_c3d_bytes(out).clip);
    const C3dLayout& layout = document_of(clip).layout;
    const std::string_view place =
        std::string_view(out).substr(layout.data_begin, 3 * layout.value_bytes());
    EXPECT_EQ(place.find_first_not_of('\0'), place.npos);
  }
}

// Zeros that mean missing because of the samples around them are marked explicitly once those
// samples change.
TEST(C3dWriter, GapsOfZerosAreMarkedInAFileThatChanges) {
  Take clip = read_good_c3d("zeros");
  ASSERT_FALSE(clip.is_observed(0, 1));
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (clip.is_observed(f, 0)) clip.position(f, 0) = {0.125, 0, 0};
  }
  const C3dResult again = read_c3d_bytes(write_take(clip, "c3d"));
  EXPECT_TRUE(again.diagnostics.empty());
  expect_same_samples(clip, again.clip);
}

TEST(C3dWriter, ResidualsAreWrittenInStepsOfTheScale) {
  for (const char* const name : encodings) {
    SCOPED_TRACE(name);
    Take clip = read_good_c3d(name);
    clip.residuals[0] = 0.5;     // 4 steps
    clip.residuals[1] = 0.001f;  // less than one step, but measured
    clip.residuals[3] = 1000;    // more than a byte holds
    clip.residuals[5] = 0;       // filtered
    const Take again = read_c3d_bytes(write_take(clip, "c3d")).clip;
    EXPECT_EQ(again.residuals[0], 0.5f);
    EXPECT_EQ(again.residuals[1], 0.125f);
    EXPECT_EQ(again.residuals[3], 255 * 0.125f);
    EXPECT_EQ(again.residuals[5], 0);
    EXPECT_EQ(again.residuals[6], clip.residuals[6]);
  }
}

TEST(C3dWriter, IntegersAreRoundedToTheirScale) {
  Take clip = read_good_c3d("mips_integer");
  clip.positions[0] = {1.06, -1.07, 100};
  const Take again = read_c3d_bytes(write_take(clip, "c3d")).clip;
  EXPECT_EQ(again.positions[0].x, 1.0);
  EXPECT_EQ(again.positions[0].y, -1.125);
  EXPECT_EQ(again.positions[0].z, 100);
}

TEST(C3dWriter, WhatDoesNotFitIntoIntegersBecomesAFileOfRealsThatLosesNothing) {
  for (const char* const name : {"dec_integer", "unsigned_analog"}) {
    SCOPED_TRACE(name);
    Take clip = read_good_c3d(name);
    clip.positions[0].x = 40000 * 0.125;
    const Take again = read_c3d_bytes(write_take(clip, "c3d")).clip;
    EXPECT_EQ(fact_of(again, "encoding"), "Intel reals");
    expect_same_samples(clip, again);
    EXPECT_EQ(again.is_position, clip.is_position);
    EXPECT_EQ(fact_of(again, "cameras"), fact_of(clip, "cameras"));
    EXPECT_EQ(fact_of(again, "subjects"), "Ann");
    ASSERT_EQ(again.events.size(), 2u);
    EXPECT_EQ(again.events[1].context, "Right");
    const C3dAnalog before = analog_of(clip);
    const C3dAnalog after = analog_of(again);
    EXPECT_EQ(after.values, before.values);
    EXPECT_EQ(after.names, before.names);
    EXPECT_EQ(after.rate_hz, before.rate_hz);
  }
}

TEST(C3dWriter, AChangedRateIsPatchedWhereItStands) {
  for (const char* const name : encodings) {
    SCOPED_TRACE(name);
    Take clip = read_good_c3d(name);
    clip.frame_rate_hz = 60;
    const std::string out = write_take(clip, "c3d");
    EXPECT_LE(changed_bytes(good_c3d(name), out).size(), 12u);
    const Take again = read_c3d_bytes(out).clip;
    EXPECT_EQ(again.frame_rate_hz, 60);
    EXPECT_EQ(fact_of(again, "analog"), "2 channels at 120 Hz");
    EXPECT_EQ(document_of(again).parameters.number("ANALOG", "RATE"), 120);
  }
}

TEST(C3dWriter, OtherMarkersGetANewFileWithTheSourcesParameters) {
  const Take source = read_good_c3d("dec_real");
  Take clip = make_marker_take({"A", "B"}, 6, 50);
  clip.source = source.source;
  clip.unit = "mm";
  for (std::size_t f = 0; f < 6; ++f) {
    clip.position(f, 0) = {1.0 + static_cast<double>(f), 2, 3};
    clip.observed[2 * f] = 1;
  }
  clip.is_position = {1, 0};
  clip.events = {{"Stop", "General", 123.75}};
  const Take again = read_c3d_bytes(write_take(clip, "c3d")).clip;
  expect_same_samples(clip, again);
  EXPECT_EQ(again.is_position, clip.is_position);
  EXPECT_EQ(again.unit, "mm");
  ASSERT_EQ(again.events.size(), 1u);
  EXPECT_EQ(again.events[0].label, "Stop");
  EXPECT_EQ(again.events[0].context, "General");
  EXPECT_EQ(again.events[0].time_s, 123.75);
  EXPECT_EQ(fact_of(again, "subjects"), "Ann");
  EXPECT_EQ(fact_of(again, "analog"), "2 channels at 100 Hz");
  EXPECT_EQ(analog_of(again).values, analog_of(source).values);
}

// The first file has two groups with one number; the second has analog values without a channel.
TEST(C3dWriter, NewFilesOfDamagedSourcesReadBack) {
  for (const char* const name : {"groups_of_one_number.c3d", "analog_without_channels.c3d"}) {
    SCOPED_TRACE(name);
    Take clip = read_c3d_bytes(read_file(c3d_folder() / "found" / name)).clip;
    clip.events.push_back({"again", "", 2});
    expect_same_samples(clip, read_c3d_bytes(write_take(clip, "c3d")).clip);
  }
}

TEST(C3dWriter, OtherFramesGetANewFileWithoutAnalogSamples) {
  const Take source = read_good_c3d("intel_real");
  Take clip = slice(source, 1, 4);
  clip.source.document = source.source.document;
  const Take again = read_c3d_bytes(write_take(clip, "c3d")).clip;
  expect_same_samples(clip, again);
  EXPECT_EQ(again.first_frame, 2);
  EXPECT_EQ(again.residuals, clip.residuals);
  EXPECT_EQ(fact_of(again, "analog"), "");
  EXPECT_EQ(fact_of(again, "force plates"), "");
  EXPECT_EQ(fact_of(again, "subjects"), "Ann");
}

// Checks the header rules of c3d.org byte by byte.
TEST(C3dWriter, NewFilesKeepTheRulesOfTheManual) {
  Take clip = make_marker_take({"Ann:A", "B", "\u53f3"}, 3, 120);
  clip.unit = "m";
  clip.first_frame = 7;
  clip.events = {{"Foot Strike", "Left", 0.5}};
  for (std::size_t i = 0; i < 9; ++i) {
    clip.positions[i] = {0.5, -1.6, 0.25 * static_cast<double>(i)};
    clip.observed[i] = i == 4 ? 0 : 1;
  }
  const std::string out = write_take(clip, "c3d");
  const auto word = [&](std::size_t number) {
    std::uint16_t value = 0;
    std::memcpy(&value, out.data() + 2 * (number - 1), 2);
    return value;
  };
  const auto real = [&](std::size_t offset) {
    float value = 0;
    std::memcpy(&value, out.data() + offset, 4);
    return value;
  };
  EXPECT_EQ(out.size() % 512, 0u);
  EXPECT_EQ(word(1), 0x5002);
  EXPECT_EQ(word(2), 3);
  EXPECT_EQ(word(3), 0);
  EXPECT_EQ(word(4), 7);
  EXPECT_EQ(word(5), 9);
  EXPECT_FLOAT_EQ(real(12), -2.0f / 32000);
  EXPECT_EQ(real(20), 120.0f);
  EXPECT_EQ(word(150), 12345);
  EXPECT_EQ(word(151), 1);
  EXPECT_EQ(real(2 * 152), 0.5f);
  EXPECT_EQ(out.substr(2 * 198, 4), "Foot");
  EXPECT_EQ(out[512 + 1], 0x50);
  EXPECT_EQ(out[512 + 3], 84);
  const std::size_t data = 512u * (word(9) - 1u);
  EXPECT_EQ(static_cast<std::size_t>(static_cast<unsigned char>(out[512 + 2])) * 512 + 512, data);
  EXPECT_EQ(real(data), 0.5f);
  EXPECT_EQ(real(data + 12), 0.0f);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(real(data + 4 * 16 + 4 * i), 0.0f);
  EXPECT_EQ(real(data + 4 * 16 + 12), -1.0f);
  const Take again = read_c3d_bytes(out).clip;
  const C3dParameters& parameters = document_of(again).parameters;
  EXPECT_EQ(parameters.count("POINT", "DATA_START"), word(9));
  EXPECT_EQ(parameters.text("POINT", "UNITS"), "m");
  // The markers extend higher along y than along z.
  EXPECT_EQ(parameters.text("POINT", "Y_SCREEN"), "+Z");
  for (const char* const group : {"POINT", "ANALOG", "FORCE_PLATFORM", "TRIAL", "EVENT"})
    EXPECT_TRUE(parameters.has_group(group)) << group;
  expect_same_samples(clip, again, 1e-7);
  EXPECT_EQ(again.first_frame, 7);
}

TEST(C3dWriter, HoldsMoreThan255MarkersAndEvents) {
  std::vector<std::string> names;
  for (int m = 0; m < 700; ++m) names.push_back("Marker" + std::to_string(m));
  names[100] = std::string(200, 'n');
  Take clip = make_marker_take(names, 2, 100);
  for (int i = 0; i < 300; ++i) clip.events.push_back({"e" + std::to_string(i), "", 0.25 * i});
  const Take again = read_c3d_bytes(write_take(clip, "c3d")).clip;
  EXPECT_EQ(again.names, names);
  ASSERT_EQ(again.events.size(), 300u);
  EXPECT_EQ(again.events[299].label, "e299");
  EXPECT_EQ(again.events[299].time_s, 0.25 * 299);
}

TEST(C3dWriter, HoldsMoreThan65535Frames) {
  for (const std::int64_t first : {1, 70000}) {
    const std::size_t frames = 70001;
    Take clip = make_marker_take({"A"}, frames, 100);
    clip.first_frame = first;
    for (std::size_t f = 0; f < frames; ++f) {
      clip.positions[f] = {static_cast<double>(f), 1, 2};
      clip.observed[f] = 1;
    }
    std::string out = write_take(clip, "c3d");
    const Take again = read_c3d_bytes(out).clip;
    EXPECT_EQ(again.frame_count(), frames);
    EXPECT_EQ(again.first_frame, first);
    expect_same_samples(clip, again);
    // A section after the data, which some programs append, adds no frames.
    out += std::string(5000 * 16, '\2');
    EXPECT_EQ(read_c3d_bytes(out).clip.frame_count(), frames);
  }
}

// By a misprint in the manual, the high word counts 65,535 frames.
TEST(C3dWriter, ReadsFrameFieldsThatFollowTheMisprint) {
  const std::size_t frames = 70001;
  Take clip = make_marker_take({"A"}, frames, 100);
  std::string out = write_take(clip, "c3d");
  const std::size_t low = 70001 % 65536, misprinted = 70001 - 65535;
  const std::string field = "ACTUAL_END_FIELD";
  const std::size_t at = out.find(field) + field.size() + 2 + 2 + 1;
  ASSERT_EQ(static_cast<unsigned char>(out[at]), low % 256);
  out[at] = static_cast<char>(misprinted % 256);
  out[at + 1] = static_cast<char>(misprinted / 256);
  EXPECT_EQ(read_c3d_bytes(out).clip.frame_count(), frames);
}

TEST(C3dWriter, RefusesWhatTheFormatCannotHold) {
  const auto refusal = [](const Take& clip) -> std::string {
    try {
      write_take(clip, "c3d");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal(make_marker_take({std::string(256, 'n')}, 1, 100)),
            "a text of 256 bytes; C3D files can hold 255");
  EXPECT_EQ(refusal(make_marker_take(std::vector<std::string>(65536), 1, 100)),
            "65536 markers; C3D files can hold 65,535");
  Take clip = read_good_c3d("intel_real");
  clip.positions[0].x = 1e39;
  EXPECT_EQ(refusal(clip), "1e+39 is too large for a C3D file");
  // The value exceeds the DEC range, so a new file in Intel format is written.
  clip.positions[0].x = 2e38;
  EXPECT_EQ(refusal(clip), "no error");
}

TEST(C3dParameters, SurviveWritingAndReading) {
  C3dParameters parameters;
  set_parameter(parameters, "POINT", c3d_real("SCALE", -0.25));
  set_parameter(parameters, "POINT", c3d_integer("USED", 60000));
  set_parameter(parameters, "ANALOG", c3d_reals("TABLE", {1, 2, 3, 4, 5, 6}, 3));
  set_texts(parameters, "POINT", "LABELS", std::vector<std::string>(600, "label"));
  set_parameter(parameters, "point", c3d_text("UNITS", "mm"));
  const std::string section = c3d_parameter_section(parameters);
  Diagnostics diagnostics;
  const C3dSource source{"x", section, false, diagnostics};
  const C3dParameters again = read_c3d_parameters(source, 4, section.size());
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(again.groups.size(), 2u);
  EXPECT_EQ(again.number("POINT", "SCALE"), -0.25);
  EXPECT_EQ(again.count("POINT", "USED"), 60000u);
  EXPECT_EQ(again.texts("POINT", "LABELS").size(), 600u);
  EXPECT_NE(again.find("POINT", "LABELS3"), nullptr);
  EXPECT_EQ(again.text("POINT", "UNITS"), "mm");
  EXPECT_EQ(again.numbers("ANALOG", "TABLE"), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(again.find("ANALOG", "TABLE")->dimensions, (std::vector<std::uint8_t>{3, 2}));
  // Both of two parameters with the same name are removed.
  parameters.entries.push_back(*parameters.find("POINT", "LABELS"));
  remove_parameter(parameters, "POINT", "LABELS");
  EXPECT_EQ(parameters.find("POINT", "LABELS"), nullptr);
  EXPECT_EQ(parameters.find("POINT", "LABELS3"), nullptr);
  remove_group(parameters, "ANALOG");
  EXPECT_FALSE(parameters.has_group("ANALOG"));
}

}  // namespace
}  // namespace kinemend
