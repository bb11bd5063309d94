// Reads a table of joints, writes a changed take into its bytes, and writes and reads a skeleton as
// lines of notes.
#include "io/table/csv_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "io/bvh/bvh_hierarchy.hpp"
#include "io/held_samples.hpp"
#include "io/motion/motion_columns.hpp"
#include "io/reading_limits.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

constexpr unsigned shortest_digits = most_fixed_decimals + 1;

std::vector<const CsvGroup*> groups_of(const std::vector<CsvGroup>& groups, CsvGroup::Kind kind) {
  std::vector<const CsvGroup*> found;
  for (const CsvGroup& group : groups) {
    if (group.kind == kind) found.push_back(&group);
  }
  return found;
}

// The columns of a table of joints.
struct JointColumns {
  std::vector<std::array<std::size_t, 4>> rotations;  // J times w, x, y, z
  // Root, then the translated joints; the first is unused without a root position.
  std::vector<std::array<std::size_t, 3>> positions;
  bool has_root = false;
};

JointColumns columns_of(const std::vector<CsvGroup>& groups) {
  JointColumns columns;
  for (const CsvGroup* group : groups_of(groups, CsvGroup::Kind::rotation))
    columns.rotations.push_back(group->columns);
  const auto roots = groups_of(groups, CsvGroup::Kind::position);
  columns.has_root = !roots.empty();
  columns.positions.emplace_back();
  if (columns.has_root) {
    std::copy_n(roots[0]->columns.begin(), 3, columns.positions[0].begin());
  }
  for (const CsvGroup* group : groups_of(groups, CsvGroup::Kind::translation)) {
    columns.positions.push_back({group->columns[0], group->columns[1], group->columns[2]});
  }
  return columns;
}

std::size_t width_of(const MarkerTable& table, const std::vector<CsvGroup>& groups) {
  std::size_t width = table.width();
  for (const CsvGroup& group : groups) {
    width = std::max(width, *std::max_element(group.columns.begin(), group.columns.end()) + 1);
  }
  return width;
}

class JointReader {
 public:
  JointReader(const SourceText& text, const CsvHeader& header, CsvDocument& document,
              RowLabels& labels)
      : text_(text),
        header_(header),
        document_(document),
        labels_(labels),
        columns_(columns_of(header.groups)),
        width_(width_of(document.table, header.groups)) {}

  Take read() {
    build_skeleton();
    find_translated_joints();
    read_unit();
    read_rows();
    fill_gaps();
    document_.skeleton = clip_.skeleton;
    document_.groups = header_.groups;
    document_.metres_per_unit = clip_.metres_per_unit;
    return std::move(clip_);
  }

 private:
  std::size_t joints() const { return columns_.rotations.size(); }

  void build_skeleton() {
    const auto rotations = groups_of(header_.groups, CsvGroup::Kind::rotation);
    clip_.skeleton = read_skeleton_lines(text_, header_.notes);
    const bool stated = clip_.skeleton.joint_count() > 0;
    if (stated && clip_.skeleton.joint_count() != joints()) {
      throw text_.error_at(header_.labels_line,
                           fmt::format("expected rotations of the {} joints stated above, found {}",
                                       clip_.skeleton.joint_count(), joints()));
    }
    const RotationOrder order = parse_rotation_order("ZXY");
    for (std::size_t j = 0; j < joints(); ++j) {
      const std::string& label = rotations[j]->label;
      if (!stated) {
        clip_.skeleton.add_joint(label, j == 0 ? -1 : 0, {},
                                 make_channels(j == 0 || has_translation(label), order));
      } else if (clip_.skeleton.names[j] != label) {
        throw text_.error_at(header_.labels_line,
                             fmt::format("expected the rotation of joint {}, found {}",
                                         quote(clip_.skeleton.names[j]), quote(label)));
      }
    }
    if (!stated) {
      text_.note("skeleton_missing", header_.labels_line,
                 "no lines '# joint': every joint is a child of the first, without an offset");
    }
  }

  bool has_translation(const std::string& label) const {
    const auto groups = groups_of(header_.groups, CsvGroup::Kind::translation);
    return std::any_of(groups.begin(), groups.end(),
                       [&](const CsvGroup* group) { return group->label == label; });
  }

  void find_translated_joints() {
    const auto groups = groups_of(header_.groups, CsvGroup::Kind::translation);
    for (std::size_t j = 1; j < joints(); ++j) {
      if (!clip_.skeleton.has_position_channels(j)) continue;
      const std::size_t index = clip_.translated_joints.size();
      if (index >= groups.size() || groups[index]->label != clip_.skeleton.names[j]) {
        throw text_.error_at(header_.labels_line,
                             fmt::format("expected the translation of joint {} (_tx, _ty, _tz)",
                                         quote(clip_.skeleton.names[j])));
      }
      clip_.translated_joints.push_back(static_cast<std::int32_t>(j));
    }
    if (clip_.translated_joints.size() != groups.size()) {
      throw text_.error_at(header_.labels_line,
                           fmt::format("expected translations of {} joints, found {}",
                                       clip_.translated_joints.size(), groups.size()));
    }
  }

