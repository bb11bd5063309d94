// Pools the energies of frequency bands about a step and writes the features of each channel.
#include "methods/learned/motion_bands.hpp"

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"

namespace kinemend {

namespace {

// Squares below these, in square degrees, carry no information. Chosen by hand; the network has
// learned with them.
constexpr float least_square = 1e-5F, least_spread_square = 1e-4F;
// Bands from this one on change slowly and are pooled over twice the time. Chosen by hand; the
// network has learned with it.
constexpr std::size_t first_slow_band = 5;
// The smoothing by the measured noise is compared with the level above this band. Chosen by hand;
// the network has learned with it.
constexpr std::size_t measured_band = 5;

float log_feature(float square) { return 0.25F * portable::log(square) + 0.5F; }

std::vector<float> hat(double half_frames) {
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t k = 0; weights.empty() || static_cast<double>(k) < half_frames; ++k) {
    weights.push_back(half_frames > 0 ? std::max(0.0, 1 - static_cast<double>(k) / half_frames)
                                      : 1);
    sum += k == 0 ? weights[k] : 2 * weights[k];
  }
  for (double& weight : weights) weight /= sum;
  return {weights.begin(), weights.end()};
}

}  // namespace

BandHats::BandHats(double frame_rate_hz)
    : quick(hat(frame_rate_hz / motion_steps_hz)), slow(hat(2 * frame_rate_hz / motion_steps_hz)) {}

void read_bands(const SmootherBank& bank, const ExtendedChannels& extended, const BandHats& hats,
                std::span<const std::ptrdiff_t> frames, BandBlock& block) {
  const std::size_t channels = extended.channels;
  block.channels = channels;
  block.first_frame = frames.front() - hats.margin();
  block.frames = static_cast<std::size_t>(frames.back() + hats.margin() - block.first_frame + 1);
  block.levels.resize(bank_levels);
  for (std::size_t level = 0; level < bank_levels; ++level) {
    block.levels[level].resize(block.frames * channels);
    bank.level(extended, level, block.first_frame, block.frames, block.levels[level]);
  }
  block.squares.resize(frames.size() * channels * motion_bands);
  block.sums.resize(channels);
  for (std::size_t band = 0; band < motion_bands; ++band) {
    const std::vector<float>& weights = band < first_slow_band ? hats.quick : hats.slow;
    const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
    const float *upper = block.levels[band].data(), *lower = block.levels[band + 1].data();
    for (std::size_t s = 0; s < frames.size(); ++s) {
      const std::ptrdiff_t at = frames[s] - block.first_frame;
      std::fill(block.sums.begin(), block.sums.end(), 0.0F);
      for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        const float weight = weights[static_cast<std::size_t>(std::abs(k))];
        const std::size_t row = static_cast<std::size_t>(at + k) * channels;
        for (std::size_t c = 0; c < channels; ++c) {
          const float difference = upper[row + c] - lower[row + c];
          block.sums[c] += weight * difference * difference;
        }
      }
      float* const squares = block.squares.data() + s * channels * motion_bands + band;
      for (std::size_t c = 0; c < channels; ++c) squares[c * motion_bands] = block.sums[c];
    }
  }
}

StrengthSums::StrengthSums(std::size_t channels)
    : squares(channels * motion_bands), sum(channels), square(channels) {}

void StrengthSums::add(std::span<const float> step_squares, std::span<const float> slowest,
                       double weight) {
  steps += weight;
  for (std::size_t i = 0; i < squares.size(); ++i)
    squares[i] += weight * static_cast<double>(step_squares[i] + least_square);
  for (std::size_t c = 0; c < sum.size(); ++c) {
    const auto value = static_cast<double>(slowest[c]);
    sum[c] += weight * value;
    square[c] += weight * value * value;
  }
}

void StrengthSums::strengths(std::span<const std::uint8_t> is_position, bool expects_slow_noise,
                             MotionStrengths& result) const {
  const std::size_t channels = sum.size();
  result.bands.resize(channels * motion_bands);
  result.spread.resize(channels);
  result.features.resize(channels * motion_take_features);
  result.is_alive.resize(channels);
  for (std::size_t c = 0; c < channels; ++c) {
    double all = 0;
    float* const features = result.features.data() + c * motion_take_features;
    for (std::size_t band = 0; band < motion_bands; ++band) {
      const double mean =
          std::max(squares[c * motion_bands + band] / steps, static_cast<double>(least_square));
      all += mean - static_cast<double>(least_square);
      result.bands[c * motion_bands + band] = static_cast<float>(std::sqrt(mean));
      features[band] = log_feature(static_cast<float>(mean));
    }
    const double variance = std::max(0.0, square[c] / steps - (sum[c] / steps) * (sum[c] / steps));
    const float spread = static_cast<float>(variance) + least_spread_square;
    result.spread[c] = std::sqrt(spread);
    features[motion_bands] = log_feature(spread);
    features[motion_bands + 1] = is_position[c] != 0 ? 1.0F : 0.0F;
    features[motion_bands + 2] = expects_slow_noise ? 1.0F : 0.0F;
    result.is_alive[c] = all + variance > 1e-8 ? 1 : 0;
  }
}

StepRow step_row(MotionSteps& steps, std::size_t channel, std::size_t step) {
  const std::size_t row = channel * steps.count + step;
  return {steps.features.data() + row * motion_features, steps.levels.data() + row * motion_levels,
          steps.changes.data() + row * motion_levels, steps.scales.data() + row * motion_scales};
}

void write_step(const BandBlock& block, std::size_t step, std::ptrdiff_t frame, std::size_t channel,
                double frame_rate_hz, const MotionStrengths& strengths, float missing,
                const MeasuredAt& measured, const StepRow& row) {
  const auto speed = static_cast<float>(frame_rate_hz / motion_change_rate_hz);
  for (std::size_t level = 0; level < bank_levels; ++level) {
    row.levels[level] = block.level_at(level, frame, channel);
    row.changes[level] = speed * (block.level_at(level, frame + 1, channel) - row.levels[level]);
  }
  row.levels[bank_levels] = measured.level;
  row.changes[bank_levels] = measured.change;
  const float* const squares =
      block.squares.data() + (step * block.channels + channel) * motion_bands;
  const float* const of_take = strengths.features.data() + channel * motion_take_features;
  for (std::size_t band = 0; band < motion_bands; ++band) {
    const float strength = log_feature(squares[band] + least_square);
    row.features[band] = strength;
    row.features[motion_bands + band] = strength - of_take[band];
  }
  const auto unit_of = [&](std::size_t band) {
    return strengths.bands[channel * motion_bands + band] + 0.01F;
  };
  for (std::size_t band = first_signed_band; band < motion_bands; ++band) {
    row.features[2 * motion_bands + band - first_signed_band] =
        portable::asinh((row.levels[band] - row.levels[band + 1]) / unit_of(band));
  }
  row.features[missing_feature] = missing;
  row.features[missing_feature + 1] = log_feature(measured.taken_out + least_square);
  row.features[missing_feature + 2] = portable::asinh(
      (row.levels[bank_levels] - row.levels[measured_band]) / unit_of(measured_band));
  row.features[missing_feature + 3] = measured.is_known ? 1.0F : 0.0F;
  for (std::size_t i = 0; i + 1 < motion_scales; ++i)
    row.scales[i] = std::sqrt(squares[scale_bands[i]] + least_square);
  row.scales[motion_scales - 1] = missing * strengths.spread[channel];
}

}  // namespace kinemend
