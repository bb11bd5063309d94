// Writes a skeleton as lines of notes, and reads these lines.
#include "io/table/csv_skeleton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "io/bvh/bvh_hierarchy.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

constexpr std::array<std::string_view, 6> channel_names{"Xposition", "Yposition", "Zposition",
                                                        "Xrotation", "Yrotation", "Zrotation"};

std::string quoted_name(const std::string& name) {
  if (name.find_first_of("\r\n") != name.npos) {
    throw Error(ErrorKind::usage, fmt::format("CSV cannot hold the name {}", quote(name)));
  }
  const bool plain = !name.empty() && name.find_first_of(";\"") == name.npos &&
                     !is_space(name.front()) && !is_space(name.back());
  if (plain) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

std::string numbers(std::span<const double> values) {
  std::string text;
  char room[fixed_number_room];
  for (const double value : values) {
    text += ' ';
    if (std::isinf(value)) {
      text += value < 0 ? "-inf" : "inf";
    } else {
      text.append(room, write_shortest(room, value));
    }
  }
  return text;
}

std::string offset_text(Vec3 v) { return numbers(std::array{v.x, v.y, v.z}); }

// The fields of one line.
class NoteReader {
 public:
  NoteReader(const SourceText& text, const CsvNote& note)
      : text_(text), note_(note), fields_(split_cells(note.value, ';')) {}

  std::string name() const { return fields_.empty() ? std::string() : fields_[0]; }

  // Returns the words after a field's name.
  std::vector<std::string> words(std::string_view field) const {
    for (std::size_t i = 1; i < fields_.size(); ++i) {
      std::vector<std::string> parts = split_cells(fields_[i], ' ');
      if (parts.empty() || !equal_ignoring_case(parts[0], field)) continue;
      parts.erase(parts.begin());
      return parts;
    }
    return {};
  }

  // Returns the numbers of a field; empty if it is missing. Errors: not `count` finite numbers.
  std::vector<double> values(std::string_view field, std::size_t count) const {
    const std::vector<std::string> parts = words(field);
    std::vector<double> found;
    for (const std::string& part : parts) {
      const NumberToken token = read_number(part.data(), part.data() + part.size());
      const bool infinite = part == "inf" || part == "-inf";
      if (token.kind != TokenKind::number && !infinite) fail(field, count);
      constexpr double infinity = std::numeric_limits<double>::infinity();
      found.push_back(infinite ? (part[0] == '-' ? -infinity : infinity) : token.value);
    }
    if (!found.empty() && found.size() != count) fail(field, count);
    return found;
  }

  Vec3 offset() const {
    const auto v = values("offset", 3);
    if (v.empty() || !std::isfinite(v[0] + v[1] + v[2])) fail("offset", 3);
    return {v[0], v[1], v[2]};
  }

  // Returns the parent, below `joints`, or -1.
  std::int32_t parent(std::size_t joints) const {
    const auto v = values("parent", 1);
    const double index = v.empty() ? -2 : v[0];
    if (index == -1) return -1;
    if (!(index >= 0 && index < static_cast<double>(joints) && index == std::floor(index))) {
      throw text_.error_at(note_.place,
                           fmt::format("expected the number of a joint above as parent, found {}",
                                       quote(v.empty() ? "nothing" : words("parent")[0])));
    }
    return static_cast<std::int32_t>(index);
  }

  std::vector<Channel> channels() const {
    std::vector<Channel> found;
    for (const std::string& word : words("channels")) {
      const auto* const name =
          std::find_if(channel_names.begin(), channel_names.end(),
                       [&](std::string_view known) { return equal_ignoring_case(known, word); });
      if (name == channel_names.end()) {
        throw text_.error_at(
            note_.place,
            fmt::format("expected a channel such as Xrotation, found {}", quote(word)));
      }
      found.push_back(static_cast<Channel>(name - channel_names.begin()));
    }
    return found;
  }

 private:
  [[noreturn]] void fail(std::string_view field, std::size_t count) const {
    throw text_.error_at(note_.place, fmt::format("expected {} number{} behind {}", count,
                                                  count == 1 ? "" : "s", quote(field)));
  }

  const SourceText& text_;
  const CsvNote& note_;
  std::vector<std::string> fields_;
};

void add_joint(const NoteReader& note, Skeleton& skeleton) {
  const std::int32_t parent = note.parent(skeleton.joint_count());
  skeleton.add_joint(note.name(), parent, note.offset(), note.channels());
  const auto rest = note.values("rest", 4);
  if (!rest.empty()) skeleton.rest_rotations.back() = {rest[0], rest[1], rest[2], rest[3]};
  std::vector<ChannelLimit> limits;
  const std::size_t channels = skeleton.channels.back().size();
  const auto values = note.values("limits", 2 * channels);
  for (std::size_t i = 0; i + 1 < values.size(); i += 2)
    limits.push_back({values[i], values[i + 1]});
  if (!limits.empty()) skeleton.limits.resize(skeleton.joint_count());
  if (!skeleton.limits.empty()) {
    skeleton.limits.resize(skeleton.joint_count());
    skeleton.limits.back() = std::move(limits);
  }
}

void check_rules(const SourceText& text, std::size_t place, const Skeleton& skeleton) {
  try {
    skeleton.validate();
  } catch (const Error& error) {
    throw text.error_at(place, error.what());
  }
}

}  // namespace

