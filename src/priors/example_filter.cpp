#include "priors/example_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "priors/pattern_penalty.hpp"

namespace kinemend {

namespace {

// Steps on one least-squares problem. The weights change with the next one, so that it need not be
// solved to the end.
constexpr std::size_t most_steps = 6;
constexpr double enough_of_residual = 0.2;

double dot(const PoseMatrix& a, const PoseMatrix& b) {
  // Four sums at once, so that additions do not wait for each other.
  double sums[4] = {};
  const std::size_t whole = a.values.size() / 4 * 4;
  for (std::size_t i = 0; i < whole; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sums[k] += a.values[i + k] * b.values[i + k];
  }
  double rest = 0;
  for (std::size_t i = whole; i < a.values.size(); ++i) rest += a.values[i] * b.values[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest;
}

class Minimisation {
 public:
  Minimisation(const PoseMatrix& first_guess, const PoseMatrix& measured,
               std::span<const std::uint8_t> observed, const WindowBases& bases,
               std::span<const double> mean, const ExampleWeights& weights,
               const ExampleSettings& settings)
      : frames_(measured.frames),
        channels_(measured.channels),
        mean_(mean),
        weights_(weights),
        settings_(settings),
        penalty_(bases, doubled(weights.prior), doubled(weights.coefficients), measured.frames),
        z_(penalty_.padded_frames(), channels_),
        y_(z_),
        alpha_(z_),
        image_(z_),
        weight_(z_),
        diagonal_(z_),
        residual_(z_),
        direction_(z_),
        direction_image_(z_) {
    for (std::size_t f = 0; f < z_.frames; ++f) {
      const std::size_t from = std::min(f, frames_ - 1);
      for (std::size_t c = 0; c < channels_; ++c) {
        z_(f, c) = first_guess(from, c) - mean[c];
        if (f >= frames_) continue;
        y_(f, c) = measured(f, c) - mean[c];
        const bool seen = observed.empty() || observed[f * channels_ + c] != 0;
        alpha_(f, c) = seen ? weights.data[c] : 0.0;
      }
    }
    if (!limited()) return;
    poses_ = PoseMatrix(frames_, channels_);
    nearest_ = poses_;
  }

  ExampleTrace run() {
    ExampleTrace trace;
    scale_ = std::max(settings_.first_welsch, 1.0);
    penalty_.multiply(z_, image_);
    find_nearest();
    trace.objective.push_back(objective());
    for (std::size_t i = 0; i < settings_.iterations; ++i) {
      reweigh();
      if (settings_.solver == ExampleSolver::alternation) {
        alternate();
      } else {
        descend();
      }
      find_nearest();
      const double before = trace.objective.back(), now = objective();
      trace.objective.push_back(now);
      if (scale_ > 1) {
        scale_ = std::max(1.0, scale_ / 2);
      } else if (before - now <= settings_.tolerance * now) {
        break;
      }
    }
    reweigh();
    trace.weights = PoseMatrix(frames_, channels_);
    for (std::size_t f = 0; f < frames_; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) {
        trace.weights(f, c) = weight_(f, c) / weights_.data[c];
      }
    }
    return trace;
  }

  void store(PoseMatrix& poses) const {
    for (std::size_t f = 0; f < frames_; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) poses(f, c) = z_(f, c) + mean_[c];
    }
  }

 private:
  // The data term has a half in it that the others have not.
  static std::vector<double> doubled(std::vector<double> values) {
    for (double& value : values) value *= 2;
    return values;
  }

  bool limited() const { return settings_.limit_weight > 0 && settings_.project; }

  void find_nearest() {
    if (!limited()) return;
    store(poses_);
    settings_.project(poses_, nearest_);
  }

  double objective() const {
    double data = 0;
    for (std::size_t f = 0; f < frames_; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) {
        if (alpha_(f, c) == 0) continue;
        const double r = z_(f, c) - y_(f, c), p = scale_ * weights_.welsch[c];
        data +=
            alpha_(f, c) * (std::isinf(p) ? r * r / 2 : -p * p / 2 * std::expm1(-r * r / (p * p)));
      }
    }
    double patterns = -dot(z_, image_);
    const PoseMatrix& penalty_diagonal = penalty_.diagonal();
    for (std::size_t i = 0; i < z_.values.size(); ++i) {
      patterns += penalty_diagonal.values[i] * z_.values[i] * z_.values[i];
    }
    double limits = 0;
    if (limited()) {
      for (std::size_t i = 0; i < poses_.values.size(); ++i) {
        const double beyond = poses_.values[i] - nearest_.values[i];
        limits += beyond * beyond;
      }
    }
    return data + patterns / 2 + settings_.limit_weight * limits;
  }

