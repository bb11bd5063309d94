// Reads and writes mapping files, which state the take's name for each joint or marker of a model,
// applies such a map, checks a layout against a take, and lists unmatched tracks and names.
#include "body/body_correspondence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/cells.hpp"
#include "body/body_names.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend::representation {

namespace {

// Finds a name exactly, or ignoring case and prefixes.
std::int32_t find_name(const std::vector<std::string>& names, std::string_view name) {
  const auto same = std::find(names.begin(), names.end(), name);
  if (same != names.end()) return static_cast<std::int32_t>(same - names.begin());
  const std::string plain = plain_name(name);
  const auto alike = std::find_if(names.begin(), names.end(), [&](const std::string& other) {
    return !plain.empty() && plain_name(other) == plain;
  });
  return alike == names.end() ? -1 : static_cast<std::int32_t>(alike - names.begin());
}

std::string_view noun(const BodyLayout& layout) {
  return layout.kind == BodyKind::joints ? "joint" : "marker";
}

}  // namespace

MappedTracks mapped_tracks(const BodyLayout& layout, const std::vector<std::string>& names,
                           const NameMap& map) {
  MappedTracks mapped{std::vector<std::int32_t>(layout.track_count(), -1),
                      std::vector<std::uint8_t>(layout.track_count()),
                      std::vector<std::uint8_t>(names.size())};
  for (const auto& [model_name, take_name] : map) {
    const std::int32_t track = find_name(layout.names, model_name);
    if (track < 0) {
      throw Error(ErrorKind::usage,
                  fmt::format("names: the model has no {} \"{}\" (it knows {})", noun(layout),
                              printable_name(model_name), fmt::join(layout.names, ", ")));
    }
    mapped.settled[static_cast<std::size_t>(track)] = 1;
    if (take_name.empty()) continue;
    const std::int32_t index = find_name(names, take_name);
    if (index < 0) {
      throw Error(ErrorKind::usage,
                  fmt::format("names: the take has no {} \"{}\" (it has {})", noun(layout),
                              printable_name(take_name), fmt::join(names, ", ")));
    }
    mapped.tracks[static_cast<std::size_t>(track)] = index;
    mapped.used[static_cast<std::size_t>(index)] = 1;
  }
  return mapped;
}

void check_kind(const BodyLayout& layout, BodyKind kind) {
  if (layout.kind == kind) return;
  throw Error(ErrorKind::usage, fmt::format("the model knows {}, the take holds {}",
                                            to_string(layout.kind), to_string(kind)));
}

std::vector<std::uint8_t> possible_tracks(const Take& take) {
  std::vector<std::uint8_t> possible(take.has_joints() ? take.joint_count() : take.marker_count());
  for (std::size_t n = 0; n < possible.size(); ++n) {
    const bool can =
        take.has_joints() ? take.skeleton.rotation_order(n).count > 0 : take.holds_positions(n);
    possible[n] = can ? 1 : 0;
  }
  return possible;
}

void list_unmatched(const BodyLayout& layout, const std::vector<std::string>& names,
                    const std::vector<std::uint8_t>& known, BodyMatch& match) {
  std::vector<std::uint8_t> matched(names.size());
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    if (match.tracks[i] < 0)
      match.missing.push_back(layout.names[i]);
    else
      matched[static_cast<std::size_t>(match.tracks[i])] = 1;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (known[i] != 0 && matched[i] == 0) match.unknown.push_back(names[i]);
  }
  const std::size_t found = layout.track_count() - match.missing.size();
  const bool rootless = layout.kind == BodyKind::joints && match.tracks[0] < 0;
  if (2 * found >= layout.track_count() && !rootless) return;
  throw Error(ErrorKind::usage,
              fmt::format("the model knows {} {}s, of which the take lacks {}: {}; a file of names "
                          "can say which of the take's are the same (kinemend models --map)",
                          layout.track_count(), noun(layout), match.missing.size(),
                          fmt::join(match.missing, ", ")));
}

}  // namespace kinemend::representation

namespace kinemend {

namespace {

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
  text = without_byte_order_mark(text);
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
