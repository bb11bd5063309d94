// Reads and writes positions and quaternions of bones within datagrams.
#include "live/vmc_messages.hpp"

#include <array>
#include <cmath>
#include <span>

#include "motion/take_checks.hpp"

namespace kinemend {

namespace {

constexpr std::size_t float_bytes = 4, position_floats = 3, pose_floats = 7;

bool write_floats(std::string& datagram, std::size_t place, std::span<const double> values) {
  for (const double value : values) {
    if (!std::isfinite(static_cast<float>(value))) return false;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    set_osc_float(datagram, place + float_bytes * i, static_cast<float>(values[i]));
  return true;
}

}  // namespace

void read_vmc_poses(std::string_view datagram, const std::vector<OscMessage>& messages,
                    std::vector<VmcPose>& poses) {
  for (const OscMessage& message : messages) {
    const bool is_root = message.address == "/VMC/Ext/Root/Pos";
    // Later versions of the protocol add arguments after these.
    if (!(is_root || message.address == "/VMC/Ext/Bone/Pos") ||
        !message.types.starts_with("sfffffff"))
      continue;
    const auto name = osc_string(datagram, message.arguments, message.end);
    if (!name) continue;
    const std::size_t place = message.arguments + osc_string_bytes(name->size());
    if (message.end - place < pose_floats * float_bytes) continue;
    poses.push_back({is_root, *name, place});
  }
}

bool VmcValues::is_usable() const {
  const double length = norm(rotation);
  // Senders round their quaternions; zeros mark a bone that is not tracked.
  constexpr double least = 0.5, most = 2;
  return is_finite(position) && length >= least && length <= most;
}

VmcValues vmc_values(std::string_view datagram, std::size_t place) {
  std::array<double, pose_floats> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = osc_float(datagram, place + float_bytes * i);
  return {{v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]}};
}

bool set_vmc_rotation(std::string& datagram, std::size_t place, Quat rotation) {
  const double values[] = {rotation.x, rotation.y, rotation.z, rotation.w};
  return write_floats(datagram, place + position_floats * float_bytes, values);
}

bool set_vmc_position(std::string& datagram, std::size_t place, Vec3 position) {
  const double values[] = {position.x, position.y, position.z};
  return write_floats(datagram, place, values);
}

}  // namespace kinemend
