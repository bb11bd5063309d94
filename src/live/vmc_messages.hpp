// The poses of bones in datagrams of VMC: their positions in the bytes, and their values.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/rotation.hpp"
#include "live/osc.hpp"

namespace kinemend {

/// A message `/VMC/Ext/Bone/Pos` or `/VMC/Ext/Root/Pos`.
struct VmcPose {
  bool is_root = false;
  std::string_view name;
  std::size_t place =
      0;  ///< of its seven floats in the datagram: position, then quaternion x y z w
};

/// Appends the poses among the messages of a datagram, in order. Messages with other argument types
/// are skipped.
void read_vmc_poses(std::string_view datagram, const std::vector<OscMessage>& messages,
                    std::vector<VmcPose>& poses);

struct VmcValues {
  Vec3 position;
  Quat rotation;  ///< as received: with any norm
  /// Whether all values are finite and the quaternion is a rotation once it is normalised.
  bool is_usable() const;
};
VmcValues vmc_values(std::string_view datagram, std::size_t place);
/// Sets the pose and returns true; values that a float cannot hold leave it unchanged and return
/// false.
bool set_vmc_rotation(std::string& datagram, std::size_t place, Quat rotation);
bool set_vmc_position(std::string& datagram, std::size_t place, Vec3 position);

}  // namespace kinemend
