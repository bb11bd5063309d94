// Calls Eigen's solver, so that its templates are compiled once.
#include "signal/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace kinemend {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace kinemend
