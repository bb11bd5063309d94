// Tests of curves through gaps, against SciPy's splines and PCHIP.
#include "fill/curves.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "fill/natural_spline.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend::fill {
namespace {

using testing::Each;
using testing::Pointwise;

MATCHER_P(NearTo, tolerance, "") {
  return std::fabs(std::get<0>(arg) - std::get<1>(arg)) <= tolerance;
}

// Reference values from SciPy, made by tools/reference/gap_curves.py.
const std::vector<double>& reference(const std::string& name) {
  static const auto records = [] {
    std::map<std::string, std::vector<double>> result;
    for (const auto& row : test::read_csv("fill/curves.csv")) {
      for (std::size_t i = 1; i < row.size(); ++i) result[row[0]].push_back(std::stod(row[i]));
    }
    return result;
  }();
  return records.at(name);
}

constexpr FrameSpan reference_gap{70, 94};
constexpr CurveSettings settings{.frame_rate_hz = 120};
constexpr std::array curves = {Curve::linear, Curve::cubic, Curve::quintic, Curve::shape_preserving,
                               Curve::hermite};

// Puts the values along x.
Track track_along_x(const std::vector<double>& x, std::vector<std::uint8_t> observed) {
  Track track{{}, std::move(observed)};
  for (const double value : x) track.values.push_back({value, 0, 0});
  return track;
}

Track reference_samples() {
  std::vector<double> values = reference("input");
  std::vector<std::uint8_t> observed;
  for (std::size_t f = 0; f < values.size(); ++f) {
    observed.push_back(reference("missing")[f] == 0);
    if (!observed[f]) values[f] = 1e6;  // values in a gap must be ignored
  }
  return track_along_x(values, observed);
}

std::vector<double> x_in(const Track& track, FrameSpan span) {
  std::vector<double> x;
  for (const Vec3 v : values_in(track, span)) x.push_back(v.x);
  return x;
}

std::vector<double> filled(Track track, FrameSpan span, Curve curve) {
  EXPECT_TRUE(fill_with_curve(track, span, curve, settings));
  return x_in(track, span);
}

template <class Function>
Track sampled(std::size_t frames, FrameSpan span, Function function) {
  Track track;
  for (std::size_t f = 0; f < frames; ++f) {
    track.values.push_back({function(static_cast<double>(f)), 0, 0});
    track.observed.push_back(f < span.first || f > span.last);
  }
  return track;
}

TEST(Curves, CubicIsSciPysNaturalSpline) {
  EXPECT_THAT(filled(reference_samples(), reference_gap, Curve::cubic),
              Pointwise(NearTo(1e-10), reference("cubic")));
}

TEST(Curves, ShapePreservingIsSciPysPchip) {
  EXPECT_THAT(filled(reference_samples(), reference_gap, Curve::shape_preserving),
              Pointwise(NearTo(1e-12), reference("pchip")));
  for (const FrameSpan span :
       {FrameSpan{66, 66}, FrameSpan{99, 99}, FrameSpan{120, 120}, FrameSpan{130, 132}}) {
    const auto values = filled(reference_samples(), span, Curve::shape_preserving);
    for (std::size_t f = span.first; f <= span.last; ++f) {
      EXPECT_NEAR(values[f - span.first], reference("pchip_all")[f], 1e-12) << f;
    }
  }
}

TEST(Curves, ShapePreservingHasSciPysSlopesAtTheOutermostSamples) {
  Track samples =
      track_along_x({1, 0, 0, 0, 0, 0, 0, 0, 0, 4, 4.5}, {1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1});
  EXPECT_THAT(filled(samples, {1, 8}, Curve::shape_preserving),
              Pointwise(NearTo(1e-12), reference("pchip_ends")));
  const Track mirrored =
      track_along_x({4.5, 4, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1});
  auto values = filled(mirrored, {2, 9}, Curve::shape_preserving);
  std::reverse(values.begin(), values.end());
  EXPECT_THAT(values, Pointwise(NearTo(1e-12), reference("pchip_ends")));
  samples.values.back().x = 1;
  EXPECT_THAT(filled(samples, {1, 8}, Curve::shape_preserving),
              Pointwise(NearTo(1e-12), reference("pchip_ends_turning")));
}

NaturalSpline reference_spline(int half_order) {
  Track samples = reference_samples();
  std::vector<double> knots, values;
  for (std::size_t f = 0; f < samples.observed.size(); ++f) {
    if (!samples.observed[f]) continue;
    knots.push_back(static_cast<double>(f));
    values.push_back(samples.values[f].x);
  }
  return {half_order, knots, values, 1};
}

// The values at the knots and in the gap, in the order of the fixture.
std::vector<double> values_of(const NaturalSpline& spline) {
  std::vector<double> values;
  const auto& missing = reference("missing");
  for (std::size_t f = 0, knot = 0; f < missing.size(); ++f) {
    if (missing[f] == 0) values.push_back(spline.knot_values(knot++)[0]);
  }
  for (std::size_t f = reference_gap.first; f <= reference_gap.last; ++f) {
    double value = 0;
    spline.evaluate(static_cast<double>(f), {&value, 1});
    values.push_back(value);
  }
  return values;
}

TEST(NaturalSpline, OfFifthDegreeInterpolatesAsSciPy) {
  NaturalSpline spline = reference_spline(3);
  spline.fit(0);
  for (std::size_t f = reference_gap.first; f <= reference_gap.last; ++f) {
    double value = 0;
    spline.evaluate(static_cast<double>(f), {&value, 1});
    EXPECT_NEAR(value, reference("quintic")[f - reference_gap.first], 1e-8) << f;
  }
}

TEST(NaturalSpline, SmoothsAsSciPy) {
  for (const char* smoothing : {"0.5", "30.0", "5000.0"}) {
    NaturalSpline cubic = reference_spline(2);
    cubic.fit(std::stod(smoothing));
    EXPECT_THAT(values_of(cubic),
                Pointwise(NearTo(1e-8), reference(std::string("smoothing_cubic/") + smoothing)));
    NaturalSpline quintic = reference_spline(3);
    quintic.fit(std::stod(smoothing));
    EXPECT_THAT(values_of(quintic),
                Pointwise(NearTo(1e-7), reference(std::string("smoothing_quintic/") + smoothing)));
    const double score = reference(std::string("cross_validation/") + smoothing)[0];
    EXPECT_NEAR(quintic.cross_validation_score(), score, 1e-6 * score);
  }
}

TEST(NaturalSpline, CrossValidationFindsTheLeastScore) {
  NaturalSpline spline = reference_spline(3);
  spline.fit_by_cross_validation(1e-4, 1e6);
  const double least = spline.cross_validation_score();
  for (double smoothing = 1e-4; smoothing < 1e6; smoothing *= 1.3) {
    spline.fit(smoothing);
    EXPECT_GE(spline.cross_validation_score(), least * (1 - 1e-4)) << smoothing;
  }
}

TEST(NaturalSpline, EvaluatesInEveryInterval) {
  // With m = 3, smoothing leaves a parabola unchanged at every place and strength.
  const std::vector<double> knots = {0, 1, 3, 4, 9, 10};
  std::vector<double> values;
  for (const double x : knots) values.push_back(2 - x + 0.5 * x * x);
  NaturalSpline spline(3, knots, values, 1);
  for (const double smoothing : {0.0, 10.0}) {
    spline.fit(smoothing);
    for (double x = 0; x <= 10; x += 0.25) {
      double value = 0;
      spline.evaluate(x, {&value, 1});
      EXPECT_NEAR(value, 2 - x + 0.5 * x * x, 1e-9) << x;
    }
  }
}

TEST(Curves, MeetTheirEndsInValueAndVelocity) {
  const FrameSpan span{100, 139};
  const auto motion = [](double f) { return 40 * std::sin(0.05 * f) + 0.3 * f; };
  for (const Curve curve : {Curve::cubic, Curve::quintic, Curve::hermite}) {
    Track samples = sampled(240, span, motion);
    ASSERT_TRUE(fill_with_curve(samples, span, curve, settings));
    const auto second = [&](std::size_t f) {
      return samples.values[f - 1].x - 2 * samples.values[f].x + samples.values[f + 1].x;
    };
    // The motion's own second differences are below 0.1; a jump or kink would exceed 0.3.
    for (const std::size_t f : {99u, 100u, 139u, 140u}) {
      EXPECT_LT(std::fabs(second(f)), 0.3) << static_cast<int>(curve) << " at " << f;
    }
  }
}

TEST(Curves, FillAStraightLineWithItself) {
  const FrameSpan span{40, 59};
  for (const Curve curve : curves) {
    const auto line = [](double f) { return 3 - 0.25 * f; };
    const auto values = filled(sampled(120, span, line), span, curve);
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i], line(40 + static_cast<double>(i)), 1e-9) << static_cast<int>(curve);
    }
  }
}

