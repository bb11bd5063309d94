// The document of a page: its program, and the parts of data that it reads.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinemend::page {

extern const std::string_view script;
extern const std::string_view style;

/// Data of the page: the name of an element and what it holds, before it is deflated.
using Parts = std::vector<std::pair<std::string_view, std::string>>;

/// Errors: `ErrorKind::usage` for a build without the page.
void check_is_built();
/// The parts alone, for a page that is open already: a line of JSON with the name and the size in
/// bytes of each, [["report",1234],...], then their bytes as they are. Whoever waits for them is on
/// the same machine, so that packing them would only take time.
std::string joined(const Parts& parts);
/// `summary` is what a browser without scripts shows.
/// `is_served`: the page may ask the server that it came from.
std::string document(std::string_view title, std::string_view summary, const Parts& parts,
                     bool is_served = false);

}  // namespace kinemend::page
