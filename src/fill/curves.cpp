// Fills spans by lines, splines, PCHIP and Hermite curves, with robust velocities at their ends.
#include "fill/curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "fill/natural_spline.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::fill {

namespace {

// Not swept. A quintic spline forgets a sample at 2e-18 of its value over this support.
constexpr std::size_t least_support = 48;
// With fewer samples a spline interpolates, and a line is fitted without outlier rejection. Not
// swept.
constexpr std::size_t least_to_smooth = 12, least_robust = 5;
// Huber's usual constant, in standard deviations; the rounds are not swept.
constexpr double huber = 1.5 * deviations_per_median;
constexpr int huber_rounds = 4;

double to_frames(double seconds, const CurveSettings& settings) {
  return seconds * settings.frame_rate_hz;
}

template <class Function>
Vec3 by_component(const Function& function) {
  return {function(&Vec3::x), function(&Vec3::y), function(&Vec3::z)};
}

// Returns the distance of a frame from the last one before the span, in frames.
double from_start(FrameSpan span, std::size_t frame) {
  return static_cast<double>(frame - span.first + 1);
}
double steps_across(FrameSpan span) { return static_cast<double>(span.length() + 1); }

enum class Side : std::uint8_t { before, behind };

// Up to `most` observed frames on one side of `frame` (not included), ascending.
std::vector<std::size_t> observed_on(const Track& track, Side side, std::size_t frame,
                                     std::size_t most) {
  const bool before = side == Side::before;
  const std::size_t room = before ? frame : track.frames() - 1 - frame;
  std::vector<std::size_t> found;
  for (std::size_t k = 1; k <= room && found.size() < most; ++k) {
    const std::size_t f = before ? frame - k : frame + k;
    if (track.observed[f]) found.push_back(f);
  }
  if (before) std::reverse(found.begin(), found.end());
  return found;
}

// Returns the slope of the weighted least-squares line and writes what remains to `residuals`.
double fitted_slope(std::span<const double> u, std::span<const double> y, std::span<const double> w,
                    std::span<double> residuals) {
  double weight = 0, mean_u = 0, mean_y = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    weight += w[i];
    mean_u += w[i] * u[i];
    mean_y += w[i] * y[i];
  }
  mean_u /= weight;
  mean_y /= weight;
  double spread = 0, product = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    spread += w[i] * (u[i] - mean_u) * (u[i] - mean_u);
    product += w[i] * (u[i] - mean_u) * (y[i] - mean_y);
  }
  const double slope = product / spread;
  for (std::size_t i = 0; i < u.size(); ++i) residuals[i] = y[i] - mean_y - slope * (u[i] - mean_u);
  return slope;
}

// Returns a slope with Huber's weights, by iterated least squares scaled by the median deviation.
double robust_slope(std::span<const double> u, std::span<const double> y) {
  if (u.size() < 2) return 0;
  std::vector<double> weights(u.size(), 1.0), residuals(u.size()), sizes(u.size());
  double slope = fitted_slope(u, y, weights, residuals);
  for (int round = 0; round < huber_rounds && u.size() >= least_robust; ++round) {
    std::transform(residuals.begin(), residuals.end(), sizes.begin(),
                   [](double r) { return std::fabs(r); });
    const double limit = huber * upper_median_of(sizes);
    if (!(limit > 0)) break;
    for (std::size_t i = 0; i < u.size(); ++i) {
      weights[i] = std::fabs(residuals[i]) <= limit ? 1.0 : limit / std::fabs(residuals[i]);
    }
    slope = fitted_slope(u, y, weights, residuals);
  }
  return slope;
}

// The state uses observed frames no farther from the end than two windows.
EndState state_on(const Track& track, Side side, FrameSpan span, const CurveSettings& settings) {
  const bool before = side == Side::before;
  if (before ? span.first == 0 : span.last + 1 == track.frames()) return {};
  const std::size_t window = velocity_window(settings);
  const std::size_t end = before ? span.first - 1 : span.last + 1;
  std::vector<std::size_t> frames =
      observed_on(track, side, before ? span.first : span.last, window);
  std::erase_if(frames,
                [&](std::size_t f) { return std::max(f, end) - std::min(f, end) > 2 * window; });
  std::vector<double> u, y(frames.size());
  for (const std::size_t f : frames) {
    u.push_back((static_cast<double>(f) - static_cast<double>(end)) / static_cast<double>(window));
  }
  const Vec3 velocity = by_component([&](double Vec3::*c) {
    for (std::size_t i = 0; i < frames.size(); ++i) y[i] = track.values[frames[i]].*c;
    return robust_slope(u, y) / static_cast<double>(window);
  });
  return {true, track.values[end], velocity};
}

// Returns the value `u` frames beyond an end whose velocity decays.
Vec3 coast(Vec3 value, Vec3 velocity, double u, double decay_frames) {
  const double reached = 1 - portable::exp(-u / decay_frames);
  return value + reached * (decay_frames * velocity);
}

