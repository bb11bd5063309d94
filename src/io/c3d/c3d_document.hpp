// Keeps a C3D file as it was read so that it can be written back in its own layout.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/c3d/c3d_layout.hpp"
#include "io/c3d/c3d_parameters.hpp"
#include "io/table/marker_zeros.hpp"
#include "kinemend/take.hpp"
#include "motion/take_change.hpp"

namespace kinemend {

/// A C3D file as it was read. The bytes hold every sample, so beside them only what tells where
/// they stand is kept, and what the clip was made with: a rewrite decodes the samples again, which
/// is quicker than to store them twice.
struct C3dDocument : FollowingDocument, std::enable_shared_from_this<C3dDocument> {
  std::string bytes;
  C3dProcessor processor = C3dProcessor::intel;
  C3dLayout layout;
  C3dParameters parameters;
  std::vector<ZeroGap> zero_gaps;
  std::vector<std::string> names;  ///< of the clip, as are the next three
  std::string unit;
  double frame_rate_hz = 0;
  std::vector<MarkerEvent> events;
  /// False where an event was left out because its time is not finite: the file is then written
  /// anew.
  bool event_times_finite = true;

  /// What belongs to the points follows them when a file is written.
  std::shared_ptr<const SourceDocument> after(const TakeChange& further) const override;
};

/// A C3D file whose take was converted since it was read.
struct ConvertedC3d : FollowingDocument {
  std::shared_ptr<const C3dDocument> original;
  TakeChange change;

  std::shared_ptr<const SourceDocument> after(const TakeChange& further) const override;
};

/// Where a clip comes from, when it is from a C3D file.
struct C3dOrigin {
  const C3dDocument* document = nullptr;  ///< null: from none
  bool converted = false;
  TakeChange change;
};
C3dOrigin c3d_origin(const SourceInfo& source);

}  // namespace kinemend
