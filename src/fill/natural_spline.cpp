// Solves for the spline in banded form and chooses its smoothing by cross-validation.
#include "fill/natural_spline.hpp"

#include <algorithm>
#include <array>

#include "base/portable.hpp"

namespace kinemend::fill {

namespace {

// Gauss-Legendre on [-1, 1] with three points is exact to degree 5, which suffices for a quintic.
constexpr std::array<double, 3> gauss_nodes = {-0.77459666924148337704, 0.0,
                                               0.77459666924148337704};
constexpr std::array<double, 3> gauss_weights = {5.0 / 9, 8.0 / 9, 5.0 / 9};

double factorial(std::size_t n) { return n < 2 ? 1.0 : static_cast<double>(n) * factorial(n - 1); }

}  // namespace

NaturalSpline::NaturalSpline(int half_order, std::vector<double> knots,
                             std::span<const double> values, std::size_t channels)
    : m_(static_cast<std::size_t>(half_order)),
      channels_(channels),
      knots_(std::move(knots)),
      values_(values.begin(), values.end()),
      fitted_(values_) {
  assemble();
}

// N_j of `degree` on knots j to j + degree + 1, at x in the given interval (Cox & de Boor).
double NaturalSpline::basis(std::size_t j, int degree, std::size_t interval, double x) const {
  if (degree == 0) return j == interval ? 1.0 : 0.0;
  const auto d = static_cast<std::size_t>(degree);
  const double rising = (x - knots_[j]) / (knots_[j + d] - knots_[j]);
  const double falling = (knots_[j + d + 1] - x) / (knots_[j + d + 1] - knots_[j + 1]);
  return rising * basis(j, degree - 1, interval, x) +
         falling * basis(j + 1, degree - 1, interval, x);
}

void NaturalSpline::assemble() {
  const std::size_t width = m_ + 1, unknowns = knots_.size() - m_;
  const int degree = static_cast<int>(m_) - 1;
  differences_.assign(unknowns * width, 0.0);
  gram_.assign(unknowns * width, 0.0);
  squares_.assign(unknowns * width, 0.0);
  const double scale = factorial(m_ - 1);
  for (std::size_t j = 0; j < unknowns; ++j) {
    for (std::size_t i = 0; i < width; ++i) {
      double product = 1;
      for (std::size_t k = 0; k < width; ++k) {
        if (k != i) product *= knots_[j + i] - knots_[j + k];
      }
      differences_[j * width + i] = scale * (knots_[j + m_] - knots_[j]) / product;
    }
  }
  for (std::size_t j = 0; j < unknowns; ++j) {
    for (std::size_t k = 0; k < width && j + k < unknowns; ++k) {
      double sum = 0;
      for (std::size_t i = k; i < width; ++i) {
        sum += differences_[j * width + i] * differences_[(j + k) * width + i - k];
      }
      squares_[j * width + k] = sum;
    }
  }
  for (std::size_t interval = 0; interval + 1 < knots_.size(); ++interval) {
    const std::size_t first = interval + 1 >= m_ ? interval + 1 - m_ : 0;
    const std::size_t last = std::min(interval, unknowns - 1);
    const double half = (knots_[interval + 1] - knots_[interval]) / 2;
    const double centre = (knots_[interval + 1] + knots_[interval]) / 2;
    for (std::size_t g = 0; g < gauss_nodes.size(); ++g) {
      std::array<double, 3> at{};
      for (std::size_t j = first; j <= last; ++j) {
        at[j - first] = basis(j, degree, interval, centre + half * gauss_nodes[g]);
      }
      for (std::size_t j = first; j <= last; ++j) {
        for (std::size_t k = j; k <= last; ++k) {
          gram_[j * width + k - j] += half * gauss_weights[g] * at[j - first] * at[k - first];
        }
      }
    }
  }
}

// factor_[j][0] = d_j, factor_[j][k] = l_(j+k, j).
void NaturalSpline::factorize() {
  const std::size_t width = m_ + 1, unknowns = knots_.size() - m_;
  factor_.resize(gram_.size());
  for (std::size_t i = 0; i < gram_.size(); ++i) factor_[i] = gram_[i] + smoothing_ * squares_[i];
  for (std::size_t j = 0; j < unknowns; ++j) {
    double* column = factor_.data() + j * width;
    for (std::size_t k = 1; k < width && j + k < unknowns; ++k) {
      const double l = column[k] / column[0];
      for (std::size_t i = k; i < width && j + i < unknowns; ++i) {
        factor_[(j + k) * width + i - k] -= l * column[i];
      }
    }
    for (std::size_t k = 1; k < width; ++k) column[k] /= column[0];
  }
}

void NaturalSpline::fit(double smoothing) {
  smoothing_ = smoothing;
  factorize();
  const std::size_t width = m_ + 1, unknowns = knots_.size() - m_;
  derivatives_.assign(unknowns * channels_, 0.0);
  for (std::size_t c = 0; c < channels_; ++c) {
    const auto g = [&](std::size_t j) -> double& { return derivatives_[j * channels_ + c]; };
    for (std::size_t j = 0; j < unknowns; ++j) {
      for (std::size_t i = 0; i < width; ++i) {
        g(j) += differences_[j * width + i] * values_[(j + i) * channels_ + c];
      }
    }
    for (std::size_t j = 0; j < unknowns; ++j) {
      for (std::size_t k = 1; k < width && j + k < unknowns; ++k) {
        g(j + k) -= factor_[j * width + k] * g(j);
      }
    }
    for (std::size_t j = unknowns; j-- > 0;) {
      g(j) /= factor_[j * width];
      for (std::size_t k = 1; k < width && j + k < unknowns; ++k) {
        g(j) -= factor_[j * width + k] * g(j + k);
      }
    }
  }
  fitted_ = values_;
  if (smoothing_ == 0) return;
  for (std::size_t j = 0; j < unknowns; ++j) {
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t c = 0; c < channels_; ++c) {
        fitted_[(j + i) * channels_ + c] -=
            smoothing_ * differences_[j * width + i] * derivatives_[j * channels_ + c];
      }
    }
  }
}

