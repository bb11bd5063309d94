// Compares models of smoothing by their likelihood under white and under coloured noise, and adapts
// strengths by expectation maximisation.
#include "signal/evidence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable.hpp"

namespace kinemend::signal {

namespace {

// Chosen by hand, not swept.
constexpr double largest_cutoff_share = 0.45;  // of the frame rate

using Channels = std::vector<std::size_t>;

// Splits channels into blocks of eight at most, without splitting groups of channels.
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
  for_each_index(blocks.size(), [&](std::size_t b) { work(blocks[b]); });
}

// -2 log p(y), less terms that all models share: y^T (I - A^-1) y / s + log |A| - (F - d)
// log strength - d log s.
double misfit(const SmoothingModel& model, const SharedFactor& factor, std::size_t frames,
              double residual, double variance) {
  const auto order = static_cast<double>(model.order);
  return residual / variance + factor.log_determinant -
         (static_cast<double>(frames) - order) * portable::log(model.strength) -
         order * portable::log(variance);
}

// Mean over `half` rows on either side, the first and last rows repeated.
void box_average(ChannelBlock& block, std::size_t half) {
  if (block.frames == 0 || half == 0) return;
  const std::size_t last = block.frames - 1;
  const auto row_at = [&](std::size_t t) {
    BlockRow row;
    std::copy_n(block.values.begin() + static_cast<std::ptrdiff_t>(t * block_channels),
                block_channels, row.begin());
    return row;
  };
  const BlockRow first = row_at(0);
  // The former values of overwritten rows that are still needed.
  std::vector<BlockRow> before(half + 1, first);
  const double scale = 1.0 / static_cast<double>(2 * half + 1);
  BlockRow sum{};
  for (std::size_t k = 0; k <= 2 * half; ++k) {
    const BlockRow row = row_at(std::min(k < half ? 0 : k - half, last));
    for (std::size_t c = 0; c < block_channels; ++c) sum[c] += row[c];
  }
  for (std::size_t t = 0; t <= last; ++t) {
    before[t % (half + 1)] = row_at(t);
    const BlockRow next = row_at(std::min(t + half + 1, last));
    const BlockRow gone = t < half ? first : before[(t - half) % (half + 1)];
    for (std::size_t c = 0; c < block_channels; ++c) {
      block(t, c) = scale * sum[c];
      sum[c] += next[c] - gone[c];
    }
  }
}

// Adds the squared differences of the fit to their posterior variances.
void add_squared_differences(const ChannelBlock& x, std::size_t order, ChannelBlock& variances) {
  const auto c = difference_coefficients(order);
  for (std::size_t t = 0; t < variances.frames; ++t) {
    for (std::size_t i = 0; i < block_channels; ++i) {
      double difference = 0;
      for (std::size_t k = 0; k <= order; ++k) difference += c[k] * x(t + k, i);
      variances(t, i) += difference * difference;
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

std::vector<SmoothingModel> models_of_orders(std::span<const std::size_t> orders,
                                             const CutoffGrid& cutoffs, std::size_t frames,
                                             double frame_rate_hz) {
  std::vector<SmoothingModel> models;
  for (const std::size_t order : orders) {
    if (order + 3 > frames) continue;
    for (std::size_t i = 0; i < cutoffs.count; ++i) {
      const double cutoff = cutoffs.hz(i) / frame_rate_hz;
      if (cutoff > largest_cutoff_share) continue;
      const double strength = strength_of_cutoff(cutoff, order);
      if (strength <= largest_strength) models.push_back({order, strength});
    }
  }
  return models;
}

ModelGrid::ModelGrid(std::size_t frames, double frame_rate_hz, const CutoffGrid& cutoffs)
    : frames_(frames), frame_rate_hz_(frame_rate_hz) {
  // The orders that `auto` chooses from, by definition (docs/details/auto.md).
  constexpr std::size_t orders[] = {1, 2, 3};
  models_ = models_of_orders(orders, cutoffs, frames, frame_rate_hz);
  factors_.resize(models_.size());
  for_each_index(models_.size(), [&](std::size_t m) {
    factors_[m] = factor_shared(frames_, models_[m].order, models_[m].strength);
  });
}

std::vector<std::size_t> most_likely_models(const ChannelBlock& y,
                                            std::span<const double> noise_variance,
                                            const ModelGrid& grid, std::size_t group) {
  const std::size_t channels = noise_variance.size();
  assert(group >= 1 && channels <= block_channels && channels % group == 0);
  std::vector<double> least(channels, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> best(channels, 0);
  const std::vector<BlockRow> residuals = shared_residuals(grid.factors(), y);
  for (std::size_t m = 0; m < grid.models().size(); ++m) {
    for (std::size_t first = 0; first < channels; first += group) {
      double value = 0;
      for (std::size_t i = first; i < first + group; ++i) {
        value +=
            misfit(grid.models()[m], grid.factor(m), y.frames, residuals[m][i], noise_variance[i]);
      }
      if (value < least[first]) {
        least[first] = value;
        std::fill_n(best.begin() + static_cast<std::ptrdiff_t>(first), group, m);
      }
    }
  }
  return best;
}

void smooth_with(const ModelGrid& grid, std::span<const std::size_t> models, ChannelBlock& y) {
  const ChannelBlock given = y;
  ChannelBlock x(y.frames);
  for (std::size_t i = 0; i < models.size(); ++i) {
    const auto here = models.begin() + static_cast<std::ptrdiff_t>(i);
    // An earlier channel has solved this model.
    if (std::find(models.begin(), here, models[i]) != here) continue;
    solve_shared(grid.factor(models[i]), given, x);
    for (std::size_t k = i; k < models.size(); ++k) {
      if (models[k] != models[i]) continue;
      for (std::size_t t = 0; t < y.frames; ++t) y(t, k) = x(t, k);
    }
  }
}

std::vector<std::size_t> most_likely_models(const PoseMatrix& matrix,
                                            std::span<const double> noise_variance,
                                            const ModelGrid& grid, std::size_t group) {
  assert(noise_variance.size() == matrix.channels && grid.frames() == matrix.frames);
  assert(group >= 1 && group <= block_channels && matrix.channels % group == 0);
  if (grid.models().empty()) return {};
  Channels all(matrix.channels);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::size_t> chosen(matrix.channels);
  for_each_block(in_blocks(all, group), [&](const Channels& block) {
    const std::vector<std::size_t> best = most_likely_models(
        gather(matrix, block), noise_variance.subspan(block[0], block.size()), grid, group);
    std::copy(best.begin(), best.end(), chosen.begin() + static_cast<std::ptrdiff_t>(block[0]));
  });
  return chosen;
}

ChannelBlock smooth_adaptively(const ChannelBlock& y, const ChannelBlock& weight,
                               std::span<const double> noise_variance,
                               std::span<const SmoothingModel> models, double frame_rate_hz,
                               const AdaptiveSettings& settings, const ChannelBlock* coupling) {
  const std::size_t order = models[0].order, differences = y.frames - order;
  // The variance of one squared difference is too large, so at least three are averaged.
  const auto half_window = static_cast<std::size_t>(
      std::max(1.0, std::round((settings.window_s * frame_rate_hz - 1) / 2)));
  BlockRow constant;  // constant variance of the differences, by the model
  constant.fill(1);
  for (std::size_t i = 0; i < models.size(); ++i) {
    assert(models[i].order == order);
    constant[i] = noise_variance[i] / models[i].strength;
  }
  // The penalty is the inverse of the variances, which are computed in the same memory.
  ChannelBlock x = y, penalty(differences), scratch(y.frames);
  for (std::size_t t = 0; t < differences; ++t) {
    for (std::size_t i = 0; i < block_channels; ++i) penalty(t, i) = 1 / constant[i];
  }
  WeightedSystem system(y.frames, order, coupling);
  for (int iteration = 0;; ++iteration) {
    system.factor(weight, penalty);
    system.refine(weight, penalty, y, x, scratch);
    if (iteration == settings.iterations) return x;
    ChannelBlock& variances = penalty;
    system.difference_variances(variances);
    add_squared_differences(x, order, variances);
    box_average(variances, half_window);
    box_average(variances, half_window);
    for (std::size_t t = 0; t < differences; ++t) {
      for (std::size_t i = 0; i < block_channels; ++i) {
        const double share = settings.share_of_constant;
        penalty(t, i) = 1 / ((1 - share) * variances(t, i) + share * constant[i]);
      }
    }
  }
}

void smooth_adaptively(PoseMatrix& matrix, std::span<const std::uint8_t> missing,
                       std::span<const double> noise_variance,
                       std::span<const SmoothingModel> models, double frame_rate_hz,
                       const AdaptiveSettings& settings) {
  assert(noise_variance.size() == matrix.channels && models.size() == matrix.channels);
  assert(missing.empty() || missing.size() == matrix.values.size());
  for_each_of_one_order(models, [&](const Channels& members) {
    ChannelBlock weight(matrix.frames, 1);
    std::vector<double> variances;
    std::vector<SmoothingModel> own;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::size_t c = members[i];
      variances.push_back(noise_variance[c]);
      own.push_back(models[c]);
      for (std::size_t t = 0; t < matrix.frames; ++t) {
        const bool lost = !missing.empty() && missing[t * matrix.channels + c] != 0;
        weight(t, i) = lost ? 0 : 1 / noise_variance[c];
      }
    }
    const ChannelBlock y = gather(matrix, members);
    scatter(smooth_adaptively(y, weight, variances, own, frame_rate_hz, settings), members, matrix);
  });
}

void for_each_of_one_order(std::span<const SmoothingModel> models,
                           const std::function<void(const std::vector<std::size_t>&)>& work) {
  std::vector<Channels> blocks;
  for (std::size_t order = 1; order <= largest_order; ++order) {
    Channels channels;
    for (std::size_t c = 0; c < models.size(); ++c) {
      if (models[c].order == order) channels.push_back(c);
    }
    for (Channels& block : in_blocks(channels)) blocks.push_back(std::move(block));
  }
  for_each_block(blocks, work);
}

void NoisePrecision::set_channel(std::size_t channel, double correlation,
                                 std::span<const std::uint8_t> missing) {
  const double variance = 1 - correlation * correlation;  // of the innovation in a frame
  const auto is_missing = [&](std::size_t t) { return !missing.empty() && missing[t] != 0; };
  log_determinant[channel] = observed[channel] = 0;
  for (std::size_t t = 0; t < weight.frames; ++t) {
    coupling(t, channel) = 0;
    weight(t, channel) = 0;
    if (is_missing(t)) continue;
    observed[channel] += 1;
    if (t == 0 || is_missing(t - 1)) {
      weight(t, channel) = 1;
      continue;
    }
    weight(t, channel) = 1 / variance;
    weight(t - 1, channel) += correlation * correlation / variance;
    coupling(t - 1, channel) = -correlation / variance;
    log_determinant[channel] -= portable::log(variance);
  }
}

ColouredEvidence evidence_of(const ChannelBlock& y, const NoisePrecision& precision,
                             const SmoothingModel& model) {
  const std::size_t differences = y.frames - model.order;
  const ChannelBlock penalty(differences, model.strength);
  ChannelBlock x = y, scratch(y.frames);
  WeightedSystem system(y.frames, model.order, &precision.coupling);
  system.factor(precision.weight, penalty);
  system.refine(precision.weight, penalty, y, x, scratch);
  ColouredEvidence evidence;
  // The minimum of the fit's objective, which hardly depends on the fit's last digits.
  const auto c = difference_coefficients(model.order);
  for (std::size_t t = 0; t < y.frames; ++t) {
    for (std::size_t i = 0; i < block_channels; ++i) {
      const double rest = y(t, i) - x(t, i);
      evidence.squares[i] += precision.weight(t, i) * rest * rest;
      if (t + 1 < y.frames) {
        evidence.squares[i] += 2 * precision.coupling(t, i) * rest * (y(t + 1, i) - x(t + 1, i));
      }
    }
    if (t >= differences) continue;
    for (std::size_t i = 0; i < block_channels; ++i) {
      double difference = 0;
      for (std::size_t k = 0; k <= model.order; ++k) difference += c[k] * x(t + k, i);
      evidence.squares[i] += model.strength * difference * difference;
    }
  }
  evidence.logarithms = system.log_determinants();
  for (std::size_t i = 0; i < block_channels; ++i) {
    evidence.differences[i] = precision.observed[i] - static_cast<double>(model.order);
    evidence.logarithms[i] -= precision.log_determinant[i] +
                              static_cast<double>(differences) * portable::log(model.strength);
  }
  return evidence;
}

}  // namespace kinemend::signal
