// Tests of conversions of C3D files: kept, changed and reported parts.
#include "c3d_law.hpp"

namespace kinemend {
namespace {

using namespace test;

TEST(C3dConversions, BringAllThroughThatTheyDoNotConcern) {
  for (const auto& entry : std::filesystem::directory_iterator(c3d_folder() / "good")) {
    SCOPED_TRACE(entry.path());
    ASSERT_NO_FATAL_FAILURE(expect_lawful_conversions(read_file(entry.path())));
  }
}

const C3dParameters& parameters_of(const Take& clip) { return document_of(clip).parameters; }

Take written(const Take& clip) { return read_c3d_bytes(write_take(clip, "c3d")).clip; }

TEST(C3dConversions, TurnTheAxesOfTheScreen) {
  const auto screen = [](const Take& clip, const char* name) {
    return parameters_of(clip).text("POINT", name);
  };
  const Take clip = read_good_c3d("laboratory");
  const Take up_y = written(turn_axes(clip, Axis::z, Axis::y));
  EXPECT_EQ(screen(up_y, "X_SCREEN"), "+X");
  EXPECT_EQ(screen(up_y, "Y_SCREEN"), "+Y");
  const Take up_x = written(turn_axes(clip, Axis::z, Axis::x));
  EXPECT_EQ(screen(up_x, "X_SCREEN"), "-Z");
  EXPECT_EQ(screen(up_x, "Y_SCREEN"), "+X");
  EXPECT_EQ(screen(written(turn_axes(up_x, Axis::x, Axis::z)), "X_SCREEN"), "+X");
}

// Measurements of plates have the units of analog channels; values computed by a model have their
// own.
TEST(C3dConversions, ScaleLengthsOnly) {
  const Take clip = read_good_c3d("laboratory");
  const Take metres = written(scale_lengths(clip, 0.001, "m"));
  EXPECT_EQ(parameters_of(metres).text("POINT", "UNITS"), "m");
  EXPECT_EQ(parameters_of(metres).text("POINT", "MOMENT_UNITS"), "Nmm");
  EXPECT_EQ(metres.position(2, 3), clip.position(2, 3));
  EXPECT_EQ(parameters_of(metres).number("PROCESSING", "Bodymass"), 61.5);
  EXPECT_FLOAT_EQ(static_cast<float>(*parameters_of(metres).number("POINT", "SCALE")), -0.125e-3F);
}

TEST(C3dConversions, NumberTheFramesOfTheTrialAnew) {
  const Take clip = read_good_c3d("laboratory");
  const Take half = written(resample(clip, 25));
  // Frame 20 at 50 Hz is 0.38 s into the trial: between frames 10 and 11 at 25 Hz.
  EXPECT_EQ(half.first_frame, 11);
  EXPECT_NEAR(half.events[0].time_s, 0.25 + 0.02, 1e-6);
  EXPECT_EQ(parameters_of(half).texts("EVENT", "DESCRIPTIONS")[1], "The toe");
  EXPECT_EQ(parameters_of(half).numbers("FORCE_PLATFORM", "ZERO"), (std::vector<double>{1, 3}));
  EXPECT_EQ(parameters_of(half).number("TRIAL", "CAMERA_RATE"), 25);
  EXPECT_EQ(fact_of(half, "analog"), "3 channels at 200 Hz");
  EXPECT_EQ(fact_of(half, "cameras"), fact_of(clip, "cameras"));
}

TEST(C3dConversions, NameWhatTheyCut) {
  const auto losses = [](const Take& clip, double rate_hz) {
    std::vector<std::string> names;
    const Diagnostics lost = lost_in_writing(Take(resample(clip, rate_hz)), "c3d");
    for (const Diagnostic& loss : lost.entries()) names.push_back(loss.name);
    return names;
  };
  using Names = std::vector<std::string>;
  const Take clip = read_good_c3d("laboratory");
  EXPECT_EQ(losses(clip, 50), Names{});
  EXPECT_EQ(losses(clip, 100), Names{"analog_cut"});
  EXPECT_EQ(losses(clip, 25), Names{"analog_held"});
  EXPECT_EQ(losses(clip, 60), (Names{"analog_lost", "force_plates_lost"}));
  EXPECT_EQ(losses(read_good_c3d("plates_only"), 60), Names{});
}

TEST(C3dConversions, NameWhatOtherFormatsCannotHold) {
  const Take clip = read_good_c3d("laboratory");
  for (const char* const format : {"trc", "csv", "glb"}) {
    const Diagnostics lost = lost_in_writing(clip, format);
    ASSERT_EQ(lost.entries().size(), 1u) << format;
    EXPECT_EQ(lost.entries()[0].message,
              std::string(format) +
                  " files cannot hold 3 analog channels at 200 Hz; 2 force plates; the parameters "
                  "of SUBJECTS, PROCESSING; 2 events; a point that is not a position");
  }
  EXPECT_TRUE(lost_in_writing(Take(make_marker_take({"A"}, 1, 100)), "trc").empty());
}

TEST(C3dConversions, LeaveAMarkerThatStandsAtTheOrigin) {
  for (const char* const name : {"laboratory", "laboratory_integer", "origin_alone"}) {
    SCOPED_TRACE(name);
    const Take clip = read_good_c3d(name);
    const auto marker = static_cast<std::size_t>(std::max(0, clip.find("ORIGIN")));
    const auto expect_there = [&](const Take& take) {
      for (std::size_t f = 0; f < take.frame_count(); ++f) {
        EXPECT_TRUE(take.is_observed(f, marker));
        EXPECT_EQ(take.position(f, marker), Vec3{});
      }
    };
    expect_there(clip);
    expect_there(written(clip));
    expect_there(written(without_layout(clip)));
    for (const char* const format : {"trc", "csv"}) {
      const std::string text = write_take(clip, format);
      const Take again = read_take(text, std::string("take.") + format).take;
      expect_there(again);
      expect_there(written(again));
    }
  }
}

TEST(C3dConversions, WriteOtherFormatsWithoutPointsThatAreNoPositions) {
  const Take clip = read_good_c3d("laboratory");
  const Take kept = positions_only(clip);
  EXPECT_LT(kept.marker_count(), clip.marker_count());
  for (const char* const format : {"trc", "csv", "tsv"}) {
    const Take take = read_take(write_take(clip, format), std::string("take.") + format).take;
    EXPECT_EQ(take.names, kept.names) << format;
  }
  Take angles = clip;
  angles.is_position.assign(clip.marker_count(), 0);
  EXPECT_THROW(write_take(angles, "trc"), Error);
}

}  // namespace
}  // namespace kinemend
