// Turns the degrees of freedom of ASF into channels, and writes a skeleton: a bone for each joint,
// and connecting bones to children that are not at its end.
#include "io/acclaim/asf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "io/acclaim/amc_document.hpp"
#include "io/motion/motion_write.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// Whether a word is a keyword of ASF or AMC.
bool is_reserved(std::string_view name) {
  constexpr std::array<std::string_view, 3> words{"root", "begin", "end"};
  const auto same = [&](std::string_view word) { return equal_ignoring_case(name, word); };
  if (std::any_of(words.begin(), words.end(), same)) return true;
  return read_number(name).kind != TokenKind::text;
}

// Converts a name to one word that is not a number, keyword or comment.
std::string as_word(std::string_view name) {
  std::string word;
  for (const char c : name) {
    const bool separates = is_space(c) || c == ',' || c == '(' || c == ')' || c == '#';
    const bool control = static_cast<unsigned char>(c) < ' ';
    word += separates || control || (word.empty() && (c == ':' || c == '/')) ? '_' : c;
  }
  if (word.empty()) return "joint";
  return is_reserved(word) ? "_" + word : word;
}

class BonePlanner {
 public:
  explicit BonePlanner(const Skeleton& skeleton)
      : skeleton_(skeleton),
        children_(skeleton.joint_count()),
        sites_(skeleton.joint_count()),
        bone_of_(skeleton.joint_count(), -1) {
    for (std::size_t j = 1; j < skeleton.joint_count(); ++j) {
      if (skeleton.parents[j] < 0) {
        throw Error(ErrorKind::usage, fmt::format("ASF holds one root; joint {} is another",
                                                  quote(skeleton.names[j])));
      }
      children_[static_cast<std::size_t>(skeleton.parents[j])].push_back(j);
    }
    for (const EndSite& site : skeleton.end_sites) {
      sites_[static_cast<std::size_t>(site.parent)].push_back(site.offset);
    }
  }

  std::vector<PlannedBone> plan() {
    names_.push_back("root");
    used_.insert("root");
    for (std::size_t j = 1; j < skeleton_.joint_count(); ++j) {
      names_.push_back(unique(as_word(skeleton_.names[j])));
    }
    for (std::size_t j = 0; j < skeleton_.joint_count(); ++j) plan_joint(j);
    return std::move(bones_);
  }

 private:
  std::string unique(std::string name) {
    std::string candidate = name;
    for (int i = 2; !used_.insert(candidate).second; ++i) candidate = fmt::format("{}_{}", name, i);
    return candidate;
  }

  // Parents come first, so that the bone of a joint's parent already exists.
  void plan_joint(std::size_t joint) {
    PlannedBone bone;
    bone.name = names_[joint];
    bone.joint = static_cast<std::int32_t>(joint);
    bone.dofs = dofs_of(joint);
    if (joint > 0) {
      bone.parent = bone_of_[joint];
      bone.axis = normalized(bones_[static_cast<std::size_t>(bone.parent)].axis *
                             skeleton_.rest_rotations[joint]);
    }
    const bool together = joint > 0 && ends_together(joint);
    if (together) bone.extent = rotate(bone.axis, end_of(joint));
    const auto index = static_cast<std::int32_t>(bones_.size());
    const Quat axis = bone.axis;
    bones_.push_back(std::move(bone));
    for (const std::size_t child : children_[joint]) {
      const Vec3 offset = skeleton_.offsets[child];
      const bool here = together || offset == Vec3{};
      bone_of_[child] = here ? index : lead(names_[child] + "_offset", index, axis, offset);
    }
    if (together) return;
    for (const Vec3 offset : sites_[joint]) lead(names_[joint] + "_end", index, axis, offset);
  }

  std::int32_t lead(std::string name, std::int32_t parent, Quat axis, Vec3 offset) {
    PlannedBone bone;
    bone.name = unique(std::move(name));
    bone.parent = parent;
    bone.axis = axis;
    bone.extent = rotate(axis, offset);
    bones_.push_back(std::move(bone));
    return static_cast<std::int32_t>(bones_.size()) - 1;
  }

