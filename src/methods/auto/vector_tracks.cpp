// Measures the white noise of tracks by differences that motion hardly changes, and the share of
// smoothing of each track.
#include "methods/auto/vector_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "base/frame_span.hpp"
#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"

namespace kinemend {

namespace {

double squared(double x) { return x * x; }

// Binomial coefficients.
constexpr double third_difference[] = {-1, 3, -3, 1};
constexpr double fifth_difference[] = {-1, 5, -10, 10, -5, 1};

// The differences without marked samples, divided by their deviation for white noise of deviation
// 1.
template <std::size_t count>
std::vector<Vec3> differences(std::span<const Vec3> track, std::span<const std::uint8_t> marked,
                              const double (&coefficients)[count]) {
  constexpr std::size_t order = count - 1;
  double gain = 0;
  for (const double c : coefficients) gain += c * c;
  const double scale = 1 / std::sqrt(gain);
  std::vector<Vec3> result;
  result.reserve(track.size());
  for (std::size_t t = 0; t + order < track.size(); ++t) {
    Vec3 difference;
    bool complete = true;
    for (std::size_t k = 0; k <= order; ++k) {
      difference += coefficients[k] * track[t + k];
      complete = complete && marked[t + k] == 0;
    }
    if (complete) result.push_back(scale * difference);
  }
  return result;
}

// The level of the white noise with these differences; none if they are too few.
std::optional<double> median_level(const std::vector<Vec3>& differences) {
  if (differences.size() < 3) return std::nullopt;
  std::vector<double> sizes(differences.size());
  std::transform(differences.begin(), differences.end(), sizes.begin(),
                 [](Vec3 v) { return norm(v); });
  return median_of(sizes) / median_of_chi3;
}

double isotropic_level(std::span<const Vec3> track, std::span<const std::uint8_t> marked,
                       const NoiseTuning& tuning) {
  const auto third = median_level(differences(track, marked, third_difference));
  if (!third) return 0;
  const auto fifth =
      track.size() < 20 ? std::nullopt : median_level(differences(track, marked, fifth_difference));
  return tuning.minimum_bias * std::min(*third, fifth.value_or(*third));
}

// Huber's standard deviation of numbers with outliers: squares are limited to (2.5 deviations)^2.
double huber_deviation(std::vector<double> numbers) {
  // Values for normal numbers of deviation 1: the mean of squares limited at `cut`, and the median
  // size. The cut is chosen by hand, not swept; the other two follow by definition, to four digits.
  constexpr double cut = 2.5, share_within_cut = 0.9775, median_size = 0.6745;
  constexpr int rounds = 10;  // of the fixed-point iteration
  if (numbers.empty()) return 0;
  for (double& number : numbers) number = std::abs(number);
  std::vector<double> ordered = numbers;
  double deviation = median_of(ordered) / median_size;
  for (int round = 0; round < rounds; ++round) {
    double sum = 0;
    for (const double number : numbers) sum += squared(std::min(number, cut * deviation));
    deviation = std::sqrt(sum / (share_within_cut * static_cast<double>(numbers.size())));
  }
  return deviation;
}

// Root mean square over the axes that have noise.
double whitened_level(std::span<const Vec3> track, std::span<const std::uint8_t> marked,
                      const NoiseTuning& tuning) {
  const Vec3 levels =
      noise_along(fifth_differences(track, marked), {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
  const double largest = std::max({levels.x, levels.y, levels.z});
  double sum = 0, count = 0;
  for (const double level : {levels.x, levels.y, levels.z}) {
    if (level < tuning.least_axis_share * largest) continue;
    sum += squared(level);
    count += 1;
  }
  return std::sqrt(sum / count);
}

}  // namespace

std::vector<Vec3> fifth_differences(std::span<const Vec3> track,
                                    std::span<const std::uint8_t> marked) {
  return differences(track, marked, fifth_difference);
}

Vec3 noise_along(std::span<const Vec3> differences, const std::array<Vec3, 3>& directions) {
  const auto along = [&](Vec3 direction) {
    std::vector<double> numbers(differences.size());
    std::transform(differences.begin(), differences.end(), numbers.begin(),
                   [&](Vec3 v) { return dot(v, direction); });
    return huber_deviation(std::move(numbers));
  };
  return {along(directions[0]), along(directions[1]), along(directions[2])};
}

SampleMarks either(const SampleMarks& a, const SampleMarks& b) {
  SampleMarks result = a;
  for (std::size_t i = 0; i < result.marks.size(); ++i) result.marks[i] |= b.marks[i];
  return result;
}

void fill_marked(std::span<Vec3> track, std::span<const std::uint8_t> marked) {
  const auto frames = static_cast<std::ptrdiff_t>(track.size());
  const auto value = [&](std::ptrdiff_t t) -> Vec3& { return track[static_cast<std::size_t>(t)]; };
  const auto is_marked = [&](std::ptrdiff_t t) { return marked[static_cast<std::size_t>(t)] != 0; };
  std::ptrdiff_t before = -1;
  for (std::ptrdiff_t t = 0; t < frames; ++t) {
    if (!is_marked(t)) {
      before = t;
      continue;
    }
    std::ptrdiff_t after = t;
    while (after < frames && is_marked(after)) ++after;
    if (before < 0 && after == frames) break;
    const std::ptrdiff_t from = before < 0 ? after : before, to = after == frames ? before : after;
    const Vec3 start = value(from), end = value(to);
    for (; t < after; ++t) {
      const double share =
          to > from ? static_cast<double>(t - from) / static_cast<double>(to - from) : 0;
      value(t) = start + share * (end - start);
    }
    before = after;
  }
}

double noise_level(std::span<const Vec3> track, std::span<const std::uint8_t> marked,
                   bool is_whitened, const NoiseTuning& tuning) {
  if (track.size() < 6) return 0;
  return is_whitened ? whitened_level(track, marked, tuning)
                     : isotropic_level(track, marked, tuning);
}

std::vector<double> noise_levels(const VectorTracks& tracks, const SampleMarks& marked,
                                 const NoiseTuning& tuning) {
  std::vector<double> levels(tracks.tracks(), 0);
  for_each_parallel(tracks.tracks(), tracks.values.size(), [&](std::size_t n) {
    levels[n] = noise_level(tracks.track(n), marked.track(n), tracks.is_whitened[n] != 0, tuning);
  });
  return levels;
}

double smooth_ramp(double value, double start, double full) {
  return smooth_step(std::clamp((value - start) / (full - start), 0.0, 1.0));
}

double rate_factor_of(double frame_rate_hz, const DeadZoneTuning& tuning) {
  return std::max(1.0, portable::pow(120 / frame_rate_hz, tuning.rate_exponent));
}

std::vector<double> smoothing_shares(const std::vector<double>& noise, double frame_rate_hz,
                                     const DeadZoneTuning& tuning) {
  if (noise.empty()) return {};
  const double rate_factor = rate_factor_of(frame_rate_hz, tuning);
  std::vector<double> sorted = noise;
  const double median = median_of(sorted) / rate_factor;
  const double noisy = std::clamp(median / tuning.noisy_from - 1, 0.0, 1.0);
  const double start = tuning.start_quiet + (tuning.start_noisy - tuning.start_quiet) * noisy;
  const double full = tuning.full_quiet + (tuning.full_noisy - tuning.full_quiet) * noisy;
  std::vector<double> shares(noise.size());
  for (std::size_t n = 0; n < noise.size(); ++n) {
    shares[n] = smooth_ramp(noise[n] / rate_factor, start, full);
  }
  return shares;
}

bool is_brief(std::size_t frames, double frame_rate_hz, const AgreementTuning& tuning) {
  return frame_rate_hz < tuning.lowest_rate_hz &&
         static_cast<double>(frames) < tuning.shortest_s * frame_rate_hz;
}

double agreement_of(const VectorTracks& tracks, std::span<const std::uint8_t> is_damaged,
                    double frame_rate_hz, const AgreementTuning& tuning) {
  if (!is_brief(tracks.frames(), frame_rate_hz, tuning)) return 1;
  std::size_t moving = 0, damaged = 0;
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    const auto track = tracks.track(n);
    if (std::all_of(track.begin(), track.end(), [&](Vec3 v) { return v == track[0]; })) continue;
    ++moving;
    damaged += is_damaged[n];
  }
  if (moving < tuning.fewest_tracks) return 0;
  const double share = static_cast<double>(damaged) / static_cast<double>(moving);
  return std::clamp((share - tuning.start) / (tuning.full - tuning.start), 0.0, 1.0);
}

double noise_agreement(const VectorTracks& tracks, const std::vector<double>& noise,
                       double frame_rate_hz, const TrackTuning& tuning) {
  const double least = tuning.dead_zone.start_noisy * rate_factor_of(frame_rate_hz);
  std::vector<std::uint8_t> is_noisy(noise.size());
  for (std::size_t n = 0; n < noise.size(); ++n) is_noisy[n] = noise[n] > least ? 1 : 0;
  return agreement_of(tracks, is_noisy, frame_rate_hz, tuning.agreement);
}

std::vector<double> smoothing_shares(const VectorTracks& tracks, const std::vector<double>& noise,
                                     double frame_rate_hz, const TrackTuning& tuning) {
  std::vector<double> shares = smoothing_shares(noise, frame_rate_hz, tuning.dead_zone);
  const double agreement = noise_agreement(tracks, noise, frame_rate_hz, tuning);
  for (double& share : shares) share *= agreement;
  return shares;
}

}  // namespace kinemend
