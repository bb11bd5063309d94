#include "fill/cycles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinemend::fill {

namespace {

std::size_t surroundings_of(FrameSpan span, const CurveSettings& settings) {
  const double frames = std::clamp(0.5 * static_cast<double>(span.length()),
                                   0.15 * settings.frame_rate_hz, 0.5 * settings.frame_rate_hz);
  return std::max<std::size_t>(4, static_cast<std::size_t>(std::lround(frames)));
}

// The span with the frames around it that are compared.
struct Scene {
  std::size_t first = 0, last = 0;    // inclusive
  std::vector<std::size_t> compared;  // observed frames, ascending
};

Scene scene_of(const Track& track, FrameSpan span, std::size_t reach) {
  Scene scene;
  scene.first = span.first - std::min(reach, span.first);
  scene.last = std::min(span.last + reach, track.frames() - 1);
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

// Sum over the channels of the squared distances of `value(frame, channel)` from its best line.
template <class Value>
double squares_about_line(const std::vector<std::size_t>& frames, std::size_t channels,
                          Value value) {
  double mean_frame = 0, spread = 0;
  const auto count = static_cast<double>(frames.size());
  for (const std::size_t f : frames) mean_frame += static_cast<double>(f) / count;
  for (const std::size_t f : frames) {
    spread += (static_cast<double>(f) - mean_frame) * (static_cast<double>(f) - mean_frame);
  }
  double squares = 0;
  for (std::size_t c = 0; c < channels; ++c) {
    double sum = 0, square = 0, product = 0;
    const double origin = value(frames[0], c);  // keeps the differences of large numbers small
    for (const std::size_t f : frames) {
      const double y = value(f, c) - origin;
      sum += y;
      square += y * y;
      product += y * (static_cast<double>(f) - mean_frame);
    }
    squares += square - sum * sum / count - (spread > 0 ? product * product / spread : 0.0);
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
    return squares_about_line(frames, track_.channels, [&](std::size_t f, std::size_t c) {
      const auto other = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(f) + lag);
      return track_.row(other)[c] - track_.row(f)[c];
    });
  }

  double own_squares(const std::vector<std::size_t>& frames) const {
    return squares_about_line(frames, track_.channels,
                              [&](std::size_t f, std::size_t c) { return track_.row(f)[c]; });
  }

 private:
  const Track& track_;
  const Scene& scene_;
  std::vector<std::size_t> missing_;  // how many before each frame
};

// The minimum of squares among the lags within `step` of `lag`.
Cycle refined(const Matcher& matcher, std::ptrdiff_t lag, std::ptrdiff_t step,
              const std::vector<std::size_t>& frames) {
  Cycle best{lag, std::numeric_limits<double>::infinity()};
  for (std::ptrdiff_t s = lag - step; s <= lag + step; ++s) {
    const double squares = matcher.squares_at(s, frames);
    if (squares < best.mismatch) best = {s, squares};
  }
  return best;
}

}  // namespace

std::vector<Cycle> find_cycles(const Track& track, FrameSpan span, const CurveSettings& settings,
                               const CycleSettings& rules) {
  constexpr std::size_t compared_at_first = 24;
  const Scene scene = scene_of(track, span, surroundings_of(span, settings));
  if (scene.compared.size() < 6) return {};
  const Matcher matcher(track, scene);
  const std::vector<std::size_t> few = thinned(scene.compared, compared_at_first);
  const double own = matcher.own_squares(scene.compared);
  if (!(own > 0)) return {};

  const auto step = std::max<std::ptrdiff_t>(1, std::lround(settings.frame_rate_hz / 40));
  const auto farthest =
      std::min(static_cast<std::ptrdiff_t>(track.frames()),
               static_cast<std::ptrdiff_t>(rules.farthest_s * settings.frame_rate_hz));
  std::vector<std::ptrdiff_t> lags;
  std::vector<double> squares;
  for (std::ptrdiff_t lag = -(farthest / step) * step; lag < farthest; lag += step) {
    lags.push_back(lag);
    squares.push_back(matcher.squares_at(lag, few));
  }
  std::vector<Cycle> cycles;
  const double limit =
      2 * rules.largest_mismatch * rules.largest_mismatch * matcher.own_squares(few);
  for (std::size_t i = 0; i < lags.size(); ++i) {
    const bool is_minimum = (i == 0 || squares[i] <= squares[i - 1]) &&
                            (i + 1 == lags.size() || squares[i] < squares[i + 1]);
    if (!is_minimum || !(squares[i] <= limit)) continue;
    Cycle cycle = refined(matcher, lags[i], step, scene.compared);
    cycle.mismatch = std::sqrt(cycle.mismatch / own);
    if (cycle.mismatch <= rules.largest_mismatch) cycles.push_back(cycle);
  }
  std::stable_sort(cycles.begin(), cycles.end(),
                   [](const Cycle& a, const Cycle& b) { return a.mismatch < b.mismatch; });
  if (cycles.size() > rules.most_cycles) cycles.resize(rules.most_cycles);
  std::erase_if(cycles,
                [&](const Cycle& cycle) { return cycle.mismatch > 1.5 * cycles[0].mismatch; });
  return cycles;
}

bool fill_with_cycles(const Track& track, FrameSpan span, std::span<const Cycle> cycles,
                      const CurveSettings& settings) {
  if (cycles.empty()) return false;
  const Scene scene = scene_of(track, span, surroundings_of(span, settings));
  Guess guess{scene.first, {}};
  guess.values.assign((scene.last - scene.first + 1) * track.channels, 0.0);
  double total = 0;
  for (const Cycle& cycle : cycles) total += 1 / (cycle.mismatch * cycle.mismatch + 1e-6);
  for (const Cycle& cycle : cycles) {
    const double weight = 1 / (cycle.mismatch * cycle.mismatch + 1e-6) / total;
    const auto from =
        static_cast<std::size_t>(static_cast<std::ptrdiff_t>(scene.first) + cycle.lag);
    const std::span<const double> source =
        track.values.subspan(from * track.channels, guess.values.size());
    for (std::size_t i = 0; i < source.size(); ++i) guess.values[i] += weight * source[i];
  }
  place_guess(track, span, guess, settings);
  return true;
}

}  // namespace kinemend::fill
