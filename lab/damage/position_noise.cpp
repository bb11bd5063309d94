// Damages that add noise to positions, by a deviation or a signal-to-noise ratio, and refit the
// skeleton to them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "lab/damage/body_parts.hpp"
#include "lab/damage/damage_kind.hpp"
#include "lab/damage/position_targets.hpp"

namespace kinemend::corrupt {

namespace {

// Adds Gaussian noise with the given deviation to each joint. A joint's noise does not depend on
// other joints.
void add_noise(std::vector<Vec3>& positions, std::size_t joint_count,
               const std::vector<double>& deviations, const Random& random) {
  for (std::size_t j = 0; j < joint_count; ++j) {
    if (deviations[j] == 0) continue;
    Random own = random.fork(j);
    for (std::size_t i = j; i < positions.size(); i += joint_count) {
      const double x = own.normal(), y = own.normal(), z = own.normal();
      positions[i] += deviations[j] * Vec3{x, y, z};
    }
  }
}

void add_noise(VectorMotion& motion, const std::vector<double>& deviations, const Random& random) {
  for (std::size_t n = 0; n < deviations.size(); ++n) {
    if (deviations[n] == 0 || motion.is_rotation[n] != 0) continue;
    Random own = random.fork(n);
    for (std::size_t f = 0; f < frame_count(motion); ++f) {
      const double x = own.normal(), y = own.normal(), z = own.normal();
      if (is_observed(motion, f, n))
        set_vector(motion, f, n, vector_at(motion, f, n) + deviations[n] * Vec3{x, y, z});
    }
  }
}

struct PositionNoise {
  static constexpr auto name = "position-noise";
  static constexpr auto summary =
      "Gaussian noise on joint positions, refitted to rotations with bone lengths kept";
  static constexpr auto paper = "Mall et al. 2017, section 4 (\"spatial\" noise, 0.5 cm)";
  struct Options : TargetOptions {
    Options() { root = false; }
    double std_cm = 0.5;
    double cm_per_unit = 0;
    std::string spread = "same";
    double ends_factor = 3;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::std_cm, "std_cm", "cm", 0, 1e6, "standard deviation along each axis");
      t.number(&Options::cm_per_unit, "cm_per_unit", "cm", 0, 1e9,
               "length of a file unit; 0: the usual unit that makes the skeleton a person, else "
               "such that it is 170 cm tall");
      t.choice(&Options::spread, "spread", {"same", "ends"},
               "same: the same noise at all joints; ends: larger at wrists and ankles");
      t.number(&Options::ends_factor, "ends_factor", "", 0, 1000, "how many times larger there");
      return add_target_options(t);
    }();
    return options;
  }
  static void damage(Take& clip, const Random& random, const Options& options, Notes& notes) {
    const double scale =
        options.cm_per_unit > 0 ? options.cm_per_unit : usual_cm_per_unit(clip.skeleton, notes);
    std::vector<double> deviations(clip.joint_count(), 0.0);
    for (const std::size_t j : position_joints(clip.skeleton, options))
      deviations[j] = options.std_cm / scale;
    spread(clip.skeleton.names, options, deviations, notes);
    std::vector<Vec3> targets = joint_positions(clip);
    add_noise(targets, clip.joint_count(), deviations, random);
    refit_to(clip, targets, options);
  }
  // Damages positions only.
  static void damage(VectorMotion& motion, const Random& random, const Options& options,
                     Notes& notes) {
    const double per_cm = options.cm_per_unit > 0 ? 1 / options.cm_per_unit : motion.per_cm;
    if (!(per_cm > 0))
      throw Error(ErrorKind::usage, "cm_per_unit: the length of a centimetre is not known here");
    if (options.cm_per_unit <= 0)
      notes.push_back(fmt::format("a file unit is taken as {:.4g} cm", 1 / per_cm));
    std::vector<double> deviations(motion.track_count(), 0.0);
    for (const std::size_t n : target_tracks(motion, options))
      deviations[n] = options.std_cm * per_cm;
    spread(motion.names, options, deviations, notes);
    add_noise(motion, deviations, random);
  }
  static void spread(const std::vector<std::string>& names, const Options& options,
                     std::vector<double>& deviations, Notes& notes) {
    if (options.spread != "ends") return;
    const auto ends = wrists_and_ankles(names);
    if (ends.empty())
      notes.emplace_back("no wrist or ankle found by name: the noise is the same at all joints");
    for (const std::size_t j : ends) deviations[j] *= options.ends_factor;
  }
};

