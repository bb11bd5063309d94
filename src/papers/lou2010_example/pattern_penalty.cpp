// Applies the quadratic form of the patterns by windows or by frequencies, whichever is faster.
#include "papers/lou2010_example/pattern_penalty.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "base/parallel.hpp"
#include "kinemend/experimental/threads.hpp"
#include "nn/gemm.hpp"

namespace kinemend {

namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Rows of E that are weighted at once. For speed, not swept.
constexpr std::size_t gram_rows = 192;
// Prepared matrices are written to new memory, which costs about half as much as their products.
// Not swept.
constexpr double cost_of_preparing = 1.5;
// Columns of the inverse of a triangle that are multiplied at once. For speed, not swept.
constexpr std::size_t triangle_columns = 48;

// E^T D^2 E of bases that are sampled at the clip's frames.
RowMatrix sampled_gram(const WindowBases& bases, std::span<const double> weights) {
  const std::size_t rows = bases.frames * bases.channels, count = bases.count;
  const auto size = static_cast<Eigen::Index>(count);
  RowMatrix gram = RowMatrix::Zero(size, size);
  std::vector<double> weighted(gram_rows * count);
  for (std::size_t first = 0; first < rows; first += gram_rows) {
    const std::size_t found = std::min(gram_rows, rows - first);
    const double* part = &bases.values[first * count];
    for (std::size_t row = 0; row < found; ++row) {
      const double weight = weights[(first + row) % bases.channels];
      for (std::size_t k = 0; k < count; ++k) {
        weighted[row * count + k] = weight * part[row * count + k];
      }
    }
    nn::multiply(nn::MatrixView{weighted.data(), found, count, count}.transposed(),
                 {part, found, count, count}, {gram.data(), count, count, count}, nn::Product::add);
  }
  return gram;
}

// The same of bases at the model's frames: with S the interpolation, E^T (S^T S x D^2) E.
RowMatrix interpolated_gram(const WindowBases& bases, std::span<const double> weights) {
  const std::size_t frames = bases.model_frames(), count = bases.count;
  const std::size_t patterns = bases.channels * count, rows = frames * bases.channels;
  const nn::MatrixView S{bases.interpolation.data(), bases.frames, frames, frames};
  std::vector<double> shared(frames * frames), weighted(frames * patterns);
  nn::multiply_symmetric(S.transposed(), S, {shared.data(), frames, frames, frames});
  nn::multiply({shared.data(), frames, frames, frames},
               {bases.values.data(), frames, patterns, patterns},
               {weighted.data(), frames, patterns, patterns});
  for (std::size_t i = 0; i < weighted.size(); ++i)
    weighted[i] *= weights[i / count % bases.channels];
  RowMatrix gram(count, count);
  nn::multiply(nn::MatrixView{weighted.data(), rows, count, count}.transposed(),
               {bases.values.data(), rows, count, count}, {gram.data(), count, count, count});
  return gram;
}

// E^T D^2 E + V
RowMatrix penalty_gram(const WindowBases& bases, std::span<const double> weights,
                       std::span<const double> ridge) {
  const std::size_t count = bases.count;
  RowMatrix gram =
      bases.is_interpolated() ? interpolated_gram(bases, weights) : sampled_gram(bases, weights);
  for (std::size_t k = 0; k < ridge.size() && k < count; ++k) {
    gram(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) += ridge[k];
  }
  // Bases that are dependent on a short clip make the matrix singular; a small ridge prevents that.
  gram.diagonal().array() += 1e-11 * gram.diagonal().maxCoeff() + 1e-300;
  return gram;
}

// G = D^2 E R^-1 with R^T R the gram matrix, padded with zeros to the given number of rows.
// Invalidates the bases.
std::vector<double> penalty_factor(WindowBases& bases, std::span<const double> weights,
                                   std::span<const double> ridge, std::size_t whole_rows) {
  const bool plain = std::all_of(weights.begin(), weights.end(), [](double w) { return w == 1; });
  if (bases.orthonormal && plain && ridge.empty()) {
    bases.values.resize(whole_rows * bases.count);
    return std::move(bases.values);
  }
  const std::size_t count = bases.count, rows = bases.values.size() / count;
  const auto size = static_cast<Eigen::Index>(count);
  const Eigen::LLT<Eigen::MatrixXd> cholesky(penalty_gram(bases, weights, ridge));
  const RowMatrix inverse = cholesky.matrixU().solve(Eigen::MatrixXd::Identity(size, size));
  const nn::MatrixView right{inverse.data(), count, count, count};
  // Row by row, G overwrites E.
  std::vector<double> part(gram_rows * count);
  for (std::size_t first_row = 0; first_row < rows; first_row += gram_rows) {
    const std::size_t found = std::min(gram_rows, rows - first_row);
    double* of_rows = &bases.values[first_row * count];
    const nn::MatrixView left{of_rows, found, count, count};
    const nn::MutableMatrixView product{part.data(), found, count, count};
    // The inverse of an upper triangle is an upper triangle.
    for (std::size_t first = 0; first < count; first += triangle_columns) {
      const std::size_t width = std::min(triangle_columns, count - first), depth = first + width;
      nn::multiply(left.block(0, 0, found, depth), right.block(0, first, depth, width),
                   product.block(0, first, found, width));
    }
    for (std::size_t i = 0; i < found * count; ++i)
      of_rows[i] = part[i] * weights[(first_row + i / count) % bases.channels];
  }
  bases.values.resize(whole_rows * count);
  return std::move(bases.values);
}

}  // namespace

