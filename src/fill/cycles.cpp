// Compares the surroundings of a gap with every lag and averages the best cycles.
#include "fill/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinemend::fill {

namespace {

// The compared surroundings on either side: a share of the span's length, its bounds in seconds,
// and a minimum of frames. Not swept.
constexpr double compared_share = 0.5, least_compared_s = 0.15, most_compared_s = 0.5;
constexpr std::size_t least_reach = 4, least_compared = 6;
// The first search compares at most this many frames, tries this many lags a second, and accepts
// this multiple of the largest squared mismatch; for speed, not swept.
constexpr std::size_t compared_at_first = 24;
constexpr double lags_hz = 40, accepted_at_first = 2;
// The largest lag in either direction bounds the run time; the other two are not swept.
constexpr double farthest_s = 15, largest_mismatch = 0.35;
constexpr std::size_t most_cycles = 3;
// A cycle is used if its mismatch is at most this multiple of the best one's. Not swept.
constexpr double worst_of_best = 1.5;
constexpr double least_square = 1e-6;  // floor of the squared mismatch in a cycle's weight

// The span and the compared frames around it.
struct Scene {
  std::size_t first = 0, last = 0;    // inclusive
  std::vector<std::size_t> compared;  // observed frames, ascending
};

Scene scene_of(const Track& track, FrameSpan span, const CurveSettings& settings) {
  const double frames = std::clamp(compared_share * static_cast<double>(span.length()),
                                   least_compared_s * settings.frame_rate_hz,
                                   most_compared_s * settings.frame_rate_hz);
  const auto reach = std::max(least_reach, static_cast<std::size_t>(std::lround(frames)));
  const FrameSpan whole = surroundings(span, {}, reach, track.frames());
  Scene scene{whole.first, whole.last, {}};
  for (std::size_t f = scene.first; f <= scene.last; ++f) {
    if ((f < span.first || f > span.last) && track.observed[f]) scene.compared.push_back(f);
  }
  return scene;
}

std::vector<std::size_t> thinned(const std::vector<std::size_t>& frames, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t step = (frames.size() + most - 1) / most;
  for (std::size_t i = 0; i < frames.size(); i += std::max<std::size_t>(step, 1)) {
    chosen.push_back(frames[i]);
  }
  return chosen;
}

// Returns the sum over the components of the squared distances of `value(frame)` from its best
// line.
template <class Value>
double squares_about_line(const std::vector<std::size_t>& frames, Value value) {
  double mean_frame = 0, spread = 0;
  const auto count = static_cast<double>(frames.size());
  for (const std::size_t f : frames) mean_frame += static_cast<double>(f) / count;
  for (const std::size_t f : frames) {
    spread += (static_cast<double>(f) - mean_frame) * (static_cast<double>(f) - mean_frame);
  }
  Vec3 sum, square, product;
  const Vec3 origin = value(frames[0]);  // keeps the differences of large numbers small
  for (const std::size_t f : frames) {
    const Vec3 v = value(f) - origin;
    sum += v;
    square += {v.x * v.x, v.y * v.y, v.z * v.z};
    product += (static_cast<double>(f) - mean_frame) * v;
  }
  double squares = 0;
  for (double Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    squares +=
        square.*c - sum.*c * sum.*c / count - (spread > 0 ? product.*c * product.*c / spread : 0.0);
  }
  return std::max(squares, 0.0);
}

class Matcher {
 public:
  Matcher(const Track& track, const Scene& scene) : track_(track), scene_(scene) {
    missing_.resize(track.frames() + 1, 0);
    for (std::size_t f = 0; f < track.frames(); ++f) {
      missing_[f + 1] = missing_[f] + (track.observed[f] ? 0 : 1);
    }
  }

  bool is_usable(std::ptrdiff_t lag) const {
    const auto first = static_cast<std::ptrdiff_t>(scene_.first) + lag;
    const auto last = static_cast<std::ptrdiff_t>(scene_.last) + lag;
    if (first < 0 || last >= static_cast<std::ptrdiff_t>(track_.frames())) return false;
    return missing_[static_cast<std::size_t>(last) + 1] ==
           missing_[static_cast<std::size_t>(first)];
  }

  double squares_at(std::ptrdiff_t lag, const std::vector<std::size_t>& frames) const {
    if (!is_usable(lag)) return std::numeric_limits<double>::infinity();
    return squares_about_line(frames, [&](std::size_t f) {
      const auto other = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(f) + lag);
      return track_.values[other] - track_.values[f];
    });
  }

