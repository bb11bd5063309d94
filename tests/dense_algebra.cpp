// Instantiates Eigen's dense solvers and decompositions once.
#include "dense_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace kinemend::test {

using Eigen::MatrixXd;

MatrixXd least_squares(const MatrixXd& a, const MatrixXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

MatrixXd solve_symmetric(const MatrixXd& a, const MatrixXd& b) { return a.ldlt().solve(b); }

MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }

double determinant(const MatrixXd& a) { return a.determinant(); }

double log_determinant(const MatrixXd& a) {
  return 2 * a.llt().matrixLLT().diagonal().array().log().sum();
}

MatrixXd root_of(const MatrixXd& a) {
  const Eigen::LDLT<MatrixXd> factors(a);
  const MatrixXd lower = factors.matrixL();
  const MatrixXd scaled = lower * factors.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  return factors.transpositionsP().transpose() * scaled;
}

MatrixXd orthonormal(const MatrixXd& a) {
  return a.householderQr().householderQ() * MatrixXd::Identity(a.rows(), a.cols());
}

double spectral_radius(const MatrixXd& a) { return a.eigenvalues().cwiseAbs().maxCoeff(); }

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace kinemend::test