TEST(Curves, ShapePreservingNeverOvershoots) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    Track samples = sampled(60, {20, 39}, [&](double) { return random.normal(); });
    const double a = samples.values[19].x, b = samples.values[40].x;
    const auto values = filled(samples, {20, 39}, Curve::shape_preserving);
    ASSERT_EQ(values.size(), 20u);
    for (const double value : values) {
      EXPECT_GE(value, std::min(a, b) - 1e-12);
      EXPECT_LE(value, std::max(a, b) + 1e-12);
    }
  }
}

TEST(Curves, QuinticIsNotThrownByNoiseAtTheEnds) {
  const FrameSpan span{150, 179};
  const auto motion = [](double f) { return 100 * std::sin(0.04 * f); };
  double quintic = 0, interpolating = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const auto noisy = [&](double f) { return motion(f) + 0.5 * random.normal(); };
    const Track samples = sampled(330, span, noisy);
    const auto smooth = filled(samples, span, Curve::quintic);
    const auto through = filled(samples, span, Curve::cubic);
    for (std::size_t i = 0; i < smooth.size(); ++i) {
      const double truth = motion(150 + static_cast<double>(i));
      quintic += std::pow(smooth[i] - truth, 2);
      interpolating += std::pow(through[i] - truth, 2);
    }
  }
  // Root mean square below four times the noise; the spline through the noisy ends is far worse.
  EXPECT_LT(std::sqrt(quintic / 600), 2.0);
  EXPECT_GT(interpolating, 4 * quintic);
}

