#include "signal/evidence.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace kinemend::signal {

namespace {

constexpr double lowest_cutoff_hz = 0.003;
constexpr double highest_cutoff_hz = 50;
constexpr std::size_t cutoffs = 30;
constexpr double largest_cutoff_share = 0.45;  // of the frame rate
constexpr double largest_strength = 1e10;      // beyond it the factor loses its digits

using Channels = std::vector<std::size_t>;

// Splits channels into blocks of eight at most, none of which parts channels of one group.
std::vector<Channels> in_blocks(const Channels& channels, std::size_t group = 1) {
  std::vector<Channels> blocks;
  const std::size_t width = block_channels - block_channels % group;
  for (std::size_t first = 0; first < channels.size(); first += width) {
    const std::size_t last = std::min(first + width, channels.size());
    blocks.emplace_back(channels.begin() + static_cast<std::ptrdiff_t>(first),
                        channels.begin() + static_cast<std::ptrdiff_t>(last));
  }
  return blocks;
}

void for_each_block(const std::vector<Channels>& blocks, const auto& work) {
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) { work(blocks[b]); });
}

// -2 log p(y), but for what is the same for all models: y^T (I - A^-1) y / s + log |A| - (F - d)
// log strength - d log s.
double misfit(const SmoothingModel& model, const SharedFactor& factor, std::size_t frames,
              double residual, double variance) {
  const auto order = static_cast<double>(model.order);
  return residual / variance + factor.log_determinant -
         (static_cast<double>(frames) - order) * std::log(model.strength) -
         order * std::log(variance);
}

// The model of each channel of `block`; `group` neighbours share theirs.
std::vector<std::size_t> most_likely_models(const ChannelBlock& y, const Channels& block,
                                            std::span<const double> noise_variance,
                                            const ModelGrid& grid, std::size_t group) {
  ChannelBlock x(y.frames);
  std::vector<double> least(block.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> best(block.size(), 0);
  for (std::size_t m = 0; m < grid.models().size(); ++m) {
    const BlockRow residuals = solve_shared(grid.factor(m), y, x);
    for (std::size_t first = 0; first < block.size(); first += group) {
      double value = 0;
      for (std::size_t i = first; i < first + group; ++i) {
        value += misfit(grid.models()[m], grid.factor(m), y.frames, residuals[i],
                        noise_variance[block[i]]);
      }
      if (value < least[first]) {
        least[first] = value;
        std::fill_n(best.begin() + static_cast<std::ptrdiff_t>(first), group, m);
      }
    }
  }
  return best;
}

// Mean over `half` rows on either side, the first and last rows continued.
void box_average(ChannelBlock& block, std::size_t half) {
  if (block.frames == 0 || half == 0) return;
  const ChannelBlock in = block;
  const auto last = static_cast<std::ptrdiff_t>(block.frames) - 1;
  const auto row = [&](std::ptrdiff_t t) {
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(t, 0, last));
  };
  const auto reach = static_cast<std::ptrdiff_t>(half);
  const double scale = 1.0 / static_cast<double>(2 * half + 1);
  BlockRow sum{};
  for (std::ptrdiff_t t = -reach; t <= reach; ++t) {
    for (std::size_t c = 0; c < block_channels; ++c) sum[c] += in(row(t), c);
  }
  for (std::ptrdiff_t t = 0; t <= last; ++t) {
    for (std::size_t c = 0; c < block_channels; ++c) {
      block(static_cast<std::size_t>(t), c) = scale * sum[c];
      sum[c] += in(row(t + reach + 1), c) - in(row(t - reach), c);
    }
  }
}

struct AdaptiveBlock {
  ChannelBlock y;
  ChannelBlock weight;  // 1 / noise variance, 0 where missing
  BlockRow variance{};  // of the differences, were it constant
  std::size_t order;
};

ChannelBlock smooth_block(const AdaptiveBlock& block, std::size_t half_window,
                          const AdaptiveSettings& settings) {
  const std::size_t frames = block.y.frames, differences = frames - block.order;
  const auto c = difference_coefficients(block.order);
  ChannelBlock x = block.y, penalty(differences), variances(differences);
  for (std::size_t t = 0; t < differences; ++t) {
    for (std::size_t i = 0; i < block_channels; ++i) penalty(t, i) = 1 / block.variance[i];
  }
  WeightedSystem system(frames, block.order);
  for (int iteration = 0;; ++iteration) {
    system.factor(block.weight, penalty);
    system.refine(block.weight, penalty, block.y, x);
    if (iteration == settings.iterations) return x;
    system.difference_variances(variances);
    for (std::size_t t = 0; t < differences; ++t) {
      for (std::size_t i = 0; i < block_channels; ++i) {
        double difference = 0;
        for (std::size_t k = 0; k <= block.order; ++k) difference += c[k] * x(t + k, i);
        variances(t, i) += difference * difference;
      }
    }
    box_average(variances, half_window);
    box_average(variances, half_window);
    for (std::size_t t = 0; t < differences; ++t) {
      for (std::size_t i = 0; i < block_channels; ++i) {
        const double share = settings.share_of_constant;
        penalty(t, i) = 1 / ((1 - share) * variances(t, i) + share * block.variance[i]);
      }
    }
  }
}

}  // namespace

