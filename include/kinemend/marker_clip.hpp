#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// An event that the file names: a heel strike, a foot off.
struct MarkerEvent {
  std::string label;    ///< "Foot Strike"
  std::string context;  ///< "Left"; often empty
  double time_s = 0;    ///< from frame 1 of the trial, which may lie before the first stored frame
};

/// A motion of M points in F frames, frame-major. Most points are markers; `is_position` says
/// which.
struct MarkerClip {
  std::vector<std::string> names;  ///< M, as the file spells them; may repeat or be empty
  double frame_rate_hz = 0;
  std::int64_t first_frame = 1;        ///< the number that the file gives its first frame
  std::vector<Vec3> positions;         ///< F x M, file units; zero where missing
  std::vector<std::uint8_t> observed;  ///< F x M, 1 where there is a position
  std::vector<float> residuals;        ///< F x M, file units; -1 where missing, 0 where a sample
                                       ///< was filled; empty where the format has none
  std::vector<std::uint8_t>
      is_position;   ///< M, 0 for the angles, forces, moments and powers that a C3D file stores
                     ///< among its points; no step changes these; empty: all are positions
  std::string unit;  ///< "mm"; empty where the file does not say
  std::vector<MarkerEvent> events;
  SourceInfo source;

  std::size_t marker_count() const noexcept { return names.size(); }
  std::size_t frame_count() const noexcept {
    return names.empty() ? 0 : positions.size() / names.size();
  }
  Vec3& position(std::size_t frame, std::size_t marker) {
    return positions[frame * names.size() + marker];
  }
  Vec3 position(std::size_t frame, std::size_t marker) const {
    return positions[frame * names.size() + marker];
  }
  bool is_observed(std::size_t frame, std::size_t marker) const {
    return observed[frame * names.size() + marker] != 0;
  }
  /// Whether the point is the position of a marker, and not an angle, force, moment or power.
  /// Everything that counts, cleans, fills or checks markers asks this.
  bool holds_positions(std::size_t marker) const {
    return is_position.empty() || is_position[marker] != 0;
  }
  /// How many of the points are positions: the number of markers to tell a user.
  std::size_t position_count() const noexcept;
  double duration_s() const noexcept {
    return frame_rate_hz > 0 ? static_cast<double>(frame_count()) / frame_rate_hz : 0.0;
  }
  /// Index of the first marker of that name, or -1. The whole name is tried first, then the name
  /// without its subject: `LASI` finds `Ann:LASI`.
  std::int32_t find(std::string_view name) const noexcept;

  /// Checks the rules: a finite positive rate, arrays of the lengths above, and finite positions
  /// where observed. Errors: `ErrorKind::usage` with the first frame and marker that break a rule.
  void validate() const;
};

/// A clip of `frames` frames in which every sample is missing and every point is a position.
MarkerClip make_marker_clip(std::vector<std::string> names, std::size_t frames,
                            double frame_rate_hz);

/// Frames [first, last) as a new clip, without the source document.
MarkerClip slice(const MarkerClip& clip, std::size_t first, std::size_t last);

/// The number that the file gives its first frame: `MarkerClip::first_frame`.
std::int64_t first_frame_number(const MarkerClip& clip);

/// An estimate of the person's height in file units: 4.2 times the lower quartile of the distances
/// between any two markers of a frame, over at most 64 frames. It does not depend on position,
/// heading or the order of the markers; pose, outliers, props and a second person have little
/// effect. Where the unit is known the result is at most 2.2 m. Where no frame has two markers it
/// is 1.75 m, or 1 if the unit is unknown.
double body_height(const MarkerClip& clip);

/// Metres in a unit, by its usual names ("mm", "m", "cm", "in", "inches", ...); 0 for other names.
double metres_per_unit(std::string_view unit);

/// The name without its subject: `LASI` for `Ann:LASI`.
std::string_view without_subject(std::string_view name);

}  // namespace kinemend
