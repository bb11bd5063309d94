#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/marker_clip.hpp"

// Spans of missing samples.
namespace kinemend {

/// Missing samples of one joint or marker, none observed between.
struct Gap {
  std::size_t track = 0;  ///< joint or marker; of positions 0 for joint 0, k + 1 for translated
                          ///< joint k
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive

  std::size_t length() const noexcept { return last_frame - first_frame + 1; }
  friend bool operator==(const Gap&, const Gap&) = default;
};

/// The spans that are not observed, by track, then frame. Of markers only those that are positions.
std::vector<Gap> find_gaps(const Clip& clip);
std::vector<Gap> find_gaps(const MarkerClip& clip);
/// The same of `Clip::observed_positions`.
std::vector<Gap> find_position_gaps(const Clip& clip);

/// A gap as a side file states it, for formats that cannot hold one.
struct NamedGap {
  std::string name;  ///< of a joint or marker, or a shell pattern; `*` for all
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive, counted from 0
};

/// Marks the samples as not observed; what stands there is no longer used by anything. A joint's
/// gap is one of its rotation and, where it has position channels, of its position too. Errors:
/// `ErrorKind::usage` for a name or a frame that the take does not have.
void mark_gaps(Clip& clip, std::span<const NamedGap> gaps);
void mark_gaps(MarkerClip& clip, std::span<const NamedGap> gaps);

/// The side file: lines `name,first,last` with frames counted from 1, inclusive; an optional
/// heading line, `#` comments, blank lines and quoted names are understood. `name` stands in
/// messages. Errors: `unreadable_input` with the line.
std::vector<NamedGap> parse_gaps(std::string_view text, std::string_view name);
std::string gaps_text(std::span<const NamedGap> gaps);

}  // namespace kinemend
