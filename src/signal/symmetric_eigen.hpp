// Eigenvalues and eigenvectors of symmetric matrices.
#pragma once

#include <Eigen/Core>

namespace kinemend {

/// Eigenvalues, ascending, and the orthonormal eigenvectors of a symmetric N x N matrix; only its
/// lower half is read. Compiled once: the solver's templates are among the largest of the library.
struct SymmetricEigen {
  Eigen::VectorXd values;   ///< N
  Eigen::MatrixXd vectors;  ///< N x N, one per column
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

}  // namespace kinemend