TEST(Curves, EndVelocitiesAreNotThrownByASpike) {
  const FrameSpan span{60, 79};
  Track samples = sampled(150, span, [](double f) { return 2 * f; });
  samples.values[56].x += 50;
  const EndState state = state_before(samples, span, settings);
  EXPECT_TRUE(state.known);
  EXPECT_DOUBLE_EQ(state.value.x, 118);
  EXPECT_NEAR(state.velocity.x, 2, 0.05);
}

TEST(Curves, CoastAtTheEndsOfATakeWithAVelocityThatDecays) {
  const auto line = [](double f) { return 5 + 2 * f; };
  const double decay = settings.decay_s * settings.frame_rate_hz;
  const auto behind = filled(sampled(200, {100, 199}, line), {100, 199}, Curve::cubic);
  EXPECT_NEAR(behind[0] - line(99), 2 * decay * (1 - std::exp(-1 / decay)), 1e-9);
  EXPECT_NEAR(behind[99], line(99) + 2 * decay, 0.2);
  const auto before = filled(sampled(200, {0, 99}, line), {0, 99}, Curve::hermite);
  EXPECT_NEAR(line(100) - before[99], 2 * decay * (1 - std::exp(-1 / decay)), 1e-9);
  EXPECT_THAT(filled(sampled(200, {100, 199}, line), {100, 199}, Curve::linear), Each(line(99)));
}

