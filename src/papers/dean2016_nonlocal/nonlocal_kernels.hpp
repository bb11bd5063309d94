// The vectorised loops of the non-local means. All of them work on whole vectors: arrays and tracks
// have `lane_room` more elements at the end, whose content is unused.
#pragma once

#include <cstddef>
#include <span>

#include "cleaner/pieces.hpp"

namespace kinemend {

/// sums[i] += |Log(q_{a+i}^-1 q_{b+i})|^2 for i < count.
void add_squared_angles(const RotationTrack& track, std::size_t a, std::size_t b, std::size_t count,
                        double* sums);
/// The same over pairs with both samples observed; pairs[i] += 1 for each of those.
void add_observed_angles(const RotationTrack& track, const double* observed, std::size_t a,
                         std::size_t b, std::size_t count, double* sums, double* pairs);

/// Sums over points of their moves between two frames.
struct PointSums {
  double* squares;  ///< |x_b - x_a|^2
  double* x;        ///< x_b - x_a
  double* y;
  double* z;
  double* pairs;  ///< points with both samples observed
};
/// Adds the move of one point for frames a + i and b + i, i < count. `observed`: nullptr: all are.
void add_point_moves(const VectorTrack& track, const double* observed, std::size_t a, std::size_t b,
                     std::size_t count, const PointSums& sums);

/// values[i] = exp(-scale * max(0, values[i] - floors[i])) for i < count.
void decay(double scale, const double* floors, std::size_t count, double* values);

/// One neighbour of each of some consecutive frames: its offset, and its weights.
struct Neighbour {
  std::ptrdiff_t offset;
  const double* weights;
};

/// out_i = sum_n w_n Log(x_i^-1 x_{i+n}) / (1 + sum_n w_n) for the `count` frames from `first` on.
/// `observed` multiplies the weights, the frame's own (1) included; nullptr: all are 1. The track
/// has `lane_room` frames on either side of those with weight. Neighbours at +n and -n that
/// follow each other in the list cost little more than one.
void mean_turn(const RotationTrack& track, const double* observed, std::size_t first,
               std::size_t count, std::span<const Neighbour> neighbours, VectorTrack& out);
/// The same for positions: out_i = sum_n w_n (x_{i+n} - x_i) / (1 + sum_n w_n).
void mean_move(const VectorTrack& track, std::size_t first, std::size_t count,
               std::span<const Neighbour> neighbours, VectorTrack& out);
/// The same for one point of a body that moved by `travels[n]` to neighbour n: out_i = sum_n w_n
/// (x_{i+n} - x_i - travels_{n,i}) / (1 + sum_n w_n). `observed` multiplies the weights.
void mean_point_move(const VectorTrack& track, const double* observed, std::size_t first,
                     std::size_t count, std::span<const Neighbour> neighbours,
                     std::span<const VectorTrack> travels, VectorTrack& out);

}  // namespace kinemend
