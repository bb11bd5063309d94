// Reads the contents of a C3D file besides its points: facts for people, and events.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/c3d/c3d_document.hpp"
#include "io/c3d/c3d_layout.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Returns "1 channel", "1600 channels": unlike `counted` without marks between the digits.
std::string count_text(std::size_t count, std::string_view word);

/// Returns the encoding: "DEC integers in steps of 0.1", "Intel reals".
std::string c3d_encoding(const C3dDocument& document);

/// Returns the contents of a C3D file besides its points, as text.
std::vector<SourceFact> c3d_facts(const C3dDocument& document, const C3dPointCounts& counts);

/// Header words with its events, numbered from 1.
constexpr std::size_t c3d_event_key_word = 150, c3d_event_count_word = 151,
                      c3d_event_times_word = 153, c3d_event_flags_word = 189,
                      c3d_event_labels_word = 199;
constexpr std::size_t c3d_event_key = 12345, c3d_most_header_events = 18;

/// Returns the events of the group EVENT (some writers use EVENTS), else the header's, in the order
/// of the file.
std::vector<MarkerEvent> read_c3d_events(const C3dSource& source, const C3dHeader& header,
                                         const C3dParameters& parameters);

/// Whether every event time in the file, including the header's, is a finite number.
bool c3d_event_times_are_finite(const C3dSource& source, const C3dHeader& header,
                                const C3dParameters& parameters);

/// Returns `text` if it is UTF-8, else the UTF-8 of the text read as Latin 1.
std::string as_utf8(const std::string& text);

}  // namespace kinemend