  // Eq. 15: w = phi(r) / r.
  void reweigh() {
    for (std::size_t f = 0; f < frames_; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) {
        if (alpha_(f, c) == 0) continue;
        const double r = (z_(f, c) - y_(f, c)) / (scale_ * weights_.welsch[c]);
        weight_(f, c) = alpha_(f, c) * std::exp(-r * r);
      }
    }
  }

  double limit_curvature() const { return limited() ? 2 * settings_.limit_weight : 0.0; }

  // diagonal_: of the quadratic that majorises the objective, less the patterns' part.
  // residual_: its steepest descent.
  void linearise() {
    const double limit = limit_curvature();
    const PoseMatrix& penalty_diagonal = penalty_.diagonal();
    for (std::size_t i = 0; i < z_.values.size(); ++i) {
      const double w = weight_.values[i];
      diagonal_.values[i] = w + penalty_diagonal.values[i];
      residual_.values[i] = w * (y_.values[i] - z_.values[i]) -
                            penalty_diagonal.values[i] * z_.values[i] + image_.values[i];
    }
    if (!limited()) return;
    for (std::size_t i = 0; i < poses_.values.size(); ++i) {
      diagonal_.values[i] += limit;
      residual_.values[i] += limit * (nearest_.values[i] - poses_.values[i]);
    }
  }

  double preconditioned(std::size_t i) const {
    return diagonal_.values[i] > 0 ? residual_.values[i] / diagonal_.values[i] : 0.0;
  }
  double preconditioned_size() const {
    double sum = 0;
    for (std::size_t i = 0; i < residual_.values.size(); ++i) {
      sum += residual_.values[i] * preconditioned(i);
    }
    return sum;
  }

  // Eq. 13 and 15: with the coefficients held, each sample has its own minimum.
  void alternate() {
    linearise();
    for (std::size_t i = 0; i < z_.values.size(); ++i) z_.values[i] += preconditioned(i);
    penalty_.multiply(z_, image_);
  }

  // Conjugate gradients on (W + D - A) z = W y, preconditioned by the diagonal: what one step
  // gains is at least what the alternation does.
  void descend() {
    linearise();
    double size = preconditioned_size();
    const double enough = enough_of_residual * enough_of_residual * size;
    for (std::size_t i = 0; i < z_.values.size(); ++i) direction_.values[i] = preconditioned(i);
    for (std::size_t step = 0; step < most_steps && size > enough; ++step) {
      penalty_.multiply(direction_, direction_image_);
      double curvature = -dot(direction_, direction_image_);
      for (std::size_t i = 0; i < z_.values.size(); ++i) {
        curvature += diagonal_.values[i] * direction_.values[i] * direction_.values[i];
      }
      if (!(curvature > 0)) break;
      const double length = size / curvature;
      for (std::size_t i = 0; i < z_.values.size(); ++i) {
        const double move = length * direction_.values[i];
        const double image_move = length * direction_image_.values[i];
        z_.values[i] += move;
        image_.values[i] += image_move;
        residual_.values[i] += image_move - diagonal_.values[i] * move;
      }
      const double next = preconditioned_size();
      const double carry = next / size;
      size = next;
      for (std::size_t i = 0; i < z_.values.size(); ++i) {
        direction_.values[i] = preconditioned(i) + carry * direction_.values[i];
      }
    }
  }

  std::size_t frames_, channels_;
  std::span<const double> mean_;
  const ExampleWeights& weights_;
  const ExampleSettings& settings_;
  PatternPenalty penalty_;
  double scale_ = 1;  // of p
  PoseMatrix z_, y_;  // less the mean; frames behind the clip belong to nothing
  PoseMatrix alpha_;  // b_l where observed
  PoseMatrix image_;  // A z
  PoseMatrix weight_, diagonal_, residual_, direction_, direction_image_;
  PoseMatrix poses_, nearest_;  // of the limits
};

}  // namespace

void linear_example_filter(PoseMatrix& poses, const WindowBases& bases,
                           std::span<const double> mean) {
  if (poses.frames == 0) return;
  PatternPenalty patterns(bases, std::vector<double>(poses.channels, 1.0), {}, poses.frames);
  PoseMatrix z(patterns.padded_frames(), poses.channels), image = z;
  for (std::size_t f = 0; f < z.frames; ++f) {
    const std::size_t from = std::min(f, poses.frames - 1);
    for (std::size_t c = 0; c < z.channels; ++c) z(f, c) = poses(from, c) - mean[c];
  }
  patterns.multiply(z, image);
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t c = 0; c < poses.channels; ++c) {
      poses(f, c) = mean[c] + image(f, c) / patterns.diagonal()(f, c);
    }
  }
}

ExampleTrace example_filter(PoseMatrix& poses, const PoseMatrix& measured,
                            std::span<const std::uint8_t> observed, const WindowBases& bases,
                            std::span<const double> mean, const ExampleWeights& weights,
                            const ExampleSettings& settings) {
  if (measured.frames == 0) return {};
  Minimisation minimisation(poses, measured, observed, bases, mean, weights, settings);
  ExampleTrace trace = minimisation.run();
  minimisation.store(poses);
  return trace;
}

}  // namespace kinemend
