// Compares two takes of markers, also from different systems, and finds their time lag.
#include <algorithm>
#include <cmath>
#include <limits>

#include "kinemend/error.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "kinemend/experimental/signal.hpp"
#include "kinemend/metrics.hpp"
#include "metrics/marker_fit.hpp"
#include "metrics/pairing.hpp"
#include "motion/component.hpp"

namespace kinemend {

namespace {

using metrics::FittedMarker;
using metrics::MarkerPair;

// The bands of docs/noise.md and their filter, by definition; the fewest frames and the longest lag
// are chosen by hand, not swept.
constexpr double cuts_hz[] = {2, 6, 15};
constexpr std::size_t jitter_cut = 1;  // 6 Hz
constexpr int filter_order = 4;
constexpr std::size_t fewest_filtered_frames = 16;
constexpr double longest_lag_s = 0.5;

// The error of each channel (frames x 3 markers); missing samples are interpolated linearly.
struct Errors {
  PoseMatrix values;
  std::vector<std::uint8_t> seen;    // F x M
  std::vector<std::uint8_t> counts;  // 3 M: channels that move

  std::size_t markers() const { return values.channels / 3; }
};

void bridge(Errors& errors, std::size_t marker) {
  const std::size_t frames = errors.values.frames, markers = errors.markers();
  std::size_t last = frames;
  for (std::size_t f = 0; f < frames; ++f) {
    if (errors.seen[f * markers + marker] == 0) continue;
    const std::size_t begin = last == frames ? 0 : last + 1;
    for (std::size_t c = 3 * marker; c < 3 * marker + 3; ++c) {
      const double to = errors.values(f, c), from = last == frames ? to : errors.values(last, c);
      for (std::size_t g = begin; g < f; ++g) {
        const double u =
            last == frames ? 0 : static_cast<double>(g - last) / static_cast<double>(f - last);
        errors.values(g, c) = from + u * (to - from);
      }
    }
    last = f;
  }
  for (std::size_t f = last == frames ? frames : last + 1; f < frames; ++f) {
    for (std::size_t c = 3 * marker; c < 3 * marker + 3; ++c)
      errors.values(f, c) = errors.values(last, c);
  }
}

// Whether the standard deviation of the reference exceeds `least`, so that the channel is compared.
bool moves(const std::vector<double>& values, double least) {
  if (least <= 0) return true;
  double sum = 0, squares = 0;
  const auto count = static_cast<double>(values.size());
  for (const double v : values) sum += v - values[0];
  for (const double v : values)
    squares += (v - values[0] - sum / count) * (v - values[0] - sum / count);
  return std::sqrt(squares / std::max(1.0, count)) > least;
}

Errors errors_of(const MarkerPair& pair, const std::vector<FittedMarker>& fitted, double least) {
  const std::size_t markers = pair.markers();
  Errors errors{PoseMatrix(pair.frames, 3 * markers),
                std::vector<std::uint8_t>(pair.frames * markers),
                std::vector<std::uint8_t>(3 * markers)};
  for (std::size_t m = 0; m < markers; ++m) {
    std::vector<double> paths[3];
    for (std::size_t f = 0; f < pair.frames; ++f) {
      if (!pair.is_seen(f, m)) continue;
      errors.seen[f * markers + m] = 1;
      const Vec3 reference = fitted[m](pair.reference_at(f, m));
      const Vec3 off = pair.other_at(f, m) - reference;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        errors.values(f, 3 * m + axis) = component(off, axis);
        paths[axis].push_back(component(pair.reference_at(f, m), axis));
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      errors.counts[3 * m + axis] = !paths[axis].empty() && moves(paths[axis], least) ? 1 : 0;
    bridge(errors, m);
  }
  return errors;
}

// Sums of squares over some markers.
struct Squares {
  double sum = 0, count = 0;

  void add(double value) {
    sum += value * value;
    count += 1;
  }
  double rms() const { return count > 0 ? std::sqrt(sum / count) : 0; }
};

// Returns the root mean square over the compared channels of markers [first, last), where both ends
// of a span of `reach` frames about the frame are seen.
template <class Value>
double rms_of(const Errors& errors, std::size_t first, std::size_t last, std::size_t reach,
              const Value& value) {
  const std::size_t frames = errors.values.frames, markers = errors.markers();
  Squares squares;
  for (std::size_t m = first; m < last; ++m) {
    for (std::size_t f = reach; f + reach < frames; ++f) {
      if (errors.seen[(f - reach) * markers + m] == 0 ||
          errors.seen[(f + reach) * markers + m] == 0)
        continue;
      for (std::size_t c = 3 * m; c < 3 * m + 3; ++c) {
        if (errors.counts[c] != 0) squares.add(value(f, c));
      }
    }
  }
  return squares.rms();
}

// Returns the error below each cut; empty for a cut above half the frame rate.
std::vector<std::optional<PoseMatrix>> lowpasses(const Errors& errors, double rate_hz) {
  std::vector<std::optional<PoseMatrix>> low(std::size(cuts_hz));
  if (errors.values.frames < fewest_filtered_frames) return low;
  for (std::size_t i = 0; i < std::size(cuts_hz); ++i) {
    if (!(cuts_hz[i] < rate_hz / 2)) continue;
    low[i] = errors.values;
    filter_zero_phase(*low[i], butterworth_lowpass(filter_order, cuts_hz[i], rate_hz));
  }
  return low;
}

MarkerErrors summary(const Errors& errors, const std::vector<std::optional<PoseMatrix>>& low,
                     std::size_t first, std::size_t last, double rate_hz) {
  MarkerErrors result;
  const PoseMatrix& e = errors.values;
  Squares distances;
  for (std::size_t f = 0; f < e.frames; ++f) {
    for (std::size_t m = first; m < last; ++m) {
      if (errors.seen[f * errors.markers() + m] == 0) continue;
      const double distance = norm(Vec3{e(f, 3 * m), e(f, 3 * m + 1), e(f, 3 * m + 2)});
      distances.add(distance);
      result.max_distance = std::max(result.max_distance, distance);
    }
  }
  result.samples = static_cast<std::size_t>(distances.count);
  result.rms_distance = distances.rms();
  const auto rms = [&](const auto& value) { return rms_of(errors, first, last, 0, value); };
  result.rms = rms([&](std::size_t f, std::size_t c) { return e(f, c); });
  result.velocity_rms = rms_of(errors, first, last, 1, [&](std::size_t f, std::size_t c) {
    return (e(f + 1, c) - e(f - 1, c)) * rate_hz / 2;
  });
  for (std::size_t i = 0; i <= low.size(); ++i) {
    const bool has_lower = i == 0 || low[i - 1], has_upper = i < low.size() && low[i];
    // Everything above the highest cut that the rate allows is one band.
    if (!has_lower || (i == 0 && !has_upper)) continue;
    result.bands[i] = rms([&](std::size_t f, std::size_t c) {
      const double upper = has_upper ? (*low[i])(f, c) : e(f, c);
      return upper - (i == 0 ? 0 : (*low[i - 1])(f, c));
    });
  }
  if (low[jitter_cut])
    result.above_6_hz =
        rms([&](std::size_t f, std::size_t c) { return e(f, c) - (*low[jitter_cut])(f, c); });
  return result;
}

double percentile_99(const Errors& errors) {
  std::vector<double> distances;
  const PoseMatrix& e = errors.values;
  for (std::size_t f = 0; f < e.frames; ++f) {
    for (std::size_t m = 0; m < errors.markers(); ++m) {
      if (errors.seen[f * errors.markers() + m] != 0)
        distances.push_back(norm(Vec3{e(f, 3 * m), e(f, 3 * m + 1), e(f, 3 * m + 2)}));
    }
  }
  return metrics::percentile_of(std::move(distances), 99);
}

// Returns the mean square difference of steps from frame to frame, with gains and offsets removed.
double disagreement(const Take& reference, const Take& other, std::ptrdiff_t lag, MarkerFit fit) {
  const MarkerPair pair = metrics::pair_markers(reference, other, lag);
  const std::vector<FittedMarker> fitted = metrics::fit_markers(pair, fit);
  Squares squares;
  for (std::size_t m = 0; m < pair.markers(); ++m) {
    for (std::size_t f = 1; f < pair.frames; ++f) {
      if (!pair.is_seen(f - 1, m) || !pair.is_seen(f, m)) continue;
      const Vec3 step = fitted[m](pair.reference_at(f, m)) - fitted[m](pair.reference_at(f - 1, m));
      squares.add(norm(pair.other_at(f, m) - pair.other_at(f - 1, m) - step));
    }
  }
  return squares.count > 0 ? squares.sum / squares.count : std::numeric_limits<double>::infinity();
}

// Returns at most `most_frames` frames from the middle of a take.
Take middle_of(const Take& clip) {
  // For speed, not swept.
  constexpr std::size_t most_frames = 4000;
  const std::size_t frames = clip.frame_count(), kept = std::min(frames, most_frames);
  const std::size_t first = (frames - kept) / 2;
  return slice(clip, first, first + kept);
}

// Returns the lag of least disagreement, refined between frames by a parabola.
double lag_of(const Take& reference, const Take& other, MarkerFit fit) {
  const auto frames = static_cast<std::ptrdiff_t>(reference.frame_count());
  const double rate_hz = reference.frame_rate_hz;
  const auto most =
      std::min(static_cast<std::ptrdiff_t>(std::lround(longest_lag_s * window_rate_hz(rate_hz))),
               frames / 4);
  if (most < 1) return 0;
  std::vector<double> values;
  for (std::ptrdiff_t lag = -most; lag <= most; ++lag)
    values.push_back(disagreement(reference, other, lag, fit));
  const auto best =
      static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
  if (!std::isfinite(values[best])) return 0;
  double between = 0;
  if (best > 0 && best + 1 < values.size()) {
    const double before = values[best - 1], at = values[best], behind = values[best + 1];
    const double bend = before - 2 * at + behind;
    if (bend > 0) between = 0.5 * (before - behind) / bend;
  }
  return (static_cast<double>(best) - static_cast<double>(most) + between) / rate_hz;
}

}  // namespace

MarkerComparison compare_markers(const Take& reference, const Take& other,
                                 const MarkerComparisonSettings& settings) {
  const MarkerPair pair = metrics::pair_markers(reference, other, settings.lag_frames);
  const Take& shown = settings.fit_to != nullptr ? *settings.fit_to : other;
  const MarkerPair fitting = metrics::pair_markers(reference, shown, settings.lag_frames);
  if (fitting.reference_markers != pair.reference_markers)
    throw Error(ErrorKind::usage,
                "the take that is fitted to has other markers than the one that is compared");
  const std::vector<FittedMarker> fitted = metrics::fit_markers(fitting, settings.fit);
  const Errors errors = errors_of(pair, fitted, settings.least_motion);
  const double rate_hz = reference.frame_rate_hz;
  const auto low = lowpasses(errors, rate_hz);
  MarkerComparison result;
  result.frames = pair.frames;
  result.all = summary(errors, low, 0, pair.markers(), rate_hz);
  result.p99_distance = percentile_99(errors);
  result.lag_s = lag_of(middle_of(reference), middle_of(other), settings.fit);
  for (std::size_t m = 0; m < pair.markers(); ++m) {
    result.names.push_back(reference.names[pair.reference_markers[m]]);
    result.markers.push_back(summary(errors, low, m, m + 1, rate_hz));
  }
  for (std::size_t m = 0; m < reference.marker_count(); ++m) {
    const auto& paired = pair.reference_markers;
    if (reference.holds_positions(m) && !std::binary_search(paired.begin(), paired.end(), m))
      result.unmatched.push_back(reference.names[m]);
  }
  return result;
}

}  // namespace kinemend
