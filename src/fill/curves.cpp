#include "fill/curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/quantiles.hpp"
#include "fill/natural_spline.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend::fill {

namespace {

constexpr std::size_t least_support = 48;  // a quintic spline forgets a sample at 2e-18 of it

double to_frames(double seconds, const CurveSettings& settings) {
  return seconds * settings.frame_rate_hz;
}

bool has_sample_before(FrameSpan span) { return span.first > 0; }
bool has_sample_behind(const Track& track, FrameSpan span) {
  return span.last + 1 < track.frames();
}

// Up to `most` observed frames before `frame` (not included), ascending.
std::vector<std::size_t> observed_before(const Track& track, std::size_t frame, std::size_t most) {
  std::vector<std::size_t> found;
  for (std::size_t f = frame; f-- > 0 && found.size() < most;) {
    if (track.observed[f]) found.push_back(f);
  }
  std::reverse(found.begin(), found.end());
  return found;
}

std::vector<std::size_t> observed_behind(const Track& track, std::size_t frame, std::size_t most) {
  std::vector<std::size_t> found;
  for (std::size_t f = frame + 1; f < track.frames() && found.size() < most; ++f) {
    if (track.observed[f]) found.push_back(f);
  }
  return found;
}

// Slope of the line with the least weighted squares; what it leaves in `residuals`.
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

// Huber's weights, by iterated least squares about the median deviation.
double robust_slope(std::span<const double> u, std::span<const double> y) {
  constexpr int rounds = 4;
  constexpr double huber = 1.5 * deviations_per_median;
  if (u.size() < 2) return 0;
  std::vector<double> weights(u.size(), 1.0), residuals(u.size()), sizes(u.size());
  double slope = fitted_slope(u, y, weights, residuals);
  for (int round = 0; round < rounds && u.size() >= 5; ++round) {
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

// State at `end` from observed frames at one side of a span, no farther than the window.
EndState state_at(const Track& track, std::size_t end, const std::vector<std::size_t>& frames,
                  double window) {
  EndState state;
  state.known = true;
  state.value.assign(track.row(end).begin(), track.row(end).end());
  std::vector<double> u, y(frames.size());
  for (const std::size_t f : frames) {
    u.push_back((static_cast<double>(f) - static_cast<double>(end)) / window);
  }
  for (std::size_t c = 0; c < track.channels; ++c) {
    for (std::size_t i = 0; i < frames.size(); ++i) y[i] = track.row(frames[i])[c];
    state.velocity.push_back(robust_slope(u, y) / window);
  }
  return state;
}

std::size_t velocity_window(const CurveSettings& settings) {
  return std::max<std::size_t>(
      5, static_cast<std::size_t>(std::lround(to_frames(settings.velocity_window_s, settings))));
}

// u frames beyond an end whose velocity decays.
double coast(double value, double velocity, double u, double decay_frames) {
  return value + velocity * decay_frames * (1 - std::exp(-u / decay_frames));
}

void fill_one_sided(const Track& track, FrameSpan span, bool keep_velocity,
                    const CurveSettings& settings) {
  const bool forward = has_sample_before(span);
  const EndState end =
      forward ? state_before(track, span, settings) : state_behind(track, span, settings);
  const double decay = std::max(1.0, to_frames(settings.decay_s, settings));
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double u =
        forward ? static_cast<double>(f - span.first + 1) : static_cast<double>(span.last + 1 - f);
    for (std::size_t c = 0; c < track.channels; ++c) {
      const double velocity = keep_velocity ? (forward ? 1 : -1) * end.velocity[c] : 0.0;
      track.row(f)[c] = coast(end.value[c], velocity, u, decay);
    }
  }
}

// Cubic Hermite: slopes per frame.
double hermite(double y0, double slope0, double y1, double slope1, double length, double u) {
  const double t = u / length, s = 1 - t;
  return y0 * s * s * (1 + 2 * t) + y1 * t * t * (1 + 2 * s) +
         length * t * s * (slope0 * s - slope1 * t);
}

struct Slopes {
  std::vector<double> before, behind;
};

void fill_hermite(const Track& track, FrameSpan span, const Slopes& slopes) {
  const std::span<const double> y0 = track.row(span.first - 1), y1 = track.row(span.last + 1);
  const auto length = static_cast<double>(span.length() + 1);
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const auto u = static_cast<double>(f - span.first + 1);
    for (std::size_t c = 0; c < track.channels; ++c) {
      track.row(f)[c] = hermite(y0[c], slopes.before[c], y1[c], slopes.behind[c], length, u);
    }
  }
}

// A velocity of 1 at the end u frames away, which has faded after `reach` frames. On a gap of that
// length the line between its ends and both fading velocities make the cubic Hermite.
double fading(double u, double reach) {
  return u < reach ? u * (1 - u / reach) * (1 - u / reach) : 0.0;
}

// The straight line between two ends, left and reached with their velocities.
struct Crossing {
  double length = 0, reach = 0;
  double value(double y0, double v0, double y1, double v1, double u) const {
    const double slope = (y1 - y0) / length;
    return y0 + slope * u + (v0 - slope) * fading(u, reach) -
           (v1 - slope) * fading(length - u, reach);
  }
};

Crossing crossing_of(FrameSpan span, double reach_s, const CurveSettings& settings) {
  const auto length = static_cast<double>(span.length() + 1);
  return {length, std::min(length, std::max(2.0, to_frames(reach_s, settings)))};
}

void fill_between_velocities(const Track& track, FrameSpan span, const CurveSettings& settings) {
  const EndState before = state_before(track, span, settings);
  const EndState behind = state_behind(track, span, settings);
  const Crossing crossing = crossing_of(span, settings.reach_s, settings);
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const auto u = static_cast<double>(f - span.first + 1);
    for (std::size_t c = 0; c < track.channels; ++c) {
      track.row(f)[c] = crossing.value(before.value[c], before.velocity[c], behind.value[c],
                                       behind.velocity[c], u);
    }
  }
}

