#include "priors/pattern_penalty.hpp"

#include <tbb/parallel_invoke.h>

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
                               std::span<const double> ridge, std::size_t frames,
                               std::size_t products, Product product)
    : hop_(bases.hop),
      channels_(bases.channels),
      count_(bases.count),
      row_values_(bases.frames * bases.channels),
      overlap_((bases.frames + bases.hop - 1) / bases.hop),
      windows_((frames - bases.frames + bases.hop - 1) / bases.hop + 1),
      groups_(windows_ - 1 + overlap_),
      diagonal_(groups_ * hop_, channels_) {
  std::vector<double> factor = penalty_factor(bases, weights, ridge);
  analysis_ = nn::PackedMatrix({factor.data(), row_values_, count_, count_});
  // A hop's frames are sums over the windows that reach over it, the latest window last.
  const std::size_t hop_values = hop_ * channels_;
  std::vector<double> synthesis(overlap_ * count_ * hop_values);
  for (std::size_t b = 0; b < overlap_; ++b) {
    const std::size_t first = (overlap_ - 1 - b) * hop_values;
    for (std::size_t i = 0; i < hop_values && first + i < row_values_; ++i) {
      for (std::size_t k = 0; k < count_; ++k) {
        synthesis[(b * count_ + k) * hop_values + i] = factor[(first + i) * count_ + k];
      }
    }
  }
  synthesis_ = nn::PackedMatrix({synthesis.data(), overlap_ * count_, hop_values, hop_values});
  for (std::size_t s = 0; s < windows_; ++s) {
    for (std::size_t f = s * hop_; f < s * hop_ + bases.frames; ++f) {
      for (std::size_t c = 0; c < channels_; ++c) diagonal_(f, c) += weights[c];
    }
  }
  if (product == Product::windows ||
      (product == Product::quicker && !frequencies_are_quicker(products)))
    return;
  factor.resize(overlap_ * hop_values * count_);
  convolution_.emplace(factor, overlap_, hop_values, count_);
  ends_.resize(2 * (overlap_ - 1) * hop_values);
  ends_image_ = ends_;
}

bool PatternPenalty::frequencies_are_quicker(std::size_t products) const {
  const auto of_window = 2 * static_cast<double>(row_values_ * count_);
  const double saved = static_cast<double>(windows_ - (overlap_ - 1)) * of_window -
                       PatternConvolution::work(groups_, overlap_, hop_ * channels_);
  return saved * static_cast<double>(products) >
         PatternConvolution::preparation(overlap_, hop_ * channels_, count_);
}

void PatternPenalty::multiply_windows(const double* z, std::size_t windows, double* image) {
  const std::size_t hop_values = hop_ * channels_, groups = windows - 1 + overlap_;
  coefficients_.assign((windows + 2 * (overlap_ - 1)) * count_, 0.0);
  nn::multiply({z, windows, row_values_, hop_values}, analysis_,
               {&coefficients_[(overlap_ - 1) * count_], windows, count_, count_});
  nn::multiply({coefficients_.data(), groups, overlap_ * count_, count_}, synthesis_,
               {image, groups, hop_values, hop_values});
}

void PatternPenalty::multiply(const PoseMatrix& z, PoseMatrix& image) {
  if (!convolution_) {
    multiply_windows(z.values.data(), windows_, image.values.data());
    return;
  }
  const std::size_t over = overlap_ - 1, values = over * hop_ * channels_;
  const std::size_t last = z.values.size() - values;
  tbb::parallel_invoke(
      [&] { convolution_->multiply(z.values.data(), groups_, image.values.data()); },
      [&] {
        if (over == 0) return;
        std::copy_n(&z.values[last], values, ends_.begin());
        std::copy_n(z.values.begin(), values, &ends_[values]);
        multiply_windows(ends_.data(), over, ends_image_.data());
      });
  for (std::size_t i = 0; i < values; ++i) {
    image.values[last + i] -= ends_image_[i];
    image.values[i] -= ends_image_[values + i];
  }
}

}  // namespace kinemend
