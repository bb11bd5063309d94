// A VMC sender for tests: datagrams of a moving body with noise, and the parser of a receiver.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"
#include "live/osc_packets.hpp"

namespace kinemend::test {

struct VmcBonePose {
  Vec3 position;
  Quat rotation;
};
using VmcBody = std::map<std::string, VmcBonePose>;

inline std::string vmc_message(const std::string& address, const std::string& name,
                               const VmcBonePose& pose, const std::string& more_types = {},
                               const std::string& more = {}) {
  std::string values;
  for (const double v : {pose.position.x, pose.position.y, pose.position.z, pose.rotation.x,
                         pose.rotation.y, pose.rotation.z, pose.rotation.w})
    values += osc_real(static_cast<float>(v));
  return osc_message(address, "sfffffff" + more_types, osc_text(name) + values + more);
}
inline std::string vmc_bone(const std::string& name, const VmcBonePose& pose) {
  return vmc_message("/VMC/Ext/Bone/Pos", name, pose);
}
inline std::string vmc_root(const VmcBonePose& pose) {
  return vmc_message("/VMC/Ext/Root/Pos", "root", pose);
}

/// Finds the poses in a datagram by their addresses, independently of the code under test.
inline VmcBody vmc_poses(const std::string& datagram) {
  VmcBody body;
  for (const std::string address : {"/VMC/Ext/Bone/Pos", "/VMC/Ext/Root/Pos"}) {
    for (std::size_t at = 0; (at = datagram.find(address, at)) != datagram.npos; ++at) {
      std::size_t place = datagram.find(',', at);
      if (place == datagram.npos) break;
      place += datagram.substr(place).find('\0') / 4 * 4 + 4;
      const std::string name = datagram.c_str() + place;
      place += name.size() / 4 * 4 + 4;
      double v[7];
      for (int i = 0; i < 7; ++i) {
        std::uint32_t bits = 0;
        for (int b = 0; b < 4; ++b)
          bits = bits << 8 | static_cast<unsigned char>(datagram.at(place++));
        float value = 0;
        std::memcpy(&value, &bits, sizeof value);
        v[i] = value;
      }
      body[name] = {{v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]}};
    }
  }
  return body;
}

inline const std::vector<std::string>& vmc_names() {
  static const std::vector<std::string> names = {
      "Hips",          "Spine",         "Chest",         "Neck",          "Head",
      "LeftUpperLeg",  "LeftLowerLeg",  "LeftFoot",      "RightUpperLeg", "RightLowerLeg",
      "RightFoot",     "LeftShoulder",  "LeftUpperArm",  "LeftLowerArm",  "LeftHand",
      "RightShoulder", "RightUpperArm", "RightLowerArm", "RightHand"};
  return names;
}

/// The body at frame `f` at 60 Hz: each joint turns about a separate axis, and the root walks.
inline VmcBody vmc_truth(std::size_t f) {
  VmcBody body;
  const double t = static_cast<double>(f) / 60;
  body["root"] = {{0.2 * t, 0, 0}, {1, 0, 0, 0}};
  for (std::size_t b = 0; b < vmc_names().size(); ++b) {
    const double phase = static_cast<double>(b);
    const Vec3 axis{std::sin(phase), std::cos(phase), std::sin(2 * phase)};
    const Vec3 turn = (0.5 * std::sin(3 * t + phase) / norm(axis)) * axis;
    body[vmc_names()[b]] = {{0, 0.1 + 0.01 * phase, 0}, exp(turn)};
  }
  body["Hips"].position = {0.02 * std::sin(6 * t), 0.95, 0};
  return body;
}

/// The same body with noise of `noise_deg` per axis, and 5 mm for root and hips.
inline VmcBody vmc_noisy(std::size_t f, double noise_deg = 1.5) {
  VmcBody body = vmc_truth(f);
  Random random(f);
  const double scale = noise_deg * 3.14159265358979 / 180;
  for (auto& [name, pose] : body) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const Vec3 error{x, y, z};
    pose.rotation = pose.rotation * exp(scale * error);
    if (name == "root" || name == "Hips") pose.position += (0.005 * noise_deg / 1.5) * error;
  }
  return body;
}

/// The messages of a frame in a sender's order: root, bones, a face, the time.
inline std::vector<std::string> vmc_messages(std::size_t f, const VmcBody& body) {
  std::vector<std::string> messages = {vmc_root(body.at("root"))};
  for (const std::string& name : vmc_names()) {
    if (body.count(name) > 0) messages.push_back(vmc_bone(name, body.at(name)));
  }
  messages.push_back(osc_message("/VMC/Ext/Blend/Val", "sf",
                                 osc_text("Joy") + osc_real(static_cast<float>(f % 7) / 7)));
  messages.push_back(osc_message("/VMC/Ext/Blend/Apply", ""));
  messages.push_back(osc_message("/VMC/Ext/T", "f", osc_real(static_cast<float>(f) / 60)));
  return messages;
}
inline std::string vmc_datagram(std::size_t f, const VmcBody& body) {
  return osc_bundle(vmc_messages(f, body), 100 + static_cast<std::uint32_t>(f), 5);
}

/// A datagram with zeroed pose values; the remaining bytes must not change.
inline std::string without_poses(std::string datagram) {
  for (const std::string address : {"/VMC/Ext/Bone/Pos", "/VMC/Ext/Root/Pos"}) {
    for (std::size_t at = 0; (at = datagram.find(address, at)) != datagram.npos; ++at) {
      std::size_t place = datagram.find(',', at);
      place += datagram.substr(place).find('\0') / 4 * 4 + 4;
      place += datagram.substr(place).find('\0') / 4 * 4 + 4;
      datagram.replace(place, 28, std::string(28, '\0'));
    }
  }
  return datagram;
}

/// The largest step of each bone's rotation from one of its poses to the next, degrees.
class VmcSteps {
 public:
  void add(const std::string& datagram) {
    for (const auto& [name, pose] : vmc_poses(datagram)) {
      const auto before = last_.find(name);
      if (before != last_.end()) {
        const double step = angle_between(normalized(before->second), normalized(pose.rotation)) *
                            180 / 3.14159265358979;
        most[name] = std::max(most[name], step);
      }
      last_[name] = pose.rotation;
    }
  }
  std::map<std::string, double> most;

 private:
  std::map<std::string, Quat> last_;
};

}  // namespace kinemend::test
