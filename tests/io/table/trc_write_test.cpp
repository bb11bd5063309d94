// Tests of the TRC writer: only changed samples get new digits.
#include <fmt/format.h>

#include "io/hostile.hpp"
#include "io/table/support.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;

void set(Take& clip, std::size_t frame, std::size_t marker, Vec3 position) {
  clip.position(frame, marker) = position;
  clip.observed[frame * clip.marker_count() + marker] = 1;
}

void unset(Take& clip, std::size_t frame, std::size_t marker) {
  clip.position(frame, marker) = {};
  clip.observed[frame * clip.marker_count() + marker] = 0;
}

TEST(TrcWriter, EveryFixtureComesBackToTheByte) {
  for (const auto& path : fixture_paths("trc")) {
    if (path.parent_path().filename() != "good") continue;
    const std::string bytes = read_file(path);
    const std::string written = write_take(read_trc(bytes), "trc");
    EXPECT_TRUE(written == bytes || path.stem() == "nan") << path;
    EXPECT_EQ(write_take(read_trc(written), "trc"), written) << path;
  }
}

TEST(TrcWriter, OnlyChangedSamplesGetNewDigits) {
  const std::string bytes = trc_fixture("good/crlf.trc");
  Take clip = read_trc(bytes);
  clip.position(1, 0).y = -116.6370149;
  EXPECT_EQ(write_take(clip, "trc"), bytes) << "five decimals say the same";
  clip.position(1, 0).y = -110.5;
  EXPECT_EQ(write_take(clip, "trc"), with(bytes, "-116.63701", "-110.50000"));
}

std::string small_trc(const std::string& values) {
  std::string text =
      "PathFileType\t4\t(X/Y/Z)\ta.trc\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
      "OrigNumFrames\n" +
      values + "\nFrame#\tTime\tA\t\t\n\t\tX1\tY1\tZ1\n\n";
  for (int f = 0; f < 20; ++f) text += fmt::format("{}\t{:.2f}\t{}\t1\t2\n", f + 1, 0.04 * f, f);
  return text;
}

TEST(TrcWriter, ValuesOfTheHeadThatTheRowsContradictAreMendedInAFileThatIsChangedAnyway) {
  const std::string bytes = small_trc("250\t250\t99\t3\tmm\t250\t1\t99");
  TakeResult read = read_take(bytes, "a.trc");
  EXPECT_EQ(read.take.frame_rate_hz, 25);  // each row states its time
  EXPECT_EQ(read.diagnostics.count("time_mismatch"), 1u);
  EXPECT_EQ(write_take(read.take), bytes);
  read.take.positions[0].y = 7;
  std::string expected = small_trc("25.00\t250\t20\t1\tmm\t250\t1\t99");
  expected.replace(expected.find("0\t1\t2\n"), 6, "0\t7\t2\n");
  EXPECT_EQ(write_take(read.take), expected);
}

TEST(TrcWriter, FilledSamplesGetTheDecimalsOfTheFile) {
  const std::string bytes = trc_fixture("good/gaps.trc");
  Take clip = read_trc(bytes);
  set(clip, 0, 0, {1, 2.123456, -3});
  std::string expected = with(bytes, "1\t0.000\t\t\t\t", "1\t0.000\t1.00000\t2.12346\t-3.00000\t");
  EXPECT_EQ(write_take(clip, "trc"), expected);
  set(clip, 2, 1, {4, 5, 6});
  expected = with(expected, "3\t0.020\t\t\t\t\t\t", "3\t0.020\t\t\t\t4.00000\t5.00000\t6.00000");
  EXPECT_EQ(write_take(clip, "trc"), expected);
}

TEST(TrcWriter, MissingSamplesBecomeEmptyCells) {
  const std::string bytes = trc_fixture("good/plain.trc");
  Take clip = read_trc(bytes);
  unset(clip, 0, 0);
  unset(clip, 2, 1);
  EXPECT_EQ(write_take(clip, "trc"), with(with(bytes, "-201.20056\t-116.39728\t721.44098", "\t\t"),
                                          "129.51600\t-187.97800\t724.38200", "\t\t"));
}

