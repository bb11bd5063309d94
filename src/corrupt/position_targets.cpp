#include "corrupt/position_targets.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "corrupt/refit.hpp"
#include "kinemend/kinematics.hpp"

namespace kinemend::corrupt {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

template <std::size_t N>
bool has_part(const std::string& name, const std::array<std::string_view, N>& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return name.find(part) != std::string::npos; });
}

}  // namespace

std::vector<std::size_t> position_joints(const Skeleton& skeleton, const TargetOptions& options) {
  // Every joint has a position, with or without channels.
  Skeleton bare = skeleton;
  for (auto& channels : bare.channels) channels.clear();
  return target_joints(bare, options);
}

void refit_to(Clip& clip, std::span<const Vec3> targets, const TargetOptions& options) {
  std::vector<std::uint8_t> may_turn(clip.joint_count(), 0);
  TargetOptions all_joints;
  all_joints.root = options.root;
  for (const std::size_t j : target_joints(clip.skeleton, all_joints)) may_turn[j] = 1;
  refit(clip, targets, may_turn, options.root);
}

std::vector<std::size_t> wrists_and_ankles(const std::vector<std::string>& names) {
  static constexpr std::array<std::string_view, 4> ends{"hand", "wrist", "foot", "ankle"};
  static constexpr std::array<std::string_view, 8> beyond{"thumb", "index",  "middle", "ring",
                                                          "pinky", "little", "finger", "toe"};
  std::vector<std::size_t> found;
  for (std::size_t j = 0; j < names.size(); ++j) {
    const std::string name = lower(names[j]);
    if (has_part(name, ends) && !has_part(name, beyond)) found.push_back(j);
  }
  return found;
}

}  // namespace kinemend::corrupt
