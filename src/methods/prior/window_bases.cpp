// Builds the matrix of cosines and the places of windows, and finds eigenvectors by the Lanczos
// solver or the full one.
#include "methods/prior/window_bases.hpp"

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>

#include "base/portable.hpp"
#include "kinemend/error.hpp"
#include "signal/symmetric_eigen.hpp"

namespace kinemend {

Eigen::MatrixXd window_cosines(Eigen::Index frames, Eigen::Index count) {
  Eigen::MatrixXd cosines(frames, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index i = 0; i < frames; ++i) {
      const double phase = std::numbers::pi * static_cast<double>(k) *
                           (static_cast<double>(i) + 0.5) / static_cast<double>(frames);
      cosines(i, k) = k == 0 ? 1.0 : std::numbers::sqrt2 * portable::cos(phase);
    }
  }
  return cosines;
}

Eigen::Index window_frames(double window_s, double rate_hz) {
  return std::max<Eigen::Index>(4, std::lround(window_s * rate_hz));
}

std::vector<Eigen::Index> window_starts(Eigen::Index frames, Eigen::Index window) {
  const Eigen::Index hop = std::max<Eigen::Index>(1, window / 4);
  std::vector<Eigen::Index> starts;
  for (Eigen::Index start = 0; start + window < frames; start += hop) starts.push_back(start);
  starts.push_back(std::max<Eigen::Index>(0, frames - window));
  return starts;
}

namespace {

// An unknown number starts here and is doubled until the energy is reached. Chosen by hand, not
// swept.
constexpr Eigen::Index first_count = 32;
// Beyond this share of all eigenvectors the full solver is faster. For speed; the rest are limits
// by definition, and not swept.
constexpr Eigen::Index full_share = 6;
constexpr Eigen::Index most_restarts = 1000;  // a limit for the solver
constexpr double rounding = 1e-14;            // of the largest eigenvalue

struct EigenPairs {
  Eigen::VectorXd values;  // descending
  Eigen::MatrixXd vectors;
};

using MatrixView = Eigen::Map<const Eigen::MatrixXd>;

EigenPairs all_pairs(const MatrixView& matrix) {
  const SymmetricEigen eigen = symmetric_eigen(matrix);
  return {eigen.values.reverse(), eigen.vectors.rowwise().reverse()};
}

EigenPairs leading_pairs(const MatrixView& matrix, Eigen::Index count, double tolerance) {
  const Eigen::Index n = matrix.rows();
  if (full_share * count >= n) return all_pairs(matrix);
  Spectra::DenseSymMatProd<double> product(matrix);
  Spectra::SymEigsSolver<Spectra::DenseSymMatProd<double>> solver(product, count,
                                                                  std::min(n, 2 * count + 10));
  Eigen::Index found = 0;
  try {
    solver.init();
    found = solver.compute(Spectra::SortRule::LargestAlge, most_restarts, tolerance);
  } catch (const std::exception&) {
    throw Error(ErrorKind::usage, "the values are too large, or too uneven, to find patterns in");
  }
  if (found < count) return all_pairs(matrix);
  return {solver.eigenvalues(), solver.eigenvectors(count)};
}

// Number of pairs to return; all of them if they do not reach the energy.
Eigen::Index wanted_count(const EigenPairs& pairs, double energy, bool& reached) {
  double sum = 0;
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    sum += pairs.values[k];
    if (sum >= energy) {
      reached = true;
      return k + 1;
    }
  }
  return pairs.values.size();
}

void make_largest_entries_positive(Eigen::MatrixXd& vectors) {
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    Eigen::Index largest = 0;
    vectors.col(k).cwiseAbs().maxCoeff(&largest);
    if (vectors(largest, k) < 0) vectors.col(k) *= -1;
  }
}

}  // namespace

LeadingEigenvectors leading_eigenvectors(std::span<const double> matrix, std::size_t n,
                                         const EigenvectorLimits& limits) {
  LeadingEigenvectors result;
  result.size = n;
  const auto side = static_cast<Eigen::Index>(n);
  const MatrixView view(matrix.data(), side, side);
  const double trace = view.trace();
  if (!(trace > 0)) return result;
  if (!std::isfinite(trace)) {
    throw Error(ErrorKind::usage, "the values are too large, or too uneven, to find patterns in");
  }

  const auto given = static_cast<Eigen::Index>(std::min(limits.count, n));
  Eigen::Index count = given > 0 ? given : std::min(first_count, side);
  EigenPairs pairs = leading_pairs(view, count, limits.tolerance);
  Eigen::Index wanted = count;
  for (bool reached = given > 0; !reached;) {
    wanted = wanted_count(pairs, limits.energy * trace, reached);
    if (reached || pairs.values.size() == side) break;
    count = std::min(2 * count, side);
    pairs = leading_pairs(view, count, limits.tolerance);
  }
  while (wanted > 0 && pairs.values[wanted - 1] <= rounding * pairs.values[0]) --wanted;

  make_largest_entries_positive(pairs.vectors);
  result.values.assign(pairs.values.data(), pairs.values.data() + wanted);
  result.vectors.resize(n * static_cast<std::size_t>(wanted));
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      result.vectors.data(), side, wanted) = pairs.vectors.leftCols(wanted);
  return result;
}

}  // namespace kinemend