// Returns the mean square of a coordinate of the listed joints, relative to joint 0.
double signal_power(const std::vector<Vec3>& positions, std::size_t joint_count,
                    const std::vector<std::size_t>& joints) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t frame = 0; frame < positions.size(); frame += joint_count) {
    for (const std::size_t j : joints) {
      if (j == 0) continue;
      const Vec3 p = positions[frame + j] - positions[frame];
      sum += dot(p, p);
      count += 3;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double realised_snr_db(double power, const std::vector<Vec3>& clean, const std::vector<Vec3>& noisy,
                       std::size_t joint_count, const std::vector<std::size_t>& joints) {
  double sum = 0;
  for (std::size_t frame = 0; frame < clean.size(); frame += joint_count) {
    for (const std::size_t j : joints) {
      const Vec3 d = noisy[frame + j] - clean[frame + j];
      sum += dot(d, d);
    }
  }
  const std::size_t frames = clean.size() / joint_count;
  const auto terms = static_cast<double>(3 * joints.size() * frames);
  return 10 * portable::log10(power * terms / sum);
}

struct Snr {
  static constexpr auto name = "snr";
  static constexpr auto summary =
      "Gaussian noise on joint positions at a signal-to-noise ratio, refitted to rotations";
  static constexpr auto paper = "Xiao et al. 2015, section 4 (40, 30, 20, 10 dB)";
  struct Options : TargetOptions {
    Options() { root = false; }
    double snr_db = 20;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::snr_db, "snr_db", "dB", -40, 200,
               "10 log10 of the mean square of joint positions relative to the root over that of "
               "the noise");
      return add_target_options(t);
    }();
    return options;
  }
  static void damage(Take& clip, const Random& random, const Options& options, Notes& notes) {
    const auto joints = position_joints(clip.skeleton, options);
    const std::vector<Vec3> clean = joint_positions(clip);
    const double power = signal_power(clean, clip.joint_count(), joints);
    if (power == 0) {
      notes.emplace_back("all joints lie at the root: there is no signal to scale the noise by");
      return;
    }
    std::vector<double> deviations(clip.joint_count(), 0.0);
    for (const std::size_t j : joints)
      deviations[j] = std::sqrt(power * portable::pow(10, -options.snr_db / 10));
    std::vector<Vec3> targets = clean;
    add_noise(targets, clip.joint_count(), deviations, random);
    refit_to(clip, targets, options);
    notes.push_back(fmt::format(
        "{:.2f} dB before the bones have their lengths again, {:.2f} dB after",
        realised_snr_db(power, clean, targets, clip.joint_count(), joints),
        realised_snr_db(power, clean, joint_positions(clip), clip.joint_count(), joints)));
  }
  // Damages positions only; their power is measured about the mean of their frame.
  static void damage(VectorMotion& motion, const Random& random, const Options& options,
                     Notes& notes) {
    const auto tracks = target_tracks(motion, options);
    double sum = 0, count = 0;
    for (std::size_t f = 0; f < frame_count(motion); ++f) {
      const Vec3 mean = mean_position(motion, f);
      for (const std::size_t n : tracks) {
        if (motion.is_rotation[n] != 0 || !is_observed(motion, f, n)) continue;
        const Vec3 p = vector_at(motion, f, n) - mean;
        sum += dot(p, p);
        count += 3;
      }
    }
    if (sum == 0) {
      notes.emplace_back("all positions are one: there is no signal to scale the noise by");
      return;
    }
    std::vector<double> deviations(motion.track_count(), 0.0);
    for (const std::size_t n : tracks)
      deviations[n] = std::sqrt(sum / count * portable::pow(10, -options.snr_db / 10));
    add_noise(motion, deviations, random);
  }
};

}  // namespace

void add_position_noise(std::vector<Damage>& table) {
  table.push_back(entry<Snr>());
  table.push_back(entry<PositionNoise>());
}

}  // namespace kinemend::corrupt
