// Squares the matrix until only the leading eigenvector is left.
#include "motion/leading_eigenvector.hpp"

namespace kinemend::rotation {

Quat leading_eigenvector(Matrix4 matrix, Quat fallback) {
  // Repeated squaring, with the trace kept at 1, leaves the projection on the leading eigenvector.
  const double size = matrix[0][0] + matrix[1][1] + matrix[2][2] + matrix[3][3];
  if (!(size > 0)) return normalized(fallback);
  for (auto& row : matrix) {
    for (double& entry : row) entry /= size;
  }
  for (int squaring = 0; squaring < 48; ++squaring) {
    Matrix4 square{};
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = r; c < 4; ++c) {
        for (std::size_t k = 0; k < 4; ++k) square[r][c] += matrix[r][k] * matrix[c][k];
      }
    }
    const double trace = square[0][0] + square[1][1] + square[2][2] + square[3][3];
    const double scale = 1 / trace;
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = r; c < 4; ++c) matrix[r][c] = matrix[c][r] = scale * square[r][c];
    }
    if (trace > 1 - 1e-15) break;  // the matrix has rank one
  }
  std::size_t largest = 0;
  for (std::size_t r = 1; r < 4; ++r) {
    if (matrix[r][r] > matrix[largest][largest]) largest = r;
  }
  const auto& row = matrix[largest];
  return normalized({row[0], row[1], row[2], row[3]});
}

}  // namespace kinemend::rotation
