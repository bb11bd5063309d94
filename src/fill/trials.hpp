// Tries the ways to fill a gap on spans of the take that were measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fill/judgement.hpp"
#include "fill/track.hpp"

namespace kinemend::fill {

/// The frames that a gap is filled from: a minute on either side, or ten times its length where
/// that is more, so that the cost of a gap does not grow with the take.
FrameSpan evidence_around(FrameSpan gap, std::size_t frames, double frame_rate_hz);

/// Spans as long as the gap in which all is seen, with a frame on either side: the six nearest to
/// the gap, half a length apart at least, for what moves there; and three evenly over the frames,
/// for what the nearest do not show. Shorter ones (half, a quarter, ...) where there is no room for
/// three; none where there is no room at all. `usable[i]` is about frame `first_frame` + i; 0 in
/// the gap itself.
std::vector<FrameSpan> trial_places(std::span<const std::uint8_t> usable, std::size_t first_frame,
                                    FrameSpan gap);

/// A gap of a take, and the frames around it in which it can be tried.
struct TrialRoom {
  FrameSpan gap;
  TakeEnds ends;                     ///< where the gap starts or ends the take
  FrameSpan evidence;                ///< `evidence_around`
  std::vector<std::uint8_t> usable;  ///< of its frames, as `trial_places` takes them; none at first
};
TrialRoom room_around(FrameSpan gap, std::size_t frames, double frame_rate_hz);

/// What the candidates make of a span as if it were a gap, in these frames of it: for each
/// candidate the offsets from the truth.
using TryOn = std::function<Proposals(FrameSpan span, const std::vector<std::size_t>& frames)>;

/// Has the candidates tried on the `trial_places`, each compared in up to `trial_frames` frames.
Trials try_out(const TrialRoom& room, const TryOn& try_on);

inline constexpr std::size_t trial_frames = 12;  ///< for speed; not swept

}  // namespace kinemend::fill
