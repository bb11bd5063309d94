// Interpolates the bases of a model at the rate of a clip by a cubic spline.
#include "papers/lou2010_example/window_bases.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "nn/gemm.hpp"

namespace kinemend {

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