  Vec3 end_of(std::size_t joint) const {
    if (!children_[joint].empty()) return skeleton_.offsets[children_[joint].front()];
    return sites_[joint].empty() ? Vec3{} : sites_[joint].front();
  }

  bool ends_together(std::size_t joint) const {
    const Vec3 end = end_of(joint);
    const auto& children = children_[joint];
    const auto& sites = sites_[joint];
    return std::all_of(children.begin(), children.end(),
                       [&](std::size_t child) { return skeleton_.offsets[child] == end; }) &&
           std::all_of(sites.begin(), sites.end(), [&](Vec3 site) { return site == end; });
  }

  // The rotations are reversed, as in `channels_of`.
  std::vector<AsfDof> dofs_of(std::size_t joint) const {
    std::vector<AsfDof> dofs;
    for (const Channel channel : skeleton_.channels[joint]) {
      if (std::find(dofs.begin(), dofs.end(), AsfDof(channel)) != dofs.end()) {
        throw Error(ErrorKind::usage,
                    fmt::format("ASF cannot hold joint {}, which turns about one axis twice",
                                quote(skeleton_.names[joint])));
      }
      dofs.push_back(channel);
    }
    const std::vector<Channel> reversed = channels_of(dofs);
    return {reversed.begin(), reversed.end()};
  }

  const Skeleton& skeleton_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::vector<Vec3>> sites_;
  std::vector<std::int32_t> bone_of_;  // the bone that ends at each joint
  std::vector<std::string> names_;
  std::unordered_set<std::string> used_;
  std::vector<PlannedBone> bones_;
};

}  // namespace

std::vector<PlannedBone> plan_bones(const Skeleton& skeleton) {
  return BonePlanner(skeleton).plan();
}

Skeleton with_root_positions(Skeleton skeleton) {
  auto& channels = skeleton.channels[0];
  std::vector<Channel> missing;
  for (const Channel channel : {Channel::x_position, Channel::y_position, Channel::z_position}) {
    if (std::find(channels.begin(), channels.end(), channel) == channels.end())
      missing.push_back(channel);
  }
  channels.insert(channels.begin(), missing.begin(), missing.end());
  if (missing.empty() || skeleton.limits.empty() || skeleton.limits[0].empty()) return skeleton;
  skeleton.limits[0].insert(skeleton.limits[0].begin(), missing.size(), ChannelLimit{});
  return skeleton;
}

namespace {

bool turns(const AsfDof& dof) { return dof && is_rotation(*dof); }

}  // namespace

std::vector<std::optional<std::size_t>> channel_slots(const std::vector<AsfDof>& dofs) {
  std::vector<std::optional<std::size_t>> slots(dofs.size());
  std::vector<std::size_t> rotations;
  std::size_t next = 0;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (!dofs[i]) continue;
    if (turns(dofs[i])) rotations.push_back(i);
    slots[i] = next++;
  }
  for (std::size_t i = 0; i < rotations.size() / 2; ++i) {
    std::swap(slots[rotations[i]], slots[rotations[rotations.size() - 1 - i]]);
  }
  return slots;
}

std::vector<Channel> channels_of(const std::vector<AsfDof>& dofs) {
  const auto slots = channel_slots(dofs);
  std::vector<Channel> channels(static_cast<std::size_t>(
      std::count_if(dofs.begin(), dofs.end(), [](const AsfDof& dof) { return dof.has_value(); })));
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (slots[i]) channels[*slots[i]] = *dofs[i];
  }
  return channels;
}

namespace {

class AsfWriter {
 public:
  AsfWriter(const Skeleton& skeleton, double metres_per_unit)
      : skeleton_(skeleton),
        metres_per_unit_(metres_per_unit),
        bones_(plan_bones(skeleton)),
        out_(4096) {}

  std::string write() {
    write_head();
    write_root();
    out_.append(":bonedata\n");
    for (std::size_t i = 1; i < bones_.size(); ++i) write_bone(i);
    write_hierarchy();
    return std::move(out_).take();
  }

