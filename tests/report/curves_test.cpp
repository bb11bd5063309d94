// Tests of curves over time and their drawings.
#include "kinemend/extend/pages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/lab/synth.hpp"
#include "report/support.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Take markers() {
  Take clip = make_marker_take({"A", "B<&>"}, 100, 50);
  clip.unit = "mm";
  clip.first_frame = 101;
  for (std::size_t f = 0; f < 100; ++f) {
    for (std::size_t m = 0; m < 2; ++m) {
      clip.position(f, m) = {10.0 * std::sin(0.1 * static_cast<double>(f)), 5, 0};
      clip.observed[2 * f + m] = 1;
    }
  }
  return clip;
}

TEST(Curves, OfRotationsAreTheAnglesOfTheChannels) {
  const Take before = synthesize({.motion = "walk", .duration_s = 1, .frame_rate_hz = 60});
  Take after = before;
  after.rotation(20, 5) = after.rotation(20, 5) * exp({0.1, 0, 0});
  const TrackCurves curves = rotation_curves(before, after, 5);
  EXPECT_EQ(curves.name, before.skeleton.names[5]);
  EXPECT_EQ(curves.unit, "deg");
  const RotationOrder order = before.skeleton.rotation_order(5);
  ASSERT_EQ(curves.axes.size(), order.count);
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    std::array<double, 3> angles{};
    for (std::size_t a = 0; a < order.count; ++a)
      angles[a] = curves.after[a][f] * radians_per_degree;
    EXPECT_LT(angle_between(from_euler(angles, order), after.rotation(f, 5)), 1e-9) << f;
    EXPECT_NEAR(curves.difference[f], f == 20 ? 0.1 * degrees_per_radian : 0, 1e-5) << f;
  }
}

TEST(Curves, OfRotationsHaveNoWholeTurnsInThem) {
  Take clip = synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = 60});
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.rotation(f, 0) = exp({0, 0.1 * static_cast<double>(f), 0});
  const TrackCurves curves = rotation_curves(clip, clip, 0);
  double largest = 0;
  for (const std::vector<double>& curve : curves.before) {
    for (std::size_t f = 1; f < curve.size(); ++f)
      largest = std::max(largest, std::fabs(curve[f] - curve[f - 1]));
  }
  EXPECT_LT(largest, 0.1 * degrees_per_radian + 1e-6);
}

TEST(Curves, OfMarkersBreakWhereTheyAreMissing) {
  const Take after = markers();
  Take before = after;
  for (std::size_t f = 40; f < 50; ++f) before.observed[2 * f] = 0;
  const TrackCurves curves = marker_curves(before, after, 0);
  EXPECT_THAT(curves.axes, ElementsAre("X", "Y", "Z"));
  EXPECT_TRUE(std::isnan(curves.before[0][45]));
  EXPECT_FALSE(std::isnan(curves.after[0][45]));
  EXPECT_TRUE(std::isnan(curves.difference[45]));
  EXPECT_EQ(curves.difference[50], 0);
  const std::string svg = curves_svg(curves);
  EXPECT_THAT(svg, testing::StartsWith("<svg "));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(svg, HasSubstr(">A, mm</text>"));
  EXPECT_THAT(svg, HasSubstr(">120</text>")) << "frames as the file counts them";
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(test::count_of(svg, "<g"), test::count_of(svg, "</g>"));
}

TEST(Curves, OfAPartShowItsFrames) {
  const std::string late = curves_svg(marker_curves(markers(), markers(), 0), {.first_frame = 50});
  EXPECT_THAT(late, HasSubstr(">160</text>"));
  EXPECT_THAT(late, Not(HasSubstr(">120</text>")));
}

TEST(Curves, OfAnyLengthAreDrawn) {
  TrackCurves curves = marker_curves(markers(), markers(), 1);
  EXPECT_THAT(curves_svg(curves), HasSubstr("B&lt;&amp;&gt;"));
  for (const std::size_t frames : {0, 1, 2, 200000}) {
    for (auto* axes : {&curves.before, &curves.after}) {
      for (auto& curve : *axes) curve.assign(frames, 1);
    }
    curves.difference.assign(frames, 0);
    if (frames > 1000) curves.before[0][777] = 50;
    const std::string svg = curves_svg(curves);
    EXPECT_LT(svg.size(), 300000U) << frames;
    EXPECT_THAT(svg, Not(HasSubstr("nan"))) << frames;
    EXPECT_THAT(svg, Not(HasSubstr("inf"))) << frames;
  }
}

TEST(Curves, OfTakesOfDifferentLengthAreRefused) {
  const Take all = markers();
  EXPECT_THROW(marker_curves(all, slice(all, 0, 50), 0), Error);
  EXPECT_THROW(marker_curves(all, all, 2), Error);
}

TEST(Svg, EscapesWhatXmlCannotHold) {
  EXPECT_EQ(xml_escaped("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_EQ(xml_escaped("Bra\xE7o"), "Bra\uFFFDo");
  EXPECT_EQ(xml_escaped("M\xC3\xBCller \xE9\xAA\xA8"), "M\xC3\xBCller \xE9\xAA\xA8");
  EXPECT_EQ(xml_escaped(std::string("a\0b\x1b", 4)), "a\uFFFDb\uFFFD");
  EXPECT_EQ(xml_escaped("\xE9\xAA"), "\uFFFD\uFFFD");
}

}  // namespace
}  // namespace kinemend::test
