// Extrapolates tracks across gaps and jumps, pairs the breaks, and compares nearby markers.
#include "check/swap_breaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "check/checks.hpp"

namespace kinemend::check {

namespace {

// Returns the velocity a frame at the end of a run of samples; `step` is -1 for the run before
// `frame`, 1 for the one after. Across a gap noise has more influence, so more samples are used.
std::optional<Vec3> end_velocity(const Take& clip, std::size_t marker, std::size_t frame,
                                 std::ptrdiff_t step, std::size_t most_frames) {
  const auto frames = static_cast<std::ptrdiff_t>(clip.frame_count());
  const auto start = static_cast<std::ptrdiff_t>(frame);
  std::ptrdiff_t reach = 0;
  while (reach < static_cast<std::ptrdiff_t>(most_frames)) {
    const std::ptrdiff_t next = start + step * (reach + 1);
    if (next < 0 || next >= frames || !clip.is_observed(static_cast<std::size_t>(next), marker))
      break;
    ++reach;
  }
  if (reach == 0) return std::nullopt;
  const Vec3 far = clip.position(static_cast<std::size_t>(start + step * reach), marker);
  const Vec3 near = clip.position(frame, marker);
  return (1.0 / static_cast<double>(step * reach)) * (far - near);
}

// Returns the first frame after `frame` in which the marker is seen.
std::optional<std::size_t> next_seen(const Take& clip, std::size_t marker, std::size_t frame) {
  for (std::size_t f = frame + 1; f < clip.frame_count(); ++f) {
    if (clip.is_observed(f, marker)) return f;
  }
  return std::nullopt;
}

std::optional<Exchange> exchange_of(const Take& clip, const Break& a, const Break& b) {
  // The mismatch as exchanged over that as labelled. A quarter is the "four times less" of
  // docs/check.md. Chosen by hand, not swept.
  constexpr double largest_doubt = 0.25;
  const double a_to_b = side_mismatch(clip, a.marker, a.before, b.marker, b.after);
  const double b_to_a = side_mismatch(clip, b.marker, b.before, a.marker, a.after);
  const double worst = std::max(a_to_b, b_to_a), least = std::min(a.mismatch, b.mismatch);
  if (!(worst < 2 * largest_doubt * least)) return std::nullopt;
  const double doubt = (a_to_b + b_to_a) / (a.mismatch + b.mismatch);
  if (!(doubt < largest_doubt)) return std::nullopt;
  return Exchange{std::min(a.marker, b.marker),
                  std::max(a.marker, b.marker),
                  std::max(a.before, b.before),
                  std::min(a.after, b.after),
                  std::max({a.after - a.before, b.after - b.before,
                            b.after > a.before ? b.after - a.before : std::size_t{1},
                            a.after > b.before ? a.after - b.before : std::size_t{1}}) -
                      1,
                  doubt};
}

}  // namespace

double side_mismatch(const Take& clip, std::size_t from, std::size_t before, std::size_t to,
                     std::size_t after) {
  const double half = 0.5 * static_cast<double>(after - before);
  const std::size_t reach = after - before > 5 ? 3 : 1;
  std::optional<Vec3> leaving = end_velocity(clip, from, before, -1, reach);
  std::optional<Vec3> arriving = end_velocity(clip, to, after, 1, reach);
  if (!leaving) leaving = arriving.value_or(Vec3{});
  if (!arriving) arriving = leaving;
  return norm(clip.position(before, from) + half * *leaving -
              (clip.position(after, to) - half * *arriving));
}

std::vector<Break> find_breaks(const Take& clip, const std::vector<std::size_t>& markers) {
  // Chosen by hand, not swept.
  constexpr double clear_ratio = 6;  // of the median mismatch from frame to frame
  std::vector<Break> breaks;
  for (const std::size_t m : markers) {
    std::vector<Break> steps;
    std::vector<double> usual;
    std::size_t frame = 0;
    if (clip.frame_count() == 0) break;
    if (!clip.is_observed(0, m)) frame = next_seen(clip, m, 0).value_or(clip.frame_count());
    while (frame < clip.frame_count()) {
      const std::optional<std::size_t> next = next_seen(clip, m, frame);
      if (!next) break;
      steps.push_back({m, frame, *next, side_mismatch(clip, m, frame, m, *next)});
      if (*next == frame + 1) usual.push_back(steps.back().mismatch);
      frame = *next;
    }
    const double limit = clear_ratio * median_of(usual);
    for (const Break& step : steps) {
      if (step.after > step.before + 1 || step.mismatch > limit) breaks.push_back(step);
    }
  }
  std::sort(breaks.begin(), breaks.end(), [](const Break& a, const Break& b) {
    return std::pair(a.before, a.marker) < std::pair(b.before, b.marker);
  });
  return breaks;
}

std::vector<Exchange> find_exchanges(const Take& clip, const std::vector<Break>& breaks) {
  struct Candidate {
    Exchange exchange;
    std::size_t a = 0, b = 0;  // breaks
  };
  std::vector<Candidate> candidates;
  for (std::size_t a = 0; a < breaks.size(); ++a) {
    for (std::size_t b = a + 1; b < breaks.size() && breaks[b].before < breaks[a].after; ++b) {
      if (breaks[a].marker == breaks[b].marker) continue;
      if (const auto exchange = exchange_of(clip, breaks[a], breaks[b]))
        candidates.push_back({*exchange, a, b});
    }
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.exchange.doubt < b.exchange.doubt; });
  std::vector<std::uint8_t> used(breaks.size());
  std::vector<Exchange> exchanges;
  for (const Candidate& candidate : candidates) {
    if (used[candidate.a] != 0 || used[candidate.b] != 0) continue;
    used[candidate.a] = used[candidate.b] = 1;
    exchanges.push_back(candidate.exchange);
  }
  std::sort(exchanges.begin(), exchanges.end(), [](const Exchange& a, const Exchange& b) {
    return std::tie(a.first_after, a.first_marker, a.second_marker) <
           std::tie(b.first_after, b.first_marker, b.second_marker);
  });
  return exchanges;
}

