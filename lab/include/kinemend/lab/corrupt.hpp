// Damages takes in known ways, for tests and for training.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/options.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The damage that was applied, as realised with this seed.
struct DamageReport {
  std::string kind;
  std::size_t samples = 0;  ///< samples of joints, or observed samples of markers
  std::size_t samples_damaged = 0;
  double rms_deg = 0;  ///< geodesic, over all samples; positions as an arc
  double max_deg = 0;
  double rms_position = 0;         ///< for positions of joints or markers, file units
  std::vector<std::string> notes;  ///< differences from the requested damage
};

/// Motion of N tracks of three numbers, the form shared by markers and the sequences that models
/// are trained on.
struct VectorMotion {
  PoseMatrix values;                   ///< F x 3 N
  std::vector<std::uint8_t> observed;  ///< F x N, 1 if observed; other samples are not changed
  double frame_rate_hz = 0;
  std::vector<std::string> names;         ///< N
  std::vector<std::uint8_t> is_rotation;  ///< N, 1: a rotation vector, 0: a position
  std::vector<std::uint8_t> is_root;      ///< N
  /// The value of a radian: in rotation vectors their unit, in positions the length of an arc.
  double per_radian = 1;
  double per_cm = 0;  ///< the value of a centimetre; 0: not known
  int up_axis = 1;    ///< 0, 1, 2: the axis that points up or down

  std::size_t track_count() const noexcept { return names.size(); }
};

/// An entry of the table of damages.
struct Damage {
  std::string name;     ///< "gaussian", "outliers", ...
  std::string summary;  ///< one line
  std::string paper;    ///< the paper that defines it
  std::vector<OptionSpec> options;
  /// Applies to all frames of the clip, in place.
  DamageReport (*apply)(Take& clip, Random& random, const OptionValues& values);
  /// Applies the damage without a skeleton; nullptr if the damage needs one. Limbs are single
  /// tracks. Noise and scaling apply to positions directly, about the mean of their frame.
  DamageReport (*apply_to_vectors)(VectorMotion& motion, Random& random,
                                   const OptionValues& values);
};

std::span<const Damage> damages();
/// Applies the damage called `name`. Damages are combined by calling this again. In takes of
/// joints, calibration frames at the start are left alone. For markers, angles are arcs with a
/// radius of a quarter of the body height (`body_height`); missing markers and points that are not
/// positions are not changed. Errors: `ErrorKind::usage` for an unknown name or option or a value
/// out of range, and for a damage that needs a skeleton, if the take has none.
DamageReport apply_damage(Take& take, std::string_view name, const OptionValues& values,
                          Random& random);
DamageReport apply_damage(VectorMotion& motion, std::string_view name, const OptionValues& values,
                          Random& random);

}  // namespace kinemend
