// Writes the skeleton of a take as an ASF file.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "io/acclaim/amc_document.hpp"
#include "io/acclaim/asf.hpp"
#include "io/acclaim/asf_plan.hpp"
#include "io/motion/motion_write.hpp"
#include "io/text/text_buffer.hpp"

namespace kinemend {

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
  void numbers(std::initializer_list<double> values) {
    for (const double value : values) {
      out_.append(" ");
      out_.append_shortest(value);
    }
  }

  // Writes Euler angles for the letters XYZ: rotations about fixed axes, x first.
  void axis_angles(Quat axis) {
    const std::array<double, 3> zyx = to_euler(axis, parse_rotation_order("ZYX"));
    numbers(
        {zyx[2] * degrees_per_radian, zyx[1] * degrees_per_radian, zyx[0] * degrees_per_radian});
  }

  void dof_names(const std::vector<AsfDof>& dofs) {
    constexpr std::array<std::string_view, 6> names{"tx", "ty", "tz", "rx", "ry", "rz"};
    for (const AsfDof& dof : dofs) {
      out_.append(" ");
      out_.append(dof ? names[static_cast<std::size_t>(*dof)] : "l");
    }
  }

  void write_head() {
    out_.append(":version 1.10\n:name skeleton\n:units\n  mass 1\n  length");
    numbers({metres_per_unit_ > 0 ? 0.0254 / metres_per_unit_ : 1});
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
    numbers({direction.x, direction.y, direction.z});
    out_.append("\n    length");
    numbers({length});
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