// trace(I - H) = smoothing trace((R + smoothing Q^T Q)^-1 Q^T Q). Only the band of the inverse is
// needed; it follows from the factors by backward recursion (Hutchinson & de Hoog 1985).
double NaturalSpline::trace_of_residual() const {
  const std::size_t width = m_ + 1, unknowns = knots_.size() - m_;
  std::vector<double> inverse(unknowns * width, 0.0);
  const auto at = [&](std::size_t i, std::size_t j) {
    return inverse[std::min(i, j) * width + (i < j ? j - i : i - j)];
  };
  double trace = 0;
  for (std::size_t i = unknowns; i-- > 0;) {
    const std::size_t reach = std::min(m_, unknowns - 1 - i);
    for (std::size_t j = reach + 1; j-- > 0;) {
      double sum = j == 0 ? 1 / factor_[i * width] : 0.0;
      for (std::size_t k = 1; k <= reach; ++k) {
        sum -= factor_[i * width + k] * at(i + k, i + j);
      }
      inverse[i * width + j] = sum;
      trace += (j == 0 ? 1 : 2) * sum * squares_[i * width + j];
    }
  }
  return smoothing_ * trace;
}

double NaturalSpline::cross_validation_score() const {
  double residual = 0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    residual += (values_[i] - fitted_[i]) * (values_[i] - fitted_[i]);
  }
  const double share = trace_of_residual() / static_cast<double>(knots_.size());
  return residual / static_cast<double>(knots_.size()) / (share * share);
}

