// Matches the lines of the first frame with the bones of the skeleton.
#include "io/acclaim/amc_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "io/acclaim/asf_scanner.hpp"
#include "io/bvh/bvh_hierarchy.hpp"
#include "kinemend/experimental/letter_case.hpp"

namespace kinemend {

namespace {

struct BoneLine {
  std::string_view name;
  std::size_t values = 0;
};

bool is_number(std::string_view word) {
  const NumberToken token = read_number(word.data(), word.data() + word.size());
  return token.kind == TokenKind::number;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

// Returns the lines between the first frame's number and the second's.
std::vector<BoneLine> first_frame(const SourceText& text, std::size_t begin) {
  AsfScanner scanner(text.bytes, begin);
  scanner.next();
  std::vector<BoneLine> lines;
  for (;;) {
    const std::string_view name = scanner.peek();
    if (name.empty() || is_number(name)) return lines;
    if (lines.size() > most_joints) {
      throw text.error_at(scanner.position(), fmt::format("more than {} bones", most_joints));
    }
    scanner.next();
    lines.push_back({name, 0});
    for (std::string_view word; !(word = scanner.next_in_line()).empty();)
      lines.back().values += numbers_in_word(word);
  }
}

// Finds joints by name, in the spelling of the skeleton or in lower case.
class JointNames {
 public:
  explicit JointNames(const Skeleton& skeleton) {
    for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
      exact_.try_emplace(skeleton.names[j], j);
      lower_.try_emplace(lower_case(skeleton.names[j]), j);
    }
  }

  std::optional<std::size_t> find(std::string_view name) const {
    const auto exact = exact_.find(std::string(name));
    if (exact != exact_.end()) return exact->second;
    const auto any_case = lower_.find(lower_case(name));
    if (any_case != lower_.end()) return any_case->second;
    return std::nullopt;
  }

 private:
  std::unordered_map<std::string, std::size_t> exact_, lower_;
};

const std::vector<AsfDof>& three_turns() {
  static const std::vector<AsfDof> dofs{Channel::x_rotation, Channel::y_rotation,
                                        Channel::z_rotation};
  return dofs;
}

bool has_three_turns(const std::vector<AsfDof>& dofs) {
  return dofs.size() == 3 &&
         std::all_of(dofs.begin(), dofs.end(), [](AsfDof d) { return d && is_rotation(*d); });
}

void give_three_turns(AsfSkeleton& asf, std::size_t joint) {
  if (has_three_turns(asf.dofs[joint])) return;
  Skeleton& skeleton = asf.skeleton;
  const std::vector<Channel> channels = channels_of(three_turns());
  if (!skeleton.limits.empty() && !skeleton.limits[joint].empty()) {
    std::vector<ChannelLimit> limits(channels.size());
    for (std::size_t i = 0; i < skeleton.channels[joint].size(); ++i) {
      const auto found = std::find(channels.begin(), channels.end(), skeleton.channels[joint][i]);
      if (found == channels.end()) continue;
      limits[static_cast<std::size_t>(found - channels.begin())] = skeleton.limits[joint][i];
    }
    skeleton.limits[joint] = std::move(limits);
  }
  asf.dofs[joint] = three_turns();
  skeleton.channels[joint] = channels;
}

class LayoutMatcher {
 public:
  LayoutMatcher(const SourceText& text, Diagnostics& diagnostics, const AmcHeader& header,
                AsfSkeleton& asf, std::string_view asf_name)
      : text_(text),
        diagnostics_(diagnostics),
        header_(header),
        asf_(asf),
        asf_name_(asf_name),
        lines_(first_frame(text, header.data_begin)) {}

  AmcLayout match() {
    find_joints();
    if (header_.three_dofs || three_dofs_undeclared()) {
      for (const AmcBone& bone : layout_) {
        if (bone.joint != 0) give_three_turns(asf_, bone.joint);
      }
    }
    check_counts();
    check_none_missing();
    return std::move(layout_);
  }

 private:
  void find_joints() {
    const JointNames names(asf_.skeleton);
    std::vector<bool> seen(asf_.skeleton.joint_count());
    for (const BoneLine& line : lines_) {
      const auto joint = names.find(line.name);
      if (!joint) {
        throw text_.error_at(line.name.data(), fmt::format("the skeleton {} has no bone {}",
                                                           asf_name_, quote(line.name)));
      }
      if (seen[*joint]) {
        throw text_.error_at(line.name.data(),
                             fmt::format("the bone {} occurs twice in a frame", quote(line.name)));
      }
      seen[*joint] = true;
      layout_.push_back({std::string(line.name), *joint, {}});
    }
  }

