// The prior of the method `sparse` (Xiao et al. 2015) describes windows of the parts of a body as
// sums of few atoms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "papers/xiao2015_sparse/dictionary.hpp"
#include "papers/xiao2015_sparse/sparse_points.hpp"

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

/// Torso with head, arms and legs (section 3.1.2), without means and dictionaries, by the names of
/// the tracks and the hierarchy; markers without a known name by their position. Joints that
/// connect arms and legs to the torso are in both. Parts without points are left out; `whole`: one
/// part of all points.
std::vector<SparsePoselet> find_poselets(const BodyLayout& layout, const SparsePoints& points,
                                         bool whole = false);

/// Reads them from a file instead, one per line:
///
///     torso: Hips, Spine*, Neck, Head, *Shoulder    # a comment
///
/// Names of joints or markers, or shell patterns, in any poselet; a free end of a bone belongs to
/// its joint. `name` is the file's, for errors. Errors: `ErrorKind::usage`, `<name>:<line>: ...`,
/// for a malformed line, an empty or repeated poselet, and a name that the body lacks; also, with
/// their names, for tracks that are in no poselet.
std::vector<SparsePoselet> parse_poselets(std::string_view text, std::string_view name,
                                          const BodyLayout& layout, const SparsePoints& points);

/// The points of section 3.1.1, found by name.
LocalPoints find_local_points(const BodyLayout& layout);

/// Convert to and from tensors of the model file; atoms in 16 bits. Errors:
/// `ErrorKind::unreadable_input` naming the inconsistent tensor.
void store_sparse_prior(const SparsePrior& prior, Model& model);
SparsePrior sparse_prior_of(const Model& model);

}  // namespace kinemend
