// The prior of the method `sparse` (Xiao et al. 2015) describes windows of the parts of a body as
// sums of few atoms of a dictionary. `lab/training/ksvd.hpp` learns dictionaries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "papers/xiao2015_sparse/sparse_points.hpp"

namespace kinemend::sparse {

/// K atoms of n rows each, one after the other.
struct Dictionary {
  std::size_t rows = 0;       ///< n
  std::size_t atoms = 0;      ///< K
  std::vector<float> values;  ///< K x n

  std::span<float> atom(std::size_t k) { return {values.data() + k * rows, rows}; }
  std::span<const float> atom(std::size_t k) const { return {values.data() + k * rows, rows}; }
};

}  // namespace kinemend::sparse

namespace kinemend {

/// A part of the body and the dictionary of its motion.
struct SparsePoselet {
  std::string name;
  std::vector<std::int32_t> points;  ///< n of the body's; a point may be in several poselets
  std::vector<float> mean;           ///< 3 n: mean position in local coordinates, body heights
  /// Windows less the mean, one frame after the other: M x 3 n rows.
  sparse::Dictionary dictionary;

  std::size_t channels() const noexcept { return 3 * points.size(); }
};

struct SparsePrior {
  double rate_hz = 60;
  std::size_t window_frames = 15;  ///< M
  SparsePoints points;
  LocalPoints local;
  std::vector<SparsePoselet> poselets;
};

/// Convert to and from tensors of the model file; atoms in 16 bits. Errors:
/// `ErrorKind::unreadable_input` naming the inconsistent tensor.
void store_sparse_prior(const SparsePrior& prior, Model& model);
SparsePrior sparse_prior_of(const Model& model);

}  // namespace kinemend
