// Finds places where two markers may have exchanged their labels, decides which exchanges are real,
// undoes them, and reports them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "check/checks.hpp"
#include "kinemend/error.hpp"
#include "kinemend/take.hpp"
#include "motion/names.hpp"

namespace kinemend {

namespace check {

namespace {

// A place where a track departs from its extrapolation, or is missing for a while.
struct Break {
  std::size_t marker = 0;
  std::size_t before = 0;  // last frame seen
  std::size_t after = 0;   // next frame seen
  double mismatch = 0;     // distance of the extrapolated sides, file units
};

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

// Returns the distance between the track of `from` up to frame `before` and that of `to` from
// frame `after` on, both extrapolated to the middle with their velocities there. For successive
// frames of one track it is about half the third difference.
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

// Returns all gaps between samples, and the successive samples whose mismatch is 6 times the usual
// one of their marker, by frame `before`. `markers`: those examined.
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

// Two breaks at which the markers exchange their labels: each track continues in the other's.
struct Exchange {
  std::size_t first_marker = 0;  // the lower one
  std::size_t second_marker = 0;
  std::size_t last_before = 0;  // last frame in which either is seen before the exchange
  std::size_t first_after = 0;  // first frame in which either is seen after it
  std::size_t longest_gap = 0;  // frames missing between the sides of either
  double doubt = 0;             // mismatch with labels exchanged over that without
};

std::optional<Exchange> exchange_of(const Take& clip, const Break& a, const Break& b) {
  // The mismatch as exchanged over that as labelled. A quarter is the "four times less" of
  // docs/details/check.md. Chosen by hand, not swept.
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

// Returns the exchanges by frame. No break is in two of them; the least doubtful ones are kept.
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

std::vector<std::size_t> spread_frames(const std::vector<std::uint8_t>& swapped,
                                       std::uint8_t wanted) {
  std::vector<std::size_t> frames;
  for (std::size_t f = 0; f < swapped.size(); ++f) {
    if (swapped[f] == wanted) frames.push_back(f);
  }
  std::vector<std::size_t> some;
  for (const std::size_t i : frames_looked_at(frames.size())) some.push_back(frames[i]);
  return some;
}

// Returns the markers whose distance has the least spread, as quartile range.
std::vector<Neighbour> steady_neighbours(const Take& clip, const std::vector<std::size_t>& markers,
                                         std::size_t of, std::size_t except,
                                         const std::vector<std::size_t>& frames) {
  // The number of neighbours used, and of frames in which both are seen. Chosen by hand, not swept.
  constexpr std::size_t wanted = 5, fewest_frames = 8;
  std::vector<Neighbour> found = neighbours_of(clip, markers, of, frames, 0.25, fewest_frames);
  std::erase_if(found, [&](const Neighbour& n) { return n.marker == except; });
  if (found.size() > wanted) found.resize(wanted);
  return found;
}

// Evidence on an exchange from distances to nearby markers: their mean departure from the usual
// distances in the frames in question, as labelled and with labels exchanged.
struct NeighbourVerdict {
  double as_labelled = 0;
  double exchanged = 0;
  bool known = false;  // false if no neighbour was seen
};
// `swapped[f]`: 1 in the frames in question, 0 in those that give the usual distances.
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
          kept.push_back(std::fabs(norm(clip.position(f, marker) - at) - n.distance));
        if (clip.is_observed(f, other))
          given.push_back(std::fabs(norm(clip.position(f, other) - at) - n.distance));
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

// An unlabelled point has no label to exchange, and changes from one marker to another anyway.
std::vector<std::size_t> labelled_markers(const Take& clip) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m) && !is_unlabelled(clip.names[m])) markers.push_back(m);
  }
  return markers;
}

// Returns every other span between the exchanges of one pair: the odd or the even ones, whichever
// have fewer frames.
std::vector<FrameSpan> swapped_spans(const std::vector<Exchange>& exchanges, std::size_t frames) {
  std::vector<FrameSpan> odd, even;
  std::size_t in_odd = 0, in_even = 0;
  for (std::size_t i = 0; i <= exchanges.size(); ++i) {
    const std::size_t first = i == 0 ? 0 : exchanges[i - 1].first_after;
    const std::size_t last = i == exchanges.size() ? frames - 1 : exchanges[i].last_before;
    if (first > last) continue;
    (i % 2 == 1 ? odd : even).push_back({first, last});
    (i % 2 == 1 ? in_odd : in_even) += last - first + 1;
  }
  return in_odd <= in_even ? odd : even;
}

