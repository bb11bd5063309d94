#include "priors/pattern_penalty.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "nn/gemm.hpp"

namespace kinemend {

namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// G = D^2 E R^-1 with R^T R = E^T D^2 E + V.
std::vector<double> penalty_factor(const WindowBases& bases, std::span<const double> weights,
                                   std::span<const double> ridge) {
  const std::size_t rows = bases.frames * bases.channels, count = bases.count;
  std::vector<double> weighted = bases.values;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < count; ++k) {
      weighted[row * count + k] *= weights[row % bases.channels];
    }
  }
  const auto size = static_cast<Eigen::Index>(count);
  RowMatrix gram(size, size);
  nn::multiply(nn::MatrixView{weighted.data(), rows, count, count}.transposed(),
               {bases.values.data(), rows, count, count}, {gram.data(), count, count, count});
  for (std::size_t k = 0; k < ridge.size() && k < count; ++k) {
    gram(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) += ridge[k];
  }
  // Bases that a short clip cannot tell apart make the matrix singular.
  gram.diagonal().array() += 1e-11 * gram.diagonal().maxCoeff() + 1e-300;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(gram);
  const RowMatrix inverse =
      cholesky.matrixU().solve(Eigen::MatrixXd::Identity(size, size));  // R^-1
  std::vector<double> factor(rows * count);
  nn::multiply({weighted.data(), rows, count, count}, {inverse.data(), count, count, count},
               {factor.data(), rows, count, count});
  return factor;
}

}  // namespace

PatternPenalty::PatternPenalty(const WindowBases& bases, std::span<const double> weights,
                               std::span<const double> ridge, std::size_t frames)
    : hop_(bases.hop),
      channels_(bases.channels),
      count_(bases.count),
      row_values_(bases.frames * bases.channels),
      overlap_((bases.frames + bases.hop - 1) / bases.hop),
      windows_((frames - bases.frames + bases.hop - 1) / bases.hop + 1),
      groups_(windows_ - 1 + overlap_),
      analysis_(penalty_factor(bases, weights, ridge)),
      synthesis_(overlap_ * count_ * hop_ * channels_),
      coefficients_((windows_ + 2 * (overlap_ - 1)) * count_),
      diagonal_(groups_ * hop_, channels_) {
  // A hop's frames are sums over the windows that reach over it, the latest window last.
  const std::size_t hop_values = hop_ * channels_;
  for (std::size_t b = 0; b < overlap_; ++b) {
    const std::size_t first = (overlap_ - 1 - b) * hop_values;
    for (std::size_t i = 0; i < hop_values && first + i < row_values_; ++i) {
      for (std::size_t k = 0; k < count_; ++k) {
        synthesis_[(b * count_ + k) * hop_values + i] = analysis_[(first + i) * count_ + k];
      }
    }
  }
  for (std::size_t s = 0; s < windows_; ++s) {
    for (std::size_t f = s * hop_; f < s * hop_ + bases.frames; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) diagonal_(f, c) += weights[c];
    }
  }
}

void PatternPenalty::multiply(const PoseMatrix& z, PoseMatrix& image) {
  const std::size_t hop_values = hop_ * channels_;
  nn::multiply({z.values.data(), windows_, row_values_, hop_values},
               {analysis_.data(), row_values_, count_, count_},
               {&coefficients_[(overlap_ - 1) * count_], windows_, count_, count_});
  nn::multiply({coefficients_.data(), groups_, overlap_ * count_, count_},
               {synthesis_.data(), overlap_ * count_, hop_values, hop_values},
               {image.values.data(), groups_, hop_values, hop_values});
}

}  // namespace kinemend
