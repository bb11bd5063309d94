// Tests of real C3D files: they are written back byte for byte, and one recording reads the same in
// every encoding.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "c3d_law.hpp"
#include "io/mended.hpp"

namespace kinemend {
namespace {

using namespace test;
namespace fs = std::filesystem;

const fs::path data = KINEMEND_DATA_FOLDER;
const fs::path samples = data / "c3d/btk/c3d.org";
const fs::path suite = data / "c3d/kineticstoolkit/c3d_test_suite";

Take read_real(const fs::path& path) { return read_take(path).take; }

std::vector<fs::path> real_files() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(data)) {
    std::string extension = entry.path().extension();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".c3d") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(RealC3d, EveryFileIsValidAndComesBackToTheByte) {
  std::size_t files = 0;
  for (const fs::path& path : real_files()) {
    SCOPED_TRACE(path);
    if (path.filename() == "Empty.c3d") {
      EXPECT_THROW(read_take(path), Error);
      continue;
    }
    const std::string bytes = read_file(path);
    const C3dResult read = read_c3d_bytes(bytes);
    read.clip.validate();
    const std::string written = write_take(read.clip, "c3d");
    if (was_mended(read.diagnostics)) {
      // Only numbers that are not finite change.
      EXPECT_EQ(written.size(), bytes.size());
      EXPECT_TRUE(write_take(read_c3d_bytes(written).clip, "c3d") == written);
    } else {
      EXPECT_TRUE(written == bytes);
    }
    ++files;
  }
  EXPECT_GE(files, 90u);
}

// The repairs of each known file, so that no change of the reader goes unnoticed.
TEST(RealC3d, OnlyTheKnownFilesAreRepaired) {
  const std::map<std::string, std::string> known{
      {"sgi_int.c3d", "damaged_parameter_pointer"},
      {"sgi_real.c3d", "damaged_parameter_pointer"},
      {"MACsample.c3d", "scale_mismatch"},
      {"bad_parameter_section.c3d", "damaged_parameters event_count_mismatch"},
      {"badParameterOffset.c3d", "damaged_parameter_pointer scale_mismatch"},
      {"parameterOverflow.c3d", "zero_is_missing"},
      {"kinematics_racing_full.c3d", "value_not_finite"},
      {"kinematics_racing_probing_acromion_R.c3d", "value_not_finite"},
      {"kinematics_racing_probing_olecrane_R.c3d", "value_not_finite"},
      {"kinematics_racing_probing_radial_styloid_R.c3d", "value_not_finite"},
      {"kinematics_racing_propulsion.c3d", "value_not_finite"},
      {"kinematics_racing_static.c3d", "value_not_finite"},
      {"Optotrak.c3d", "frames_missing"},
  };
  for (const fs::path& path : real_files()) {
    if (path.filename() == "Empty.c3d") continue;
    const TakeResult result = read_take(path);
    std::string repairs;
    for (const Diagnostic& entry : result.diagnostics.entries())
      repairs += (repairs.empty() ? "" : " ") + entry.name;
    const auto found = known.find(path.filename());
    EXPECT_EQ(repairs, found == known.end() ? "" : found->second) << path;
  }
}

// `analog_tolerance` is added to the rounding errors of reals.
void expect_same_recording(const Take& a, const Take& b, double tolerance,
                           double analog_tolerance) {
  EXPECT_EQ(a.frame_rate_hz, b.frame_rate_hz);
  EXPECT_EQ(a.first_frame, b.first_frame);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.is_position, b.is_position);
  ASSERT_NO_FATAL_FAILURE(expect_same_samples(a, b, tolerance));
  for (std::size_t i = 0; i < a.residuals.size(); ++i)
    ASSERT_NEAR(a.residuals[i], b.residuals[i], 1e-4) << "sample " << i;
  const std::size_t events = std::min(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < events; ++i) {
    EXPECT_EQ(a.events[i].label, b.events[i].label);
    EXPECT_EQ(a.events[i].context, b.events[i].context);
    EXPECT_NEAR(a.events[i].time_s, b.events[i].time_s, 1e-6);
  }
  for (const char* const fact : {"analog", "force plates", "cameras", "subjects", "software"})
    EXPECT_EQ(fact_of(a, fact), fact_of(b, fact)) << fact;
  const C3dAnalog x = analog_of(a), y = analog_of(b);
  EXPECT_EQ(x.names, y.names);
  EXPECT_EQ(x.units, y.units);
  ASSERT_EQ(x.values.size(), y.values.size());
  for (std::size_t i = 0; i < x.values.size(); ++i)
    ASSERT_NEAR(x.values[i], y.values[i],
                analog_tolerance + 1e-4 * std::max(1.0, std::fabs(x.values[i])))
        << i;
}