// PCHIP's slope at a knot between two intervals: 0 at an extremum, else the weighted harmonic mean.
double inner_slope(double h0, double slope0, double h1, double slope1) {
  if (slope0 * slope1 <= 0) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / slope0 + w1 / slope1);
}

// Its slope at the outermost knot: three points, limited so that the curve keeps its shape.
double outer_slope(double h0, double slope0, double h1, double slope1) {
  const double slope = ((2 * h0 + h1) * slope0 - h0 * slope1) / (h0 + h1);
  if (slope * slope0 <= 0) return 0;
  if (slope0 * slope1 <= 0 && std::fabs(slope) > 3 * std::fabs(slope0)) return 3 * slope0;
  return slope;
}

void fill_shape_preserving(const Track& track, FrameSpan span) {
  const std::size_t left = span.first - 1, right = span.last + 1;
  const auto before = observed_before(track, left, 1);
  const auto behind = observed_behind(track, right, 1);
  const auto length = static_cast<double>(right - left);
  Slopes slopes{std::vector<double>(track.channels), std::vector<double>(track.channels)};
  for (std::size_t c = 0; c < track.channels; ++c) {
    const auto secant = [&](std::size_t from, std::size_t to) {
      return (track.row(to)[c] - track.row(from)[c]) / static_cast<double>(to - from);
    };
    const double middle = secant(left, right);
    slopes.before[c] = slopes.behind[c] = middle;
    const double h0 = before.empty() ? 0 : static_cast<double>(left - before[0]);
    const double h1 = behind.empty() ? 0 : static_cast<double>(behind[0] - right);
    const double slope0 = before.empty() ? 0 : secant(before[0], left);
    const double slope1 = behind.empty() ? 0 : secant(right, behind[0]);
    if (!before.empty()) {
      slopes.before[c] = inner_slope(h0, slope0, length, middle);
    } else if (!behind.empty()) {
      slopes.before[c] = outer_slope(length, middle, h1, slope1);
    }
    if (!behind.empty()) {
      slopes.behind[c] = inner_slope(length, middle, h1, slope1);
    } else if (!before.empty()) {
      slopes.behind[c] = outer_slope(length, middle, h0, slope0);
    }
  }
  fill_hermite(track, span, slopes);
}

void fill_linear(const Track& track, FrameSpan span) {
  const std::span<const double> y0 = track.row(span.first - 1), y1 = track.row(span.last + 1);
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t =
        static_cast<double>(f - span.first + 1) / static_cast<double>(span.length() + 1);
    for (std::size_t c = 0; c < track.channels; ++c) {
      track.row(f)[c] = (1 - t) * y0[c] + t * y1[c];
    }
  }
}

// Smoothing leaves the end samples a little beside the curve; the difference goes over from one end
// to the other with no slope at the ends, which keeps the velocities.
void meet_end_values(const Track& track, FrameSpan span, std::span<const double> miss_before,
                     std::span<const double> miss_behind) {
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t =
        static_cast<double>(f - span.first + 1) / static_cast<double>(span.length() + 1);
    const double behind = t * t * (3 - 2 * t);
    for (std::size_t c = 0; c < track.channels; ++c) {
      track.row(f)[c] += (1 - behind) * miss_before[c] + behind * miss_behind[c];
    }
  }
}

