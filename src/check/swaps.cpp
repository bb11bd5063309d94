// Decides which exchanges of labels are real, undoes them, and reports them.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "check/checks.hpp"
#include "check/swap_breaks.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

using check::Exchange;

// An unnamed track (such as `*12`) has no label to exchange.
bool is_named(const std::string& name) {
  const std::string_view own = without_subject(name);
  return !own.empty() && own.front() != '*' && own.substr(0, 5) != "uname";
}

std::vector<std::size_t> named_markers(const Take& clip) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if ((clip.is_position.empty() || clip.is_position[m] != 0) && is_named(clip.names[m]))
      markers.push_back(m);
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
  const check::NeighbourVerdict verdict =
      check::ask_neighbours(clip, markers, pair.first, pair.second, swapped);
  const bool sure = static_cast<double>(longest_gap) <= short_gap_s * clip.frame_rate_hz;
  if (!verdict.known) return sure;
  return verdict.exchanged < (sure ? 1.0 : 0.6) * verdict.as_labelled;
}

}  // namespace

std::vector<MarkerSwap> find_swaps(const Take& clip) {
  const std::vector<std::size_t> markers = named_markers(clip);
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Exchange>> by_pair;
  for (const Exchange& e : check::find_exchanges(clip, check::find_breaks(clip, markers)))
    by_pair[{e.first_marker, e.second_marker}].push_back(e);
  std::vector<MarkerSwap> swaps;
  for (const auto& [pair, exchanges] : by_pair) {
    const std::vector<FrameSpan> spans = swapped_spans(exchanges, clip.frame_count());
    for (const FrameSpan& span : spans) {
      std::size_t longest_gap = 0;
      for (const Exchange& e : exchanges) {
        if (e.first_after == span.first || e.last_before == span.last)
          longest_gap = std::max(longest_gap, e.longest_gap);
      }
      if (neighbours_agree(clip, markers, pair, span, spans, longest_gap))
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

void check_swaps(const Take& clip, const std::vector<std::int32_t>& track_of, CheckReport& report) {
  report.swaps = find_swaps(clip);
  report.figures.swaps = report.swaps.size();
  for (const MarkerSwap& swap : report.swaps) {
    for (const std::size_t marker : {swap.first_marker, swap.second_marker}) {
      if (const std::int32_t track = track_of[marker]; track >= 0)
        ++report.tracks[static_cast<std::size_t>(track)].swaps;
    }
    Finding finding{FindingKind::swap,
                    Severity::serious,
                    clip.names[swap.first_marker] + ", " + clip.names[swap.second_marker],
                    swap.first_frame,
                    swap.last_frame,
                    static_cast<double>(swap.last_frame - swap.first_frame + 1),
                    "frames",
                    "the two labels are exchanged"};
    report.findings.push_back(std::move(finding));
  }
}

}  // namespace check

}  // namespace kinemend