double decay_frames(const CurveSettings& settings) {
  return std::max(1.0, to_frames(settings.decay_s, settings));
}

void fill_one_sided(Track& track, FrameSpan span, bool keep_velocity,
                    const CurveSettings& settings) {
  const bool forward = span.first > 0;
  const EndState end =
      forward ? state_before(track, span, settings) : state_behind(track, span, settings);
  const Vec3 velocity = keep_velocity ? (forward ? 1.0 : -1.0) * end.velocity : Vec3{};
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double u = forward ? from_start(span, f) : static_cast<double>(span.last + 1 - f);
    track.values[f] = coast(end.value, velocity, u, decay_frames(settings));
  }
}

// Returns the displacement that a velocity of 1 at the end causes `u` frames away; it is 0 from
// `reach` frames on. On a gap of length `reach` the line between its ends and both fading
// velocities form the cubic Hermite.
double fading(double u, double reach) {
  return u < reach ? u * (1 - u / reach) * (1 - u / reach) : 0.0;
}

// The straight line between two ends, corrected to meet the velocity at either end.
struct Crossing {
  double length = 0, reach = 0;
  Vec3 value(const EndState& before, const EndState& behind, double u) const {
    const Vec3 slope =
        by_component([&](double Vec3::*c) { return (behind.value.*c - before.value.*c) / length; });
    return before.value + u * slope + fading(u, reach) * (before.velocity - slope) -
           fading(length - u, reach) * (behind.velocity - slope);
  }
};

Crossing crossing_of(FrameSpan span, double reach_s, const CurveSettings& settings) {
  const double length = steps_across(span);
  return {length, std::min(length, std::max(2.0, to_frames(reach_s, settings)))};
}

void fill_between_velocities(Track& track, FrameSpan span, const CurveSettings& settings) {
  const EndState before = state_before(track, span, settings);
  const EndState behind = state_behind(track, span, settings);
  const Crossing crossing = crossing_of(span, settings.reach_s, settings);
  for (std::size_t f = span.first; f <= span.last; ++f) {
    track.values[f] = crossing.value(before, behind, from_start(span, f));
  }
}

// PCHIP's slope at a knot between two intervals: 0 at an extremum, otherwise the weighted harmonic
// mean.
double inner_slope(double h0, double slope0, double h1, double slope1) {
  if (slope0 * slope1 <= 0) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / slope0 + w1 / slope1);
}

// PCHIP's slope at the outermost knot: from three points, limited so that the curve keeps its
// shape.
double outer_slope(double h0, double slope0, double h1, double slope1) {
  const double slope = ((2 * h0 + h1) * slope0 - h0 * slope1) / (h0 + h1);
  if (slope * slope0 <= 0) return 0;
  if (slope0 * slope1 <= 0 && std::fabs(slope) > 3 * std::fabs(slope0)) return 3 * slope0;
  return slope;
}

// A cubic Hermite curve; slopes are per frame.
double hermite(double y0, double slope0, double y1, double slope1, double length, double u) {
  const double t = u / length, s = 1 - t;
  return y0 * s * s * (1 + 2 * t) + y1 * t * t * (1 + 2 * s) +
         length * t * s * (slope0 * s - slope1 * t);
}

void fill_shape_preserving(Track& track, FrameSpan span) {
  const std::size_t left = span.first - 1, right = span.last + 1;
  const auto before = observed_on(track, Side::before, left, 1);
  const auto behind = observed_on(track, Side::behind, right, 1);
  const double length = steps_across(span);
  const double h0 = before.empty() ? 0 : static_cast<double>(left - before[0]);
  const double h1 = behind.empty() ? 0 : static_cast<double>(behind[0] - right);
  for (double Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    const auto secant = [&](std::size_t from, std::size_t to) {
      return (track.values[to].*c - track.values[from].*c) / static_cast<double>(to - from);
    };
    const double middle = secant(left, right);
    const double outer0 = before.empty() ? 0 : secant(before[0], left);
    const double outer1 = behind.empty() ? 0 : secant(right, behind[0]);
    double slope0 = middle, slope1 = middle;
    if (!before.empty()) {
      slope0 = inner_slope(h0, outer0, length, middle);
    } else if (!behind.empty()) {
      slope0 = outer_slope(length, middle, h1, outer1);
    }
    if (!behind.empty()) {
      slope1 = inner_slope(length, middle, h1, outer1);
    } else if (!before.empty()) {
      slope1 = outer_slope(length, middle, h0, outer0);
    }
    for (std::size_t f = span.first; f <= span.last; ++f) {
      track.values[f].*c = hermite(track.values[left].*c, slope0, track.values[right].*c, slope1,
                                   length, from_start(span, f));
    }
  }
}

void fill_linear(Track& track, FrameSpan span) {
  const Vec3 before = track.values[span.first - 1], behind = track.values[span.last + 1];
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t = from_start(span, f) / steps_across(span);
    track.values[f] = (1 - t) * before + t * behind;
  }
}

