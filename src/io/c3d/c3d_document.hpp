// Keeps a C3D file as it was read so that it can be written back in its own layout, and decodes its
// samples: positions, residuals and cameras of points, and analog samples, for example from force
// plates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/c3d/c3d_layout.hpp"
#include "io/c3d/c3d_parameters.hpp"
#include "io/table/marker_zeros.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"
#include "motion/conversions.hpp"

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

/// The fourth word of a point. If it is below zero, or 65,535 from writers without signs, the point
/// is missing. Else its low byte times the scale is the residual, and each higher bit is a camera
/// that saw the point.
constexpr std::int32_t missing_point_word = -1;

/// The samples of some frames, frame by frame.
struct C3dPoints {
  std::vector<Vec3> positions;  ///< zero if missing
  std::vector<std::uint8_t> observed;
  std::vector<float> residuals;  ///< file units; -1 if missing

  void resize(std::size_t count);
};

/// Counts of the decoder.
struct C3dPointCounts {
  std::size_t not_finite = 0;          ///< samples that are not finite and not marked as missing
  std::size_t missing_not_finite = 0;  ///< samples that are not finite and marked as missing
  std::size_t zeros = 0;               ///< samples at the origin that are not marked as missing
  std::uint32_t cameras = 0;           ///< bits of all cameras that saw a point
};

/// Decodes the points of a file's data section, in which frames are `layout.frame_bytes()` apart.
class C3dPointDecoder {
 public:
  C3dPointDecoder(C3dProcessor processor, const C3dLayout& layout)
      : processor_(processor), layout_(layout) {}

  /// Decodes `count` frames that start at `frames` into `out`, which must be large enough.
  void decode(const char* frames, std::size_t count, C3dPoints& out);
  const C3dPointCounts& counts() const { return counts_; }

 private:
  C3dProcessor processor_;
  C3dLayout layout_;
  C3dPointCounts counts_;
};

/// Returns the fourth word of an observed sample for a residual in file units. `before` is the old
/// word, `missing_point_word` if the sample was missing. The old word is kept if it already has
/// this residual. A residual of 0, which means filled or filtered, removes the cameras.
std::int32_t c3d_point_word(float residual, double scale, std::int32_t before);

/// Returns how many frames of this layout form a block that stays in the processor's cache.
std::size_t c3d_block_frames(const C3dLayout& layout);

/// The frames of a document, decoded and repaired as its reader did, a block at a time.
class C3dSourceFrames {
 public:
  explicit C3dSourceFrames(const C3dDocument& document);

  /// Moves to the next block; false after the last.
  bool next();

  std::size_t first() const { return first_; }  ///< frame of the take
  std::size_t count() const { return count_; }
  const C3dPoints& points() const { return points_; }
  /// Returns the offset of a frame of the block in the document's bytes.
  std::size_t frame_begin(std::size_t block_frame) const;
  /// Returns the fourth word of a sample; `missing_point_word` if it is missing.
  std::int32_t word(std::size_t block_frame, std::size_t point) const;

 private:
  void hide_zero_gaps();

  const C3dDocument& document_;
  C3dPointDecoder decoder_;
  C3dPoints points_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::vector<std::uint8_t> hidden_;  // F x M, 1 in a zero gap; empty without zero gaps
};

/// Reads the analog samples of a file (force plates, muscle sensors and so on): `(stored - OFFSET)
/// * SCALE * GEN_SCALE`, where both stored integers and OFFSET are unsigned if ANALOG:FORMAT says
/// UNSIGNED.
class C3dAnalogDecoder {
 public:
  explicit C3dAnalogDecoder(const C3dDocument& document);

  /// Reads the stored values of one frame: instant by instant, all channels of each.
  void stored(std::size_t frame, std::vector<double>& values) const;
  /// Converts a stored number to a value in the unit of its channel.
  double value(double stored, std::size_t channel) const {
    return (stored - offsets_[channel]) * scales_[channel];
  }

 private:
  const C3dDocument& document_;
  bool is_unsigned_;
  std::vector<double> offsets_;
  std::vector<double> scales_;
};

}  // namespace kinemend
