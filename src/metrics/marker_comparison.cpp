// Compares two takes of markers, also from different systems, and finds their time lag. Each marker
// is fitted by a rigid motion, or by a gain and an offset along each axis.
#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/signal.hpp"
#include "kinemend/metrics.hpp"
#include "metrics/compare.hpp"
#include "motion/rotation.hpp"

namespace kinemend::metrics {

/// Markers that two takes share, with a lag in time.
struct MarkerPair {
  const Take& reference;
  const Take& other;
  std::vector<std::size_t> reference_markers, other_markers;  ///< the same length
  std::size_t first_frame = 0;  ///< first compared frame of the reference
  std::size_t frames = 0;
  std::ptrdiff_t lag = 0;  ///< frame f of the reference is f + lag of the other
  double scale = 1;        ///< factor of the other's lengths

  std::size_t markers() const { return reference_markers.size(); }
  bool is_seen(std::size_t frame, std::size_t marker) const;
  Vec3 reference_at(std::size_t frame, std::size_t marker) const;  ///< frames count from 0
  Vec3 other_at(std::size_t frame, std::size_t marker) const;
};

/// Throws as `compare_markers` does.
MarkerPair pair_markers(const Take& reference, const Take& other, std::ptrdiff_t lag_frames);

/// The fit of one marker from the reference to the other system: p' = turn p + shift, or gain p +
/// shift along each axis.
struct FittedMarker {
  Quat turn{1, 0, 0, 0};
  Vec3 gain{1, 1, 1};
  Vec3 shift;

  Vec3 operator()(Vec3 p) const;
};
/// Fits by least squares over the samples that both takes have. A marker that is never seen in both
/// is not moved; a constant channel gets an offset only.
std::vector<FittedMarker> fit_markers(const MarkerPair& pair, MarkerFit fit);

}  // namespace kinemend::metrics

namespace kinemend {

namespace {

using metrics::FittedMarker;
using metrics::MarkerPair;

// The bands of docs/measured/noise.md and their filter, by definition; the fewest frames and the
// longest lag are chosen by hand, not swept.
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
      const double distance = norm(vector_at(e, f, m));
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
      if (errors.seen[f * errors.markers() + m] != 0) distances.push_back(norm(vector_at(e, f, m)));
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

namespace kinemend::metrics {

namespace {

// Chosen by hand, not swept.
constexpr double rate_tolerance = 1e-3;  // relative: 29.97 and 30 are not the same

double scale_between(const Take& reference, const Take& other) {
  const double of_reference = metres_per_unit(reference.unit);
  const double of_other = metres_per_unit(other.unit);
  return of_reference > 0 && of_other > 0 ? of_other / of_reference : 1;
}

// Sums over the samples of one channel that both takes have.
struct ChannelSums {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;

