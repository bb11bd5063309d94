// The method `pattern`: fills a marker's gap with the movement of another marker.
#include <fmt/format.h>

#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

// The part of the donor's movement beside the gap that is used. Not swept.
constexpr double pattern_beside_s = 0.3;
constexpr std::size_t least_beside = 16;  // frames

}  // namespace

Filling fill_by_pattern(const Samples& samples, const MarkerGap& gap,
                        const MarkerRequest& request) {
  constexpr std::string_view name = "pattern";
  const std::size_t donor = request.donor;
  if (donor == gap.marker) return Filling::refused(name, "the marker is its own donor");
  // Finds the donor's contiguous frames that cover the gap and enough frames beside it to meet the
  // ends.
  const std::size_t reach = samples.frames_in(pattern_beside_s, least_beside);
  std::size_t first = gap.span.first, last = gap.span.last;
  for (std::size_t f = first; f <= last; ++f) {
    if (samples.sees(f, donor)) continue;
    return Filling::refused(name,
                            fmt::format("the donor is missing in frame {}",
                                        static_cast<std::int64_t>(f) + samples.first_frame),
                            true);
  }
  while (first > 0 && gap.span.first - first < reach && samples.sees(first - 1, donor)) --first;
  while (last + 1 < samples.frames && last - gap.span.last < reach &&
         samples.sees(last + 1, donor)) {
    ++last;
  }
  const auto meets = [&](bool at_end, std::size_t beside) {
    return !at_end && samples.sees(beside, donor) && samples.measures(beside, gap.marker);
  };
  const bool before = meets(gap.span.first == 0, gap.span.first - 1);
  const bool behind = meets(gap.span.last + 1 == samples.frames, gap.span.last + 1);
  if (!(before && behind) && !(request.lenient && (before || behind))) {
    return Filling::refused(name, "the donor and the marker are not both seen at the gap's ends");
  }
  Track track = track_around(samples, gap);
  const FrameSpan span = within(track, gap.span);
  Guess guess{first - track.first_frame, {}};
  for (std::size_t f = first; f <= last; ++f) guess.values.push_back(samples.at(f, donor));
  place_guess(track, span, guess, {.frame_rate_hz = samples.frame_rate_hz});
  Filling filling{values_in(track, span), std::string(name)};
  filling.markers_used = {donor};
  return filling;
}

}  // namespace kinemend::fill
