// Dense matrix computations that tests compare the library with, compiled once: each of these takes
// a compiler longer than most tests.
#pragma once

#include <Eigen/Core>

namespace kinemend::test {

/// The X with the least |A X - B|.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// A^-1 B of a symmetric positive definite A.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
double determinant(const Eigen::MatrixXd& a);
/// Of a symmetric positive definite A of any size.
double log_determinant(const Eigen::MatrixXd& a);
/// An R with R R^T = A, of a symmetric positive semidefinite A.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& a);
/// As many orthonormal columns as A has, spanning the same.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& a);
/// The largest |eigenvalue| of a square matrix.
double spectral_radius(const Eigen::MatrixXd& a);

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< in columns
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);

}  // namespace kinemend::test