double NaturalSpline::fit_by_cross_validation(double least, double most) {
  // The resolution is fine enough given the coarse grid's steps; not swept.
  constexpr int fine = 6;  // halvings: to a 64th of the grid's step
  const double low = portable::log(least), width = portable::log(most) - low;
  // The minima of the score are at least a factor of about 16 apart.
  const int coarse = 2 + static_cast<int>(width / portable::log(16.0));
  const double step = width / (coarse - 1);
  const auto score_at = [&](double log_smoothing) {
    fit(portable::exp(log_smoothing));
    return cross_validation_score();
  };
  double best = low, best_score = score_at(low);
  for (int i = 1; i < coarse; ++i) {
    const double score = score_at(low + i * step);
    if (score < best_score) best = low + i * step, best_score = score;
  }
  // The score is smooth in log(smoothing), so halving the step about the grid's best finds the
  // minimum.
  double reach = step / 2;
  for (int i = 0; i < fine; ++i, reach /= 2) {
    for (const double candidate : {best - reach, best + reach}) {
      if (candidate < low || candidate > portable::log(most)) continue;
      const double score = score_at(candidate);
      if (score < best_score) best = candidate, best_score = score;
    }
  }
  fit(portable::exp(best));
  return smoothing_;
}

std::span<const double> NaturalSpline::knot_values(std::size_t k) const {
  return std::span(fitted_).subspan(k * channels_, channels_);
}

// Adds to `result` the integral over [from, to] of (at - s)^(m-1) / (m-1)! f^(m)(s) ds, inside one
// interval.
void NaturalSpline::add_moment(std::size_t interval, double from, double to, double at,
                               std::span<double> result) const {
  const std::size_t unknowns = knots_.size() - m_;
  const std::size_t first = interval + 1 >= m_ ? interval + 1 - m_ : 0;
  const std::size_t last = std::min(interval, unknowns - 1);
  const double half = (to - from) / 2, centre = (to + from) / 2;
  for (std::size_t g = 0; g < gauss_nodes.size(); ++g) {
    const double s = centre + half * gauss_nodes[g];
    const double kernel = half * gauss_weights[g] *
                          portable::pow(at - s, static_cast<double>(m_ - 1)) / factorial(m_ - 1);
    for (std::size_t j = first; j <= last; ++j) {
      const double weight = kernel * basis(j, static_cast<int>(m_) - 1, interval, s);
      for (std::size_t c = 0; c < channels_; ++c) {
        result[c] += weight * derivatives_[j * channels_ + c];
      }
    }
  }
}

// f is T, the m-fold integral of f^(m) from the knot left of x, plus a polynomial of degree m - 1
// that corrects f at the knots on both sides and, for m = 3, at a third one beside them.
void NaturalSpline::evaluate(double x, std::span<double> result) const {
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), x);
  const auto after = static_cast<std::size_t>(above - knots_.begin());
  const std::size_t k = std::clamp<std::size_t>(after, 1, knots_.size() - 1) - 1;
  const bool third_left = k > 0;
  const std::array<std::size_t, 3> at = {k, k + 1, third_left ? k - 1 : k + 2};
  std::fill(result.begin(), result.end(), 0.0);
  add_moment(k, knots_[k], x, x, result);
  std::vector<double> moments(channels_);
  for (std::size_t i = 0; i < m_; ++i) {
    const double node = knots_[at[i]];
    double lagrange = 1;
    for (std::size_t other = 0; other < m_; ++other) {
      if (other != i) lagrange *= (x - knots_[at[other]]) / (node - knots_[at[other]]);
    }
    std::fill(moments.begin(), moments.end(), 0.0);
    if (i == 1) add_moment(k, knots_[k], node, node, moments);
    if (i == 2 && third_left) add_moment(k - 1, knots_[k], node, node, moments);
    if (i == 2 && !third_left) {
      add_moment(k, knots_[k], knots_[k + 1], node, moments);
      add_moment(k + 1, knots_[k + 1], node, node, moments);
    }
    for (std::size_t c = 0; c < channels_; ++c) {
      result[c] += lagrange * (fitted_[at[i] * channels_ + c] - moments[c]);
    }
  }
}

}  // namespace kinemend::fill
