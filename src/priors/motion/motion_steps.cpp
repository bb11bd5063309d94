#include "priors/motion/motion_steps.hpp"

#include <algorithm>
#include <cmath>

namespace kinemend {

namespace {

constexpr double change_rate_hz = 120;
// Below these, degrees squared, nothing is told from nothing.
constexpr float least_square = 1e-5F, least_spread_square = 1e-4F;
constexpr std::size_t steps_read_together = 512;
// Bands from this one on are pooled over twice the time: they change that slowly.
constexpr std::size_t first_slow_band = 5;
// The smoothing by the measured noise is told by how it lies to the level above this band.
constexpr std::size_t measured_band = 5;

float log_feature(float square) { return 0.25F * std::log(square) + 0.5F; }

// Weights of the frames about a step, a hat of half the width `half_frames`.
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

std::size_t MotionTake::steps() const {
  return static_cast<std::size_t>(
             static_cast<double>(frames - 1) * motion_steps_hz / frame_rate_hz + 1e-9) +
         2;
}

std::size_t MotionTake::frame_of_step(std::size_t step) const {
  const double frame = static_cast<double>(step) * frame_rate_hz / motion_steps_hz;
  return std::min(frames - 1, static_cast<std::size_t>(std::lround(frame)));
}

struct MotionReader::Block {
  std::ptrdiff_t first_frame = 0;
  std::size_t frames = 0;
  std::vector<std::vector<float>> levels;  // each frames x C
  std::vector<float> squares;              // steps x C x motion_bands
  std::vector<float> taken_out;            // steps x C: mean squares of the measured noise
};

MotionReader::Block MotionReader::block(std::size_t first, std::size_t count) const {
  const std::size_t channels = take_.channels;
  const double half = take_.frame_rate_hz / motion_steps_hz;
  const std::vector<float> quick = hat(half), slow = hat(2 * half);
  const auto margin = static_cast<std::ptrdiff_t>(slow.size());
  Block result;
  result.first_frame = static_cast<std::ptrdiff_t>(take_.frame_of_step(first)) - margin;
  const auto last = static_cast<std::ptrdiff_t>(take_.frame_of_step(first + count - 1)) + margin;
  result.frames = static_cast<std::size_t>(last - result.first_frame + 1);
  for (std::size_t level = 0; level < bank_levels; ++level) {
    result.levels.emplace_back(result.frames * channels);
    bank_.level(extended_, level, result.first_frame, result.frames, result.levels.back());
  }
  result.squares.resize(count * channels * motion_bands);
  std::vector<float> sums(channels);
  for (std::size_t band = 0; band < motion_bands; ++band) {
    const std::vector<float>& weights = band < first_slow_band ? quick : slow;
    const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
    const float *upper = result.levels[band].data(), *lower = result.levels[band + 1].data();
    for (std::size_t s = 0; s < count; ++s) {
      const auto at =
          static_cast<std::ptrdiff_t>(take_.frame_of_step(first + s)) - result.first_frame;
      std::fill(sums.begin(), sums.end(), 0.0F);
      for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        const float weight = weights[static_cast<std::size_t>(std::abs(k))];
        const std::size_t row = static_cast<std::size_t>(at + k) * channels;
        for (std::size_t c = 0; c < channels; ++c) {
          const float difference = upper[row + c] - lower[row + c];
          sums[c] += weight * difference * difference;
        }
      }
      float* const squares = result.squares.data() + s * channels * motion_bands + band;
      for (std::size_t c = 0; c < channels; ++c) squares[c * motion_bands] = sums[c];
    }
  }
  result.taken_out.assign(count * channels, 0);
  const auto last_frame = static_cast<std::ptrdiff_t>(take_.frames) - 1;
  const auto reach = static_cast<std::ptrdiff_t>(quick.size()) - 1;
  for (std::size_t s = 0; s < count && !take_.measured.empty(); ++s) {
    const auto at = static_cast<std::ptrdiff_t>(take_.frame_of_step(first + s));
    float* const out = result.taken_out.data() + s * channels;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const auto row =
          static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at + k, 0, last_frame)) * channels;
      const float weight = quick[static_cast<std::size_t>(std::abs(k))];
      for (std::size_t c = 0; c < channels; ++c) {
        const float difference = take_.values[row + c] - take_.measured[row + c];
        out[c] += weight * difference * difference;
      }
    }
  }
  return result;
}