  void add(double reference, double other) {
    count += 1;
    x += reference;
    y += other;
    xx += reference * reference;
    xy += reference * other;
  }
  double variance() const { return xx - x * x / count; }
  double gain() const {
    // Rounding errors, as a share of the squared size. Not swept.
    constexpr double standing_still = 1e-12;
    return variance() > standing_still * xx ? (xy - x * y / count) / variance() : 1;
  }
};

FittedMarker gains_and_offsets(const MarkerPair& pair, std::size_t marker) {
  ChannelSums x, y, z;
  // Coordinates relative to a point of the path lose no digits in sums of squares.
  Vec3 origin;
  for (std::size_t f = 0; f < pair.frames; ++f) {
    if (!pair.is_seen(f, marker)) continue;
    if (x.count == 0) origin = pair.reference_at(f, marker);
    const Vec3 p = pair.reference_at(f, marker) - origin, q = pair.other_at(f, marker) - origin;
    x.add(p.x, q.x);
    y.add(p.y, q.y);
    z.add(p.z, q.z);
  }
  FittedMarker fitted;
  if (x.count == 0) return fitted;
  fitted.gain = {x.gain(), y.gain(), z.gain()};
  const auto offset = [](const ChannelSums& sums, double gain, double start) {
    return (sums.y - gain * sums.x) / sums.count + start - gain * start;
  };
  fitted.shift = {offset(x, fitted.gain.x, origin.x), offset(y, fitted.gain.y, origin.y),
                  offset(z, fitted.gain.z, origin.z)};
  return fitted;
}

Eigen::Vector3d vector_of(Vec3 v) { return {v.x, v.y, v.z}; }

FittedMarker rigid(const MarkerPair& pair) {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = from;
  double count = 0;
  const auto for_each_sample = [&](const auto& work) {
    for (std::size_t f = 0; f < pair.frames; ++f) {
      for (std::size_t m = 0; m < pair.markers(); ++m) {
        if (pair.is_seen(f, m))
          work(vector_of(pair.reference_at(f, m)), vector_of(pair.other_at(f, m)));
      }
    }
  };
  for_each_sample([&](const auto& p, const auto& q) {
    from += p;
    to += q;
    count += 1;
  });
  if (count == 0) return {};
  from /= count;
  to /= count;
  Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
  for_each_sample(
      [&](const auto& p, const auto& q) { product += (q - to) * (p - from).transpose(); });
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0) {
    Eigen::Matrix3d u = svd.matrixU();
    u.col(2) = -u.col(2);
    turn = u * svd.matrixV().transpose();
  }
  const Eigen::Quaterniond q(turn);
  const Eigen::Vector3d shift = to - turn * from;
  return {{q.w(), q.x(), q.y(), q.z()}, {1, 1, 1}, {shift.x(), shift.y(), shift.z()}};
}

}  // namespace

bool MarkerPair::is_seen(std::size_t frame, std::size_t marker) const {
  const std::size_t f = first_frame + frame;
  return reference.is_observed(f, reference_markers[marker]) &&
         other.is_observed(f + static_cast<std::size_t>(lag), other_markers[marker]);
}

Vec3 MarkerPair::reference_at(std::size_t frame, std::size_t marker) const {
  return reference.position(first_frame + frame, reference_markers[marker]);
}

Vec3 MarkerPair::other_at(std::size_t frame, std::size_t marker) const {
  return scale *
         other.position(first_frame + frame + static_cast<std::size_t>(lag), other_markers[marker]);
}

MarkerPair pair_markers(const Take& reference, const Take& other, std::ptrdiff_t lag_frames) {
  const std::size_t frames = reference.frame_count();
  if (frames != other.frame_count())
    throw Error(ErrorKind::usage, fmt::format("the reference has {} frames, the other take {}",
                                              frames, other.frame_count()));
  const double rate_hz = reference.frame_rate_hz;
  if (!(std::fabs(other.frame_rate_hz - rate_hz) <= rate_tolerance * rate_hz))
    throw Error(ErrorKind::usage,
                fmt::format("the reference has {:g} frames a second, the other take {:g}; kinemend "
                            "convert --fps brings one to the rate of the other",
                            rate_hz, other.frame_rate_hz));
  MarkerPair pair{reference, other, {}, {}};
  for (std::size_t m = 0; m < reference.marker_count(); ++m) {
    const std::int32_t found = other.find(reference.names[m]);
    if (found < 0 || !reference.holds_positions(m) ||
        !other.holds_positions(static_cast<std::size_t>(found)))
      continue;
    pair.reference_markers.push_back(m);
    pair.other_markers.push_back(static_cast<std::size_t>(found));
  }
  if (pair.markers() == 0)
    throw Error(ErrorKind::usage, "the two takes have no marker of the same name");
  const auto shift = static_cast<std::size_t>(std::abs(lag_frames));
  if (shift >= frames)
    throw Error(ErrorKind::usage,
                fmt::format("a lag of {} frames leaves nothing of {}", lag_frames, frames));
  pair.lag = lag_frames;
  pair.first_frame = lag_frames < 0 ? shift : 0;
  pair.frames = frames - shift;
  pair.scale = scale_between(reference, other);
  return pair;
}

Vec3 FittedMarker::operator()(Vec3 p) const {
  const Vec3 q = rotate(turn, p);
  return Vec3{gain.x * q.x, gain.y * q.y, gain.z * q.z} + shift;
}

std::vector<FittedMarker> fit_markers(const MarkerPair& pair, MarkerFit fit) {
  std::vector<FittedMarker> fitted(pair.markers());
  if (fit == MarkerFit::rigid) std::fill(fitted.begin(), fitted.end(), rigid(pair));
  for (std::size_t m = 0; m < fitted.size() && fit == MarkerFit::gain_offset; ++m)
    fitted[m] = gains_and_offsets(pair, m);
  return fitted;
}

}  // namespace kinemend::metrics
