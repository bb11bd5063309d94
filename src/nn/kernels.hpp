// The inner loops of products of matrices and of layers, compiled for each instruction set and
// chosen at run time.
#pragma once

#include <cstddef>

#include "nn/gemm.hpp"

namespace kinemend::nn {

/// Rows of b that are packed at once: a panel of them stays in the nearest caches. For speed, not
/// swept.
inline constexpr std::size_t gemm_depth = 192;

/// Columns of a full panel on this processor; the last panel of a matrix is as wide as it needs.
template <class Real>
std::size_t gemm_panel_columns();
template <>
std::size_t gemm_panel_columns<double>();
template <>
std::size_t gemm_panel_columns<float>();

/// Copies rows [first, first + depth) of b panel by panel: the rows of each panel one after the
/// other, `gemm_panel_columns()` values each, padded with zeros beyond the columns of b.
void pack_panels(const MatrixView& b, std::size_t first, std::size_t depth, double* packed);
void pack_panels(const MatrixViewF& b, std::size_t first, std::size_t depth, float* packed);

/// c[r] = or += a[r, first .. first + depth) * packed for rows [first_row, last_row) of c.
void multiply_rows(const MatrixView& a, std::size_t first, std::size_t depth, const double* packed,
                   const MutableMatrixView& c, std::size_t first_row, std::size_t last_row,
                   Product product);
void multiply_rows(const MatrixViewF& a, std::size_t first, std::size_t depth, const float* packed,
                   const MutableMatrixViewF& c, std::size_t first_row, std::size_t last_row,
                   Product product);

/// Functions of `count` floats in place.
void exp_of(float* values, std::size_t count);
void tanh_of(float* values, std::size_t count);
/// For training, which keeps the gates of each step.
void sigmoid_of(float* values, std::size_t count);
void relu_of(float* values, std::size_t count);

/// A step of an LSTM's memory from its gates i, f, g and o before activation, `units` each, one
/// after the other: c = s(f) c + s(i) tanh(g), h = s(o) tanh(c).
void lstm_gates(float* gates, std::size_t units, float* cell, float* state);

}  // namespace kinemend::nn
