#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corrupt/damage_kind.hpp"
#include "kinemend/error.hpp"
#include "kinemend/kinematics.hpp"
#include "motion/calibration.hpp"

namespace kinemend {

namespace corrupt {

namespace {

void measure_rotations(const Clip& before, const Clip& after, DamageReport& report) {
  double sum = 0;
  const std::size_t joints = before.joint_count();
  for (std::size_t i = 0; i < before.local_rotations.size(); ++i) {
    const Quat old = before.local_rotations[i], now = after.local_rotations[i];
    const bool lost =
        before.is_observed(i / joints, i % joints) && !after.is_observed(i / joints, i % joints);
    if (lost || !(old == now)) ++report.samples_damaged;
    const double angle = degrees_per_radian * angle_between(old, now);
    sum += angle * angle;
    report.max_deg = std::max(report.max_deg, angle);
  }
  report.samples = before.local_rotations.size();
  if (report.samples > 0) report.rms_deg = std::sqrt(sum / static_cast<double>(report.samples));
}

void measure_positions(const Clip& before, const Clip& after, DamageReport& report) {
  const auto old = joint_positions(before), now = joint_positions(after);
  double sum = 0;
  for (std::size_t i = 0; i < old.size(); ++i) sum += dot(now[i] - old[i], now[i] - old[i]);
  if (!old.empty()) report.rms_position = std::sqrt(sum / static_cast<double>(old.size()));
}

}  // namespace

DamageReport measured(std::string kind, Clip& clip, const std::function<void(Notes&)>& damage) {
  DamageReport report;
  report.kind = std::move(kind);
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): `damage` changes `clip`
  const Clip before = clip;
  damage(report.notes);
  measure_rotations(before, clip, report);
  measure_positions(before, clip, report);
  return report;
}

}  // namespace corrupt

std::span<const Damage> damages() {
  static const std::vector<Damage> table = [] {
    std::vector<Damage> list;
    corrupt::add_rotation_noise(list);
    corrupt::add_biases(list);
    corrupt::add_outliers(list);
    corrupt::add_position_noise(list);
    corrupt::add_gaps(list);
    return list;
  }();
  return table;
}

namespace {

const Damage& find_damage(std::string_view name) {
  const auto table = damages();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Damage& d) { return d.name == name; });
  if (found != table.end()) return *found;
  std::string names;
  for (const Damage& damage : table) names += (names.empty() ? "" : ", ") + damage.name;
  throw Error(ErrorKind::usage, fmt::format("unknown damage \"{}\"; there are {}", name, names));
}

}  // namespace

DamageReport apply_damage(Clip& clip, std::string_view name, const OptionValues& values,
                          Random& random) {
  const Damage& damage = find_damage(name);
  const std::size_t calibration = leading_calibration_frames(clip);
  DamageReport report;
  on_motion(clip, calibration,
            [&](Clip& motion) { report = damage.apply(motion, random, values); });
  if (calibration == 0) return report;
  report.notes.push_back(
      fmt::format("the first {} (a calibration pose) stays as it is",
                  calibration == 1 ? "frame" : fmt::format("{} frames", calibration)));
  return report;
}

}  // namespace kinemend