ChannelBlock gather(const PoseMatrix& matrix, std::span<const std::size_t> channels) {
  ChannelBlock block(matrix.frames);
  for (std::size_t t = 0; t < matrix.frames; ++t) {
    for (std::size_t i = 0; i < channels.size(); ++i) block(t, i) = matrix(t, channels[i]);
  }
  return block;
}

void scatter(const ChannelBlock& block, std::span<const std::size_t> channels, PoseMatrix& matrix) {
  for (std::size_t t = 0; t < matrix.frames; ++t) {
    for (std::size_t i = 0; i < channels.size(); ++i) matrix(t, channels[i]) = block(t, i);
  }
}

ModelGrid::ModelGrid(std::size_t frames, double frame_rate_hz)
    : frames_(frames), frame_rate_hz_(frame_rate_hz) {
  for (std::size_t order = 1; order <= largest_order && order + 3 <= frames; ++order) {
    for (std::size_t i = 0; i < cutoffs; ++i) {
      const double ratio = static_cast<double>(i) / static_cast<double>(cutoffs - 1);
      const double cutoff =
          lowest_cutoff_hz * std::pow(highest_cutoff_hz / lowest_cutoff_hz, ratio) / frame_rate_hz;
      if (cutoff > largest_cutoff_share) continue;
      const double strength = strength_of_cutoff(cutoff, order);
      if (strength <= largest_strength) models_.push_back({order, strength});
    }
  }
  factors_.resize(models_.size());
  tbb::parallel_for(std::size_t{0}, models_.size(), [&](std::size_t m) {
    factors_[m] = factor_shared(frames_, models_[m].order, models_[m].strength);
  });
}

std::vector<std::size_t> smooth_by_evidence(PoseMatrix& matrix,
                                            std::span<const double> noise_variance,
                                            const ModelGrid& grid, std::size_t group) {
  assert(noise_variance.size() == matrix.channels && grid.frames() == matrix.frames);
  assert(group >= 1 && group <= block_channels && matrix.channels % group == 0);
  if (grid.models().empty()) return {};
  Channels all(matrix.channels);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::size_t> chosen(matrix.channels);
  for_each_block(in_blocks(all, group), [&](const Channels& block) {
    const ChannelBlock y = gather(matrix, block);
    const std::vector<std::size_t> best = most_likely_models(y, block, noise_variance, grid, group);
    ChannelBlock x(matrix.frames);
    for (std::size_t i = 0; i < block.size(); ++i) {
      chosen[block[i]] = best[i];
      const auto here = best.begin() + static_cast<std::ptrdiff_t>(i);
      if (std::find(best.begin(), here, best[i]) != here)
        continue;  // solved with an earlier channel
      solve_shared(grid.factor(best[i]), y, x);
      for (std::size_t k = i; k < block.size(); ++k) {
        if (best[k] != best[i]) continue;
        for (std::size_t t = 0; t < matrix.frames; ++t) matrix(t, block[k]) = x(t, k);
      }
    }
  });
  return chosen;
}

void smooth_adaptively(PoseMatrix& matrix, std::span<const std::uint8_t> missing,
                       std::span<const double> noise_variance,
                       std::span<const SmoothingModel> models, double frame_rate_hz,
                       const AdaptiveSettings& settings) {
  assert(noise_variance.size() == matrix.channels && models.size() == matrix.channels);
  assert(missing.empty() || missing.size() == matrix.values.size());
  const auto half_window = static_cast<std::size_t>(
      std::max(0.0, std::round((settings.window_s * frame_rate_hz - 1) / 2)));
  for (std::size_t order = 1; order <= largest_order; ++order) {
    Channels channels;
    for (std::size_t c = 0; c < matrix.channels; ++c) {
      if (models[c].order == order) channels.push_back(c);
    }
    for_each_block(in_blocks(channels), [&](const Channels& members) {
      AdaptiveBlock block{gather(matrix, members), ChannelBlock(matrix.frames, 1), {}, order};
      block.variance.fill(1);
      for (std::size_t i = 0; i < members.size(); ++i) {
        const std::size_t c = members[i];
        block.variance[i] = noise_variance[c] / models[c].strength;
        for (std::size_t t = 0; t < matrix.frames; ++t) {
          const bool lost = !missing.empty() && missing[t * matrix.channels + c] != 0;
          block.weight(t, i) = lost ? 0 : 1 / noise_variance[c];
        }
      }
      scatter(smooth_block(block, half_window, settings), members, matrix);
    });
  }
}

}  // namespace kinemend::signal
