#include "signal/whittaker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "signal/whittaker_kernels.hpp"

namespace kinemend::signal {

namespace {

constexpr double pi = 3.14159265358979323846;

// A[t, t - k] of (D^d)^T D^d for F frames.
double penalty_entry(const std::array<double, largest_order + 1>& c, std::size_t order,
                     std::size_t frames, std::size_t t, std::size_t k) {
  double sum = 0;
  for (std::size_t u = 0; u + k <= order; ++u) {
    if (t >= k + u && t - k - u < frames - order) sum += c[u] * c[u + k];
  }
  return sum;
}

WeightedRows rows_of(std::size_t frames, std::vector<double>& diagonal,
                     std::vector<std::vector<double>>& lower,
                     std::vector<std::vector<double>>& inverse) {
  WeightedRows rows{frames, lower.size(), diagonal.data(), {}, {}};
  for (std::size_t k = 0; k < lower.size(); ++k) rows.lower[k] = lower[k].data();
  for (std::size_t k = 0; k < inverse.size(); ++k) rows.inverse[k] = inverse[k].data();
  return rows;
}

}  // namespace

std::array<double, largest_order + 1> difference_coefficients(std::size_t order) {
  switch (order) {
    case 1:
      return {-1, 1, 0, 0};
    case 2:
      return {1, -2, 1, 0};
    default:
      return {-1, 3, -3, 1};
  }
}

double strength_of_cutoff(double cutoff, std::size_t order) {
  return std::pow(2 * std::sin(pi * cutoff), -2.0 * static_cast<double>(order));
}

SharedFactor factor_shared(std::size_t frames, std::size_t order, double strength) {
  assert(order >= 1 && order <= largest_order && order < frames);
  const auto c = difference_coefficients(order);
  SharedFactor factor;
  factor.order = order;
  factor.lower.assign(frames * order, 0);
  factor.inverse_diagonal.resize(frames);
  std::vector<double> diagonal(frames);
  const auto lower = [&](std::size_t t, std::size_t k) -> double& {
    return factor.lower[t * order + k - 1];
  };
  for (std::size_t t = 0; t < frames; ++t) {
    diagonal[t] = 1 + strength * penalty_entry(c, order, frames, t, 0);
    for (std::size_t k = std::min(order, t); k >= 1; --k) {
      double entry = strength * penalty_entry(c, order, frames, t, k);
      for (std::size_t m = k + 1; m <= std::min(order, t); ++m) {
        entry -= lower(t, m) * diagonal[t - m] * lower(t - k, m - k);
      }
      lower(t, k) = entry / diagonal[t - k];
      diagonal[t] -= lower(t, k) * lower(t, k) * diagonal[t - k];
    }
    factor.inverse_diagonal[t] = 1 / diagonal[t];
    factor.log_determinant += std::log(diagonal[t]);
  }
  return factor;
}

BlockRow solve_shared(const SharedFactor& factor, const ChannelBlock& y, ChannelBlock& x) {
  assert(factor.inverse_diagonal.size() == y.frames && x.frames == y.frames);
  BlockRow sums{};
  solve_shared_rows(factor.lower.data(), factor.inverse_diagonal.data(), factor.order, y.frames,
                    y.values.data(), x.values.data(), sums.data());
  return sums;
}

std::vector<double> leverages(const SharedFactor& factor) {
  const std::size_t frames = factor.inverse_diagonal.size(), order = factor.order;
  // Takahashi's recursion: band[t][k] = A^-1[t, t + k].
  std::vector<std::array<double, largest_order + 1>> band(frames);
  std::vector<double> diagonal(frames);
  for (std::size_t t = frames; t-- > 0;) {
    const std::size_t width = std::min(order, frames - 1 - t);
    const auto lower = [&](std::size_t m) { return factor.lower[(t + m) * order + m - 1]; };
    for (std::size_t k = width; k >= 1; --k) {
      double sum = 0;
      for (std::size_t m = 1; m <= width; ++m) {
        sum -= lower(m) * band[t + std::min(m, k)][m > k ? m - k : k - m];
      }
      band[t][k] = sum;
    }
    band[t][0] = factor.inverse_diagonal[t];
    for (std::size_t m = 1; m <= width; ++m) band[t][0] -= lower(m) * band[t][m];
    diagonal[t] = band[t][0];
  }
  return diagonal;
}

WeightedSystem::WeightedSystem(std::size_t frames, std::size_t order)
    : frames_(frames),
      diagonal_(frames * block_channels),
      lower_(order, std::vector<double>(frames * block_channels)),
      inverse_(order + 1, std::vector<double>(frames * block_channels)) {
  assert(order >= 1 && order <= largest_order && order < frames);
}

void WeightedSystem::factor(const ChannelBlock& weight, const ChannelBlock& penalty) {
  factor_weighted_rows(rows_of(frames_, diagonal_, lower_, inverse_), weight.values.data(),
                       penalty.values.data());
}

void WeightedSystem::solve(const ChannelBlock& weight, const ChannelBlock& y, ChannelBlock& x) {
  solve_weighted_rows(rows_of(frames_, diagonal_, lower_, inverse_), weight.values.data(),
                      y.values.data(), x.values.data());
}

void WeightedSystem::difference_variances(ChannelBlock& variances) {
  const WeightedRows rows = rows_of(frames_, diagonal_, lower_, inverse_);
  invert_weighted_rows(rows);
  difference_variance_rows(rows, variances.values.data());
}

}  // namespace kinemend::signal