std::string skeleton_lines(const Skeleton& skeleton) {
  std::string text;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    text += fmt::format("# joint {}: {}; parent {}; offset{}", j, quoted_name(skeleton.names[j]),
                        skeleton.parents[j], offset_text(skeleton.offsets[j]));
    const Quat rest = skeleton.rest_rotations[j];
    if (!(rest == Quat{})) text += "; rest" + numbers(std::array{rest.w, rest.x, rest.y, rest.z});
    text += "; channels";
    for (const Channel channel : skeleton.channels[j]) {
      text += ' ';
      text += channel_names[static_cast<std::size_t>(channel)];
    }
    if (j < skeleton.limits.size() && !skeleton.limits[j].empty()) {
      text += "; limits";
      for (const ChannelLimit& limit : skeleton.limits[j])
        text += numbers(std::array{limit.minimum, limit.maximum});
    }
    text += '\n';
  }
  for (std::size_t e = 0; e < skeleton.end_sites.size(); ++e) {
    const EndSite& site = skeleton.end_sites[e];
    text += fmt::format("# end {}: {}; parent {}; offset{}\n", e, quoted_name(site.name),
                        site.parent, offset_text(site.offset));
  }
  return text;
}

Skeleton read_skeleton_lines(const SourceText& text, const std::vector<CsvNote>& notes) {
  Skeleton skeleton;
  std::size_t last_place = 0;
  for (const CsvNote& note : notes) {
    const bool is_joint = note.key.substr(0, 6) == "joint ",
               is_end = note.key.substr(0, 4) == "end ";
    if (!is_joint && !is_end) continue;
    last_place = note.place;
    if (skeleton.joint_count() == most_joints || skeleton.end_sites.size() == most_joints) {
      throw text.error_at(note.place, fmt::format("no more than {} joints are read", most_joints));
    }
    const NoteReader fields(text, note);
    if (is_joint) {
      add_joint(fields, skeleton);
      continue;
    }
    const std::int32_t parent = fields.parent(skeleton.joint_count());
    if (parent < 0) throw text.error_at(note.place, "expected the number of a joint as parent");
    skeleton.end_sites.push_back({parent, fields.offset(), fields.name()});
  }
  if (!skeleton.limits.empty()) skeleton.limits.resize(skeleton.joint_count());
  if (skeleton.joint_count() > 0) check_rules(text, last_place, skeleton);
  return skeleton;
}

}  // namespace kinemend
