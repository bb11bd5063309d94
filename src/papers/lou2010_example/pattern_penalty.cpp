// Applies the quadratic form of the patterns by windows or by frequencies, whichever is faster. By
// frequencies it transforms blocks of rows, multiplies at each frequency, and transforms back.
#include "papers/lou2010_example/pattern_penalty.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <mutex>
#include <numbers>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "kinemend/extend/system.hpp"
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

namespace {

// Longer blocks repeat fewer rows and have more frequencies.
std::size_t rows_of_block(std::size_t window_rows) { return (3 * window_rows) | 1; }

// Frequencies whose matrices are computed at once, and values of G that are transformed for them.
// For speed, not swept.
constexpr std::size_t frequencies_at_once = 2;
constexpr std::size_t patterns_at_once = 8192;
// Blocks of about this number of columns are transformed at once. For speed, not swept.
constexpr std::size_t columns_at_once = 300;
// Values of spectra that are computed before they are used: enough for efficient products of
// matrices. For speed, not swept.
constexpr std::size_t spectrum_values = std::size_t{3} << 19;

// Reuses memory from one piece of work for the next; there are at most as many buffers as threads.
class SharedScratch {
 public:
  std::vector<double> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return {};
    std::vector<double> scratch = std::move(free_.back());
    free_.pop_back();
    return scratch;
  }
  void give_back(std::vector<double> scratch) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(scratch));
  }

 private:
  std::mutex mutex_;
  std::vector<std::vector<double>> free_;
};

}  // namespace

PatternConvolution::PatternConvolution(const std::vector<double>& patterns, std::size_t window_rows,
                                       std::size_t row_values, std::size_t count)
    : row_values_(row_values),
      reach_(window_rows - 1),
      block_rows_(rows_of_block(window_rows)),
      frequencies_((block_rows_ + 1) / 2),
      fresh_rows_(block_rows_ - 2 * reach_) {
  prepare_transforms();
  if (is_narrow()) {
    narrow_.resize(frequencies_);
  } else {
    matrices_.resize(frequencies_);
  }
  // First use of memory costs more than the products. A thread that waits for a nested product
  // starts no other frequencies, which would need scratch of their own.
  SharedScratch scratch;
  const auto ranges = halved_ranges(0, frequencies_, frequencies_at_once);
  for_each_index(ranges.size(), [&](std::size_t i) {
    run_isolated([&] {
      std::vector<double> parts = scratch.take();
      prepare_matrices(patterns, count, ranges[i].first, ranges[i].second, parts);
      scratch.give_back(std::move(parts));
    });
  });
}

bool PatternConvolution::is_narrow() const {
  return 2 * sizeof(double) * frequencies_ * row_values_ * row_values_ > most_exact_bytes;
}

void PatternConvolution::prepare_transforms() {
  const auto angle = [&](std::size_t frequency, std::size_t time) {
    const double turns =
        static_cast<double>(frequency * time % block_rows_) / static_cast<double>(block_rows_);
    return 2 * std::numbers::pi * turns;
  };
  for (std::size_t f = 0; f < frequencies_; ++f) {
    for (std::size_t t = 0; t < frequencies_; ++t) {
      cosines_.push_back(portable::cos(angle(f, t)));
      sines_.push_back(-portable::sin(angle(f, t)));
    }
  }
  for (std::size_t t = 0; t <= fresh_rows_ / 2; ++t) {
    for (std::size_t f = 0; f < frequencies_; ++f) {
      const double share = (f == 0 ? 1.0 : 2.0) / static_cast<double>(block_rows_);
      cosines_back_.push_back(share * portable::cos(angle(f, t)));
      sines_back_.push_back(-share * portable::sin(angle(f, t)));
    }
  }
}