TEST(TrcWriter, ZerosThatMeanMissingStayUntilTheyAreFilled) {
  const std::string bytes = trc_fixture("good/zeros.trc");
  Take clip = read_trc(bytes);
  set(clip, 1, 0, {-200.7, -116.6, 721.5});
  EXPECT_EQ(write_take(clip, "trc"),
            with(bytes, "0.00000\t0.00000\t0.00000", "-200.70000\t-116.60000\t721.50000"));
}

TEST(TrcWriter, RowsThatEndEarlyGrow) {
  const std::string bytes = trc_fixture("good/short_rows.trc");
  Take clip = read_trc(bytes);
  set(clip, 1, 1, {1, 2, 3});
  set(clip, 2, 1, {4, 5, 6});
  EXPECT_EQ(write_take(clip, "trc"),
            with(with(bytes, "721.52441\n", "721.52441\t1.00000\t2.00000\t3.00000\n"),
                 "-116.87550\n", "-116.87550\t\t4.00000\t5.00000\t6.00000\n"));
}

TEST(TrcWriter, SpacesAndCommasStay) {
  const std::string spaces = trc_fixture("good/spaces.trc");
  Take clip = read_trc(spaces);
  clip.position(0, 0).x = 7;
  EXPECT_EQ(write_take(clip, "trc"), with(spaces, "-201.20056", "7.00000"));
  // Only tabs can mark an empty cell.
  unset(clip, 1, 1);
  const std::string tabs = write_take(clip, "trc");
  EXPECT_NE(tabs.find("2\t0.010000\t-200.70854\t-116.63701\t721.52441\t\t\t\n"), tabs.npos);
  EXPECT_EQ(read_trc(tabs).observed, clip.observed);
  const std::string commas = trc_fixture("good/decimal_comma.trc");
  clip = read_trc(commas);
  clip.position(0, 0).x = 7.5;
  EXPECT_EQ(write_take(clip, "trc"), with(commas, "-201,20056", "7,50000"));
}

TEST(TrcWriter, RandomChangesReadBackAndLeaveTheRestAlone) {
  Random random(5);
  for (const auto& path : fixture_paths("trc")) {
    // The number of unnamed markers is that of the widest row, which may change.
    if (path.parent_path().filename() != "good" || path.stem() == "unnamed") continue;
    SCOPED_TRACE(path.filename());
    const Take source = read_trc(read_file(path));
    for (int round = 0; round < 40; ++round) {
      Take clip = source;
      for (std::size_t f = 0; f < clip.frame_count(); ++f) {
        for (std::size_t m = 0; m < clip.marker_count(); ++m) {
          if (random.chance(0.3)) unset(clip, f, m);
          if (random.chance(0.3)) set(clip, f, m, {random.normal() + 900, random.normal(), 1});
        }
      }
      const Take again = read_trc(write_take(clip, "trc"));
      ASSERT_EQ(again.observed.size(), clip.observed.size());
      for (std::size_t i = 0; i < clip.positions.size(); ++i) {
        // The neighbouring samples decide whether the origin is a place or means missing.
        if (clip.observed[i] != 0 && clip.positions[i] == Vec3{}) continue;
        ASSERT_EQ(again.observed[i], clip.observed[i]) << i;
        if (clip.observed[i] == 0) continue;
        ASSERT_LT(norm(again.positions[i] - clip.positions[i]), 0.1) << i;
        if (clip.positions[i] == source.positions[i]) {
          ASSERT_EQ(again.positions[i], clip.positions[i]);
        }
      }
    }
  }
}

