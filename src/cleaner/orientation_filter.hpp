// Linear filters on orientations, built from the increments between neighbouring frames.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cleaner/pieces.hpp"

/// The construction of Lee & Shin (2002), in the form of Courty (2008), eq. 2-3: a filter with the
/// mask m_-k .. m_k (sum 1) acts on orientations as
///   H(q_i) = q_i Exp(sum_{r=-k}^{k-1} b_r w_{i+r}),   w_i = Log(q_i^-1 q_{i+1}),
///   b_r = sum_{j=r+1}^{k} m_j for r >= 0,   b_r = -sum_{j=-k}^{r} m_j for r < 0.
/// (Courty's eq. 3 leaves out the minus sign, without which the filter is no average.) On vectors,
/// with differences for w and sums for products, this is sum_j m_j x_{i+j}.
namespace kinemend {

/// out_i = Log(q_i^-1 q_{i+1}) for i < frames - 1; out_{frames-1} = 0.
VectorTrack increments(const RotationTrack& rotations);
/// out_i = x_{i+1} - x_i for i < frames - 1; out_{frames-1} = 0.
VectorTrack increments(const VectorTrack& positions);

/// q_i = q_i Exp(v_i).
void turn(RotationTrack& rotations, const VectorTrack& turns);
/// x_i = x_i + v_i.
void turn(VectorTrack& positions, const VectorTrack& moves);

/// b_-k .. b_{k-1} of the mask m_-k .. m_k: 2 k values of 2 k + 1 values.
std::vector<double> increment_weights(std::span<const double> mask);

/// sum_{r=-k}^{k-1} b_r w_{i+r} for every i, with w = 0 beyond both ends.
VectorTrack weigh_increments(const VectorTrack& increments, std::span<const double> weights);

}  // namespace kinemend
