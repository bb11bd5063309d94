#include "priors/recurrent_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kinemend {

namespace {

using Floats = std::vector<float>;

constexpr float most_feature = 6;             // deviations: what is beyond counts as this
constexpr float least_feature_scale = 1e-4F;  // degrees, of features
constexpr float fade_scale = 0.02F;           // degrees
constexpr float quick_scale = 0.1F;           // degrees, added to the scale of the quick part of a
constexpr float deviations_per_mad = 1.4826F;
constexpr float least_share_of_rms = 0.25F;
// Half widths of the kernels, in frames, each three moving averages in a row: deviations of 12, 20,
// 37, 71 and 137 ms at 120 Hz.
constexpr std::array<std::size_t, 5> half_widths{1, 2, 4, 8, 16};

struct Signal {
  std::size_t frames, channels;
  Floats values;

  const float* row(std::size_t f) const { return values.data() + f * channels; }
  float* row(std::size_t f) { return values.data() + f * channels; }
};

// Moving average over 2 h + 1 frames; h frames shorter at either end.
Signal moving_average(const Signal& x, std::size_t h) {
  Signal result{x.frames - 2 * h, x.channels, Floats((x.frames - 2 * h) * x.channels)};
  std::vector<double> sum(x.channels, 0.0);
  for (std::size_t f = 0; f < 2 * h; ++f) {
    for (std::size_t c = 0; c < x.channels; ++c) sum[c] += static_cast<double>(x.row(f)[c]);
  }
  const double share = 1 / static_cast<double>(2 * h + 1);
  for (std::size_t f = 0; f < result.frames; ++f) {
    const float *next = x.row(f + 2 * h), *last = x.row(f);
    float* to = result.row(f);
    for (std::size_t c = 0; c < x.channels; ++c) {
      sum[c] += static_cast<double>(next[c]);
      to[c] = static_cast<float>(share * sum[c]);
      sum[c] -= static_cast<double>(last[c]);
    }
  }
  return result;
}

// Continued at both ends by its point reflection.
Signal extended(const Signal& x, std::size_t pad) {
  Signal result{x.frames + 2 * pad, x.channels, {}};
  result.values.reserve(result.frames * x.channels);
  const auto add_reflected = [&](std::size_t about, std::size_t from) {
    for (std::size_t c = 0; c < x.channels; ++c)
      result.values.push_back(2 * x.row(about)[c] - x.row(from)[c]);
  };
  const std::size_t last = x.frames - 1;
  for (std::size_t i = pad; i > 0; --i) add_reflected(0, std::min(i, last));
  result.values.insert(result.values.end(), x.values.begin(), x.values.end());
  for (std::size_t i = 1; i <= pad; ++i) add_reflected(last, last - std::min(i, last));
  return result;
}

Signal smoothed(const Signal& x, std::size_t h) {
  return moving_average(moving_average(moving_average(extended(x, 3 * h), h), h), h);
}

// Writes less - more of each frame into band `band`.
void put_band(const Signal& less, const Signal* more, std::size_t band, RecurrentInput& input) {
  for (std::size_t f = 0; f < input.frames; ++f) {
    float* to = input.bands.data() + (f * recurrent_bands + band) * input.channels;
    for (std::size_t c = 0; c < input.channels; ++c)
      to[c] = less.row(f)[c] - (more != nullptr ? more->row(f)[c] : 0.0F);
  }
}

// The quick part of a, for the features.
Signal put_bands(const Signal& u, const Signal& a, RecurrentInput& input) {
  input.bands.resize(input.frames * recurrent_bands * input.channels);
  std::size_t band = 0;
  Signal less = u;
  for (const std::size_t h : half_widths) {
    Signal more = smoothed(u, h);
    put_band(less, &more, band++, input);
    less = std::move(more);
  }
  put_band(less, nullptr, band++, input);
  Signal quick = a;
  less = a;
  for (std::size_t i = 1; i < half_widths.size(); ++i) {
    Signal more = smoothed(a, half_widths[i]);
    put_band(less, &more, band++, input);
    if (i == 2) {
      for (std::size_t k = 0; k < quick.values.size(); ++k) quick.values[k] -= more.values[k];
    }
    less = std::move(more);
  }
  return quick;
}

bool is_marked(const RecurrentTake& take, std::size_t frame, std::size_t channel) {
  return take.marks[frame * (take.channels / 3) + channel / 3] != 0;
}

float scale_of(const RecurrentTake& take, std::size_t channel) {
  Floats sizes;
  double square = 0;
  for (std::size_t f = 0; f < take.frames; ++f) {
    if (is_marked(take, f, channel)) continue;
    const std::size_t i = f * take.channels + channel;
    const float u = take.measured[i] - take.automatic[i];
    sizes.push_back(std::abs(u));
    square += static_cast<double>(u) * static_cast<double>(u);
  }
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double rms = std::sqrt(square / static_cast<double>(sizes.size()));
  return std::max(deviations_per_mad * *middle, least_share_of_rms * static_cast<float>(rms));
}

float bounded(float value) { return std::clamp(value, -most_feature, most_feature); }

// Tracks of which nothing was measured tell nothing of the pose.
std::vector<std::uint8_t> seen_tracks(const RecurrentTake& take) {
  const std::size_t tracks = take.channels / 3;
  std::vector<std::uint8_t> seen(tracks, 0);
  for (std::size_t i = 0; i < take.marks.size(); ++i) {
    if (take.marks[i] == 0) seen[i % tracks] = 1;
  }
  return seen;
}

void put_features(const RecurrentTake& take, const RecurrentStatistics& statistics, const Signal& u,
                  const Signal& quick, RecurrentInput& input) {
  const std::size_t channels = take.channels, tracks = channels / 3;
  const std::size_t width = recurrent_feature_count(channels);
  input.features.assign(input.steps * width, 0.0F);
  const std::vector<std::uint8_t> seen = seen_tracks(take);
  for (std::size_t t = 0; t < input.steps; ++t) {
    float* row = input.features.data() + t * width;
    float *pose = row, *change = pose + channels, *taken = change + channels;
    float* fast = taken + recurrent_step * channels;
    float *scale = fast + recurrent_step * channels, *marks = scale + channels;
    for (std::size_t i = 0; i < recurrent_step; ++i) {
      // The last step repeats the last frame.
      const std::size_t f = std::min(t * recurrent_step + i, take.frames - 1);
      for (std::size_t c = 0; c < channels; ++c) {
        if (seen[c / 3] == 0) continue;
        const float s = std::max(input.scales[c], least_feature_scale);
        const float a = take.automatic[f * channels + c];
        pose[c] += (a - statistics.mean[c]) / (recurrent_step * statistics.deviation[c]);
        taken[i * channels + c] = bounded(u.row(f)[c] / s);
        fast[i * channels + c] = bounded(quick.row(f)[c] / (s + quick_scale));
      }
      for (std::size_t n = 0; n < tracks; ++n)
        marks[i * tracks + n] = take.marks[f * tracks + n] != 0 ? 1.0F : 0.0F;
    }
    for (std::size_t c = 0; c < channels; ++c) {
      if (seen[c / 3] == 0) continue;
      pose[c] = bounded(pose[c]);
      scale[c] = 0.5F * std::log(std::max(input.scales[c], least_feature_scale));
      const float* before = pose - (t > 0 ? width : 0);
      change[c] = bounded((pose[c] - before[c]) * statistics.deviation[c] / statistics.speed[c]);
    }
  }
}

// Calls `use(f, t, next, share)`: frame f lies between the middles of the steps t and next.
template <class Use>
void for_each_frame(const RecurrentInput& input, const Use& use) {
  for (std::size_t f = 0; f < input.frames; ++f) {
    const float place = (static_cast<float>(f) + 0.5F) / static_cast<float>(recurrent_step) - 0.5F;
    const float below = std::floor(place);
    const std::size_t t = below < 0 ? 0 : static_cast<std::size_t>(below);
    const std::size_t next = below < 0 ? 0 : std::min(t + 1, input.steps - 1);
    use(f, t, next, below < 0 ? 0.0F : place - below);
  }
}

Floats fades_of(const RecurrentInput& input) {
  Floats fades;
  for (const float s : input.scales) fades.push_back(s / (s + fade_scale));
  return fades;
}

}  // namespace