// Smoothing leaves the end samples slightly off the curve. The offset is blended from one end to
// the other with zero slope at the ends, which keeps the velocities.
void meet_end_values(Track& track, FrameSpan span, Vec3 miss_before, Vec3 miss_behind) {
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t = from_start(span, f) / steps_across(span);
    const double behind = smooth_step(t);
    track.values[f] += (1 - behind) * miss_before + behind * miss_behind;
  }
}

void fill_spline(Track& track, FrameSpan span, bool quintic, const CurveSettings& settings) {
  const std::size_t support = frames_in(settings.support_s, settings.frame_rate_hz, least_support);
  std::vector<std::size_t> frames = observed_on(track, Side::before, span.first, support);
  const std::size_t left = frames.size() - 1;
  const auto behind = observed_on(track, Side::behind, span.last, support);
  frames.insert(frames.end(), behind.begin(), behind.end());
  const int half_order = quintic ? 3 : 2;
  if (frames.size() < static_cast<std::size_t>(half_order) + 1) return fill_linear(track, span);

  const auto knot_of = [&](std::size_t f) {
    return static_cast<double>(f) - static_cast<double>(span.first);
  };
  std::vector<double> knots, values;
  for (const std::size_t f : frames) {
    const Vec3 v = track.values[f];
    knots.push_back(knot_of(f));
    values.insert(values.end(), {v.x, v.y, v.z});
  }
  NaturalSpline spline(half_order, std::move(knots), values, 3);
  if (quintic && frames.size() >= least_to_smooth) {
    // A spline smoothed by s halves the amplitude of a wave of w radians a frame where s w^6 = 1.
    const auto smoothing_of = [&](double cutoff_hz) {
      return portable::pow(2 * pi * cutoff_hz / settings.frame_rate_hz, -6);
    };
    spline.fit_by_cross_validation(smoothing_of(settings.most_cutoff_hz),
                                   smoothing_of(settings.least_cutoff_hz));
  } else {
    spline.fit(0);
  }
  const auto vector_of = [](std::span<const double> v) { return Vec3{v[0], v[1], v[2]}; };
  std::array<double, 3> value{};
  for (std::size_t f = span.first; f <= span.last; ++f) {
    spline.evaluate(knot_of(f), value);
    track.values[f] = vector_of(value);
  }
  meet_end_values(track, span, track.values[span.first - 1] - vector_of(spline.knot_values(left)),
                  track.values[span.last + 1] - vector_of(spline.knot_values(left + 1)));
}

}  // namespace

std::size_t velocity_window(const CurveSettings& settings) {
  return frames_in(settings.velocity_window_s, settings.frame_rate_hz, least_robust);
}

EndState state_before(const Track& track, FrameSpan span, const CurveSettings& settings) {
  return state_on(track, Side::before, span, settings);
}

EndState state_behind(const Track& track, FrameSpan span, const CurveSettings& settings) {
  return state_on(track, Side::behind, span, settings);
}

bool fill_with_curve(Track& track, FrameSpan span, Curve curve, const CurveSettings& settings) {
  const bool before = span.first > 0, behind = span.last + 1 < track.frames();
  if (!before && !behind) return false;
  if (!before || !behind) {
    fill_one_sided(track, span, curve != Curve::linear, settings);
    return true;
  }
  switch (curve) {
    case Curve::linear:
      fill_linear(track, span);
      break;
    case Curve::cubic:
    case Curve::quintic:
      fill_spline(track, span, curve == Curve::quintic, settings);
      break;
    case Curve::shape_preserving:
      fill_shape_preserving(track, span);
      break;
    case Curve::hermite:
      fill_between_velocities(track, span, settings);
      break;
  }
  return true;
}

void place_guess(Track& track, FrameSpan span, const Guess& guess, const CurveSettings& settings) {
  // The difference between samples and guess is a track of its own, observed where the guess is.
  const std::size_t from = guess.first_frame, count = guess.values.size();
  Track misses{std::vector<Vec3>(count), std::vector<std::uint8_t>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    if (!track.observed[from + i]) continue;
    misses.observed[i] = 1;
    misses.values[i] = track.values[from + i] - guess.values[i];
  }
  const FrameSpan inner{span.first - from, span.last - from};
  const EndState before = state_before(misses, inner, settings);
  const EndState behind = state_behind(misses, inner, settings);
  const Crossing crossing = crossing_of(span, settings.blend_s, settings);
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double u = from_start(span, f);
    Vec3 miss;
    if (before.known && behind.known) {
      miss = crossing.value(before, behind, u);
    } else if (before.known) {
      miss = coast(before.value, before.velocity, u, decay_frames(settings));
    } else if (behind.known) {
      miss = coast(behind.value, -behind.velocity, crossing.length - u, decay_frames(settings));
    }
    track.values[f] = guess.values[f - from] + miss;
  }
}

}  // namespace kinemend::fill
