// Tests of drawings of whole takes.
#include "kinemend/extend/pages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/lab/synth.hpp"
#include "report/support.hpp"

namespace kinemend::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

constexpr FrameSpanToDraw all_frames{0, std::numeric_limits<std::size_t>::max()};

void expect_svg(const std::string& svg) {
  EXPECT_THAT(svg, StartsWith("<svg "));
  EXPECT_THAT(svg, EndsWith("</svg>\n"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_EQ(test::count_of(svg, "<g"), test::count_of(svg, "</g>"));
}

Take gapped_markers() {
  Take clip = make_marker_take({"A", "B<&>", "C"}, 100, 50);
  clip.unit = "mm";
  clip.first_frame = 101;
  for (std::size_t f = 0; f < 100; ++f) {
    for (std::size_t m = 0; m < 3; ++m) {
      clip.position(f, m) = {static_cast<double>(f), 1000.0 * static_cast<double>(m), 0};
      clip.observed[f * 3 + m] = m != 1 || f < 20 || f > 44 ? 1 : 0;
    }
  }
  return clip;
}

// A sine of amplitude 3 at 10 Hz for 20 s at 100 Hz, in one axis.
TrackCurves sine() {
  TrackCurves curves;
  curves.name = "A";
  curves.quantity = "position";
  curves.unit = "mm";
  curves.frame_rate_hz = 100;
  curves.axes = {"X"};
  curves.before.resize(1);
  for (int f = 0; f < 2000; ++f) curves.before[0].push_back(7 + 3 * std::sin(0.2 * pi * f));
  curves.after = curves.before;
  curves.difference.assign(2000, 0);
  return curves;
}

TEST(Pictures, OfASpectrumHoldThePowerOfASine) {
  const TrackSpectrum spectrum = track_spectrum(sine());
  ASSERT_EQ(spectrum.hertz.size(), spectrum.before.size());
  double power = 0;
  std::size_t peak = 0;
  for (std::size_t k = 0; k < spectrum.hertz.size(); ++k) {
    power += spectrum.before[k] * spectrum.hertz[1];
    if (spectrum.before[k] > spectrum.before[peak]) peak = k;
  }
  // The mean square of a sine is half of its squared amplitude; the mean itself is subtracted.
  EXPECT_NEAR(power, 4.5, 0.05);
  EXPECT_NEAR(spectrum.hertz[peak], 10, spectrum.hertz[1]);
  EXPECT_NEAR(spectrum.hertz.back(), 50, 1e-9);
  expect_svg(spectrum_svg(sine()));
}

TEST(Pictures, OfASpectrumLeaveWindowsWithGapsOut) {
  TrackCurves curves = sine();
  const TrackSpectrum whole = track_spectrum(curves);
  // The second of two windows has a gap.
  curves.before[0].resize(1536);
  curves.after = curves.before;
  curves.difference.resize(1536);
  curves.before[0][1300] = std::nan("");
  const TrackSpectrum spectrum = track_spectrum(curves);
  ASSERT_EQ(spectrum.before.size(), whole.before.size());
  EXPECT_NEAR(spectrum.before[102], whole.before[102], 0.2 * whole.before[102]);
  for (double& value : curves.before[0]) value = std::nan("");
  curves.after = curves.before;
  EXPECT_TRUE(track_spectrum(curves).before.empty());
  EXPECT_THAT(spectrum_svg(curves), HasSubstr("too few samples"));
}

TEST(Pictures, OfPosesStandInARow) {
  const Take clip = synthesize({.duration_s = 2, .frame_rate_hz = 60});
  const std::string svg = film_strip_svg(clip, &clip, all_frames, 5);
  expect_svg(svg);
  EXPECT_EQ(test::count_of(svg, "<path"), 11u) << "two a pose, and the floor";
  EXPECT_THAT(svg, HasSubstr(">1</text>"));
  EXPECT_THAT(svg, HasSubstr(">120</text>"));
  const std::string dots = film_strip_svg(gapped_markers(), nullptr, {30, 30}, 5);
  expect_svg(dots);
  EXPECT_EQ(test::count_of(dots, "<circle"), 2u) << "one of three is missing";
}

TEST(Pictures, MovingOnesHaveAPoseForEveryThirtiethOfASecond) {
  const Take clip = synthesize({.duration_s = 2, .frame_rate_hz = 120});
  const std::string both = moving_picture_svg(clip, &clip, all_frames);
  expect_svg(both);
  EXPECT_EQ(test::count_of(both, "<animate "), 2u);
  EXPECT_THAT(both, HasSubstr("dur=\"2.000s\""));
  const std::string part = moving_picture_svg(clip, nullptr, {0, 119});
  EXPECT_EQ(test::count_of(part, "<animate "), 1u);
  EXPECT_EQ(test::count_of(part, ";"), 29u) << "thirty poses";
  const std::string dots = moving_picture_svg(gapped_markers(), nullptr, {30, 30});
  EXPECT_EQ(test::count_of(dots, "h0"), 2u * 2)
      << "two of three markers, as drawn first and in motion";
}

TEST(Pictures, MovingOnesSayWhenTheyWouldBeTooLong) {
  const Take clip = synthesize({.duration_s = 61, .frame_rate_hz = 30});
  EXPECT_THROW(moving_picture_svg(clip, nullptr, all_frames), Error);
  EXPECT_NO_THROW(moving_picture_svg(clip, nullptr, {0, 1799}));
}

TEST(Pictures, AreDrawnOfTakesWithNothingInThem) {
  const Take clip = synthesize({.duration_s = 1, .frame_rate_hz = 60});
  const Take none = slice(clip, 0, 0);
  EXPECT_THAT(film_strip_svg(none, nullptr, all_frames), HasSubstr("no frames"));
  expect_svg(spectrum_svg(rotation_curves(none, none, 0)));
  const Take unseen = make_marker_take({"A"}, 3, 100);
  expect_svg(film_strip_svg(unseen, nullptr, all_frames));
  expect_svg(moving_picture_svg(unseen, nullptr, all_frames));
  EXPECT_THAT(moving_picture_svg(none, nullptr, all_frames), HasSubstr("no frames"));
  EXPECT_THAT([&] { film_strip_svg(clip, &none, all_frames); },
              ThrowsMessage<Error>("film strip: 60 frames before and 0 after"));
  EXPECT_THAT([&] { moving_picture_svg(clip, &none, all_frames); },
              ThrowsMessage<Error>("moving picture: 60 frames before and 0 after"));
}

TEST(Pictures, OfOneTakeHaveNoDifference) {
  const TrackCurves curves = sine();
  const std::string svg = curves_svg(curves, {.one_take = true});
  expect_svg(svg);
  EXPECT_THAT(svg, Not(HasSubstr("difference")));
  EXPECT_LT(svg.size(), curves_svg(curves).size());
}

}  // namespace
}  // namespace kinemend::test