void PatternConvolution::prepare_matrices(const std::vector<double>& patterns, std::size_t count,
                                          std::size_t first, std::size_t last,
                                          std::vector<double>& parts) {
  const std::size_t v = row_values_, window_rows = reach_ + 1, row_patterns = v * count;
  const std::size_t found = last - first;
  // Transforms P + iQ of G's rows: for each frequency P and Q, V x K.
  parts.resize(2 * found * row_patterns);
  for (std::size_t from = 0; from < row_patterns; from += patterns_at_once) {
    const std::size_t columns = std::min(patterns_at_once, row_patterns - from);
    const nn::MatrixView some{&patterns[from], window_rows, columns, row_patterns};
    nn::multiply({&cosines_[first * frequencies_], found, window_rows, frequencies_}, some,
                 {&parts[from], found, columns, 2 * row_patterns});
    nn::multiply({&sines_[first * frequencies_], found, window_rows, frequencies_}, some,
                 {&parts[row_patterns + from], found, columns, 2 * row_patterns});
  }
  std::vector<double> mixed(v * v), matrix(2 * v * v);
  for (std::size_t f = first; f < last; ++f) {
    // (P + iQ)(P + iQ)^H = P P^T + Q Q^T + i (Q P^T - (Q P^T)^T)
    const double* of_f = &parts[2 * (f - first) * row_patterns];
    const nn::MatrixView p{of_f, v, count, count}, q{of_f + row_patterns, v, count, count};
    const nn::MutableMatrixView real{matrix.data(), v, v, 2 * v};
    nn::multiply_symmetric(p, p.transposed(), real);
    nn::multiply_symmetric(q, q.transposed(), real, nn::Product::add);
    nn::multiply(q, p.transposed(), {mixed.data(), v, v, v});
    for (std::size_t r = 0; r < v; ++r) {
      for (std::size_t c = 0; c < v; ++c)
        matrix[r * 2 * v + v + c] = mixed[r * v + c] - mixed[c * v + r];
    }
    nn::PackedMatrix packed({matrix.data(), v, 2 * v, 2 * v});
    if (is_narrow()) {
      narrow_[f].assign(packed.values().begin(), packed.values().end());
    } else {
      matrices_[f] = std::move(packed);
    }
  }
}

void PatternConvolution::multiply(const double* z, std::size_t rows, double* image) {
  const std::size_t blocks = (rows + fresh_rows_ - 1) / fresh_rows_;
  const std::size_t of_block = frequencies_ * 2 * row_values_;
  const std::size_t at_once =
      std::max<std::size_t>(1, std::min(blocks, spectrum_values / of_block));
  spectrum_.resize(of_block * at_once);
  for (first_block_ = 0; first_block_ < blocks; first_block_ += at_once) {
    blocks_ = std::min(at_once, blocks - first_block_);
    const std::size_t some_blocks = std::max<std::size_t>(1, columns_at_once / row_values_);
    for_each_range(0, blocks_, some_blocks,
                   [&](std::size_t first, std::size_t last) { transform(z, rows, first, last); });
    for_each_index(frequencies_, [&](std::size_t f) { filter(f); });
    for_each_range(0, blocks_, some_blocks, [&](std::size_t first, std::size_t last) {
      transform_back(image, rows, first, last);
    });
  }
}

void PatternConvolution::transform(const double* z, std::size_t rows, std::size_t first,
                                   std::size_t last) {
  const std::size_t v = row_values_, columns = (last - first) * v;
  std::vector<double> even(frequencies_ * columns), odd(frequencies_ * columns);
  for (std::size_t b = first; b < last; ++b) {
    const std::size_t middle = (first_block_ + b) * fresh_rows_ + fresh_rows_ / 2;
    for (std::size_t t = 0; t < frequencies_; ++t) {
      const double* after = &z[(middle + t) % rows * v];
      const double* before = &z[(middle + t * (rows - 1)) % rows * v];
      double* sum = &even[t * columns + (b - first) * v];
      double* difference = &odd[t * columns + (b - first) * v];
      for (std::size_t c = 0; c < v; ++c) {
        sum[c] = t == 0 ? after[c] : after[c] + before[c];
        difference[c] = after[c] - before[c];
      }
    }
  }
  const std::size_t stride = 2 * blocks_ * v;
  double* real = &spectrum_[first * v];
  nn::multiply({cosines_.data(), frequencies_, frequencies_, frequencies_},
               {even.data(), frequencies_, columns, columns},
               {real, frequencies_, columns, stride});
  nn::multiply({sines_.data(), frequencies_, frequencies_, frequencies_},
               {odd.data(), frequencies_, columns, columns},
               {real + blocks_ * v, frequencies_, columns, stride});
}

