// Tries the ways to fill a gap on observed spans of the take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fill/judgement.hpp"
#include "fill/track.hpp"

namespace kinemend::fill {

/// Returns the frames that a gap is filled from: a minute on either side, or ten times its length
/// if that is more. The cost of a gap therefore does not grow with the take.
FrameSpan evidence_around(FrameSpan gap, std::size_t frames, double frame_rate_hz);

/// Returns spans as long as the gap in which all is seen, with a frame on either side: the six
/// nearest to the gap, at least half a length apart, for the local motion; and three evenly over
/// the frames, for the rest. The spans are shorter (half, a quarter, ...) if fewer than three would
/// fit, and empty if none fits. `usable[i]` belongs to frame `first_frame` + i and is 0 in the gap
/// itself.
std::vector<FrameSpan> trial_places(std::span<const std::uint8_t> usable, std::size_t first_frame,
                                    FrameSpan gap);

/// A gap of a take, and the frames around it in which it can be tried.
struct TrialRoom {
  FrameSpan gap;
  TakeEnds ends;                     ///< whether the gap starts or ends the take
  FrameSpan evidence;                ///< `evidence_around`
  std::vector<std::uint8_t> usable;  ///< of its frames, as in `trial_places`; all 0 at first
};
TrialRoom room_around(FrameSpan gap, std::size_t frames, double frame_rate_hz);

/// Fills a span as if it were a gap and returns each candidate's offsets from the ground truth in
/// these frames of it.
using TryOn = std::function<Proposals(FrameSpan span, const std::vector<std::size_t>& frames)>;

/// Tries the candidates on the `trial_places`, each compared in up to `trial_frames` frames.
Trials try_out(const TrialRoom& room, const TryOn& try_on);

inline constexpr std::size_t trial_frames = 12;  ///< for speed; not swept

}  // namespace kinemend::fill