TEST(TrcWriter, AClipWithOtherFramesKeepsFirstLineLineEndsAndDecimals) {
  const std::string bytes = trc_fixture("good/crlf.trc");
  Take clip = read_trc(bytes);
  Take part = slice(clip, 1, 3);
  part.source.document = clip.source.document;
  EXPECT_EQ(write_take(part, "trc"),
            "PathFileType\t4\t(X/Y/Z)\twalk.trc\r\n"
            "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\t"
            "OrigDataStartFrame\tOrigNumFrames\r\n"
            "100.00\t100.00\t2\t2\tmm\t100.00\t2\t2\r\n"
            "Frame#\tTime\tLASI\t\t\tRASI\t\t\r\n"
            "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\r\n"
            "\r\n"
            "2\t0.000000\t-200.70854\t-116.63701\t721.52441\t129.47598\t-188.07799\t724.33362\r\n"
            "3\t0.010000\t-200.21008\t-116.87550\t721.60700\t129.51600\t-187.97800\t724.38200\r\n");
}

TEST(TrcWriter, AClipMadeInMemoryReadsBackExactly) {
  Take clip = make_marker_take({"A", "B b", "Ann:C"}, 50, 30000 / 1001.0);
  clip.unit = "m";
  clip.first_frame = 7;
  Random random(3);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    set(clip, f, 0, {random.normal(), 1e-3, -5});
    // These values come from floats, as in a C3D file, and are written with a float's digits.
    set(clip, f, 1, {static_cast<float>(random.normal()), 0.1f, 1e6f});
    if (f % 3 == 0) set(clip, f, 2, {std::round(1e6 * random.normal()) / 1e6, 0, 1});
  }
  const TakeResult result = read_take(write_take(clip, "trc"), "new.trc", {});
  EXPECT_TRUE(result.diagnostics.empty());
  const auto& again = result.take;
  EXPECT_EQ(again.names, clip.names);
  EXPECT_EQ(again.observed, clip.observed);
  EXPECT_EQ(again.unit, "m");
  EXPECT_EQ(again.first_frame, 7);
  EXPECT_EQ(again.frame_rate_hz, clip.frame_rate_hz);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_LE(norm(again.position(f, 0) - clip.position(f, 0)), 1e-9);
    EXPECT_EQ(static_cast<float>(again.position(f, 1).x),
              static_cast<float>(clip.position(f, 1).x));
    EXPECT_EQ(again.position(f, 1).y, 0.1);
    EXPECT_EQ(again.position(f, 2), clip.position(f, 2));
  }
}

TEST(TrcWriter, AUnitThatIsNoNumberIsNotWritten) {
  std::string text = write_take(make_marker_take({"A"}, 2, 100), "trc");
  text.replace(text.find("\tmm\t"), 4, "\tnan\t");
  const TakeResult read = read_take(text, "take.trc");
  EXPECT_EQ(read.diagnostics.count("head_not_finite"), 1u);
  const std::string written = write_take(read.take);
  EXPECT_EQ(read_take(written, "take.trc").diagnostics.count("head_not_finite"), 0u);
}

TEST(TrcWriter, NamesWithQuotesBlanksAndTabsReadBack) {
  Take clip = make_marker_take({"a\"b", "\"c\"", " d ", "\"e\tf\"g"}, 1, 100);
  for (std::size_t m = 0; m < 4; ++m) clip.positions[m] = {1, 2, static_cast<double>(m)};
  clip.observed.assign(4, 1);
  const auto again = read_take(write_take(clip, "trc"), "take.trc").take;
  EXPECT_EQ(again.names, clip.names);
  EXPECT_EQ(again.positions, clip.positions);
}

TEST(TrcWriter, RefusesWhatTheFormatCannotHold) {
  const auto error = [](const Take& clip) {
    return message_of([&] { write_take(clip, "trc"); }, ErrorKind::usage);
  };
  EXPECT_EQ(error(make_marker_take({"a\nb"}, 1, 100)), "TRC cannot hold the name \"a.b\"");
  EXPECT_EQ(error(make_marker_take({}, 0, 100)), "TRC cannot hold a clip without markers");
  Take joints;
  joints.skeleton.names = {"root"};
  EXPECT_EQ(error(joints), "trc files hold markers, not joints");
}

}  // namespace
}  // namespace kinemend
