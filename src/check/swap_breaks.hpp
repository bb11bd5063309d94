// Finds places where two markers may have exchanged their labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::check {

/// A place where a track departs from its extrapolation, or is missing for a while.
struct Break {
  std::size_t marker = 0;
  std::size_t before = 0;  ///< last frame seen
  std::size_t after = 0;   ///< next frame seen
  double mismatch = 0;     ///< distance of the extrapolated sides, file units
};

/// Returns the distance between the track of `from` up to frame `before` and that of `to` from
/// frame `after` on, both extrapolated to the middle with their velocities there. For successive
/// frames of one track it is about half the third difference.
double side_mismatch(const Take& clip, std::size_t from, std::size_t before, std::size_t to,
                     std::size_t after);

/// Returns all gaps between samples, and the successive samples whose mismatch is 6 times the usual
/// one of their marker, by frame `before`. `markers`: those examined.
std::vector<Break> find_breaks(const Take& clip, const std::vector<std::size_t>& markers);

/// Two breaks at which the markers exchange their labels: each track continues in the other's.
struct Exchange {
  std::size_t first_marker = 0;  ///< the lower one
  std::size_t second_marker = 0;
  std::size_t last_before = 0;  ///< last frame in which either is seen before the exchange
  std::size_t first_after = 0;  ///< first frame in which either is seen after it
  std::size_t longest_gap = 0;  ///< frames missing between the sides of either
  double doubt = 0;             ///< mismatch with labels exchanged over that without
};

/// Returns the exchanges by frame. No break is in two of them; the least doubtful ones are kept.
std::vector<Exchange> find_exchanges(const Take& clip, const std::vector<Break>& breaks);

/// Evidence on an exchange from distances to nearby markers: their mean departure from the usual
/// distances in the frames in question, as labelled and with labels exchanged.
struct NeighbourVerdict {
  double as_labelled = 0;
  double exchanged = 0;
  bool known = false;  ///< false if no neighbour was seen
};
/// `swapped[f]`: 1 in the frames in question, 0 in those that give the usual distances.
NeighbourVerdict ask_neighbours(const Take& clip, const std::vector<std::size_t>& markers,
                                std::size_t first_marker, std::size_t second_marker,
                                const std::vector<std::uint8_t>& swapped);

}  // namespace kinemend::check