  void read_unit() {
    clip_.metres_per_unit = metres_per_unit(header_.unit);
    for (const CsvNote& note : header_.notes) {
      if (note.key != "metres_per_unit" || note.value.empty()) continue;
      const NumberToken token = read_number(note.value);
      if (token.kind == TokenKind::number && token.value > 0) clip_.metres_per_unit = token.value;
    }
  }

  std::size_t bytes_per_frame() const {
    return joints() * (sizeof(Quat) + 1) + columns_.positions.size() * sizeof(Vec3) + 16;
  }

  // Reserves memory, but not for more frames than the limit allows.
  void reserve(std::size_t frames) {
    const std::size_t affordable = memory_limit(text_.bytes.size()) / bytes_per_frame();
    clip_.rotations.reserve(std::min(frames, affordable) * joints());
  }

  void read_rows() {
    CellRows rows(text_.bytes, document_.table.begin, header_.style);
    values_.resize(width_);
    reserve(estimate_rows(text_.bytes, document_.table.begin));
    while (rows.next()) {
      const std::size_t place = rows.position();
      const CellRow row = rows.read(values_.data(), width_);
      if (ends_in_row(row)) {
        leave_out_from(place);
        break;
      }
      if (row.fault != nullptr) fail_at_cell(text_, row.fault, header_.style.separator);
      if (row.used > width_) {
        throw text_.error_at(
            place,
            fmt::format("expected {} cells as in the row of labels, found {}", width_, row.used));
      }
      if (document_.table.is_filler(row)) continue;
      if (row.cells + 1 < width_) too_short_.add(place);
      if ((clip_.frame_count() + 1) * bytes_per_frame() > memory_limit(text_.bytes.size())) {
        throw text_.error_at(place, fmt::format("{} joints in rows that hold few of them: too much "
                                                "memory for a file of {} bytes",
                                                joints(), text_.bytes.size()));
      }
      store(place);
    }
    if (clip_.frame_count() == 0 && !header_.has_no_frames()) {
      throw text_.error_at(header_.data_begin, "expected a row for each frame, found none");
    }
    document_.table.frames = clip_.frame_count();
    text_.note("value_not_finite", rows.not_finite(), "a value is not finite: it is missing");
    text_.note("row_too_short", too_short_, "a row ends early: the rest of it is missing");
    text_.note("rotation_not_unit", not_unit_, "the length of a quaternion is not 1: it is scaled");
    text_.note("rotation_missing", rotation_missing_,
               "a rotation is missing: held from a neighbour");
    text_.note("position_missing", position_missing_,
               "a position is missing: held from a neighbour");
  }

  // Whether the file was cut off in this row, after complete rows.
  bool ends_in_row(const CellRow& row) const {
    const char* const end = text_.bytes.data() + text_.bytes.size();
    if (row.end != end || clip_.frame_count() == 0 || row.used != row.cells) return false;
    if (row.fault != nullptr) {
      return may_start_number({row.fault, static_cast<std::size_t>(end - row.fault)});
    }
    const char separator = header_.style.separator;
    return row.cells < width_ || last_number_may_be_cut(text_.bytes.substr(document_.table.begin),
                                                        header_.style.commas, separator);
  }

  // A partial rotation is not usable, so the frame is left out.
  void leave_out_from(std::size_t place) {
    text_.note("file_cut", place,
               "the file ends in the middle of a row: the rows before it are read");
    document_.bytes.resize(place);
  }

  void store(std::size_t place) {
    auto& rotations = clip_.rotations;
    if (rotations.size() + joints() > rotations.capacity()) reserve(text_.bytes.size());
    for (const auto& [w, x, y, z] : columns_.rotations) {
      const Quat raw{values_[w], values_[x], values_[y], values_[z]};
      const Quat rotation = rotation_of_values(raw.w, raw.x, raw.y, raw.z);
      if (is_missing(rotation)) {
        rotation_missing_.add(place);
      } else if (std::fabs(norm(raw) - 1) > unit_length_tolerance) {
        not_unit_.add(place);
      }
      rotations.push_back(rotation);
    }
    for (std::size_t i = 0; i < columns_.positions.size(); ++i) {
      const auto& [x, y, z] = columns_.positions[i];
      const bool absent = i == 0 && !columns_.has_root;
      const Vec3 position =
          absent ? clip_.skeleton.offsets[0] : Vec3{values_[x], values_[y], values_[z]};
      if (is_missing(position)) position_missing_.add(place);
      clip_.positions.push_back(position);
    }
    const auto label = [&](std::int32_t column, std::vector<double>& labels) {
      if (column >= 0) labels.push_back(values_[static_cast<std::size_t>(column)]);
    };
    label(document_.table.frame_column, labels_.frames);
    label(document_.table.time_column, labels_.times_s);
  }

