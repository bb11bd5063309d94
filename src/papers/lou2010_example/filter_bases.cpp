// Sums up the covariance of all windows of the training and finds its leading eigenvectors.
// Interpolates bases at the rate of a clip by a cubic spline.
#include "papers/lou2010_example/filter_bases.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "kinemend/error.hpp"
#include "methods/prior/window_bases.hpp"
#include "nn/gemm.hpp"

namespace kinemend {

namespace {

// Number of sequence ends that are added to the covariance in one product. For speed, not swept.
constexpr std::size_t ends_at_once = 64;

// Mean variance of each channel over the window: diagonal of C less `kept`.
std::vector<double> residual_variances(const FilterBases& bases, std::span<const double> matrix,
                                       std::span<const double> kept) {
  const std::size_t side = bases.window_frames * bases.channels;
  std::vector<double> residual(bases.channels);
  for (std::size_t row = 0; row < side; ++row) {
    residual[row % bases.channels] += std::max(matrix[row * side + row] - kept[row], 0.0) /
                                      static_cast<double>(bases.window_frames);
  }
  return residual;
}

// Variances along the bases (K) and outside them (L) of windows that have this covariance.
void spread_along(const FilterBases& bases, std::span<const double> matrix,
                  std::vector<double>& along, std::vector<double>& outside) {
  const std::size_t side = bases.window_frames * bases.channels, count = bases.count;
  std::vector<double> image(side * count), gram(count * count), projected(side * count);
  const nn::MatrixView E{bases.bases.data(), side, count, count};
  nn::multiply({matrix.data(), side, side, side}, E, {image.data(), side, count, count});
  const nn::MatrixView CE{image.data(), side, count, count};
  nn::multiply(E.transposed(), CE, {gram.data(), count, count, count});
  nn::multiply(E, {gram.data(), count, count, count}, {projected.data(), side, count, count});
  along.resize(count);
  for (std::size_t k = 0; k < count; ++k) along[k] = gram[k * count + k];
  // diag((1 - E E^T) C (1 - E E^T)) = diag(C) - diag(2 C E E^T - E (E^T C E) E^T)
  std::vector<double> kept(side);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = row * count + k;
      kept[row] += (2 * image[i] - projected[i]) * bases.bases[i];
    }
  }
  outside = residual_variances(bases, matrix, kept);
}

}  // namespace

LagCovariance::LagCovariance(std::size_t window_frames, std::size_t channels)
    : window_(window_frames),
      channels_(channels),
      frame_sum_(channels),
      window_sum_(window_frames * channels),
      first_row_(channels * window_frames * channels) {
  if (window_frames == 0) throw Error(ErrorKind::usage, "a window has one frame at least");
  const std::size_t side = (window_ - 1) * channels_;
  steps_.assign(side * side, 0.0);
}

void LagCovariance::add(const PoseMatrix& sequence, double weight) {
  if (sequence.frames < window_ || sequence.channels != channels_) return;
  const std::size_t windows = sequence.frames - window_ + 1;
  const std::size_t side = window_ * channels_;
  std::vector<double> weighted(
      sequence.values.begin(),
      sequence.values.begin() + static_cast<std::ptrdiff_t>(windows * channels_));
  for (double& value : weighted) value *= weight;
  nn::multiply(nn::MatrixView{weighted.data(), windows, channels_, channels_}.transposed(),
               {sequence.values.data(), windows, side, channels_},
               {first_row_.data(), channels_, side, side}, nn::Product::add);
  keep_ends(sequence, weight);

  windows_ += weight * static_cast<double>(windows);
  frames_ += weight * static_cast<double>(sequence.frames);
  std::vector<double> sum(channels_);
  for (std::size_t f = 0; f < sequence.frames; ++f) {
    for (std::size_t c = 0; c < channels_; ++c) sum[c] += sequence(f, c);
  }
  for (std::size_t c = 0; c < channels_; ++c) frame_sum_[c] += weight * sum[c];
  // The first frames of all windows are all frames but the last M-1; for the second frames, the
  // range moves on by one frame, and so on.
  for (std::size_t f = sequence.frames - window_ + 1; f < sequence.frames; ++f) {
    for (std::size_t c = 0; c < channels_; ++c) sum[c] -= sequence(f, c);
  }
  for (std::size_t j = 0; j < window_; ++j) {
    for (std::size_t c = 0; c < channels_; ++c) {
      window_sum_[j * channels_ + c] += weight * sum[c];
      if (j + 1 < window_) sum[c] += sequence(windows + j, c) - sequence(j, c);
    }
  }
}

