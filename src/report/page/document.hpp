// Builds the document of a page from its program and its parts of data: of a take these are,
// besides its channels, names, skeleton and gaps, the up direction, the floor and the ground
// contacts, and lines between markers.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "feet/body_points.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/take.hpp"
#include "report/page/codec.hpp"

namespace kinemend::page {

extern const std::string_view script;
extern const std::string_view style;

/// The data of the page: the name of each element and its content before deflation.
using Parts = std::vector<std::pair<std::string_view, std::string>>;

/// Throws `ErrorKind::usage` for a build without the page.
void check_is_built();
/// Returns the parts alone, for a page that is already open: a JSON line with the name and size in
/// bytes of each, [["report",1234],...], then their bytes. They are not compressed: the reader is
/// on the same machine, so compression would only cost time.
std::string joined(const Parts& parts);
/// Returns the document. `summary`: shown by a browser without scripts. `is_served`: the page may
/// send requests to its server.
std::string document(std::string_view title, std::string_view summary, const Parts& parts,
                     bool is_served = false);

/// The time of a ground contact.
struct StageContact {
  std::vector<std::size_t> points;  ///< joints, then end sites, or markers, with ground contact
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
  std::string foot;       ///< "left heel"; the name of the foot if its parts are not told apart
  double confidence = 1;  ///< 0 to 1
};

struct Stage {
  feet::Up up;
  double floor = 0;   ///< along `up`, file units
  double height = 0;  ///< of the body, file units; positive
  std::vector<StageContact> contacts;
};

Stage stage_of(const Take& take);
/// Returns the contacts that `clean` used.
std::vector<StageContact> contacts_of(const FeetReport& report, const Take& clip);
/// Returns the contacts that `check` found.
std::vector<StageContact> contacts_of(const FootStands& stands);

using Json = nlohmann::ordered_json;

/// Returns names, skeleton, gaps and stage. Frames count from 0.
Json take_json(const Take& before, const Take* after, const Channels& channels, const Stage& stage);

/// Returns pairs of markers to connect by a line, lower index first, in a fixed order. Markers on
/// one bone keep their distance, and across a joint it changes little: the shortest and steadiest
/// pairs are taken until every group of markers is connected, without a loop. Markers that are too
/// far apart for the body, drift apart, or are rarely observed together are not linked. Uses at
/// most 120 frames. `body_height`: in the clip's unit, above 0.
std::vector<std::array<std::size_t, 2>> marker_links(const Take& clip, double body_height);

}  // namespace kinemend::page
