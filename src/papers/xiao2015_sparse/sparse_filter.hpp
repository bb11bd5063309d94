// Filters the points of a body by the dictionaries of its parts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend {

enum class SparseLoss : std::uint8_t {
  mixed,     ///< eq. 5, then eq. 4 without the samples far from its fit
  squares,   ///< eq. 4
  absolute,  ///< eq. 5
};

struct SparseSettings {
  SparseLoss loss = SparseLoss::mixed;
  /// Weight of sparsity, relative to the largest correlation of noise with the atoms.
  double lambda = 0.1;
  double outlier_deviations = 4.5;
  std::size_t hops = 4;     ///< windows over a frame
  double tolerance = 1e-2;  ///< of the solvers
  bool exact = false;       ///< the paper's solver for both problems, to the gap that it proves
};

struct SparseTake {
  const PoseMatrix& positions;  ///< F x 3 P, as measured; gaps bridged
  const PoseMatrix& guide;      ///< F x 3 P, the same without noise, for local coordinates
  std::span<const std::uint8_t> observed;  ///< F x 3 P; empty: all
  std::span<const double> noise;           ///< 3 P, positive: standard deviations
  double rate_hz = 120;
  /// P; empty: all. Poselets without a wanted point are not solved: points that no other poselet
  /// has keep the guide's positions.
  std::span<const std::uint8_t> wanted = {};
};

/// The take after the dictionaries, F x 3 P: its poses in local coordinates, cut into windows of
/// each poselet, are coded by eq. 4 or 5, rebuilt, and averaged over windows and poselets. Rows are
/// weighted by their noise, those of missing samples by 0. Lambda is `settings.lambda` times the
/// expected largest of K correlations with noise alone, sqrt(2 log K). In units of the noise both
/// problems are free of scale.
PoseMatrix sparse_filter(const SparsePrior& prior, const SparseTake& take,
                         const SparseSettings& settings = {});

/// The dictionary of windows of `frames` frames at a take's rate: atoms as their cosines over the
/// window, resampled, of length 1.
sparse::Dictionary dictionary_at_rate(const SparsePoselet& poselet, std::size_t window_frames,
                                      std::size_t frames);

}  // namespace kinemend
