// The wavelet transform splits channels into bands; its inverse is exact.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"

namespace kinemend::signal {

/// A wavelet transform of all channels. Each level extends its input of n rows by point reflection
/// and keeps every coefficient whose filter touches a row: floor((n + L - 1) / 2) of each band, so
/// that the inverse is exact.
struct WaveletTransform {
  std::vector<PoseMatrix> details;  ///< finest first
  PoseMatrix smooth;
  std::vector<std::size_t> lengths;  ///< input rows of each level
};

WaveletTransform forward_transform(const PoseMatrix& matrix, std::span<const double> scaling_filter,
                                   int levels);
/// Writes the inverse to `matrix`, which has the original size.
void inverse_transform(WaveletTransform transform, std::span<const double> scaling_filter,
                       PoseMatrix& matrix);

/// The coefficients of one level whose filters lie inside the n input rows; all of them if no
/// filter does.
struct CoefficientRange {
  std::size_t first;
  std::size_t count;
};
CoefficientRange inner_coefficients(std::size_t length, std::size_t filter_length);

}  // namespace kinemend::signal
