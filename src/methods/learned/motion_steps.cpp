// Smooths channels by each kernel of the bank, pools the energies of frequency bands about a step,
// and writes the features of each channel.
#include "methods/learned/motion_steps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/portable.hpp"

namespace kinemend {

namespace {

// Chosen by hand, not swept.
constexpr std::size_t steps_read_together = 512;  // limits memory

}  // namespace

std::size_t frames_of_quick_noise(double frame_rate_hz) {
  return static_cast<std::size_t>(std::ceil(0.04 * frame_rate_hz));
}

std::size_t motion_step_count(std::size_t frames, double frame_rate_hz) {
  return static_cast<std::size_t>(
             static_cast<double>(frames - 1) * motion_steps_hz / frame_rate_hz + 1e-9) +
         2;
}

std::size_t frame_of_motion_step(std::size_t step, double frame_rate_hz) {
  return static_cast<std::size_t>(
      std::lround(static_cast<double>(step) * frame_rate_hz / motion_steps_hz));
}

std::size_t MotionTake::frame_of_step(std::size_t step) const {
  return std::min(frames - 1, frame_of_motion_step(step, frame_rate_hz));
}

MotionReader::MotionReader(const MotionTake& take)
    : take_(take),
      bank_(take.frame_rate_hz),
      extended_(bank_.extended(take.values, take.channels)) {
  const std::size_t channels = take.channels, steps = take.steps();
  const BandHats hats(take.frame_rate_hz);
  StrengthSums sums(channels);
  BandBlock block;
  std::vector<float> slowest(channels);
  for (std::size_t first = 0; first < steps; first += steps_read_together) {
    const std::vector<std::ptrdiff_t> frames =
        frames_of(first, std::min(steps_read_together, steps - first));
    read_bands(bank_, extended_, hats, frames, block);
    for (std::size_t s = 0; s < frames.size(); ++s) {
      for (std::size_t c = 0; c < channels; ++c)
        slowest[c] = block.level_at(bank_levels - 1, frames[s], c) - take.values[c];
      const std::size_t size = channels * motion_bands;
      sums.add(std::span(block.squares).subspan(s * size, size), slowest, 1);
    }
  }
  sums.strengths(take.is_position, take.expects_slow_noise, strengths_);
}

std::vector<std::ptrdiff_t> MotionReader::frames_of(std::size_t first, std::size_t count) const {
  std::vector<std::ptrdiff_t> frames;
  for (std::size_t s = first; s < first + count; ++s)
    frames.push_back(static_cast<std::ptrdiff_t>(take_.frame_of_step(s)));
  return frames;
}

// Mean square that the smoothing by the measured noise removes about a step, for all channels.
void MotionReader::read_taken_out(std::size_t frame, const std::vector<float>& weights,
                                  std::vector<float>& result) const {
  std::fill(result.begin(), result.end(), 0.0F);
  if (take_.measured.empty()) return;
  const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  const auto at = static_cast<std::ptrdiff_t>(frame),
             last = static_cast<std::ptrdiff_t>(take_.frames) - 1;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const auto row =
        static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at + k, 0, last)) * take_.channels;
    const float weight = weights[static_cast<std::size_t>(std::abs(k))];
    for (std::size_t c = 0; c < take_.channels; ++c) {
      const float difference = take_.values[row + c] - take_.measured[row + c];
      result[c] += weight * difference * difference;
    }
  }
}

float MotionReader::missing_share(std::size_t frame, std::size_t channel) const {
  if (take_.missing.empty()) return 0;
  const auto half =
      static_cast<std::ptrdiff_t>(std::lround(take_.frame_rate_hz / motion_steps_hz / 2));
  float missing = 0, seen = 0;
  for (std::ptrdiff_t k = -half; k <= half; ++k) {
    const std::ptrdiff_t f = static_cast<std::ptrdiff_t>(frame) + k;
    if (f < 0 || f >= static_cast<std::ptrdiff_t>(take_.frames)) continue;
    (take_.is_missing(static_cast<std::size_t>(f), channel) ? missing : seen) += 1;
  }
  return missing > 0 ? missing / (missing + seen) : 0;
}

