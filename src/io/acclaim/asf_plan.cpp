// Makes a bone for each joint, and connecting bones to children that are not at its end.
#include "io/acclaim/asf_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "io/text/number.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// Whether a word is a keyword of ASF or AMC.
bool is_reserved(std::string_view name) {
  constexpr std::array<std::string_view, 3> words{"root", "begin", "end"};
  const auto same = [&](std::string_view word) { return equal_ignoring_case(name, word); };
  if (std::any_of(words.begin(), words.end(), same)) return true;
  return read_number(name.data(), name.data() + name.size()).kind != TokenKind::text;
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

}  // namespace kinemend
