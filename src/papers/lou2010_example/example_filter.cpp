// Minimises the objective of the filter by weighted least squares, in stretches of bounded memory.
#include "papers/lou2010_example/example_filter.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable.hpp"

namespace kinemend {

namespace {

// A vector of a stretch is about 2 MB. Limits memory; not swept.
constexpr std::size_t values_at_once = std::size_t{1} << 18;
// Length in margins, which limits the repeated work. For speed, not swept.
constexpr std::size_t least_lengths = 4;

}  // namespace

Stretches::Stretches(const WindowBases& bases, std::size_t frames, std::size_t margin_windows)
    : frames_(frames), length_(frames), hop_(bases.hop) {
  const std::size_t margin = margin_windows * bases.frames;
  const std::size_t most =
      std::max({values_at_once / bases.channels, 2 * least_lengths * margin, bases.frames});
  if (frames <= most) return;
  length_ = bases.frames + (most - bases.frames) / hop_ * hop_;
  const std::size_t fresh = length_ - 2 * margin;
  count_ = 1 + (frames - length_ + fresh - 1) / fresh;
}

std::size_t Stretches::begin(std::size_t stretch) const {
  if (count_ == 1) return 0;
  const std::size_t hops = (frames_ - length_ + hop_ - 1) / hop_;
  return stretch * hops / (count_ - 1) * hop_;
}

std::size_t Stretches::end(std::size_t stretch) const {
  return std::min(frames_, begin(stretch) + length_);
}

std::size_t Stretches::first(std::size_t stretch) const {
  if (stretch == 0) return 0;
  if (stretch == count_) return frames_;
  return (begin(stretch) + end(stretch - 1)) / 2;
}

namespace {

// Expected number of products; it decides how they are prepared.
constexpr std::size_t usual_iterations = 12;
// Least relative area of two directions that count as independent.
constexpr double least_area = 1e-12;

// For speed, not swept.
constexpr std::size_t frames_at_once = 64;  // task size; it fixes the order of sums
// Frames that a frame of the result depends on, in windows. The linear filter depends on one
// window, by definition. The other depends on all frames, but negligibly beyond two windows; that
// is chosen by hand, not swept.
constexpr std::size_t linear_margin = 1, margin = 2;

// The sum over all frames of summand(first, last), in an order independent of threads.
template <typename Sum, typename Summand>
Sum sum_over_frames(std::size_t frames, const Summand& summand) {
  return sum_in_halves<Sum>(frames, frames_at_once, summand);
}

class Minimisation {
 public:
  // Minimises over the frames of `measured` (and `observed`) from `first` on, as many as
  // `first_guess` has.
  Minimisation(PatternPenalty& penalty, PoseMatrix first_guess, const PoseMatrix& measured,
               std::span<const std::uint8_t> observed, std::size_t first,
               std::span<const double> mean, const ExampleWeights& weights,
               const ExampleSettings& settings)
      : frames_(first_guess.frames),
        channels_(measured.channels),
        measured_(&measured.values[first * channels_]),
        observed_(observed.empty() ? observed : observed.subspan(first * channels_)),
        mean_(mean),
        weights_(weights),
        settings_(settings),
        penalty_(penalty),
        z_(padded(std::move(first_guess), penalty_.padded_frames())),
        image_(z_.frames, channels_),
        confidence_(frames_, channels_),
        gradient_(z_.frames, channels_),
        gradient_image_(z_.frames, channels_),
        step_(z_.frames, channels_),
        step_image_(z_.frames, channels_) {
    for (std::size_t f = 0; f < z_.frames; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) z_(f, c) -= mean[c];
    }
  }

  // Returns the objective before the first iteration and after each.
  std::vector<double> run() {
    std::vector<double> trace;
    scale_ = std::max(settings_.first_welsch, 1.0);
    penalty_.multiply(z_, image_);
    double before = evaluate();
    trace.push_back(before);
    for (std::size_t i = 0; i < settings_.iterations; ++i) {
      step();
      const double now = evaluate();
      trace.push_back(now);
      if (scale_ > 1) {
        scale_ = std::max(1.0, scale_ / 2);
        before = evaluate();
      } else if (before - now <= settings_.tolerance * now) {
        break;
      } else {
        before = now;
      }
    }
    return trace;
  }

  // Returns the minimiser and invalidates this object.
  PoseMatrix take_poses() {
    PoseMatrix poses = std::move(z_);
    poses.values.resize(frames_ * channels_);
    poses.frames = frames_;
    for (std::size_t i = 0; i < poses.values.size(); ++i) poses.values[i] += mean_[i % channels_];
    return poses;
  }

 private:
  // Frames beyond the clip are padding, initially its last frame.
  static PoseMatrix padded(PoseMatrix poses, std::size_t frames) {
    const std::size_t channels = poses.channels, last = poses.values.size() - channels;
    poses.values.reserve(frames * channels);
    for (std::size_t f = poses.frames; f < frames; ++f) {
      for (std::size_t c = 0; c < channels; ++c) poses.values.push_back(poses.values[last + c]);
    }
    poses.frames = frames;
    return poses;
  }

