// Builds the document of a page from its program and its parts of data.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

}  // namespace kinemend::page
