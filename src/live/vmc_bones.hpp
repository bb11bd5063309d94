// The bones that VMC may name, and the skeleton of the bones that a sender has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Bones are numbered from 0: the root, those of Unity's humanoid, then added ones.
class VmcBones {
 public:
  static constexpr std::size_t root = 0, hips = 1;

  explicit VmcBones(const std::vector<std::string>& more);

  std::size_t count() const { return names_.size(); }
  const std::string& name(std::size_t bone) const { return names_[bone]; }
  /// Returns -1 if no bone has that name. Matching ignores case.
  std::int32_t find(std::string_view name) const;

  /// Returns a take without frames, of the root and of the bones that `present` marks, in the order
  /// of their numbers. Each bone's parent is its nearest present ancestor. `offsets`: for each
  /// bone.
  Take take_of(const std::vector<std::uint8_t>& present, const std::vector<Vec3>& offsets,
               double frame_rate_hz) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::string> keys_;  ///< in lower case
  std::vector<std::int32_t> parents_;
};

}  // namespace kinemend