namespace {

std::vector<std::size_t> spread_frames(const std::vector<std::uint8_t>& swapped,
                                       std::uint8_t wanted) {
  std::vector<std::size_t> frames;
  for (std::size_t f = 0; f < swapped.size(); ++f) {
    if (swapped[f] == wanted) frames.push_back(f);
  }
  if (frames.size() <= most_looked_at) return frames;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most_looked_at; ++i)
    some.push_back(frames[i * frames.size() / most_looked_at]);
  return some;
}

struct Neighbour {
  std::size_t marker = 0;
  double usual = 0;   // distance
  double spread = 0;  // quartile range of the distance
};

// Returns the markers whose distance has the least spread.
std::vector<Neighbour> steady_neighbours(const Take& clip, const std::vector<std::size_t>& markers,
                                         std::size_t of, std::size_t except,
                                         const std::vector<std::size_t>& frames) {
  // The number of neighbours used, and of frames in which both are seen. Chosen by hand, not swept.
  constexpr std::size_t wanted = 5, fewest_frames = 8;
  std::vector<Neighbour> found;
  std::vector<double> distances;
  for (const std::size_t n : markers) {
    if (n == of || n == except) continue;
    distances.clear();
    for (const std::size_t f : frames) {
      if (clip.is_observed(f, of) && clip.is_observed(f, n))
        distances.push_back(norm(clip.position(f, of) - clip.position(f, n)));
    }
    if (distances.size() < fewest_frames) continue;
    const double low = quantile_of(distances, 0.25), high = quantile_of(distances, 0.75);
    found.push_back({n, median_of(distances), high - low});
  }
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return std::pair(a.spread, a.marker) < std::pair(b.spread, b.marker);
  });
  if (found.size() > wanted) found.resize(wanted);
  return found;
}

}  // namespace

NeighbourVerdict ask_neighbours(const Take& clip, const std::vector<std::size_t>& markers,
                                std::size_t first_marker, std::size_t second_marker,
                                const std::vector<std::uint8_t>& swapped) {
  const std::vector<std::size_t> elsewhere = spread_frames(swapped, 0),
                                 inside = spread_frames(swapped, 1);
  std::vector<double> as_labelled, exchanged;
  for (const auto& [marker, other] :
       {std::pair(first_marker, second_marker), std::pair(second_marker, first_marker)}) {
    for (const Neighbour& n : steady_neighbours(clip, markers, marker, other, elsewhere)) {
      std::vector<double> kept, given;
      for (const std::size_t f : inside) {
        if (!clip.is_observed(f, n.marker)) continue;
        const Vec3 at = clip.position(f, n.marker);
        if (clip.is_observed(f, marker))
          kept.push_back(std::fabs(norm(clip.position(f, marker) - at) - n.usual));
        if (clip.is_observed(f, other))
          given.push_back(std::fabs(norm(clip.position(f, other) - at) - n.usual));
      }
      if (kept.empty() || given.empty()) continue;
      as_labelled.push_back(median_of(kept));
      exchanged.push_back(median_of(given));
    }
  }
  NeighbourVerdict verdict;
  verdict.known = !as_labelled.empty();
  for (const double d : as_labelled) verdict.as_labelled += d;
  for (const double d : exchanged) verdict.exchanged += d;
  return verdict;
}

}  // namespace kinemend::check
