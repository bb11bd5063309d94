// Transforms blocks of rows, multiplies at each frequency, and transforms back.
#include "papers/lou2010_example/pattern_convolution.hpp"

#include <algorithm>
#include <mutex>
#include <numbers>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "kinemend/experimental/threads.hpp"

namespace kinemend {

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