TEST(RealC3d, OneRecordingReadsEqualInEveryEncoding) {
  struct Recording {
    fs::path first;
    std::vector<fs::path> others;
    std::size_t markers, frames, events;
    double analog_tolerance = 0;
  };
  const fs::path one = samples / "sample01", two = samples / "sample02";
  const std::vector<Recording> recordings{
      {one / "Eb015pi.c3d",
       {one / "Eb015pr.c3d", one / "Eb015vi.c3d", one / "Eb015vr.c3d", one / "Eb015si.c3d",
        one / "Eb015sr.c3d", suite / "Sample01/Eb015pi.c3d", suite / "Sample01/Eb015pr.c3d",
        suite / "Sample01/Eb015vi.c3d", suite / "Sample01/Eb015vr.c3d",
        suite / "Sample08/EB015PI.c3d"},
       26,
       450,
       3},
      // Only DEC_INT has one event less in its header.
      {two / "pc_int.c3d",
       {two / "pc_real.c3d", two / "DEC_INT.C3D", two / "Dec_real.c3d", two / "sgi_int.c3d",
        two / "sgi_real.c3d", suite / "Sample02/pc_int.c3d", suite / "Sample02/pc_real.c3d",
        suite / "Sample02/dec_int.c3d", suite / "Sample02/dec_real.c3d",
        suite / "Sample02/sgi_int.c3d", suite / "Sample02/sgi_real.c3d"},
       36,
       89,
       9},
      // The parameters and the data are in other blocks.
      {samples / "sample08/TESTAPI.c3d",
       {samples / "sample08/TESTBPI.c3d", samples / "sample08/TESTCPI.c3d",
        samples / "sample08/TESTDPI.c3d", suite / "Sample08/TESTAPI.c3d",
        suite / "Sample08/TESTBPI.c3d", suite / "Sample08/TESTCPI.c3d",
        suite / "Sample08/TESTDPI.c3d"},
       26,
       450,
       3},
      {data / "c3d/btk/others/ADemo1_rewrite_c3d_pc_integer.c3d",
       {data / "c3d/btk/others/ADemo1_rewrite_c3d_pc_float.c3d"},
       24,
       512,
       0,
       0.1},
  };
  for (const Recording& recording : recordings) {
    const Take first = read_real(recording.first);
    EXPECT_EQ(first.marker_count(), recording.markers);
    EXPECT_EQ(first.frame_count(), recording.frames);
    EXPECT_EQ(first.events.size(), recording.events);
    // The integers were rounded down from the reals: up to one step on each axis.
    const double tolerance = std::sqrt(3.0) * document_of(first).layout.scale;
    for (const fs::path& path : recording.others) {
      SCOPED_TRACE(path);
      ASSERT_NO_FATAL_FAILURE(
          expect_same_recording(first, read_real(path), tolerance, recording.analog_tolerance));
    }
  }
}

TEST(RealC3d, ReadsWhatIsKnownOfTheTakes) {
  const Take walk = read_real(data / "cmu/c3d/85_02.c3d");
  EXPECT_EQ(walk.names[0], "Male:LFWT");
  EXPECT_EQ(walk.find("LFWT"), 0);
  EXPECT_EQ(walk.frame_count(), 810u);
  EXPECT_EQ(walk.frame_rate_hz, 120);
  EXPECT_EQ(std::count(walk.observed.begin(), walk.observed.end(), 0), 0);
  const Take dance = read_real(data / "cmu/c3d/05_13.c3d");
  EXPECT_EQ(dance.marker_count(), 330u);
  EXPECT_EQ(dance.names[329].substr(0, 6), "Dance:");
  EXPECT_EQ(dance.first_frame, 20);
  const Take paired = read_real(data / "paired/S02-Trial-Walk-1-vicon.c3d");
  EXPECT_EQ(std::count(paired.is_position.begin(), paired.is_position.end(), 0), 11);
}

TEST(RealC3d, ReadsMoreThan255AnalogChannels) {
  const Take clip = read_real(suite / "others/many_analogs.c3d");
  const C3dAnalog analog = analog_of(clip);
  ASSERT_EQ(analog.names.size(), 922u);
  EXPECT_NE(analog.names[921], "");
  EXPECT_EQ(analog.values.size(), 922u * clip.frame_count());
}

// The program writes 65,535 and zeros for a missing marker.
TEST(RealC3d, NoMarkerOfTheRollingTakeIsAtTheOrigin) {
  const Take clip = read_real(data / "c3d/other/03_rolling.c3d");
  std::size_t missing = 0;
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (clip.observed[i] == 0) {
      ++missing;
    } else {
      ASSERT_GT(norm(clip.positions[i]), 1.0) << i;
    }
  }
  EXPECT_GT(missing, 30000u);
}

// Every file reads back as written after small changes everywhere and filled gaps.
TEST(RealC3d, ChangedTakesReadBack) {
  for (const fs::path& path : real_files()) {
    if (path.filename() == "Empty.c3d") continue;
    SCOPED_TRACE(path);
    Take clip = read_real(path);
    const C3dLayout layout = document_of(clip).layout;
    for (std::size_t i = 0; i < clip.positions.size(); ++i) {
      if (clip.observed[i] != 0) {
        clip.positions[i] = clip.positions[i] + Vec3{0.5, -0.25, 0.125};
      } else if (i % 3 == 0) {
        clip.positions[i] = {100, 200, 300};
        clip.observed[i] = 1;
        clip.residuals[i] = 0;
      }
    }
    const auto is_whole = [&](Vec3 p) {
      constexpr double most_steps = 32767;
      return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= most_steps * layout.scale;
    };
    const bool in_range = std::all_of(clip.positions.begin(), clip.positions.end(), is_whole);
    const Take again = read_c3d_bytes(write_take(clip, "c3d")).clip;
    EXPECT_EQ(document_of(again).layout.is_float, layout.is_float || !in_range);
    expect_same_samples(clip, again, layout.is_float ? 1e-2 : 0.9 * layout.scale);
    clip.source.document.reset();
    expect_same_samples(clip, read_c3d_bytes(write_take(clip, "c3d")).clip, 1e-2);
  }
}

// Converts the rate, unit and axes of every file, and writes each in a plain layout.
TEST(RealC3d, ConversionsBringAllThroughThatTheyDoNotConcern) {
  std::size_t files = 0;
  for (const fs::path& path : real_files()) {
    if (path.filename() == "Empty.c3d") continue;
    SCOPED_TRACE(path);
    ASSERT_NO_FATAL_FAILURE(expect_lawful_conversions(read_file(path)));
    ++files;
  }
  EXPECT_GE(files, 90u);
}

}  // namespace
}  // namespace kinemend