  double own_squares(const std::vector<std::size_t>& frames) const {
    return squares_about_line(frames, [&](std::size_t f) { return track_.values[f]; });
  }

 private:
  const Track& track_;
  const Scene& scene_;
  std::vector<std::size_t> missing_;  // number of missing frames before each frame
};

// Returns the lag within `step` of `lag` that has the least squares.
Cycle refined(const Matcher& matcher, std::ptrdiff_t lag, std::ptrdiff_t step,
              const std::vector<std::size_t>& frames) {
  Cycle best{lag, std::numeric_limits<double>::infinity()};
  for (std::ptrdiff_t s = lag - step; s <= lag + step; ++s) {
    const double squares = matcher.squares_at(s, frames);
    if (squares < best.mismatch) best = {s, squares};
  }
  return best;
}

// Fills the span with the mean of these cycles (one at least).
void fill_with_cycles(Track& track, FrameSpan span, std::span<const Cycle> cycles,
                      const CurveSettings& settings) {
  const Scene scene = scene_of(track, span, settings);
  Guess guess{scene.first, std::vector<Vec3>(scene.last - scene.first + 1)};
  const auto weight_of = [](const Cycle& cycle) {
    return 1 / (cycle.mismatch * cycle.mismatch + least_square);
  };
  double total = 0;
  for (const Cycle& cycle : cycles) total += weight_of(cycle);
  for (const Cycle& cycle : cycles) {
    const double weight = weight_of(cycle) / total;
    const auto from =
        static_cast<std::size_t>(static_cast<std::ptrdiff_t>(scene.first) + cycle.lag);
    for (std::size_t i = 0; i < guess.values.size(); ++i)
      guess.values[i] += weight * track.values[from + i];
  }
  place_guess(track, span, guess, settings);
}

}  // namespace

std::vector<Cycle> find_cycles(const Track& track, FrameSpan span, const CurveSettings& settings) {
  const Scene scene = scene_of(track, span, settings);
  if (scene.compared.size() < least_compared) return {};
  const Matcher matcher(track, scene);
  const std::vector<std::size_t> few = thinned(scene.compared, compared_at_first);
  const double own = matcher.own_squares(scene.compared);
  if (!(own > 0)) return {};

  const auto step = std::max<std::ptrdiff_t>(1, std::lround(settings.frame_rate_hz / lags_hz));
  const auto farthest = std::min(static_cast<std::ptrdiff_t>(track.frames()),
                                 static_cast<std::ptrdiff_t>(farthest_s * settings.frame_rate_hz));
  std::vector<std::ptrdiff_t> lags;
  std::vector<double> squares;
  for (std::ptrdiff_t lag = -(farthest / step) * step; lag < farthest; lag += step) {
    lags.push_back(lag);
    squares.push_back(matcher.squares_at(lag, few));
  }
  std::vector<Cycle> cycles;
  const double limit =
      accepted_at_first * largest_mismatch * largest_mismatch * matcher.own_squares(few);
  for (std::size_t i = 0; i < lags.size(); ++i) {
    const bool is_minimum = (i == 0 || squares[i] <= squares[i - 1]) &&
                            (i + 1 == lags.size() || squares[i] < squares[i + 1]);
    if (!is_minimum || !(squares[i] <= limit)) continue;
    Cycle cycle = refined(matcher, lags[i], step, scene.compared);
    cycle.mismatch = std::sqrt(cycle.mismatch / own);
    if (cycle.mismatch <= largest_mismatch) cycles.push_back(cycle);
  }
  std::stable_sort(cycles.begin(), cycles.end(),
                   [](const Cycle& a, const Cycle& b) { return a.mismatch < b.mismatch; });
  if (cycles.size() > most_cycles) cycles.resize(most_cycles);
  std::erase_if(cycles, [&](const Cycle& cycle) {
    return cycle.mismatch > worst_of_best * cycles[0].mismatch;
  });
  return cycles;
}

bool fill_by_cycles(Track& track, FrameSpan span, const CurveSettings& settings,
                    std::size_t least_cycles) {
  const std::vector<Cycle> cycles = find_cycles(track, span, settings);
  if (cycles.size() < least_cycles) return false;
  fill_with_cycles(track, span, cycles, settings);
  return true;
}

}  // namespace kinemend::fill
