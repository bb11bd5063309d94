#include "priors/leading_eigenvectors.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "kinemend/random.hpp"
#include "nn/gemm.hpp"

namespace kinemend {

namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t block_columns = 24;
constexpr std::uint64_t start_seed = 1;

nn::MatrixView view(const RowMatrix& m, std::size_t columns) {
  return {m.data(), static_cast<std::size_t>(m.rows()), columns,
          static_cast<std::size_t>(m.cols())};
}
nn::MatrixView view(const RowMatrix& m) { return view(m, static_cast<std::size_t>(m.cols())); }
nn::MutableMatrixView target(RowMatrix& m) {
  const auto columns = static_cast<std::size_t>(m.cols());
  return {m.data(), static_cast<std::size_t>(m.rows()), columns, columns};
}

RowMatrix random_block(std::size_t rows, std::size_t columns, Random& random) {
  RowMatrix block(rows, columns);
  for (double& value : block.reshaped()) value = random.normal();
  return block;
}

// Wanted eigenpairs of the projected matrix, largest first.
struct RitzPairs {
  Eigen::VectorXd values;   // of all
  Eigen::MatrixXd vectors;  // of all
  std::size_t wanted = 0;   // of the leading ones
  bool enough = false;      // whether so many are there
};

// A basis that grows block by block until the leading eigenvectors lie in it.
class KrylovSpace {
 public:
  KrylovSpace(std::span<const double> matrix, std::size_t n)
      : matrix_(matrix), n_(n), random_(start_seed) {
    basis_.resize(n, std::min(n, 8 * block_columns));
    for (std::size_t i = 0; i < n; ++i) trace_ += matrix[i * n + i];
  }

  double trace() const { return trace_; }
  bool complete() const { return size_ == n_; }

  // Takes the next block in, and prepares the one behind it.
  void grow() {
    if (next_.cols() == 0) start_afresh();
    append(next_);
    const auto width = static_cast<std::size_t>(next_.cols());
    RowMatrix image(n_, width);
    nn::multiply({matrix_.data(), n_, n_, n_}, view(next_), target(image));
    project(image);
    next_ = orthonormal_rest(image);
  }

  RitzPairs ritz_pairs(const EigenvectorLimits& limits) const {
    const auto m = static_cast<Eigen::Index>(size_);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(projected_.topLeftCorner(m, m));
    RitzPairs pairs;
    pairs.values = solver.eigenvalues().reverse();
    pairs.vectors = solver.eigenvectors().rowwise().reverse();
    double sum = 0;
    while (pairs.wanted < size_ && !pairs.enough) {
      sum += pairs.values[static_cast<Eigen::Index>(pairs.wanted++)];
      pairs.enough =
          limits.count > 0 ? pairs.wanted == limits.count : sum >= limits.energy * trace_;
    }
    return pairs;
  }

  // |A v - value v| of the pair: what the last block's image leaves outside the space.
  double residual(const RitzPairs& pairs, std::size_t pair) const {
    const auto width = rest_.cols();
    return (rest_ * pairs.vectors.col(static_cast<Eigen::Index>(pair)).tail(width)).norm();
  }

  RowMatrix vectors(const RitzPairs& pairs) const {
    const RowMatrix weights = pairs.vectors.leftCols(static_cast<Eigen::Index>(pairs.wanted));
    RowMatrix result(n_, pairs.wanted);
    nn::multiply(view(basis_, size_), view(weights), target(result));
    return result;
  }

 private:
  // The first block, or one where the space is closed under the matrix.
  void start_afresh() {
    RowMatrix block = random_block(n_, std::min(block_columns, n_ - size_), random_);
    next_ = orthonormal_rest(block);
  }

  void append(const RowMatrix& block) {
    const std::size_t size = size_ + static_cast<std::size_t>(block.cols());
    if (size > static_cast<std::size_t>(basis_.cols())) {
      basis_.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(std::min(n_, 2 * size)));
    }
    basis_.middleCols(static_cast<Eigen::Index>(size_), block.cols()) = block;
    size_ = size;
  }