void LagCovariance::keep_ends(const PoseMatrix& sequence, double weight) {
  const auto side = static_cast<std::ptrdiff_t>((window_ - 1) * channels_);
  if (side == 0) return;
  const auto keep = [&](std::vector<double>::const_iterator from, double factor) {
    ends_.insert(ends_.end(), from, from + side);
    std::transform(from, from + side, std::back_inserter(weighted_ends_),
                   [&](double value) { return factor * value; });
  };
  keep(sequence.values.begin(), -weight);
  keep(sequence.values.end() - side, weight);
  if (ends_.size() >= ends_at_once * static_cast<std::size_t>(side)) add_ends();
}

void LagCovariance::add_ends() {
  if (ends_.empty()) return;
  const std::size_t side = (window_ - 1) * channels_;
  const std::size_t rows = ends_.size() / side;
  nn::multiply(nn::MatrixView{ends_.data(), rows, side, side}.transposed(),
               {weighted_ends_.data(), rows, side, side}, {steps_.data(), side, side, side},
               nn::Product::add);
  ends_.clear();
  weighted_ends_.clear();
}

std::vector<double> LagCovariance::mean() const {
  std::vector<double> mean = frame_sum_;
  for (double& value : mean) value /= std::max(frames_, 1e-300);
  return mean;
}

std::vector<double> LagCovariance::covariance(bool centred) {
  return covariance_about(centred ? mean() : std::vector<double>(channels_));
}

std::vector<double> LagCovariance::covariance_about(std::span<const double> mu) {
  add_ends();
  const std::size_t L = channels_, side = window_ * L, steps_side = side - L;
  std::vector<double> matrix(side * side);
  if (windows_ == 0) return matrix;
  std::copy(first_row_.begin(), first_row_.end(), matrix.begin());
  for (std::size_t row = L; row < side; ++row) {
    const double* above = &matrix[(row - L) * side];
    const double* step = &steps_[(row - L) * steps_side];
    for (std::size_t column = row / L * L; column < side; ++column) {
      matrix[row * side + column] = above[column - L] + step[column - L];
    }
  }
  for (std::size_t row = 0; row < side; ++row) {
    const double row_mean = window_sum_[row] / windows_;
    for (std::size_t column = row; column < side; ++column) {
      const double column_mean = window_sum_[column] / windows_;
      const double mean_product =
          row_mean * mu[column % L] + mu[row % L] * column_mean - mu[row % L] * mu[column % L];
      matrix[column * side + row] = matrix[row * side + column] =
          matrix[row * side + column] / windows_ - mean_product;
    }
  }
  return matrix;
}

FilterBases filter_bases(LagCovariance& covariance, const BasesLimits& limits, bool centred) {
  if (covariance.windows() == 0) {
    throw Error(ErrorKind::usage, "no sequence is as long as a window");
  }
  const std::vector<double> matrix = covariance.covariance(centred);
  FilterBases result;
  result.window_frames = covariance.window_frames();
  result.channels = covariance.channels();
  result.mean = centred ? covariance.mean() : std::vector<double>(result.channels);
  const std::size_t side = result.window_frames * result.channels;
  LeadingEigenvectors leading =
      leading_eigenvectors(matrix, side, {limits.energy, std::min(limits.count, side)});
  result.count = leading.values.size();
  result.bases = std::move(leading.vectors);
  result.eigenvalues = std::move(leading.values);
  std::vector<double> kept(side);
  for (std::size_t row = 0; row < side; ++row) {
    result.total_energy += matrix[row * side + row];
    for (std::size_t k = 0; k < result.count; ++k) {
      const double entry = result.bases[row * result.count + k];
      kept[row] += entry * entry * result.eigenvalues[k];
    }
  }
  result.residual = residual_variances(result, matrix, kept);
  return result;
}

void cross_validate(FilterBases& bases, LagCovariance& half, LagCovariance& other_half,
                    bool centred) {
  std::vector<double> eigenvalues(bases.count), counts(bases.count);
  std::vector<double> residual(bases.channels);
  const auto hold = [&](LagCovariance& learned, LagCovariance& held) {
    const FilterBases learned_half = filter_bases(learned, {.count = bases.count}, centred);
    std::vector<double> along, outside;
    spread_along(learned_half, held.covariance_about(learned_half.mean), along, outside);
    for (std::size_t k = 0; k < learned_half.count; ++k) {
      eigenvalues[k] += along[k];
      counts[k] += 1;
    }
    for (std::size_t c = 0; c < bases.channels; ++c) residual[c] += outside[c] / 2;
  };
  hold(half, other_half);
  hold(other_half, half);
  for (std::size_t k = 0; k < bases.count; ++k) {
    if (counts[k] > 0) bases.eigenvalues[k] = eigenvalues[k] / counts[k];
  }
  bases.residual = residual;
}

