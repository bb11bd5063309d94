#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "tracks/vector_tracks.hpp"

namespace kinemend {

namespace {

double squared(double x) { return x * x; }

constexpr double third_difference[] = {-1, 3, -3, 1};
constexpr double fifth_difference[] = {-1, 5, -10, 10, -5, 1};

// The difference of some order at each frame where no sample of it is marked, divided by what white
// noise of deviation 1 would give.
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
    bool whole = true;
    for (std::size_t k = 0; k <= order; ++k) {
      difference += coefficients[k] * track[t + k];
      whole = whole && marked[t + k] == 0;
    }
    if (whole) result.push_back(scale * difference);
  }
  return result;
}

// Mean over the axes.
std::vector<double> mean_squares(const std::vector<Vec3>& vectors) {
  std::vector<double> squares;
  squares.reserve(vectors.size());
  for (const Vec3 v : vectors) squares.push_back(dot(v, v) / 3);
  return squares;
}

constexpr double chance_excess = 1.01;  // the least of several estimates is a little low

// Averages over ten differences in a row; their lower quartile is 0.853^2 of the mean for white
// noise.
double quiet_quarter(const std::vector<double>& squares) {
  constexpr std::size_t window = 10;
  constexpr double quartile_bias = 0.853 / 1.05;
  std::vector<double> averages;
  double sum = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    sum += squares[i];
    if (i >= window) sum -= squares[i - window];
    if (i + 1 >= window) averages.push_back(std::max(0.0, sum / window));
  }
  return std::sqrt(quantile_of(averages, 0.25)) / quartile_bias;
}

double round_level(std::span<const Vec3> track, std::span<const std::uint8_t> marked) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> squares = mean_squares(differences(track, marked, third_difference));
  if (squares.size() >= 3) {
    if (squares.size() >= 30) least = quiet_quarter(squares);
    least = std::min(least, std::sqrt(3 * median_of(squares)) / median_of_chi3);
  }
  if (track.size() >= 20) {
    squares = mean_squares(differences(track, marked, fifth_difference));
    if (squares.size() >= 3)
      least = std::min(least, std::sqrt(3 * median_of(squares)) / median_of_chi3);
  }
  return std::isfinite(least) ? chance_excess * least : 0;
}

// Deviation of numbers of which some may lie far off: Huber's, whose squares are cut at 2.5
// deviations.
double robust_deviation(std::vector<double> numbers) {
  constexpr double cut = 2.5, share_within_cut = 0.9775, median_size = 0.6745;
  constexpr int rounds = 10;
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

// Mean over the axes that have the track's noise.
double loud_level(std::span<const Vec3> track, std::span<const std::uint8_t> marked) {
  const Vec3 levels =
      noise_along(fifth_differences(track, marked), {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
  const double loudest = std::max({levels.x, levels.y, levels.z});
  double sum = 0, count = 0;
  for (const double level : {levels.x, levels.y, levels.z}) {
    if (level < 0.5 * loudest) continue;
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
    return robust_deviation(std::move(numbers));
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
                   bool has_quiet_axes) {
  if (track.size() < 6) return 0;
  return has_quiet_axes ? loud_level(track, marked) : round_level(track, marked);
}

std::vector<double> noise_levels(const VectorTracks& tracks, const SampleMarks& marked) {
  std::vector<double> levels(tracks.tracks(), 0);
  for_each_parallel(tracks.tracks(), tracks.values.size(), [&](std::size_t n) {
    levels[n] = noise_level(tracks.track(n), marked.track(n), tracks.has_quiet_axes[n] != 0);
  });
  return levels;
}

std::vector<double> cleaning_shares(const std::vector<double>& noise, double frame_rate_hz) {
  if (noise.empty()) return {};
  // Degrees of noise where smoothing starts and where it is whole, in a noisy take and in a clean
  // one.
  constexpr double start_noisy = 0.15, whole_noisy = 0.35, start_clean = 0.35, whole_clean = 0.7;
  const double folding = std::max(1.0, std::pow(120 / frame_rate_hz, 0.75));
  std::vector<double> sorted = noise;
  const double median = median_of(sorted) / folding;
  const double noisy = std::clamp((median - 0.15) / 0.15, 0.0, 1.0);
  const double start = start_clean + (start_noisy - start_clean) * noisy;
  const double whole = whole_clean + (whole_noisy - whole_clean) * noisy;
  std::vector<double> shares(noise.size());
  for (std::size_t n = 0; n < noise.size(); ++n) {
    const double r = std::clamp((noise[n] / folding - start) / (whole - start), 0.0, 1.0);
    shares[n] = squared(r) * (3 - 2 * r);
  }
  return shares;
}

}  // namespace kinemend