std::size_t recurrent_feature_count(std::size_t channels) {
  return (3 + 2 * recurrent_step) * channels + recurrent_step * (channels / 3);
}

std::size_t recurrent_output_count(std::size_t channels) {
  return (recurrent_bands + recurrent_step) * channels;
}

RecurrentInput recurrent_input(const RecurrentTake& take, const RecurrentStatistics& statistics) {
  RecurrentInput input;
  input.frames = take.frames;
  input.channels = take.channels;
  input.steps = (take.frames + recurrent_step - 1) / recurrent_step;
  if (take.frames == 0) return input;
  for (std::size_t c = 0; c < take.channels; ++c) input.scales.push_back(scale_of(take, c));
  const Signal a{take.frames, take.channels, take.automatic};
  Signal u{take.frames, take.channels, take.measured};
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 0; c < take.channels; ++c) {
      const std::size_t i = f * take.channels + c;
      const float most = most_feature * input.scales[c];
      u.values[i] = is_marked(take, f, c) ? 0 : std::clamp(u.values[i] - a.values[i], -most, most);
    }
  }
  const Signal quick = put_bands(u, a, input);
  put_features(take, statistics, u, quick, input);
  return input;
}

void recurrent_correction(const RecurrentInput& input, std::span<const float> outputs,
                          std::span<float> correction) {
  const std::size_t channels = input.channels, width = recurrent_output_count(channels);
  const Floats fades = fades_of(input);
  for_each_frame(input, [&](std::size_t f, std::size_t t, std::size_t next, float share) {
    const float *from = outputs.data() + t * width, *to = outputs.data() + next * width;
    const float* bands = input.bands.data() + f * recurrent_bands * channels;
    const std::size_t own = f / recurrent_step;
    const float* residual =
        outputs.data() + own * width + (recurrent_bands + f % recurrent_step) * channels;
    float* result = correction.data() + f * channels;
    for (std::size_t c = 0; c < channels; ++c) result[c] = input.scales[c] * residual[c];
    for (std::size_t k = 0; k < recurrent_bands; ++k) {
      const std::size_t row = k * channels;
      for (std::size_t c = 0; c < channels; ++c)
        result[c] += (from[row + c] + share * (to[row + c] - from[row + c])) * bands[row + c];
    }
    for (std::size_t c = 0; c < channels; ++c) result[c] *= fades[c];
  });
}

