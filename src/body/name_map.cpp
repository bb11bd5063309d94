// Reads and writes mapping files, which give the take's name for each joint or marker of a model.
#include <fmt/format.h>

#include <algorithm>

#include "body/body_correspondence.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/text.hpp"

namespace kinemend {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view space = " \t\r";
  const std::size_t first = text.find_first_not_of(space);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

[[noreturn]] void refuse(std::string_view name, std::size_t line, std::string_view message) {
  throw Error(ErrorKind::usage, fmt::format("{}:{}: {}", name, line, message));
}

void read_line(std::string_view line, std::size_t number, std::string_view name, NameMap& map) {
  const std::size_t comma = line.find_first_of(",=");
  if (comma == line.npos)
    refuse(name, number,
           fmt::format("expected \"model name,name in the take\", found \"{}\"",
                       printable_name(line)));
  const std::string model(trimmed(line.substr(0, comma))), take(trimmed(line.substr(comma + 1)));
  if (model.empty()) refuse(name, number, "expected a name of the model before the comma");
  if (take.find_first_of(",=") != take.npos)
    refuse(name, number,
           fmt::format("expected one name in the take, found \"{}\"", printable_name(take)));
  const auto known = map.find(model);
  if (known != map.end())
    refuse(name, number, fmt::format("\"{}\" is already in a line above", printable_name(model)));
  for (const auto& [other, used] : map) {
    if (!take.empty() && used == take)
      refuse(name, number,
             fmt::format("\"{}\" is already \"{}\"", printable_name(take), printable_name(other)));
  }
  map.emplace(model, take);
}

std::string mapping_text(const BodyLayout& layout, const std::vector<std::string>& names,
                         const std::vector<std::int32_t>& tracks,
                         std::vector<std::uint8_t> others) {
  std::string text = "# name in the model,name in the take\n";
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    const bool found = tracks[i] >= 0;
    text += fmt::format("{},{}\n", layout.names[i],
                        found ? names[static_cast<std::size_t>(tracks[i])] : "");
    if (found) others[static_cast<std::size_t>(tracks[i])] = 0;
  }
  text += "# in the take, and not in the model:\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (others[i] != 0) text += fmt::format("# {}\n", names[i]);
  }
  return text;
}

}  // namespace

NameMap parse_name_map(std::string_view text, std::string_view name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  NameMap map;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty()) read_line(line, number, name, map);
  }
  return map;
}

std::string name_map_text(const BodyLayout& layout, const Take& take, const NameMap& names) {
  using namespace representation;
  check_kind(layout, take.has_joints() ? BodyKind::joints : BodyKind::markers);
  return mapping_text(
      layout, take.has_joints() ? take.skeleton.names : take.names,
      take.has_joints() ? match_joints(layout, take, names) : match_markers(layout, take, names),
      possible_tracks(take));
}

}  // namespace kinemend