void fill_spline(const Track& track, FrameSpan span, bool quintic, const CurveSettings& settings) {
  const auto support =
      std::max(least_support,
               static_cast<std::size_t>(std::lround(to_frames(settings.support_s, settings))));
  std::vector<std::size_t> frames = observed_before(track, span.first, support);
  const std::size_t left = frames.size() - 1;
  const auto behind = observed_behind(track, span.last, support);
  frames.insert(frames.end(), behind.begin(), behind.end());
  const int half_order = quintic ? 3 : 2;
  if (frames.size() < static_cast<std::size_t>(half_order) + 1) return fill_linear(track, span);

  std::vector<double> knots, values;
  for (const std::size_t f : frames) {
    knots.push_back(static_cast<double>(f) - static_cast<double>(span.first));
    values.insert(values.end(), track.row(f).begin(), track.row(f).end());
  }
  NaturalSpline spline(half_order, std::move(knots), values, track.channels);
  if (quintic && frames.size() >= 12) {
    // A spline smoothed by s passes half of a wave of w radians a frame where s w^6 = 1.
    const auto smoothing_of = [&](double cutoff_hz) {
      return std::pow(2 * pi * cutoff_hz / settings.frame_rate_hz, -6);
    };
    spline.fit_by_cross_validation(smoothing_of(settings.most_cutoff_hz),
                                   smoothing_of(settings.least_cutoff_hz));
  } else {
    spline.fit(0);
  }
  for (std::size_t f = span.first; f <= span.last; ++f) {
    spline.evaluate(static_cast<double>(f) - static_cast<double>(span.first), track.row(f));
  }
  std::vector<double> miss_before(track.channels), miss_behind(track.channels);
  for (std::size_t c = 0; c < track.channels; ++c) {
    miss_before[c] = track.row(span.first - 1)[c] - spline.knot_values(left)[c];
    miss_behind[c] = track.row(span.last + 1)[c] - spline.knot_values(left + 1)[c];
  }
  meet_end_values(track, span, miss_before, miss_behind);
}

}  // namespace

EndState state_before(const Track& track, FrameSpan span, const CurveSettings& settings) {
  if (!has_sample_before(span)) return {};
  const std::size_t window = velocity_window(settings);
  const std::size_t end = span.first - 1;
  auto frames = observed_before(track, span.first, window);
  std::erase_if(frames, [&](std::size_t f) { return end - f > 2 * window; });
  return state_at(track, end, frames, static_cast<double>(window));
}

EndState state_behind(const Track& track, FrameSpan span, const CurveSettings& settings) {
  if (!has_sample_behind(track, span)) return {};
  const std::size_t window = velocity_window(settings);
  const std::size_t end = span.last + 1;
  auto frames = observed_behind(track, span.last, window);
  std::erase_if(frames, [&](std::size_t f) { return f - end > 2 * window; });
  return state_at(track, end, frames, static_cast<double>(window));
}

bool fill_with_curve(const Track& track, FrameSpan span, Curve curve,
                     const CurveSettings& settings) {
  const bool before = has_sample_before(span), behind = has_sample_behind(track, span);
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
      fill_spline(track, span, false, settings);
      break;
    case Curve::quintic:
      fill_spline(track, span, true, settings);
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

void place_guess(const Track& track, FrameSpan span, const Guess& guess,
                 const CurveSettings& settings, double blend_s) {
  const std::size_t rows = guess.values.size() / track.channels;
  const std::size_t end_frame = guess.first_frame + rows;
  // The difference between samples and guess is a track of its own, seen where the guess is.
  const std::size_t from = guess.first_frame;
  std::vector<double> misses(guess.values.size(), 0.0);
  std::vector<std::uint8_t> seen(rows, 0);
  for (std::size_t f = from; f < end_frame; ++f) {
    if (!track.observed[f]) continue;
    seen[f - from] = 1;
    for (std::size_t c = 0; c < track.channels; ++c) {
      const std::size_t at = (f - from) * track.channels + c;
      misses[at] = track.row(f)[c] - guess.values[at];
    }
  }
  const Track difference{misses, track.channels, seen};
  const FrameSpan inner{span.first - from, span.last - from};
  const EndState before = state_before(difference, inner, settings);
  const EndState behind = state_behind(difference, inner, settings);
  const Crossing crossing = crossing_of(span, blend_s, settings);
  const double decay = std::max(1.0, to_frames(settings.decay_s, settings));
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const auto u = static_cast<double>(f - span.first + 1);
    for (std::size_t c = 0; c < track.channels; ++c) {
      double miss = 0;
      if (before.known && behind.known) {
        miss = crossing.value(before.value[c], before.velocity[c], behind.value[c],
                              behind.velocity[c], u);
      } else if (before.known) {
        miss = coast(before.value[c], before.velocity[c], u, decay);
      } else if (behind.known) {
        miss = coast(behind.value[c], -behind.velocity[c], crossing.length - u, decay);
      }
      track.row(f)[c] = guess.values[(f - from) * track.channels + c] + miss;
    }
  }
}

}  // namespace kinemend::fill
