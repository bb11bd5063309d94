// Finds the points of a body, and the parts whose motion the method `sparse` learns (Xiao et al.
// 2015, section 3.1).
#pragma once

#include <string_view>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/rotation.hpp"
#include "papers/xiao2015_sparse/sparse_points.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend {

/// Averages the vectors from joints to their children over takes; one frame of each is enough.
class SparsePointsBuilder {
 public:
  explicit SparsePointsBuilder(const BodyLayout& layout);
  void add(const Take& clip);
  SparsePoints finish() const;

 private:
  const BodyLayout& layout_;
  std::vector<Vec3> sums_;
  std::vector<double> counts_;
};
/// The points of a marker layout, which determines them fully.
SparsePoints marker_points(const BodyLayout& layout);

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

}  // namespace kinemend