MotionSteps MotionReader::steps(std::size_t first, std::size_t count) const {
  const std::size_t channels = take_.channels;
  const BandHats hats(take_.frame_rate_hz);
  const std::vector<std::ptrdiff_t> frames = frames_of(first, count);
  BandBlock block;
  read_bands(bank_, extended_, hats, frames, block);
  MotionSteps result;
  result.first = first;
  result.resize(channels, count);
  result.take_features = strengths_.features;
  const auto speed = static_cast<float>(take_.frame_rate_hz / motion_change_rate_hz);
  const std::vector<float>& measured = take_.measured.empty() ? take_.values : take_.measured;
  std::vector<float> taken_out(channels);
  for (std::size_t s = 0; s < count; ++s) {
    const auto frame = static_cast<std::size_t>(frames[s]);
    const std::size_t next = std::min(frame + 1, take_.frames - 1);
    read_taken_out(frame, hats.quick, taken_out);
    for (std::size_t c = 0; c < channels; ++c) {
      MeasuredAt at{measured[frame * channels + c], 0, taken_out[c], !take_.measured.empty()};
      at.change = speed * (measured[next * channels + c] - at.level);
      write_step(block, s, frames[s], c, take_.frame_rate_hz, strengths_, missing_share(frame, c),
                 at, step_row(result, c, s));
    }
  }
  return result;
}

void MotionSteps::resize(std::size_t channels, std::size_t steps) {
  count = steps;
  features.resize(channels * count * motion_features);
  levels.resize(channels * count * motion_levels);
  changes.resize(levels.size());
  scales.resize(channels * count * motion_scales);
}

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

namespace {

// Deviations at which a Gaussian ends, 0.4 % of its peak; length of the line fit at an end. Chosen
// by hand; the network has learned with them.
constexpr double cut_deviations = 3.3;
constexpr double line_s = 0.1;

std::vector<float> taps_of(double sigma_frames) {
  const auto reach = static_cast<std::size_t>(std::ceil(cut_deviations * sigma_frames));
  std::vector<double> taps(reach + 1);
  double sum = 0;
  for (std::size_t k = 0; k <= reach; ++k) {
    const double z = static_cast<double>(k) / sigma_frames;
    taps[k] = portable::exp(-0.5 * z * z);
    sum += k == 0 ? taps[k] : 2 * taps[k];
  }
  for (double& tap : taps) tap /= sum;
  return {taps.begin(), taps.end()};
}

// The value at the first of `count` samples of a line fitted to them.
double fitted_end(const float* first, std::ptrdiff_t stride, std::size_t count) {
  double sum = 0, moment = 0;
  const double middle = (static_cast<double>(count) - 1) / 2;
  double spread = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) - middle;
    const double y = first[static_cast<std::ptrdiff_t>(i) * stride];
    sum += y;
    moment += x * y;
    spread += x * x;
  }
  const double slope = spread > 0 ? moment / spread : 0;
  return sum / static_cast<double>(count) - slope * middle;
}

}  // namespace

SmootherBank::SmootherBank(double frame_rate_hz) : frame_rate_hz_(frame_rate_hz) {
  taps_.push_back({1.0F});
  for (const double width : bank_widths_s) taps_.push_back(taps_of(width * frame_rate_hz));
  reach_ = taps_.back().size() - 1;
}

ExtendedChannels SmootherBank::extended(std::span<const float> values, std::size_t channels) const {
  ExtendedChannels result;
  result.channels = channels;
  result.frames = values.size() / channels;
  // Steps pool energies over a few frames beyond the ends.
  result.reach = reach_ + static_cast<std::size_t>(std::ceil(frame_rate_hz_ / 10)) + 2;
  result.values.resize((result.frames + 2 * result.reach) * channels);
  float* const first = result.values.data() + result.reach * channels;
  float* const last = first + (result.frames - 1) * channels;
  std::copy(values.begin(), values.end(), first);
  const auto width = static_cast<std::ptrdiff_t>(channels);
  extend(first, -width, channels, result.frames, result.reach);
  extend(last, width, channels, result.frames, result.reach);
  return result;
}

void SmootherBank::extend(float* end, std::ptrdiff_t row, std::size_t channels, std::size_t frames,
                          std::size_t rows) const {
  const std::size_t fit = std::clamp<std::size_t>(static_cast<std::size_t>(line_s * frame_rate_hz_),
                                                  std::min<std::size_t>(3, frames), frames);
  for (std::size_t c = 0; c < channels; ++c) {
    float* const own = end + c;
    const double twice = 2 * fitted_end(own, -row, fit);
    for (std::size_t k = 1; k <= rows; ++k) {
      const auto from = static_cast<std::ptrdiff_t>(std::min(k, frames - 1));
      own[static_cast<std::ptrdiff_t>(k) * row] =
          static_cast<float>(twice - static_cast<double>(own[-from * row]));
    }
  }
}

void SmootherBank::level(const ExtendedChannels& input, std::size_t level, std::ptrdiff_t first,
                         std::size_t count, std::span<float> result) const {
  const std::vector<float>& taps = taps_[level];
  const std::size_t width = input.channels;
  assert(result.size() == count * width);
  for (std::size_t i = 0; i < count; ++i)
    sum_rows(input.row(first + static_cast<std::ptrdiff_t>(i)), width, taps,
             result.data() + i * width);
}

}  // namespace kinemend