TEST(Curves, RefuseATrackWithoutSamples) {
  for (const Curve curve : curves) {
    Track samples = sampled(10, {0, 9}, [](double) { return 7.0; });
    EXPECT_FALSE(fill_with_curve(samples, {0, 9}, curve, settings));
    EXPECT_THAT(samples.values, Each(Vec3{7, 0, 0}));
  }
}

TEST(Curves, FillBetweenSingleSamples) {
  for (const Curve curve : curves) {
    Track samples = track_along_x({0, 9, 9, 3}, {1, 0, 0, 1});
    ASSERT_TRUE(fill_with_curve(samples, {1, 2}, curve, settings));
    EXPECT_NEAR(samples.values[1].x, 0.777777, 0.3) << static_cast<int>(curve);
    EXPECT_NEAR(samples.values[2].x, 2.222222, 0.3) << static_cast<int>(curve);
  }
}

TEST(Curves, FillEveryComponentByItself) {
  const FrameSpan span{30, 49};
  for (const Curve curve : curves) {
    const Track one = sampled(100, span, [](double f) { return std::sin(0.1 * f); });
    const Track other = sampled(100, span, [](double f) { return std::cos(0.07 * f); });
    Track both = one;
    for (std::size_t f = 0; f < 100; ++f) both.values[f].y = other.values[f].x;
    ASSERT_TRUE(fill_with_curve(both, span, curve, settings));
    // Quintic chooses one smoothing for all components.
    const double tolerance = curve == Curve::quintic ? 1e-3 : 1e-12;
    const auto first = filled(one, span, curve), second = filled(other, span, curve);
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_NEAR(both.values[span.first + i].x, first[i], tolerance);
      EXPECT_NEAR(both.values[span.first + i].y, second[i], tolerance);
    }
  }
}

TEST(PlaceGuess, MovesAGuessToItsEnds) {
  const FrameSpan span{100, 159};
  const auto motion = [](double f) { return 10 * std::sin(0.06 * f); };
  Track samples = sampled(260, span, motion);
  Guess guess{80, {}};
  for (std::size_t f = 80; f < 180; ++f) {
    guess.values.push_back(
        {motion(static_cast<double>(f)) + 3 + 0.05 * static_cast<double>(f), 0, 0});
  }
  place_guess(samples, span, guess, settings);
  // The offset and drift at the ends are removed.
  for (std::size_t f = span.first; f <= span.last; ++f) {
    EXPECT_NEAR(samples.values[f].x, motion(static_cast<double>(f)), 1e-9) << f;
  }
}

TEST(PlaceGuess, MeetsValueAndVelocityOfAnyGuess) {
  const FrameSpan span{100, 159};
  Track samples = sampled(260, span, [](double f) { return f < 130 ? f : 200 - f; });
  const Guess guess{80, std::vector<Vec3>(100, {4, 0, 0})};
  place_guess(samples, span, guess, settings);
  // The steps over the ends match those of the neighbouring samples, except for the fading.
  EXPECT_NEAR(samples.values[100].x - samples.values[99].x, 1, 0.35);
  EXPECT_NEAR(samples.values[160].x - samples.values[159].x, -1, 0.35);
}

TEST(PlaceGuess, MeetsOnlyTheSideThatThereIs) {
  const FrameSpan span{50, 79};
  Track samples = sampled(80, span, [](double) { return 12.0; });
  place_guess(samples, span, {30, std::vector<Vec3>(50, {4, 0, 0})}, settings);
  for (std::size_t f = span.first; f <= span.last; ++f) EXPECT_NEAR(samples.values[f].x, 12, 1e-9);
}

}  // namespace
}  // namespace kinemend::fill