PatternPenalty::PatternPenalty(WindowBases bases, std::span<const double> weights,
                               std::span<const double> ridge, std::size_t frames,
                               std::size_t products, Product product)
    : hop_(bases.hop),
      channels_(bases.channels),
      count_(bases.count),
      row_values_(bases.frames * bases.channels),
      overlap_((bases.frames + bases.hop - 1) / bases.hop),
      windows_((frames - bases.frames + bases.hop - 1) / bases.hop + 1),
      groups_(windows_ - 1 + overlap_),
      windows_over_(groups_ * hop_),
      weights_(weights.begin(), weights.end()) {
  for (std::size_t s = 0; s < windows_; ++s) {
    for (std::size_t f = s * hop_; f < s * hop_ + bases.frames; ++f) windows_over_[f] += 1;
  }
  if (bases.is_interpolated()) {
    model_frames_ = bases.model_frames();
    factor_ = penalty_factor(bases, weights, ridge, model_frames_ * channels_);
    interpolation_ = std::move(bases.interpolation);
    interpolation_.resize(overlap_ * hop_ * model_frames_);
    at_model_rate_.resize((windows_ + 2 * (overlap_ - 1)) * model_frames_ * channels_);
    coefficients_.resize(windows_ * count_);
    return;
  }
  std::vector<double> factor = penalty_factor(bases, weights, ridge, overlap_ * hop_ * channels_);
  if (product == Product::frequencies ||
      (product == Product::quicker && frequencies_are_quicker(products))) {
    convolution_.emplace(factor, overlap_, hop_ * channels_, count_);
    factor_ = std::move(factor);
  } else {
    prepare_windows(factor);
  }
}

void PatternPenalty::prepare_windows(const std::vector<double>& factor) {
  const std::size_t hop_values = hop_ * channels_;
  analysis_ = nn::PackedMatrix({factor.data(), row_values_, count_, count_});
  // A hop's frames are sums over the windows that contain it, the latest window last.
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
  coefficients_.resize((windows_ + 2 * (overlap_ - 1)) * count_);
}

bool PatternPenalty::frequencies_are_quicker(std::size_t products) const {
  const double of_window = 2 * static_cast<double>(row_values_ * count_);
  const double windows = static_cast<double>(windows_), at_ends = static_cast<double>(overlap_ - 1);
  const double saved = (windows - at_ends) * of_window -
                       PatternConvolution::work(groups_, overlap_, hop_ * channels_);
  return saved * static_cast<double>(products) >
         cost_of_preparing * PatternConvolution::preparation(overlap_, hop_ * channels_, count_);
}