  // b_l if the sample was observed, else 0.
  double alpha(std::size_t f, std::size_t c) const {
    const bool seen = f < frames_ && (observed_.empty() || observed_[f * channels_ + c] != 0);
    return seen ? weights_.data[c] : 0.0;
  }
  // z - y, both without the mean.
  double residual(std::size_t f, std::size_t c) const {
    return z_(f, c) - (measured_[f * channels_ + c] - mean_[c]);
  }

  // The objective at z, for which `image_` is up to date. Also computes eq. 15's weights, w =
  // phi(r) / r, for the next step.
  double evaluate() {
    return sum_over_frames<double>(
        z_.frames, [&](std::size_t first, std::size_t last) { return evaluate(first, last); });
  }

  double evaluate(std::size_t first, std::size_t last) {
    double data = 0, patterns = 0;
    for (std::size_t f = first; f < last; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) {
        patterns += z_(f, c) * (penalty_.diagonal(f, c) * z_(f, c) - image_(f, c));
        const double b = alpha(f, c);
        if (b == 0) continue;
        const double r = residual(f, c), p = scale_ * weights_.welsch[c];
        const double lost = portable::expm1(-r * r / (p * p));
        data += b * (std::isinf(p) ? r * r / 2 : -p * p / 2 * lost);
        confidence_(f, c) = 1 + lost;
      }
    }
    return data + patterns / 2;
  }

  // Diagonal and steepest descent of the quadratic that majorises the objective at z. The diagonal
  // leaves out the coupling of the patterns.
  struct Slope {
    double diagonal, residual;
  };
  Slope slope(std::size_t f, std::size_t c) const {
    const double b = alpha(f, c), patterns = penalty_.diagonal(f, c);
    const double w = b > 0 ? b * confidence_(f, c) : 0.0;
    const double pull = b > 0 ? w * -residual(f, c) : 0.0;
    return {w + patterns, pull - patterns * z_(f, c) + image_(f, c)};
  }

  void step() {
    for_frames([&](std::size_t f, std::size_t c) {
      const Slope s = slope(f, c);
      gradient_(f, c) = s.diagonal > 0 ? s.residual / s.diagonal : 0.0;
    });
    if (settings_.solver == ExampleSolver::alternation) {
      // Eq. 13 and 15: with fixed coefficients, the samples are independent.
      for_frames([&](std::size_t f, std::size_t c) { z_(f, c) += gradient_(f, c); });
      penalty_.multiply(z_, image_);
    } else {
      descend();
    }
  }

  // Moves to the minimum of the majorising quadratic on the plane of its preconditioned gradient
  // and the last step. With constant weights these are conjugate gradients.
  void descend() {
    penalty_.multiply(gradient_, gradient_image_);
    const auto plane = sum_over_frames<Plane>(
        z_.frames, [&](std::size_t first, std::size_t last) { return plane_of(first, last); });
    if (!(plane.gg > 0)) return;
    double along_gradient = plane.gr / plane.gg, along_step = 0;
    const double area = plane.gg * plane.ss - plane.gs * plane.gs;
    if (area > least_area * plane.gg * plane.ss) {
      along_gradient = (plane.ss * plane.gr - plane.gs * plane.sr) / area;
      along_step = (plane.gg * plane.sr - plane.gs * plane.gr) / area;
    }
    for_frames([&](std::size_t f, std::size_t c) {
      step_(f, c) = along_gradient * gradient_(f, c) + along_step * step_(f, c);
      step_image_(f, c) = along_gradient * gradient_image_(f, c) + along_step * step_image_(f, c);
      z_(f, c) += step_(f, c);
      image_(f, c) += step_image_(f, c);
    });
  }

  // Products of gradient g and last step s: g^T H g, g^T H s and s^T H s with the quadratic's
  // matrix, and those with its steepest descent.
  struct Plane {
    double gg = 0, gs = 0, ss = 0, gr = 0, sr = 0;
    Plane operator+(const Plane& o) const {
      return {gg + o.gg, gs + o.gs, ss + o.ss, gr + o.gr, sr + o.sr};
    }
  };
  Plane plane_of(std::size_t first, std::size_t last) const {
    Plane sum;
    for (std::size_t f = first; f < last; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) {
        const Slope at = slope(f, c);
        const double g = gradient_(f, c), s = step_(f, c);
        const double bent_g = at.diagonal * g - gradient_image_(f, c);
        sum.gg += g * bent_g;
        sum.gs += s * bent_g;
        sum.ss += s * (at.diagonal * s - step_image_(f, c));
        sum.gr += g * at.residual;
        sum.sr += s * at.residual;
      }
    }
    return sum;
  }

  // Calls `action` for each sample.
  template <typename Action>
  void for_frames(const Action& action) const {
    for_each_range(0, z_.frames, frames_at_once, [&](std::size_t first, std::size_t last) {
      for (std::size_t f = first; f < last; ++f) {
        for (std::size_t c = 0; c < channels_; ++c) action(f, c);
      }
    });
  }

  std::size_t frames_, channels_;
  const double* measured_;  // F x L
  std::span<const std::uint8_t> observed_;
  std::span<const double> mean_;
  const ExampleWeights& weights_;
  const ExampleSettings& settings_;
  PatternPenalty& penalty_;
  double scale_ = 1;       // of p
  PoseMatrix z_;           // without the mean; frames beyond the clip are padding
  PoseMatrix image_;       // A z
  PoseMatrix confidence_;  // F x L: exp(-r^2 / p^2)
  PoseMatrix gradient_, gradient_image_, step_, step_image_;
};

