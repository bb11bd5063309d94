// Dense matrix computations as references for tests. They are compiled once, because each takes
// longer to compile than most tests.
#pragma once

#include <Eigen/Core>

namespace kinemend::test {

/// The X that minimises |A X - B|.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// A^-1 B for symmetric positive definite A.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
double determinant(const Eigen::MatrixXd& a);
/// The log determinant of a symmetric positive definite A of any size.
double log_determinant(const Eigen::MatrixXd& a);
/// An R with R R^T = A for symmetric positive semidefinite A.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& a);
/// An orthonormal basis of A's columns, with as many columns as A.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& a);
/// The largest |eigenvalue| of a square matrix.
double spectral_radius(const Eigen::MatrixXd& a);

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< in columns
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);

}  // namespace kinemend::test
