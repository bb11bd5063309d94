// Fits a curve that most samples agree with, and marks the samples that do not.
#include "methods/auto/dense_outliers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/experimental/frame_rate.hpp"

namespace kinemend {

namespace {

double square(double x) { return x * x; }

// The frames [first, last) of a window about a frame. Windows at the ends of the take are as long
// as the others, so that outliers are not the majority of a short one.
struct Window {
  std::size_t first, last;
};

Window window_about(std::size_t t, std::size_t reach, std::size_t frames) {
  const std::size_t length = std::min(2 * reach + 1, frames);
  const std::size_t first = std::min(t - std::min(t, reach), frames - length);
  return {first, first + length};
}

// One track with its settings and intermediate results.
class RobustCurve {
 public:
  RobustCurve(std::span<const Vec3> track, std::span<const std::uint8_t> missing,
              double frame_rate_hz, const DenseTuning& tuning)
      : track_(track), missing_(missing), tuning_(tuning), errors_(track.size()) {
    const double rate_hz = window_rate_hz(frame_rate_hz);
    wide_reach_ = frames_of(tuning.wide_half_s, rate_hz);
    reach_ = frames_of(tuning.curve_half_s, rate_hz);
    scale_reach_ = frames_of(tuning.scale_half_s, rate_hz);
  }

  void fit() {
    start_by_medians();
    std::vector<double> weights(track_.size());
    // A wide window holds more samples than a cluster of outliers; a narrow one follows the motion.
    for (int round = 0; round < 2 * tuning_.rounds; ++round) {
      const std::size_t reach = round < tuning_.rounds ? wide_reach_ : reach_;
      for (std::size_t t = 0; t < track_.size(); ++t) {
        const double welsch = tuning_.welsch_deviations * scale_about(t);
        weights[t] = is_missing(t) ? 0 : portable::exp(-0.5 * square(norm(errors_[t]) / welsch));
      }
      for (std::size_t t = 0; t < track_.size(); ++t)
        errors_[t] = track_[t] - value_at(t, reach, weights);
    }
  }

  // Whether a sample is far from the curve and agrees with neither neighbour. Samples of a motion
  // too quick for the curve share a deviation; those beside a step share a value.
  bool is_outlier(std::size_t t) {
    const double error = norm(errors_[t]);
    if (is_missing(t) || error <= tuning_.least_error) return false;
    if (error <= tuning_.ratio * scale_about(t)) return false;
    const auto agrees = [&](std::size_t other) {
      const double apart =
          std::min(norm(errors_[t] - errors_[other]), norm(track_[t] - track_[other]));
      return apart < tuning_.least_apart * error;
    };
    return !(t > 0 && agrees(t - 1)) && !(t + 1 < track_.size() && agrees(t + 1));
  }

 private:
  static std::size_t frames_of(double seconds, double rate_hz) {
    // Minimum of frames on a side: a quadratic has three unknowns, and with fewer samples it can
    // fit most samples of a shake.
    constexpr std::size_t fewest = 5;
    return std::max<std::size_t>(fewest, static_cast<std::size_t>(std::lround(seconds * rate_hz)));
  }

  bool is_missing(std::size_t t) const { return !missing_.empty() && missing_[t] != 0; }

  void start_by_medians() {
    std::vector<double> x, y, z;
    for (std::size_t t = 0; t < track_.size(); ++t) {
      const Window window = window_about(t, wide_reach_, track_.size());
      x.clear();
      y.clear();
      z.clear();
      for (std::size_t k = window.first; k < window.last; ++k) {
        if (is_missing(k)) continue;
        x.push_back(track_[k].x);
        y.push_back(track_[k].y);
        z.push_back(track_[k].z);
      }
      errors_[t] = x.empty() ? Vec3{} : track_[t] - Vec3{median_of(x), median_of(y), median_of(z)};
    }
  }

  // Deviation per axis of the samples about this one that lie close to the curve, by their median.
  double scale_about(std::size_t t) {
    const Window window = window_about(t, scale_reach_, track_.size());
    sizes_.clear();
    for (std::size_t k = window.first; k < window.last; ++k)
      if (!is_missing(k)) sizes_.push_back(norm(errors_[k]));
    const double scale = sizes_.empty() ? 0 : median_of(sizes_) / median_of_chi3;
    return std::max(scale, tuning_.least_scale);
  }