// Across a gap two tracks may seem to cross by chance, so neighbours must confirm the exchange.
bool neighbours_agree(const Take& clip, const std::vector<std::size_t>& markers,
                      const std::pair<std::size_t, std::size_t>& pair, const FrameSpan& span,
                      const std::vector<FrameSpan>& all_spans, std::size_t longest_gap) {
  // Across gaps up to this length an exchange is certain without neighbours. Chosen by hand, not
  // swept.
  constexpr double short_gap_s = 0.03;
  std::vector<std::uint8_t> swapped(clip.frame_count());
  // Other swapped spans of the pair do not contribute to the usual distances.
  for (const FrameSpan& s : all_spans) std::fill_n(swapped.begin() + s.first, s.length(), 2);
  std::fill_n(swapped.begin() + span.first, span.length(), 1);
  const NeighbourVerdict verdict = ask_neighbours(clip, markers, pair.first, pair.second, swapped);
  const bool sure = static_cast<double>(longest_gap) <= short_gap_s * clip.frame_rate_hz;
  if (!verdict.known) return sure;
  return verdict.exchanged < (sure ? 1.0 : 0.6) * verdict.as_labelled;
}

}  // namespace

}  // namespace check

std::vector<MarkerSwap> find_swaps(const Take& clip) {
  const std::vector<std::size_t> markers = check::labelled_markers(clip);
  std::map<std::pair<std::size_t, std::size_t>, std::vector<check::Exchange>> by_pair;
  for (const check::Exchange& e : check::find_exchanges(clip, check::find_breaks(clip, markers)))
    by_pair[{e.first_marker, e.second_marker}].push_back(e);
  std::vector<MarkerSwap> swaps;
  for (const auto& [pair, exchanges] : by_pair) {
    const std::vector<FrameSpan> spans = check::swapped_spans(exchanges, clip.frame_count());
    for (const FrameSpan& span : spans) {
      std::size_t longest_gap = 0;
      for (const check::Exchange& e : exchanges) {
        if (e.first_after == span.first || e.last_before == span.last)
          longest_gap = std::max(longest_gap, e.longest_gap);
      }
      if (check::neighbours_agree(clip, markers, pair, span, spans, longest_gap))
        swaps.push_back({pair.first, pair.second, span.first, span.last});
    }
  }
  std::sort(swaps.begin(), swaps.end(), [](const MarkerSwap& a, const MarkerSwap& b) {
    return std::tie(a.first_frame, a.first_marker) < std::tie(b.first_frame, b.first_marker);
  });
  return swaps;
}

void undo_swaps(Take& clip, const std::vector<MarkerSwap>& swaps) {
  const std::size_t markers = clip.marker_count();
  for (auto swap = swaps.rbegin(); swap != swaps.rend(); ++swap) {
    const std::size_t a = swap->first_marker, b = swap->second_marker;
    if (std::max(a, b) >= markers || swap->first_frame > swap->last_frame ||
        swap->last_frame >= clip.frame_count()) {
      throw Error(ErrorKind::usage,
                  fmt::format("swap of markers {} and {} in frames {} to {}: the take has {} "
                              "markers and {} frames",
                              a + 1, b + 1, swap->first_frame + 1, swap->last_frame + 1, markers,
                              clip.frame_count()));
    }
    for (std::size_t f = swap->first_frame; f <= swap->last_frame; ++f) {
      const std::size_t i = f * markers + a, j = f * markers + b;
      std::swap(clip.positions[i], clip.positions[j]);
      std::swap(clip.observed[i], clip.observed[j]);
      if (!clip.residuals.empty()) std::swap(clip.residuals[i], clip.residuals[j]);
    }
  }
}

namespace check {

void check_swaps(const Rows& rows, CheckReport& report) {
  const std::vector<std::string>& names = rows.clip.names;
  report.swaps = find_swaps(rows.clip);
  report.figures.swaps = report.swaps.size();
  for (const MarkerSwap& swap : report.swaps) {
    for (const std::size_t marker : {swap.first_marker, swap.second_marker}) {
      if (const std::int32_t row = rows.row_of[marker]; row >= 0)
        ++report.tracks[static_cast<std::size_t>(row)].swaps;
    }
    report.findings.push_back({FindingKind::swap, Severity::serious,
                               names[swap.first_marker] + ", " + names[swap.second_marker],
                               swap.first_frame, swap.last_frame,
                               static_cast<double>(swap.last_frame - swap.first_frame + 1),
                               "frames", "the two labels are exchanged"});
  }
}

}  // namespace check

}  // namespace kinemend