// The data term has a factor of one half, unlike the others.
std::vector<double> doubled(std::vector<double> values) {
  for (double& value : values) value *= 2;
  return values;
}

PoseMatrix rows_of(const PoseMatrix& poses, std::size_t begin, std::size_t end) {
  PoseMatrix rows(end - begin, poses.channels);
  std::copy_n(poses.values.begin() + static_cast<std::ptrdiff_t>(begin * poses.channels),
              rows.values.size(), rows.values.begin());
  return rows;
}

// Copies frames [begin, end) from `rows`, whose first row is frame `first`, to `poses`.
void put_rows(const PoseMatrix& rows, std::size_t first, std::size_t begin, std::size_t end,
              PoseMatrix& poses) {
  const auto at = [&](std::size_t frame) {
    return static_cast<std::ptrdiff_t>(frame * poses.channels);
  };
  std::copy(rows.values.begin() + at(begin - first), rows.values.begin() + at(end - first),
            poses.values.begin() + at(begin));
}

}  // namespace

PoseMatrix filter_linearly(const PoseMatrix& poses, WindowBases bases,
                           std::span<const double> mean) {
  if (poses.frames == 0) return poses;
  // Lasting memory is allocated first, which avoids fragmentation.
  PoseMatrix filtered(poses.frames, poses.channels);
  const Stretches stretches(bases, poses.frames, linear_margin);
  PatternPenalty patterns(std::move(bases), std::vector<double>(mean.size(), 1.0), {},
                          stretches.frames(), stretches.count());
  PoseMatrix z(patterns.padded_frames(), poses.channels), image = z;
  for (std::size_t s = 0; s < stretches.count(); ++s) {
    const std::size_t begin = stretches.begin(s), end = stretches.end(s);
    for (std::size_t f = 0; f < z.frames; ++f) {
      const std::size_t from = std::min(begin + f, end - 1);
      for (std::size_t c = 0; c < z.channels; ++c) z(f, c) = poses(from, c) - mean[c];
    }
    patterns.multiply(z, image);
    for (std::size_t f = stretches.first(s); f < stretches.first(s + 1); ++f) {
      for (std::size_t c = 0; c < poses.channels; ++c)
        filtered(f, c) = mean[c] + image(f - begin, c) / patterns.diagonal(f - begin, c);
    }
  }
  return filtered;
}

std::vector<double> example_filter(PoseMatrix& poses, const PoseMatrix& measured,
                                   std::span<const std::uint8_t> observed, WindowBases bases,
                                   std::span<const double> mean, const ExampleWeights& weights,
                                   const ExampleSettings& settings) {
  std::vector<double> objective;
  if (measured.frames == 0) return objective;
  const Stretches stretches(bases, measured.frames, margin);
  PatternPenalty penalty(std::move(bases), doubled(weights.prior), doubled(weights.coefficients),
                         stretches.frames(), usual_iterations * stretches.count());
  for (std::size_t s = 0; s < stretches.count(); ++s) {
    const std::size_t begin = stretches.begin(s);
    Minimisation minimisation(penalty, rows_of(poses, begin, stretches.end(s)), measured, observed,
                              begin, mean, weights, settings);
    objective = minimisation.run();
    // The margin at the end is the first guess of the next stretch.
    put_rows(minimisation.take_poses(), begin, stretches.first(s), stretches.end(s), poses);
  }
  return objective;
}

PoseMatrix welsch_weights(const PoseMatrix& poses, const PoseMatrix& measured,
                          std::span<const std::uint8_t> observed, std::span<const double> welsch) {
  PoseMatrix weights(poses.frames, poses.channels);
  for (std::size_t i = 0; i < weights.values.size(); ++i) {
    if (!observed.empty() && observed[i] == 0) continue;
    const double off = (poses.values[i] - measured.values[i]) / welsch[i % poses.channels];
    weights.values[i] = portable::exp(-off * off);
  }
  return weights;
}

}  // namespace kinemend
