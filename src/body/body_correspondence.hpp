// Finds the joints or markers of a take that are the tracks of a layout.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/body.hpp"

namespace kinemend::representation {

/// The assignment of a take's `names` to the tracks of a layout by a name map.
struct MappedTracks {
  std::vector<std::int32_t> tracks;   ///< N, -1: not mapped
  std::vector<std::uint8_t> settled;  ///< N, 1 if the map mentions the track
  std::vector<std::uint8_t> used;     ///< one for each name of the take
};
/// Throws `ErrorKind::usage` for a name that is in neither the layout nor the take.
MappedTracks mapped_tracks(const BodyLayout& layout, const std::vector<std::string>& names,
                           const NameMap& map);

/// Returns the joint of each track, found by name, then by topology; -1: none.
std::vector<std::int32_t> match_joints(const BodyLayout& layout, const Take& clip,
                                       const NameMap& map);
/// Returns the marker of each track, found by name; -1: none.
std::vector<std::int32_t> match_markers(const BodyLayout& layout, const Take& clip,
                                        const NameMap& map);

/// Implements `match_body` for a take of one kind.
BodyMatch match_body_of_joints(const BodyLayout& layout, const Take& take, const NameMap& names);
BodyMatch match_body_of_markers(const BodyLayout& layout, const Take& take, const NameMap& names);

/// Throws `ErrorKind::usage` if a layout is of the other kind.
void check_kind(const BodyLayout& layout, BodyKind kind);

/// Returns 1 for joints that can turn, and for markers that are positions.
std::vector<std::uint8_t> possible_tracks(const Take& take);

/// Fills `match.missing` and `match.unknown`. `known`: 1 for the names of the take that may be
/// tracks. Throws `ErrorKind::usage` if less than half of the tracks are found.
void list_unmatched(const BodyLayout& layout, const std::vector<std::string>& names,
                    const std::vector<std::uint8_t>& known, BodyMatch& match);

}  // namespace kinemend::representation