 private:
  // Writes Euler angles for the letters XYZ: rotations about fixed axes, x first.
  void axis_angles(Quat axis) {
    const std::array<double, 3> zyx = to_euler(axis, parse_rotation_order("ZYX"));
    out_.append_each(" ", {zyx[2] * degrees_per_radian, zyx[1] * degrees_per_radian,
                           zyx[0] * degrees_per_radian});
  }

  void dof_names(const std::vector<AsfDof>& dofs) {
    for (const AsfDof& dof : dofs) {
      out_.append(" ");
      out_.append(dof ? asf_dof_names[static_cast<std::size_t>(*dof)] : "l");
    }
  }

  void write_head() {
    out_.append(":version 1.10\n:name skeleton\n:units\n  mass 1\n  length");
    out_.append_each(" ", {metres_per_unit_ > 0 ? 0.0254 / metres_per_unit_ : 1});
    out_.append("\n  angle deg\n:documentation\n  Written by Kinemend.\n");
  }

  void write_root() {
    out_.append(":root\n  order");
    dof_names(bones_[0].dofs);
    out_.append("\n  axis XYZ\n  position 0 0 0\n  orientation");
    axis_angles(skeleton_.rest_rotations[0]);
    out_.append("\n");
  }

  void write_bone(std::size_t index) {
    const PlannedBone& bone = bones_[index];
    const double length = norm(bone.extent);
    const Vec3 direction = length > 0 ? (1 / length) * bone.extent : Vec3{0, 0, 1};
    out_.append(fmt::format("  begin\n    id {}\n    name {}\n    direction", index, bone.name));
    out_.append_each(" ", {direction.x, direction.y, direction.z});
    out_.append("\n    length");
    out_.append_each(" ", {length});
    out_.append("\n    axis");
    axis_angles(bone.axis);
    out_.append(" XYZ\n");
    if (!bone.dofs.empty()) {
      out_.append("    dof");
      dof_names(bone.dofs);
      out_.append("\n");
      write_limits(bone);
    }
    out_.append("  end\n");
  }

  void write_limits(const PlannedBone& bone) {
    const auto& limits = skeleton_.limits;
    const auto joint = static_cast<std::size_t>(bone.joint);
    if (limits.empty() || limits[joint].empty()) return;
    const auto slots = channel_slots(bone.dofs);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const ChannelLimit limit = limits[joint][*slots[i]];
      out_.append(i == 0 ? "    limits (" : "           (");
      bound(limit.minimum);
      out_.append(" ");
      bound(limit.maximum);
      out_.append(")\n");
    }
  }

  void bound(double value) {
    if (std::isfinite(value)) return out_.append_shortest(value);
    out_.append(value < 0 ? "-inf" : "inf");
  }

  void write_hierarchy() {
    std::vector<std::vector<std::size_t>> children(bones_.size());
    for (std::size_t i = 1; i < bones_.size(); ++i) {
      children[static_cast<std::size_t>(bones_[i].parent)].push_back(i);
    }
    out_.append(":hierarchy\n  begin\n");
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      if (children[i].empty()) continue;
      out_.append("    ");
      out_.append(bones_[i].name);
      for (const std::size_t child : children[i]) {
        out_.append(" ");
        out_.append(bones_[child].name);
      }
      out_.append("\n");
    }
    out_.append("  end\n");
  }

  const Skeleton& skeleton_;
  double metres_per_unit_;
  std::vector<PlannedBone> bones_;
  TextBuffer out_;
};

}  // namespace

std::string write_asf(const Take& clip) {
  check_lengths(clip);
  const auto* document = dynamic_cast<const AmcDocument*>(clip.source.document.get());
  if (document != nullptr && same_skeleton(clip.skeleton, document->skeleton) &&
      clip.metres_per_unit == document->metres_per_unit) {
    return document->asf_bytes;
  }
  return AsfWriter(with_root_positions(clip.skeleton), clip.metres_per_unit).write();
}

}  // namespace kinemend
