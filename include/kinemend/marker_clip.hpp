#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// A moment that the file names: a heel strike, a foot off.
struct MarkerEvent {
  std::string label;    ///< "Foot Strike"
  std::string context;  ///< "Left"; often empty
  double time_s = 0;    ///< from frame 1 of the trial, which need not be the first frame stored
};

/// A motion of M markers in F frames, frame-major.
struct MarkerClip {
  std::vector<std::string> names;  ///< M, as the file spells them; may repeat or be empty
  double frame_rate_hz = 0;
  std::int64_t first_frame = 1;  ///< the number that the file gives to frame 0
  std::vector<Vec3> positions;   ///< F x M, file units; zero and without meaning where missing
  std::vector<std::uint8_t> observed;  ///< F x M, 1 where there is a position
  std::vector<float> residuals;        ///< F x M, file units; -1 where missing, 0 where a sample
                                       ///< was filled; empty where the format has none
  std::vector<std::uint8_t>
      is_position;   ///< M, 0 for angles, forces, moments and powers that a
                     ///< file keeps among its points; nothing changes these; empty: all are
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
  bool holds_positions(std::size_t marker) const {
    return is_position.empty() || is_position[marker] != 0;
  }
  double duration_s() const noexcept {
    return frame_rate_hz > 0 ? static_cast<double>(frame_count()) / frame_rate_hz : 0.0;
  }
  /// Index of the first marker of that name, with or without its subject (`Ann:LASI` is found as
  /// `LASI` where that is no other marker's whole name); -1 when there is none.
  std::int32_t find(std::string_view name) const noexcept;

  /// The rules: a finite positive rate; arrays of the lengths above; finite positions where
  /// observed. Errors: `ErrorKind::usage` naming the first frame and marker that breaks a rule.
  void validate() const;
};

/// A clip of `markers` x `frames` missing samples, all of them positions.
MarkerClip make_marker_clip(std::vector<std::string> names, std::size_t frames,
                            double frame_rate_hz);

/// Frames [first, last) as a clip of their own, without its source document.
MarkerClip slice(const MarkerClip& clip, std::size_t first, std::size_t last);

/// Body height of the person whose markers these are, file units, or of what else was captured: 4.2
/// times the lower quartile of the distances between any two markers in a frame, over at most 64
/// frames. It does not depend on place, heading or order, hardly on pose, and outliers, props and a
/// second person count for little; where the unit is known it is no more than 2.2 m. Where no two
/// markers are seen at once: 1.75 m, or 1 where the unit is not known. (CMU 85_02 and
/// 85_12: 1.73, 1.64 m.)
double body_height(const MarkerClip& clip);

/// Metres in a unit by its usual names ("mm", "m", "cm", "in", "inches", ...); 0 for any other.
double metres_per_unit(std::string_view unit);

/// `LASI` of `Ann:LASI`: the name without its subject.
std::string_view without_subject(std::string_view name);

}  // namespace kinemend