MotionReader::MotionReader(const MotionTake& take)
    : take_(take),
      bank_(take.frame_rate_hz),
      extended_(bank_.extended(take.values, take.channels)) {
  const std::size_t channels = take.channels, steps = take.steps();
  std::vector<double> squares(channels * motion_bands), sum(channels), square(channels);
  for (std::size_t first = 0; first < steps; first += steps_read_together) {
    const std::size_t count = std::min(steps_read_together, steps - first);
    const Block part = block(first, count);
    for (std::size_t s = 0; s < count; ++s) {
      const std::size_t from = s * channels * motion_bands;
      for (std::size_t i = 0; i < channels * motion_bands; ++i)
        squares[i] += static_cast<double>(part.squares[from + i] + least_square);
      const auto frame = static_cast<std::size_t>(
          static_cast<std::ptrdiff_t>(take_.frame_of_step(first + s)) - part.first_frame);
      for (std::size_t c = 0; c < channels; ++c) {
        const double value =
            static_cast<double>(part.levels.back()[frame * channels + c] - take.values[c]);
        sum[c] += value;
        square[c] += value * value;
      }
    }
  }
  const auto n = static_cast<double>(steps);
  for (std::size_t c = 0; c < channels; ++c) {
    double all = 0;
    for (std::size_t band = 0; band < motion_bands; ++band) {
      const double mean = squares[c * motion_bands + band] / n;
      all += mean - static_cast<double>(least_square);
      strengths_.bands.push_back(static_cast<float>(std::sqrt(mean)));
      strengths_.features.push_back(log_feature(static_cast<float>(mean)));
    }
    const double variance = std::max(0.0, square[c] / n - (sum[c] / n) * (sum[c] / n));
    const auto spread = static_cast<float>(variance) + least_spread_square;
    strengths_.spread.push_back(std::sqrt(spread));
    strengths_.features.push_back(log_feature(spread));
    strengths_.features.push_back(take.is_position[c] != 0 ? 1.0F : 0.0F);
    strengths_.is_alive.push_back(all + variance > 1e-8 ? 1 : 0);
  }
}

MotionSteps MotionReader::steps(std::size_t first, std::size_t count) const {
  const std::size_t channels = take_.channels;
  const Block part = block(first, count);
  MotionSteps result;
  result.first = first;
  result.count = count;
  result.features.resize(channels * count * motion_features);
  result.levels.resize(channels * count * motion_levels);
  result.changes.resize(result.levels.size());
  result.scales.resize(channels * count * motion_scales);
  const auto speed = static_cast<float>(take_.frame_rate_hz / change_rate_hz);
  const auto half =
      static_cast<std::ptrdiff_t>(std::lround(take_.frame_rate_hz / motion_steps_hz / 2));
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t frame = take_.frame_of_step(first + s);
    const auto at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(frame) - part.first_frame);
    for (std::size_t c = 0; c < channels; ++c) {
      const std::size_t row = c * count + s;
      float* const levels = result.levels.data() + row * motion_levels;
      float* const changes = result.changes.data() + row * motion_levels;
      for (std::size_t level = 0; level < bank_levels; ++level) {
        levels[level] = part.levels[level][at * channels + c];
        changes[level] = speed * (part.levels[level][(at + 1) * channels + c] - levels[level]);
      }
      const std::size_t next = std::min(frame + 1, take_.frames - 1);
      const std::vector<float>& measured = take_.measured.empty() ? take_.values : take_.measured;
      levels[bank_levels] = measured[frame * channels + c];
      changes[bank_levels] = speed * (measured[next * channels + c] - levels[bank_levels]);
      const float* const squares = part.squares.data() + (s * channels + c) * motion_bands;
      float* const features = result.features.data() + row * motion_features;
      for (std::size_t band = 0; band < motion_bands; ++band) {
        const float strength = log_feature(squares[band] + least_square);
        features[band] = strength;
        features[motion_bands + band] =
            strength - strengths_.features[c * motion_take_features + band];
      }
      for (std::size_t band = first_signed_band; band < motion_bands; ++band) {
        const float unit = strengths_.bands[c * motion_bands + band] + 0.01F;
        features[2 * motion_bands + band - first_signed_band] =
            std::asinh((levels[band] - levels[band + 1]) / unit);
      }
      float missing = 0, seen = 0;
      for (std::ptrdiff_t k = -half; k <= half && !take_.missing.empty(); ++k) {
        const std::ptrdiff_t f = static_cast<std::ptrdiff_t>(frame) + k;
        if (f < 0 || f >= static_cast<std::ptrdiff_t>(take_.frames)) continue;
        (take_.is_missing(static_cast<std::size_t>(f), c) ? missing : seen) += 1;
      }
      const float share = missing > 0 ? missing / (missing + seen) : 0;
      features[missing_feature] = share;
      const float taken_out = part.taken_out[s * channels + c];
      const float unit = strengths_.bands[c * motion_bands + measured_band] + 0.01F;
      features[missing_feature + 1] = log_feature(taken_out + least_square);
      features[missing_feature + 2] =
          std::asinh((levels[bank_levels] - levels[measured_band]) / unit);
      features[missing_feature + 3] = take_.measured.empty() ? 0.0F : 1.0F;
      float* const scales = result.scales.data() + row * motion_scales;
      for (std::size_t i = 0; i + 1 < motion_scales; ++i)
        scales[i] = std::sqrt(squares[scale_bands[i]] + least_square);
      scales[motion_scales - 1] = share * strengths_.spread[c];
    }
  }
  return result;
}

}  // namespace kinemend