  // Value at frame t of the quadratic through the samples about it.
  Vec3 value_at(std::size_t t, std::size_t reach, const std::vector<double>& weights) const {
    // A minimal weight of every sample keeps the system solvable if all are far from the curve.
    constexpr double trace = 1e-6;
    std::array<double, 5> moments{};
    std::array<Vec3, 3> products{};
    const Window window = window_about(t, reach, track_.size());
    const auto half = static_cast<double>(std::max(t - window.first, window.last - t - 1) + 1);
    for (std::size_t k = window.first; k < window.last; ++k) {
      if (is_missing(k)) continue;
      const double x = (static_cast<double>(k) - static_cast<double>(t)) / half;
      const double tricube = 1 - std::abs(x * x * x);
      double power = tricube * tricube * tricube * (weights[k] + trace);
      for (std::size_t i = 0; i < 5; ++i, power *= x) {
        moments[i] += power;
        if (i < 3) products[i] += power * track_[k];
      }
    }
    return value_of(moments, products, track_[t] - errors_[t]);
  }

  // The constant term of the quadratic with these sums, by Cramer's rule; that of the line or the
  // mean if the samples do not determine a quadratic, `otherwise` without samples.
  static Vec3 value_of(const std::array<double, 5>& m, const std::array<Vec3, 3>& p,
                       Vec3 otherwise) {
    constexpr double singular = 1e-9;
    if (m[0] <= 0) return otherwise;
    const double a = m[2] * m[4] - m[3] * m[3], b = m[2] * m[3] - m[1] * m[4],
                 c = m[1] * m[3] - m[2] * m[2];
    const double all = m[0] * a + m[1] * b + m[2] * c;
    if (all > singular * m[0] * m[0] * m[0]) return (1 / all) * (a * p[0] + b * p[1] + c * p[2]);
    const double line = m[0] * m[2] - m[1] * m[1];
    if (line > singular * m[0] * m[0]) return (1 / line) * (m[2] * p[0] - m[1] * p[1]);
    return (1 / m[0]) * p[0];
  }

  std::span<const Vec3> track_;
  std::span<const std::uint8_t> missing_;
  const DenseTuning& tuning_;
  std::vector<Vec3> errors_;  // each sample's distance from the curve
  std::size_t wide_reach_ = 0, reach_ = 0, scale_reach_ = 0;
  std::vector<double> sizes_;
};

// Whether many samples are far from the mean of their neighbours. Tracks without outliers thus need
// no fit.
bool may_be_dense(std::span<const Vec3> track, std::span<const std::uint8_t> missing,
                  const DenseTuning& tuning) {
  std::size_t far = 0, seen = 0;
  const auto is_seen = [&](std::size_t t) { return missing.empty() || missing[t] == 0; };
  for (std::size_t t = 1; t + 1 < track.size(); ++t) {
    if (!is_seen(t - 1) || !is_seen(t) || !is_seen(t + 1)) continue;
    ++seen;
    far += norm(track[t] - 0.5 * (track[t - 1] + track[t + 1])) > tuning.least_error;
  }
  return static_cast<double>(far) > tuning.least_share * static_cast<double>(seen);
}

}  // namespace

std::vector<std::uint8_t> dense_outliers(std::span<const Vec3> track,
                                         std::span<const std::uint8_t> missing,
                                         double frame_rate_hz, const DenseTuning& tuning) {
  if (track.size() < 2 * tuning.fewest_outliers || !may_be_dense(track, missing, tuning)) return {};
  RobustCurve curve(track, missing, frame_rate_hz, tuning);
  curve.fit();
  std::vector<std::uint8_t> marks(track.size());
  std::size_t seen = 0, outliers = 0;
  for (std::size_t t = 0; t < track.size(); ++t) {
    seen += missing.empty() || missing[t] == 0;
    marks[t] = curve.is_outlier(t) ? 1 : 0;
    outliers += marks[t];
  }
  if (outliers < tuning.fewest_outliers) return {};
  if (static_cast<double>(outliers) <= tuning.least_share * static_cast<double>(seen)) return {};
  return marks;
}

}  // namespace kinemend