  // Some programs write three angles per bone without declaring it.
  bool three_dofs_undeclared() {
    bool differs = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (layout_[i].joint == 0) continue;
      if (lines_[i].values != 3) return false;
      differs = differs || asf_.dofs[layout_[i].joint].size() != 3;
    }
    if (differs) {
      note_repair(text_, diagnostics_, "three_dofs_undeclared", header_.data_begin,
                  fmt::format("every bone has three values, other than the skeleton {} says: taken "
                              "as rx ry rz",
                              asf_name_));
    }
    return differs;
  }

  void check_counts() const {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const std::size_t expected = asf_.dofs[layout_[i].joint].size();
      if (lines_[i].values == expected) continue;
      throw text_.error_at(
          lines_[i].name.data(),
          fmt::format("expected {} values of the bone {} as in the skeleton {}, found {}", expected,
                      quote(lines_[i].name), asf_name_, lines_[i].values));
    }
  }

  void check_none_missing() const {
    std::vector<bool> seen(asf_.skeleton.joint_count());
    for (const AmcBone& bone : layout_) seen[bone.joint] = true;
    for (std::size_t j = 0; j < seen.size(); ++j) {
      if (seen[j] || asf_.dofs[j].empty()) continue;
      throw text_.error_at(header_.data_begin,
                           fmt::format("the frame has no bone {}, which the skeleton {} has",
                                       quote(asf_.skeleton.names[j]), asf_name_));
    }
  }

  const SourceText& text_;
  Diagnostics& diagnostics_;
  const AmcHeader& header_;
  AsfSkeleton& asf_;
  std::string_view asf_name_;
  std::vector<BoneLine> lines_;
  AmcLayout layout_;
};

void number_columns(AmcLayout& layout, const AsfSkeleton& asf) {
  std::vector<std::size_t> first_column;
  std::size_t columns = 0;
  for (const auto& channels : asf.skeleton.channels) {
    first_column.push_back(columns);
    columns += channels.size();
  }
  for (AmcBone& bone : layout) {
    for (const auto& slot : channel_slots(asf.dofs[bone.joint])) {
      bone.columns.push_back(slot ? first_column[bone.joint] + *slot : AmcBone::no_column);
    }
  }
}

}  // namespace

AmcHeader read_amc_header(const SourceText& text, Diagnostics& diagnostics) {
  const std::string_view bytes = text.bytes;
  AmcHeader header;
  std::size_t position = bytes.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  while (position < bytes.size()) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n", position), bytes.size());
    const std::string_view line = trim(bytes.substr(position, end - position));
    constexpr std::string_view skeleton_mark = "#!OML:ASF";
    const std::string_view keyword = line.substr(0, line.find_first_of(" \t"));
    if (equal_ignoring_case(keyword, skeleton_mark)) {
      header.skeleton_file = trim(line.substr(skeleton_mark.size()));
    } else if (equal_ignoring_case(keyword, ":DEGREES")) {
      header.radians = false;
    } else if (equal_ignoring_case(keyword, ":RADIANS")) {
      header.radians = true;
    } else if (equal_ignoring_case(keyword, ":FORCE-ALL-JOINTS-BE-3DOF")) {
      header.three_dofs = true;
    } else if (keyword.substr(0, 1) == ":") {
      if (!equal_ignoring_case(keyword, ":FULLY-SPECIFIED")) {
        note_repair(text, diagnostics, "unknown_keyword", position,
                    fmt::format("{} is not a keyword of the format", quote(keyword)));
      }
    } else if (!line.empty() && line[0] != '#') {
      header.data_begin = static_cast<std::size_t>(line.data() - bytes.data());
      if (is_number(keyword)) return header;
      throw text.error_at(header.data_begin,
                          fmt::format("expected the number of a frame, found {}", quote(keyword)));
    }
    position = end + 1;
  }
  header.data_begin = bytes.size();
  return header;
}

AmcLayout read_amc_layout(const SourceText& text, Diagnostics& diagnostics, const AmcHeader& header,
                          AsfSkeleton& asf, std::string_view asf_name) {
  AmcLayout layout = LayoutMatcher(text, diagnostics, header, asf, asf_name).match();
  number_columns(layout, asf);
  return layout;
}

AmcLayout make_amc_layout(const AsfSkeleton& asf) {
  AmcLayout layout;
  for (std::size_t j = 0; j < asf.skeleton.joint_count(); ++j) {
    if (!asf.dofs[j].empty()) layout.push_back({asf.skeleton.names[j], j, {}});
  }
  number_columns(layout, asf);
  return layout;
}

}  // namespace kinemend