void PatternPenalty::multiply(const PoseMatrix& z, PoseMatrix& image) {
  if (convolution_) {
    for_each_index(2, [&](std::size_t part) {
      if (part == 0) {
        convolution_->multiply(z.values.data(), groups_, image.values.data());
      } else {
        multiply_ends(z);
      }
    });
    take_off_ends(image);
  } else if (model_frames_ > 0) {
    multiply_at_model_rate(z, image);
  } else {
    multiply_windows(z, image);
  }
}

void PatternPenalty::multiply_windows(const PoseMatrix& z, PoseMatrix& image) {
  const std::size_t hop_values = hop_ * channels_;
  nn::multiply({z.values.data(), windows_, row_values_, hop_values}, analysis_,
               {&coefficients_[(overlap_ - 1) * count_], windows_, count_, count_});
  nn::multiply({coefficients_.data(), groups_, overlap_ * count_, count_}, synthesis_,
               {image.values.data(), groups_, hop_values, hop_values});
}

void PatternPenalty::multiply_at_model_rate(const PoseMatrix& z, PoseMatrix& image) {
  const std::size_t of_window = model_frames_ * channels_, of_hop = hop_ * channels_;
  const std::size_t frames = row_values_ / channels_, before = overlap_ - 1;
  double* windows = &at_model_rate_[before * of_window];
  // A thread that waits for a product must not start another window.
  const auto for_each = [](std::size_t count, const auto& action) {
    for_each_index(count, [&](std::size_t i) { run_isolated([&] { action(i); }); });
  };
  const nn::MatrixView to_clip{interpolation_.data(), frames, model_frames_, model_frames_};
  for_each(windows_, [&](std::size_t s) {
    nn::multiply(to_clip.transposed(), {&z.values[s * of_hop], frames, channels_, channels_},
                 {&windows[s * of_window], model_frames_, channels_, channels_});
  });
  const nn::MatrixView factor{factor_.data(), of_window, count_, count_};
  nn::multiply({windows, windows_, of_window, of_window}, factor,
               {coefficients_.data(), windows_, count_, count_});
  nn::multiply({coefficients_.data(), windows_, count_, count_}, factor.transposed(),
               {windows, windows_, of_window, of_window});
  // A hop's frames are sums over the windows that contain it, the latest window last.
  for_each(groups_, [&](std::size_t g) {
    for (std::size_t b = 0; b < overlap_; ++b) {
      const std::size_t hop_in_window = overlap_ - 1 - b;
      nn::multiply({&interpolation_[hop_in_window * hop_ * model_frames_], hop_, model_frames_,
                    model_frames_},
                   {&at_model_rate_[(g + b) * of_window], model_frames_, channels_, channels_},
                   {&image.values[g * of_hop], hop_, channels_, channels_},
                   b == 0 ? nn::Product::overwrite : nn::Product::add);
    }
  });
}

void PatternPenalty::multiply_ends(const PoseMatrix& z) {
  const std::size_t over = overlap_ - 1, values = over * hop_ * channels_;
  if (over == 0) return;
  // The last hops followed by the first.
  ends_.resize(2 * values);
  std::copy_n(&z.values[z.values.size() - values], values, ends_.begin());
  std::copy_n(z.values.begin(), values, &ends_[values]);
  coefficients_.resize(count_ * over);
  windows_over_end_.resize(row_values_ * over);
  const nn::MatrixView factor{factor_.data(), row_values_, count_, count_};
  nn::multiply(factor.transposed(),
               nn::MatrixView{ends_.data(), over, row_values_, hop_ * channels_}.transposed(),
               {coefficients_.data(), count_, over, over});
  nn::multiply(factor, {coefficients_.data(), count_, over, over},
               {windows_over_end_.data(), row_values_, over, over});
}

void PatternPenalty::take_off_ends(PoseMatrix& image) const {
  const std::size_t over = overlap_ - 1, values = over * hop_ * channels_;
  const std::size_t last = image.values.size() - values;
  for (std::size_t i = 0; i < row_values_; ++i) {
    for (std::size_t s = 0; s < over; ++s) {
      const std::size_t at = s * hop_ * channels_ + i;
      image.values[at < values ? last + at : at - values] -= windows_over_end_[i * over + s];
    }
  }
}

}  // namespace kinemend