  void fill_gaps() {
    if (rotation_missing_.count > 0) {
      clip_.observed.resize(clip_.rotations.size());
      for (std::size_t i = 0; i < clip_.observed.size(); ++i)
        clip_.observed[i] = is_missing(clip_.rotations[i]) ? 0 : 1;
      for (std::size_t j = 0; j < joints(); ++j) hold_missing(clip_.rotations, j, joints(), Quat{});
    }
    if (position_missing_.count == 0) return;
    const auto& offsets = clip_.skeleton.offsets;
    for (std::size_t k = 0; k < clip_.point_count(); ++k) {
      const std::int32_t joint = k == 0 ? 0 : clip_.translated_joints[k - 1];
      hold_missing(clip_.positions, k, clip_.point_count(),
                   offsets[static_cast<std::size_t>(joint)]);
    }
    document_.positions = clip_.positions;
  }

  const SourceText& text_;
  const CsvHeader& header_;
  CsvDocument& document_;
  RowLabels& labels_;
  JointColumns columns_;
  std::size_t width_;
  Take clip_;
  std::vector<double> values_;
  CountedRepair<std::size_t> too_short_, not_unit_, rotation_missing_, position_missing_;
};

class JointRewriter {
 public:
  JointRewriter(const Take& clip, const CsvDocument& document)
      : clip_(clip),
        document_(document),
        columns_(columns_of(document.groups)),
        patch_(document.bytes, document.table.begin, document.table.style,
               width_of(document.table, document.groups)) {}

  std::string rewrite() {
    for (std::size_t f = 0; f < clip_.frame_count() && patch_.next();) {
      if (document_.table.is_filler(patch_.row())) continue;
      mend_row_labels(document_.table,
                      static_cast<double>(first_frame_number(clip_)) + static_cast<double>(f),
                      patch_);
      for (std::size_t j = 0; j < clip_.joint_count(); ++j) compare_rotation(f, j);
      for (std::size_t i = columns_.has_root ? 0 : 1; i < columns_.positions.size(); ++i)
        compare_position(f, i);
      ++f;
    }
    return std::move(patch_).finish();
  }

 private:
  void compare_rotation(std::size_t frame, std::size_t joint) {
    const auto& columns = columns_.rotations[joint];
    const auto& [w, x, y, z] = columns;
    const Quat before =
        rotation_of_values(patch_.value(w), patch_.value(x), patch_.value(y), patch_.value(z));
    Quat now = clip_.rotation(frame, joint);
    const bool known = clip_.is_observed(frame, joint);
    if (holds_numbers(columns) && (is_missing(before) ? !known : known && now == before)) return;
    if (!known) now = {not_a_number, not_a_number, not_a_number, not_a_number};
    replace(columns, std::array{now.w, now.x, now.y, now.z});
  }

  void compare_position(std::size_t frame, std::size_t index) {
    const Vec3 now = clip_.position(frame, index);
    const auto& held = document_.positions;
    const auto& columns = columns_.positions[index];
    const auto& [x, y, z] = columns;
    const Vec3 before = held.empty() ? Vec3{patch_.value(x), patch_.value(y), patch_.value(z)}
                                     : held[frame * clip_.point_count() + index];
    if (now == before && holds_numbers(columns)) return;
    replace(columns, std::array{now.x, now.y, now.z});
  }

  bool holds_numbers(std::span<const std::size_t> columns) const {
    return std::none_of(columns.begin(), columns.end(),
                        [&](std::size_t column) { return patch_.is_no_number(column); });
  }

  void replace(std::span<const std::size_t> columns, std::span<const double> values) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      patch_.replace(columns[i], values[i], shortest_digits);
  }

  const Take& clip_;
  const CsvDocument& document_;
  JointColumns columns_;
  CellPatch patch_;
};

}  // namespace

Take read_csv_joints(const SourceText& text, const CsvHeader& header, CsvDocument& document,
                     RowLabels& labels) {
  return JointReader(text, header, document, labels).read();
}

std::string rewrite_csv_joints(const Take& clip, const CsvDocument& document) {
  return JointRewriter(clip, document).rewrite();
}

namespace {

std::string quoted_name(const std::string& name) {
  if (name.find_first_of("\r\n") != name.npos) {
    throw Error(ErrorKind::usage, fmt::format("CSV cannot hold the name {}", quote(name)));
  }
  return name.empty() ? "\"\"" : cell_of(name, ';');
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
      const NumberToken token = read_number(part);
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
      const std::optional<Channel> channel = channel_named(word);
      if (!channel) {
        throw text_.error_at(
            note_.place,
            fmt::format("expected a channel such as Xrotation, found {}", quote(word)));
      }
      found.push_back(*channel);
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