namespace {

// Rounding; not swept.
constexpr double same_rate = 1e-9;  // relative

// Second derivatives of the spline through M equally spaced values, as a matrix. The third
// derivative is continuous next to the ends ("not a knot"), so that cubics are reproduced.
Eigen::MatrixXd spline_curvatures(Eigen::Index count) {
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(count, count);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, count);
  if (count < 4) return right;
  for (Eigen::Index i = 1; i + 1 < count; ++i) {
    left.block<1, 3>(i, i - 1) << 1, 4, 1;
    right.block<1, 3>(i, i - 1) << 6, -12, 6;
  }
  left.block<1, 3>(0, 0) << 1, -2, 1;
  left.block<1, 3>(count - 1, count - 3) << 1, -2, 1;
  return left.partialPivLu().solve(right);
}

// Row j: weights of the M values for the value at `first + j * step`, M' x M, row-major.
std::vector<double> spline_weights(std::size_t values, double first, double step,
                                   std::size_t samples) {
  const auto count = static_cast<Eigen::Index>(values);
  const Eigen::MatrixXd curvatures = spline_curvatures(count);
  std::vector<double> weights(samples * values);
  for (std::size_t j = 0; j < samples; ++j) {
    const double place =
        std::clamp(first + step * static_cast<double>(j), 0.0, static_cast<double>(values - 1));
    const auto left =
        std::min(static_cast<Eigen::Index>(place), std::max<Eigen::Index>(count - 2, 0));
    const double right_share = place - static_cast<double>(left);
    const double left_share = 1 - right_share;
    double* row = &weights[j * values];
    row[left] += left_share;
    if (count == 1) continue;
    row[left + 1] += right_share;
    const double left_bend = (left_share * left_share * left_share - left_share) / 6;
    const double right_bend = (right_share * right_share * right_share - right_share) / 6;
    for (Eigen::Index i = 0; i < count; ++i) {
      row[i] += left_bend * curvatures(left, i) + right_bend * curvatures(left + 1, i);
    }
  }
  return weights;
}

}  // namespace

WindowBases bases_at_rate(const FilterBases& bases, double model_rate_hz, double clip_rate_hz,
                          std::size_t clip_frames, std::size_t count, std::size_t most_values) {
  const double ratio = clip_rate_hz / model_rate_hz;
  const double window = static_cast<double>(bases.window_frames - 1) * ratio;
  WindowBases result;
  const std::size_t whole = static_cast<std::size_t>(window + 1e-6) + 1;
  result.frames = std::clamp<std::size_t>(clip_frames, 1, whole);
  result.hop = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(ratio)));
  result.channels = bases.channels;
  result.count = count == 0 ? bases.count : std::min(count, bases.count);
  const std::size_t patterns = bases.channels * result.count;
  std::vector<double> kept;
  kept.reserve(bases.window_frames * patterns);
  for (std::size_t row = 0; row < bases.window_frames * bases.channels; ++row) {
    const auto from = bases.bases.begin() + static_cast<std::ptrdiff_t>(row * bases.count);
    kept.insert(kept.end(), from, from + static_cast<std::ptrdiff_t>(result.count));
  }
  result.orthonormal = std::abs(ratio - 1) < same_rate && result.frames == bases.window_frames;
  if (result.orthonormal) {
    result.values = std::move(kept);
    return result;
  }
  const double spare = static_cast<double>(whole - result.frames) / 2;
  std::vector<double> weights =
      spline_weights(bases.window_frames, spare / ratio, 1 / ratio, result.frames);
  // A short clip at a low rate has fewer frames than the model's window.
  if (result.frames > bases.window_frames && result.frames * patterns > most_values) {
    result.values = std::move(kept);
    result.interpolation = std::move(weights);
    return result;
  }
  // Padded to whole hops, for the products.
  result.values.reserve((result.frames + result.hop - 1) / result.hop * result.hop * patterns);
  result.values.resize(result.frames * patterns);
  nn::multiply({weights.data(), result.frames, bases.window_frames, bases.window_frames},
               {kept.data(), bases.window_frames, patterns, patterns},
               {result.values.data(), result.frames, patterns, patterns});
  return result;
}

}  // namespace kinemend
