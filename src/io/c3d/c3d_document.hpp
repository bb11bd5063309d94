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

/// A C3D file as it was read. The bytes hold every sample, so only their places and the settings of
/// the reader are stored with them: a rewrite decodes the samples again, which is faster than
/// storing them twice.
struct C3dDocument : FollowingDocument, std::enable_shared_from_this<C3dDocument> {
  std::string bytes;
  C3dProcessor processor = C3dProcessor::intel;
  C3dLayout layout;
  C3dParameters parameters;
  std::vector<ZeroGap> zero_gaps;
  std::vector<std::string> names;  ///< of the clip, like the next three members
  std::string unit;
  double frame_rate_hz = 0;
  std::vector<MarkerEvent> events;
  /// False if an event was left out because its time is not finite; a new file is then written.
  bool event_times_finite = true;

  /// Data that belongs to the points is converted with them when a file is written.
  std::shared_ptr<const SourceDocument> after(const TakeChange& further) const override;
};

/// A C3D file whose take was converted after reading.
struct ConvertedC3d : FollowingDocument {
  std::shared_ptr<const C3dDocument> original;
  TakeChange change;

  std::shared_ptr<const SourceDocument> after(const TakeChange& further) const override;
};

/// The C3D file that a clip comes from.
struct C3dOrigin {
  const C3dDocument* document = nullptr;  ///< null: the clip does not come from a C3D file
  bool converted = false;
  TakeChange change;
};
C3dOrigin c3d_origin(const SourceInfo& source);

}  // namespace kinemend
