// The table of damages: applies one by its name, and measures how much it changed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "lab/damage/damage_kind.hpp"
#include "lab/damage/targets.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace corrupt {

namespace {

void measure_rotations(const Take& before, const Take& after, DamageReport& report) {
  double sum = 0;
  const std::size_t joints = before.joint_count();
  for (std::size_t i = 0; i < before.rotations.size(); ++i) {
    const Quat old = before.rotations[i], now = after.rotations[i];
    const bool lost =
        before.is_observed(i / joints, i % joints) && !after.is_observed(i / joints, i % joints);
    if (lost || !(old == now)) ++report.samples_damaged;
    const double angle = degrees_per_radian * angle_between(old, now);
    sum += angle * angle;
    report.max_deg = std::max(report.max_deg, angle);
  }
  report.samples = before.rotations.size();
  if (report.samples > 0) report.rms_deg = std::sqrt(sum / static_cast<double>(report.samples));
}

void measure_positions(const Take& before, const Take& after, DamageReport& report) {
  const auto old = joint_positions(before), now = joint_positions(after);
  double sum = 0;
  for (std::size_t i = 0; i < old.size(); ++i) sum += dot(now[i] - old[i], now[i] - old[i]);
  if (!old.empty()) report.rms_position = std::sqrt(sum / static_cast<double>(old.size()));
}

}  // namespace

DamageReport measured(std::string kind, Take& clip, const std::function<void(Notes&)>& damage) {
  DamageReport report;
  report.kind = std::move(kind);
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): `damage` changes `clip`
  const Take before = clip;
  damage(report.notes);
  measure_rotations(before, clip, report);
  measure_positions(before, clip, report);
  return report;
}

namespace {

// Returns a sample's change in radians: the angle between rotations, or a position's distance as an
// arc.
double turn_between(const VectorMotion& motion, std::size_t track, Vec3 old, Vec3 now) {
  if (motion.is_rotation[track] == 0) return norm(now - old) / motion.per_radian;
  return angle_between(exp((1 / motion.per_radian) * old), exp((1 / motion.per_radian) * now));
}

}  // namespace

DamageReport measured(std::string kind, VectorMotion& motion,
                      const std::function<void(Notes&)>& damage) {
  DamageReport report;
  report.kind = std::move(kind);
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): `damage` changes `motion`
  const VectorMotion before = motion;
  damage(report.notes);
  double turns = 0, distances = 0;
  std::size_t positions = 0;
  for (std::size_t f = 0; f < before.values.frames; ++f) {
    for (std::size_t n = 0; n < before.track_count(); ++n) {
      if (!is_observed(before, f, n)) continue;
      ++report.samples;
      const bool lost = !is_observed(motion, f, n);
      const Vec3 old = vector_at(before, f, n), now = vector_at(motion, f, n);
      if (lost || !(old == now)) ++report.samples_damaged;
      const double angle = degrees_per_radian * turn_between(motion, n, old, now);
      turns += angle * angle;
      report.max_deg = std::max(report.max_deg, angle);
      if (before.is_rotation[n] != 0) continue;
      ++positions;
      distances += dot(now - old, now - old);
    }
  }
  if (report.samples > 0) report.rms_deg = std::sqrt(turns / static_cast<double>(report.samples));
  if (positions > 0) report.rms_position = std::sqrt(distances / static_cast<double>(positions));
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
    corrupt::add_lower_rates(list);
    corrupt::add_systems(list);
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

DamageReport damage_joints(Take& clip, std::string_view name, const OptionValues& values,
                           Random& random) {
  const Damage& damage = find_damage(name);
  const std::size_t calibration = leading_calibration_frames(clip);
  DamageReport report;
  on_motion(clip, calibration,
            [&](Take& motion) { report = damage.apply(motion, random, values); });
  if (calibration == 0) return report;
  report.notes.push_back(
      fmt::format("the first {} (a calibration pose) stays as it is",
                  calibration == 1 ? "frame" : fmt::format("{} frames", calibration)));
  return report;
}

// Returns the markers that are positions.
std::vector<std::size_t> position_markers(const Take& clip) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m)) markers.push_back(m);
  }
  return markers;
}

VectorMotion vectors_of(const Take& clip, const std::vector<std::size_t>& markers) {
  const double height = body_height(clip), unit_m = metres_per_unit(clip.unit);
  VectorMotion motion;
  motion.values = PoseMatrix(clip.frame_count(), 3 * markers.size());
  motion.frame_rate_hz = clip.frame_rate_hz;
  motion.is_rotation.assign(markers.size(), 0);
  motion.is_root.assign(markers.size(), 0);
  motion.per_radian = height / 4;
  motion.per_cm = unit_m > 0 ? 0.01 / unit_m : height / corrupt::usual_height_cm;
  motion.up_axis = static_cast<int>(guess_up_axis(clip));
  for (const std::size_t m : markers) motion.names.push_back(clip.names[m]);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t n = 0; n < markers.size(); ++n) {
      corrupt::set_vector(motion, f, n, clip.position(f, markers[n]));
      motion.observed.push_back(clip.is_observed(f, markers[n]) ? 1 : 0);
    }
  }
  return motion;
}

void put_back(const VectorMotion& motion, const std::vector<std::size_t>& markers, Take& clip) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t n = 0; n < markers.size(); ++n) {
      if (!clip.is_observed(f, markers[n])) continue;
      const bool seen = corrupt::is_observed(motion, f, n);
      const std::size_t i = f * clip.marker_count() + markers[n];
      clip.positions[i] = seen ? corrupt::vector_at(motion, f, n) : Vec3{};
      clip.observed[i] = seen ? 1 : 0;
      if (!seen && !clip.residuals.empty()) clip.residuals[i] = -1;
    }
  }
}

DamageReport damage_markers(Take& clip, std::string_view name, const OptionValues& values,
                            Random& random) {
  const std::vector<std::size_t> markers = position_markers(clip);
  VectorMotion motion = vectors_of(clip, markers);
  DamageReport report = apply_damage(motion, name, values, random);
  put_back(motion, markers, clip);
  return report;
}

}  // namespace

DamageReport apply_damage(VectorMotion& motion, std::string_view name, const OptionValues& values,
                          Random& random) {
  const Damage& damage = find_damage(name);
  if (damage.apply_to_vectors == nullptr) {
    throw Error(ErrorKind::usage,
                fmt::format("damage {} turns the joints of a skeleton, and here is none", name));
  }
  return damage.apply_to_vectors(motion, random, values);
}

DamageReport apply_damage(Take& take, std::string_view name, const OptionValues& values,
                          Random& random) {
  return take.has_joints() ? damage_joints(take, name, values, random)
                           : damage_markers(take, name, values, random);
}

}  // namespace kinemend