// Computes (Re + i Im)(x + iy) for rows x and y; Re is symmetric, Im antisymmetric.
void PatternConvolution::filter(std::size_t frequency) {
  const std::size_t v = row_values_, rows = 2 * blocks_;
  std::vector<double> parts(rows * 2 * v);
  double* x = &spectrum_[frequency * rows * v];
  double* y = x + blocks_ * v;
  const nn::MutableMatrixView product{parts.data(), rows, 2 * v, 2 * v};
  if (is_narrow()) {
    nn::multiply({x, rows, v, v}, nn::PackedMatrix(v, 2 * v, narrow_[frequency]), product);
  } else {
    nn::multiply({x, rows, v, v}, matrices_[frequency], product);
  }
  for (std::size_t b = 0; b < blocks_; ++b) {
    const double* of_x = &parts[b * 2 * v];
    const double* of_y = &parts[(blocks_ + b) * 2 * v];
    for (std::size_t c = 0; c < v; ++c) {
      x[b * v + c] = of_x[c] + of_y[v + c];
      y[b * v + c] = of_y[c] - of_x[v + c];
    }
  }
}

void PatternConvolution::transform_back(double* image, std::size_t rows, std::size_t first,
                                        std::size_t last) {
  const std::size_t v = row_values_, columns = (last - first) * v;
  const std::size_t times = fresh_rows_ / 2 + 1, stride = 2 * blocks_ * v;
  std::vector<double> even(times * columns), odd(times * columns);
  const double* real = &spectrum_[first * v];
  nn::multiply({cosines_back_.data(), times, frequencies_, frequencies_},
               {real, frequencies_, columns, stride}, {even.data(), times, columns, columns});
  nn::multiply({sines_back_.data(), times, frequencies_, frequencies_},
               {real + blocks_ * v, frequencies_, columns, stride},
               {odd.data(), times, columns, columns});
  for (std::size_t b = first; b < last; ++b) {
    const std::size_t middle = (first_block_ + b) * fresh_rows_ + fresh_rows_ / 2;
    for (std::size_t t = 0; t < times; ++t) {
      const double* sum = &even[t * columns + (b - first) * v];
      const double* difference = &odd[t * columns + (b - first) * v];
      double* after = &image[(middle + t) * v];
      double* before = &image[(middle - t) * v];
      for (std::size_t c = 0; c < v && middle + t < rows; ++c) after[c] = sum[c] + difference[c];
      for (std::size_t c = 0; c < v && middle - t < rows; ++c) before[c] = sum[c] - difference[c];
    }
  }
}

double PatternConvolution::work(std::size_t rows, std::size_t window_rows, std::size_t row_values) {
  const std::size_t block = rows_of_block(window_rows), fresh = block - 2 * (window_rows - 1);
  const std::size_t whole_blocks = (rows + fresh - 1) / fresh;
  const auto blocks = static_cast<double>(whole_blocks);
  const auto v = static_cast<double>(row_values), length = static_cast<double>(block);
  return blocks * v * length * (2 * v + (length + static_cast<double>(fresh)) / 2);
}

double PatternConvolution::preparation(std::size_t window_rows, std::size_t row_values,
                                       std::size_t count) {
  const std::size_t frequencies = (rows_of_block(window_rows) + 1) / 2;
  const std::size_t of_one = row_values * count * (4 * row_values + 2 * window_rows);
  return static_cast<double>(frequencies * of_one);
}

}  // namespace kinemend
