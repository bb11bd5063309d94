// Which joints or markers of a take are the tracks of a layout.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/experimental/body.hpp"

namespace kinemend::representation {

/// Which of `names` (of a take) are the tracks of a layout, as a name map says.
struct MappedTracks {
  std::vector<std::int32_t> tracks;   ///< N, -1: not mapped
  std::vector<std::uint8_t> settled;  ///< N, 1 where the map speaks of the track
  std::vector<std::uint8_t> used;     ///< one a name of the take
};
/// Errors: `ErrorKind::usage` for a name that is in neither.
MappedTracks mapped_tracks(const BodyLayout& layout, const std::vector<std::string>& names,
                           const NameMap& map);

/// Parts of joints by name, then by topology; -1: none.
std::vector<std::int32_t> match_joints(const BodyLayout& layout, const Take& clip,
                                       const NameMap& map);
/// Parts of markers by name.
std::vector<std::int32_t> match_markers(const BodyLayout& layout, const Take& clip,
                                        const NameMap& map);

/// `match_body` of a take of one kind.
BodyMatch match_body_of_joints(const BodyLayout& layout, const Take& take, const NameMap& names);
BodyMatch match_body_of_markers(const BodyLayout& layout, const Take& take, const NameMap& names);

/// Errors: `ErrorKind::usage` when a layout is of the other kind.
void check_kind(const BodyLayout& layout, BodyKind kind);

/// 1 for joints that can turn, and for markers that are positions.
std::vector<std::uint8_t> possible_tracks(const Take& take);

/// Fills `match.missing` and `match.unknown`. `known`: 1 for the names of the take that may be
/// tracks. Errors: `ErrorKind::usage` when less than half of the tracks are found.
void list_unmatched(const BodyLayout& layout, const std::vector<std::string>& names,
                    const std::vector<std::uint8_t>& known, BodyMatch& match);

}  // namespace kinemend::representation
