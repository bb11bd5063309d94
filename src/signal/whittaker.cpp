// Factorises and solves the systems of Whittaker smoothing, shared by channels or with weights.
#include "signal/whittaker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/portable.hpp"
#include "signal/whittaker_kernels.hpp"

namespace kinemend::signal {

namespace {

// Entry [t, t - k] of D^d (D^d)^T.
double product_entry(const std::array<double, largest_order + 1>& c, std::size_t order,
                     std::size_t k) {
  double sum = 0;
  for (std::size_t u = 0; u + k <= order; ++u) sum += c[u] * c[u + k];
  return sum;
}

// Whether the last two rows of a factor are equal, to rounding relative to the matrix's entries.
bool has_settled(const SharedFactor& factor, double largest_entry, double pivot,
                 double pivot_before) {
  const double rounding = 1e-14 * largest_entry;
  if (!(std::fabs(pivot - pivot_before) <= rounding)) return false;
  const double* last = factor.lower.data() + factor.lower.size() - factor.order;
  for (std::size_t k = 0; k < factor.order; ++k) {
    if (!(std::fabs(last[k] - *(last + k - factor.order)) * pivot <= rounding)) return false;
  }
  return true;
}

WeightedRows rows_of(std::size_t frames, std::vector<double>& diagonal,
                     std::vector<std::vector<double>>& lower, const double* coupling) {
  WeightedRows rows{frames, lower.size(), diagonal.data(), {}, coupling};
  for (std::size_t k = 0; k < lower.size(); ++k) rows.lower[k] = lower[k].data();
  return rows;
}

}  // namespace

SharedRows rows_of(const SharedFactor& factor) {
  return {factor.frames,
          factor.order,
          factor.strength,
          factor.lower.data(),
          factor.inverse_diagonal.data(),
          factor.inverse_diagonal.size()};
}

double strength_of_cutoff(double cutoff, std::size_t order) {
  return portable::pow(2 * portable::sin(std::numbers::pi * cutoff),
                       -2.0 * static_cast<double>(order));
}

SharedFactor factor_shared(std::size_t frames, std::size_t order, double strength) {
  assert(order >= 1 && order <= largest_order && order < frames);
  const auto c = difference_coefficients(order);
  SharedFactor factor{frames, order, strength, {}, {}, 0};
  std::vector<double> pivots;
  const auto lower = [&](std::size_t t, std::size_t k) { return factor.lower[t * order + k - 1]; };
  const std::size_t differences = frames - order;
  const double diagonal = 1 + strength * product_entry(c, order, 0);
  for (std::size_t t = 0; t < differences; ++t) {
    factor.lower.resize((t + 1) * order);
    double pivot = diagonal;
    for (std::size_t k = std::min(order, t); k >= 1; --k) {
      double entry = strength * product_entry(c, order, k);
      for (std::size_t m = k + 1; m <= std::min(order, t); ++m)
        entry -= lower(t, m) * pivots[t - m] * lower(t - k, m - k);
      factor.lower[t * order + k - 1] = entry / pivots[t - k];
      pivot -= lower(t, k) * lower(t, k) * pivots[t - k];
    }
    pivots.push_back(pivot);
    factor.inverse_diagonal.push_back(1 / pivot);
    factor.log_determinant += portable::log(pivot);
    if (t > order && has_settled(factor, diagonal, pivot, pivots[t - 1])) {
      factor.log_determinant += static_cast<double>(differences - 1 - t) * portable::log(pivot);
      break;
    }
  }
  return factor;
}

BlockRow solve_shared(const SharedFactor& factor, const ChannelBlock& y, ChannelBlock& x) {
  assert(factor.frames == y.frames && x.frames == y.frames);
  BlockRow sums{};
  solve_shared_rows(rows_of(factor), y.values.data(), x.values.data(), sums.data());
  return sums;
}

std::vector<BlockRow> shared_residuals(std::span<const SharedFactor> factors,
                                       const ChannelBlock& y) {
  // For speed, not swept.
  constexpr std::size_t tile = 512;  // rows that fit the cache, processed for all models
  std::vector<BlockRow> residuals(factors.size(), BlockRow{});
  for (std::size_t begin = 0; begin < factors.size();) {
    const std::size_t order = factors[begin].order, differences = y.frames - order;
    std::vector<SharedRows> rows;
    for (std::size_t m = begin; m < factors.size() && factors[m].order == order; ++m)
      rows.push_back(rows_of(factors[m]));
    std::vector<double> before(rows.size() * largest_order * block_channels);
    for (std::size_t first = 0; first < differences; first += tile) {
      add_shared_residuals(rows.data(), rows.size(), first, std::min(first + tile, differences),
                           y.values.data(), residuals[begin].data(), before.data());
    }
    for (std::size_t m = begin; m < begin + rows.size(); ++m) {
      for (double& residual : residuals[m]) residual *= factors[m].strength;
    }
    begin += rows.size();
  }
  return residuals;
}

std::vector<double> weights_of_others(const SharedFactor& factor) {
  const std::size_t order = factor.order, differences = factor.frames - order;
  const auto c = difference_coefficients(order);
  const std::size_t last = factor.inverse_diagonal.size() - 1;
  std::vector<double> weights(factor.frames);
  // Takahashi's recursion: band[t][k] = (L D L^T)^-1[t, t + k].
  std::vector<std::array<double, largest_order + 1>> band(differences);
  for (std::size_t t = differences; t-- > 0;) {
    const std::size_t width = std::min(order, differences - 1 - t);
    const auto lower = [&](std::size_t m) {
      return factor.lower[std::min(t + m, last) * order + m - 1];
    };
    for (std::size_t k = width; k >= 1; --k) {
      double sum = 0;
      for (std::size_t m = 1; m <= width; ++m)
        sum -= lower(m) * band[t + std::min(m, k)][m > k ? m - k : k - m];
      band[t][k] = sum;
    }
    band[t][0] = factor.inverse_diagonal[std::min(t, last)];
    for (std::size_t m = 1; m <= width; ++m) band[t][0] -= lower(m) * band[t][m];
  }
  // strength (D^d)^T (L D L^T)^-1 D^d.
  for (std::size_t t = 0; t < factor.frames; ++t) {
    double sum = 0;
    for (std::size_t a = 0; a <= std::min(order, t); ++a) {
      for (std::size_t b = a; b <= std::min(order, t); ++b) {
        if (t - a >= differences) continue;
        sum += (a == b ? 1.0 : 2.0) * c[a] * c[b] * band[t - b][b - a];
      }
    }
    weights[t] = factor.strength * sum;
  }
  return weights;
}

WeightedSystem::WeightedSystem(std::size_t frames, std::size_t order, const ChannelBlock* coupling)
    : frames_(frames),
      coupling_(coupling ? coupling->values.data() : nullptr),
      diagonal_(frames * block_channels),
      lower_(order, std::vector<double>(frames * block_channels)) {
  assert(order >= 1 && order <= largest_order && order < frames);
  assert(!coupling || coupling->frames == frames);
}

void WeightedSystem::factor(const ChannelBlock& weight, const ChannelBlock& penalty) {
  factor_weighted_rows(rows_of(frames_, diagonal_, lower_, coupling_), weight.values.data(),
                       penalty.values.data());
}

void WeightedSystem::refine(const ChannelBlock& weight, const ChannelBlock& penalty,
                            const ChannelBlock& y, ChannelBlock& x, ChannelBlock& scratch) {
  assert(scratch.frames == frames_);
  refine_weighted_rows(rows_of(frames_, diagonal_, lower_, coupling_), weight.values.data(),
                       penalty.values.data(), y.values.data(), x.values.data(),
                       scratch.values.data());
}

void WeightedSystem::difference_variances(ChannelBlock& variances) {
  difference_variance_rows(rows_of(frames_, diagonal_, lower_, coupling_), variances.values.data());
}

BlockRow WeightedSystem::log_determinants() const {
  // Not swept.
  constexpr std::size_t together = 16;  // pivots whose product is far from overflow and underflow
  BlockRow result{};
  for (std::size_t first = 0; first < frames_; first += together) {
    BlockRow product;
    product.fill(1);
    for (std::size_t t = first; t < std::min(first + together, frames_); ++t) {
      for (std::size_t c = 0; c < block_channels; ++c)
        product[c] *= diagonal_[t * block_channels + c];
    }
    for (std::size_t c = 0; c < block_channels; ++c) result[c] += portable::log(product[c]);
  }
  return result;
}

}  // namespace kinemend::signal