  // The new columns of the projected matrix.
  void project(const RowMatrix& image) {
    const auto m = static_cast<Eigen::Index>(size_);
    if (m > projected_.rows()) projected_.conservativeResize(2 * m, 2 * m);
    RowMatrix columns(m, image.cols());
    nn::multiply(view(basis_, size_).transposed(), view(image), target(columns));
    projected_.block(0, m - image.cols(), m, image.cols()) = columns;
    projected_.block(m - image.cols(), 0, image.cols(), m) = columns.transpose();
  }

  // What is new in the block, orthonormal; twice, as rounding asks for.
  RowMatrix orthonormal_rest(RowMatrix block) {
    const double size = block.norm();
    remove_basis(block);
    remove_basis(block);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(block);
    const double least = 1e-13 * size;
    Eigen::Index rank = 0;
    while (rank < std::min(block.cols(), static_cast<Eigen::Index>(n_ - size_)) &&
           std::abs(qr.matrixQR()(rank, rank)) > least) {
      ++rank;
    }
    const Eigen::MatrixXd upper =
        qr.matrixQR().topRows(block.cols()).triangularView<Eigen::Upper>();
    rest_ = upper.topRows(rank) * qr.colsPermutation().transpose();
    if (rank == 0) return {block.rows(), 0};
    RowMatrix fresh = qr.householderQ() * Eigen::MatrixXd::Identity(block.rows(), rank);
    remove_basis(fresh);
    const Eigen::HouseholderQR<Eigen::MatrixXd> again(fresh);
    const Eigen::VectorXd signs = again.matrixQR().diagonal().head(rank).cwiseSign();
    fresh = again.householderQ() * Eigen::MatrixXd::Identity(block.rows(), rank);
    return fresh * signs.asDiagonal();
  }

  void remove_basis(RowMatrix& block) const {
    if (size_ == 0) return;
    RowMatrix parts(size_, block.cols());
    nn::multiply(view(basis_, size_).transposed(), view(block), target(parts));
    parts = -parts;
    nn::multiply(view(basis_, size_), view(parts), target(block), nn::Product::add);
  }

  std::span<const double> matrix_;
  std::size_t n_;
  Random random_;
  double trace_ = 0;
  RowMatrix basis_;  // n x room, of which `size_` columns are in use
  std::size_t size_ = 0;
  Eigen::MatrixXd projected_;
  RowMatrix next_;        // the block behind the basis
  Eigen::MatrixXd rest_;  // image of the last block = basis part + next_ * rest_
};

void make_largest_entries_positive(RowMatrix& vectors) {
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
  KrylovSpace space(matrix, n);
  if (!(space.trace() > 0)) return result;
  std::size_t blocks = 0, next_check = 3;
  RitzPairs pairs;
  while (true) {
    space.grow();
    if (++blocks < next_check && !space.complete()) continue;
    next_check = blocks + std::max<std::size_t>(1, blocks / 4);
    pairs = space.ritz_pairs(limits);
    if (space.complete()) break;
    const double allowed = limits.tolerance * pairs.values[0];
    bool converged = pairs.enough;
    for (std::size_t k = 0; k < pairs.wanted && converged; ++k) {
      converged = space.residual(pairs, k) <= allowed;
    }
    if (converged) break;
  }
  while (pairs.wanted > 0 &&
         pairs.values[static_cast<Eigen::Index>(pairs.wanted) - 1] <= 1e-14 * pairs.values[0]) {
    --pairs.wanted;
  }
  RowMatrix vectors = space.vectors(pairs);
  make_largest_entries_positive(vectors);
  result.values.assign(pairs.values.data(), pairs.values.data() + pairs.wanted);
  result.vectors.assign(vectors.data(), vectors.data() + vectors.size());
  return result;
}

}  // namespace kinemend
