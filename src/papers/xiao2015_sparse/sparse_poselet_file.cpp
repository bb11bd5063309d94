// Reads a file that names the parts of a body.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "kinemend/error.hpp"
#include "kinemend/experimental/text.hpp"
#include "motion/name_pattern.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend {

namespace {

// Chosen by hand.
constexpr std::size_t most_poselets = 100;  // the limit of a model file

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view space = " \t\r";
  const std::size_t first = text.find_first_not_of(space);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

// A line of the file, with its place for errors.
struct Line {
  std::string_view file, text;
  std::size_t number;

  [[noreturn]] void refuse(const std::string& message) const {
    throw Error(ErrorKind::usage, fmt::format("{}:{}: {}", file, number, message));
  }
};

// Marks the points that a name matches: its tracks, and the free ends on them.
void mark_points(const Line& line, std::string_view name, const BodyLayout& layout,
                 const SparsePoints& points, std::vector<std::uint8_t>& marks) {
  if (name.empty()) line.refuse("a name is missing between two commas");
  const std::vector<std::uint8_t> meant = names_meant(layout.names, std::string(name));
  if (std::find(meant.begin(), meant.end(), 1) == meant.end()) {
    line.refuse(fmt::format("no {} is named \"{}\"",
                            points.kind == BodyKind::joints ? "joint" : "marker",
                            printable_name(name)));
  }
  for (std::size_t p = 0; p < points.count(); ++p) {
    const std::size_t track = p < meant.size() ? p : static_cast<std::size_t>(points.parents[p]);
    if (meant[track] != 0) marks[p] = 1;
  }
}

SparsePoselet poselet_of_line(const Line& line, const BodyLayout& layout,
                              const SparsePoints& points) {
  const std::size_t colon = line.text.find(':');
  if (colon == line.text.npos)
    line.refuse(fmt::format("expected \"poselet: name, name, ...\", found \"{}\"",
                            printable_name(line.text)));
  SparsePoselet poselet;
  poselet.name = trimmed(line.text.substr(0, colon));
  if (poselet.name.empty()) line.refuse("expected the poselet's name before the colon");
  std::string_view rest = trimmed(line.text.substr(colon + 1));
  if (rest.empty())
    line.refuse(fmt::format("poselet \"{}\" is empty", printable_name(poselet.name)));
  std::vector<std::uint8_t> marks(points.count(), 0);
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    mark_points(line, trimmed(rest.substr(0, comma)), layout, points, marks);
    more = comma != rest.npos;
    if (more) rest.remove_prefix(comma + 1);
  }
  for (std::size_t p = 0; p < marks.size(); ++p) {
    if (marks[p] != 0) poselet.points.push_back(static_cast<std::int32_t>(p));
  }
  return poselet;
}

// The tracks that are in no poselet.
std::vector<std::string> left_over(const std::vector<SparsePoselet>& poselets,
                                   const BodyLayout& layout) {
  std::vector<std::uint8_t> used(layout.track_count(), 0);
  for (const SparsePoselet& poselet : poselets) {
    for (const std::int32_t point : poselet.points) {
      if (static_cast<std::size_t>(point) < used.size()) used[static_cast<std::size_t>(point)] = 1;
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) names.push_back(layout.names[i]);
  }
  return names;
}

}  // namespace

std::vector<SparsePoselet> parse_poselets(std::string_view text, std::string_view name,
                                          const BodyLayout& layout, const SparsePoints& points) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<SparsePoselet> poselets;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view own = text.substr(0, end);
    const Line line{name, trimmed(own.substr(0, own.find('#'))), number};
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.text.empty()) continue;
    SparsePoselet poselet = poselet_of_line(line, layout, points);
    for (const SparsePoselet& other : poselets) {
      if (other.name == poselet.name)
        line.refuse(
            fmt::format("poselet \"{}\" is already in a line above", printable_name(other.name)));
    }
    if (poselets.size() == most_poselets)
      line.refuse(fmt::format("more than {} poselets", most_poselets));
    poselets.push_back(std::move(poselet));
  }
  if (poselets.empty())
    throw Error(ErrorKind::usage, fmt::format("{}: there are no poselets in it", name));
  if (const std::vector<std::string> names = left_over(poselets, layout); !names.empty()) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: in no poselet: {}", name, fmt::join(names, ", ")));
  }
  return poselets;
}

}  // namespace kinemend
