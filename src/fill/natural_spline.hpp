// Natural smoothing splines through scattered knots, cubic or quintic.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace kinemend::fill {

/// Natural smoothing splines through scattered knots, several channels at once: the curve f that
/// minimises sum_i |y_i - f(x_i)|^2 + smoothing * integral |f^(m)|^2. It is a piecewise polynomial
/// of degree 2m - 1 whose derivatives from the m-th on vanish beyond the outer knots. m = 2 is
/// cubic, m = 3 quintic (Woltring 1986). `smoothing` 0 interpolates.
///
/// With f^(m) = sum_j g_j N_j in B-splines of degree m - 1 at the knots, R the Gram matrix of the
/// N_j and Q their scaled divided differences (Q^T f = R g): (R + smoothing Q^T Q) g = Q^T y and
/// f(x) = y - smoothing Q g (Reinsch 1967, Green & Silverman 1994 for m = 2).
class NaturalSpline {
 public:
  /// `knots` ascend strictly and are at least m + 1; `values` are knots x channels.
  NaturalSpline(int half_order, std::vector<double> knots, std::span<const double> values,
                std::size_t channels);

  /// Fits with the given smoothing.
  void fit(double smoothing);
  /// Fits with the smoothing that has the least generalised cross-validation score over all
  /// channels (Craven & Wahba 1979), searched between two positive bounds. Returns the smoothing.
  double fit_by_cross_validation(double least, double most);
  /// Returns mean |y - f|^2 / (1 - trace(H) / n)^2 of the fit. Requires a `fit` with positive
  /// smoothing.
  double cross_validation_score() const;

  /// Returns the curve at knot `k`: one value a channel.
  std::span<const double> knot_values(std::size_t k) const;
  /// Evaluates the curve at `x` between the first and the last knot.
  void evaluate(double x, std::span<double> result) const;

 private:
  double basis(std::size_t j, int degree, std::size_t interval, double x) const;
  void assemble();
  void factorize();
  double trace_of_residual() const;
  void add_moment(std::size_t interval, double from, double to, double at,
                  std::span<double> result) const;

  std::size_t m_;
  std::size_t channels_;
  std::vector<double> knots_;
  std::vector<double> values_;       // y
  std::vector<double> fitted_;       // f at the knots
  std::vector<double> derivatives_;  // g, (knots - m) x channels
  std::vector<double> differences_;  // Q: per column its m + 1 entries
  std::vector<double> gram_;         // R by diagonals: unknowns x (m + 1)
  std::vector<double> squares_;      // Q^T Q likewise
  std::vector<double> factor_;       // L D L^T of R + smoothing Q^T Q, D in front
  double smoothing_ = 0;
};

}  // namespace kinemend::fill
