// Symmetric FIR filters: the Gaussian and the weighted mean.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/portable.hpp"
#include "kinemend/experimental/signal.hpp"
#include "signal/checks.hpp"
#include "signal/extension.hpp"
#include "signal/kernels.hpp"

namespace kinemend {

namespace {

void symmetric_fir(PoseMatrix& matrix, const std::vector<double>& half_weights) {
  signal::for_each_chunk(matrix, half_weights.size() - 1,
                         [&](const double* centre, std::size_t first, std::size_t count) {
                           signal::symmetric_fir_rows(centre, count, matrix.channels, half_weights,
                                                      &matrix.values[first * matrix.channels]);
                         });
}

// By definition: Smooth Keys of Blender.
constexpr double mean_weights[] = {2.0 / 12, 3.0 / 12, 2.0 / 12};  // at distance 0, 1 and 2

// The frames next to the ends as in Blender. The second neighbour before frame 2 is frame 0, but
// Blender's test for it (index - 2 > 0) leaves it out.
struct BlenderEnds {
  std::vector<std::pair<std::size_t, std::vector<double>>> rows;

  explicit BlenderEnds(const PoseMatrix& matrix) {
    const std::size_t last = matrix.frames - 1;
    std::array<std::size_t, 5> wanted = {0, 1, 2, last - 1, last};
    std::sort(wanted.begin(), wanted.end());
    const auto end = std::unique(wanted.begin(), wanted.end());
    for (auto frame = wanted.begin(); frame != end; ++frame)
      rows.emplace_back(*frame, row(matrix, *frame));
  }

  static std::vector<double> row(const PoseMatrix& matrix, std::size_t t) {
    const std::size_t last = matrix.frames - 1;
    std::vector<double> result(matrix.row(t).begin(), matrix.row(t).end());
    if (t == 0 || t == last) return result;
    const std::size_t second_before = t > 2 ? t - 2 : t - 1;
    const std::size_t second_behind = t + 2 <= last ? t + 2 : t + 1;
    for (std::size_t c = 0; c < matrix.channels; ++c) {
      result[c] = mean_weights[0] * matrix(t, c) +
                  mean_weights[1] * (matrix(t - 1, c) + matrix(t + 1, c)) +
                  mean_weights[2] * (matrix(second_before, c) + matrix(second_behind, c));
    }
    return result;
  }

  void put_into(PoseMatrix& matrix) const {
    for (const auto& [frame, values] : rows) {
      std::copy(values.begin(), values.end(), matrix.row(frame).begin());
    }
  }
};

}  // namespace

void gaussian_filter(PoseMatrix& matrix, double sigma_frames) {
  signal::require(
      sigma_frames >= 0 && sigma_frames <= 1e5,
      fmt::format("a Gaussian width of {} frames is outside 0 to 100000", sigma_frames));
  const auto radius = static_cast<std::size_t>(std::lround(4 * sigma_frames));
  if (radius == 0) return;
  std::vector<double> weights(radius + 1);
  double sum = 0;
  for (std::size_t k = radius + 1; k-- > 0;) {
    const double z = static_cast<double>(k) / sigma_frames;
    weights[k] = portable::exp(-0.5 * z * z);
    sum += k == 0 ? weights[k] : 2 * weights[k];
  }
  for (double& weight : weights) weight /= sum;
  symmetric_fir(matrix, weights);
}

void weighted_mean_filter(PoseMatrix& matrix, int passes, WeightedMeanEnds ends) {
  signal::require(passes >= 0, fmt::format("{} passes make no sense", passes));
  if (matrix.frames < 3 || matrix.channels == 0) return;
  const std::vector<double> weights(std::begin(mean_weights), std::end(mean_weights));
  for (int pass = 0; pass < passes; ++pass) {
    if (ends == WeightedMeanEnds::blender) {
      const BlenderEnds end_rows(matrix);
      symmetric_fir(matrix, weights);
      end_rows.put_into(matrix);
    } else {
      symmetric_fir(matrix, weights);
    }
  }
}

}  // namespace kinemend