void recurrent_correction_adjoint(const RecurrentInput& input, std::span<const float> derivative,
                                  std::span<float> outputs) {
  const std::size_t channels = input.channels, width = recurrent_output_count(channels);
  const Floats fades = fades_of(input);
  std::fill(outputs.begin(), outputs.end(), 0.0F);
  Floats faded(channels);
  for_each_frame(input, [&](std::size_t f, std::size_t t, std::size_t next, float share) {
    float *from = outputs.data() + t * width, *to = outputs.data() + next * width;
    const float* bands = input.bands.data() + f * recurrent_bands * channels;
    const std::size_t own = f / recurrent_step;
    float* residual =
        outputs.data() + own * width + (recurrent_bands + f % recurrent_step) * channels;
    const float* given = derivative.data() + f * channels;
    for (std::size_t c = 0; c < channels; ++c) faded[c] = fades[c] * given[c];
    for (std::size_t c = 0; c < channels; ++c) residual[c] += input.scales[c] * faded[c];
    for (std::size_t k = 0; k < recurrent_bands; ++k) {
      const std::size_t row = k * channels;
      for (std::size_t c = 0; c < channels; ++c) {
        const float part = faded[c] * bands[row + c];
        from[row + c] += (1 - share) * part;
        to[row + c] += share * part;
      }
    }
  });
}

}  // namespace kinemend
