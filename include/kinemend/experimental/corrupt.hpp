// Damages takes in known ways, for tests and for training.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/experimental/pose_matrix.hpp"
#include "kinemend/experimental/random.hpp"
#include "kinemend/options.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// What a damage did, as realised by this seed.
struct DamageReport {
  std::string kind;
  std::size_t samples = 0;  ///< of joints or markers; of these the ones that are seen
  std::size_t samples_damaged = 0;
  double rms_deg = 0;  ///< geodesic, over all samples; of positions as an arc
  double max_deg = 0;
  double rms_position = 0;         ///< of joints or markers, file units
  std::vector<std::string> notes;  ///< anything realised otherwise than asked
};

/// Motion of N tracks of three numbers, which is what markers and the sequences that models are
/// trained on have in common.
struct VectorMotion {
  PoseMatrix values;                   ///< F x 3 N
  std::vector<std::uint8_t> observed;  ///< F x N, 1 where seen; anything else stays as it is
  double frame_rate_hz = 0;
  std::vector<std::string> names;         ///< N
  std::vector<std::uint8_t> is_rotation;  ///< N, 1: a rotation vector, 0: a position
  std::vector<std::uint8_t> is_root;      ///< N
  /// What a radian is worth: of rotations the unit of the vectors, of positions an arc that long.
  double per_radian = 1;
  double per_cm = 0;  ///< what a centimetre is worth; 0: not known
  int up_axis = 1;    ///< 0, 1, 2: the axis that points up or down

  std::size_t track_count() const noexcept { return names.size(); }
};

/// An entry of the table of damages.
struct Damage {
  std::string name;     ///< "gaussian", "outliers", ...
  std::string summary;  ///< one line
  std::string paper;    ///< whose definition it is
  std::vector<OptionSpec> options;
  /// Applies to all frames of the clip, in place.
  DamageReport (*apply)(Take& clip, Random& random, const OptionValues& values);
  /// The same where there is no skeleton; nullptr of a damage that needs one. Limbs are single
  /// tracks. Positions are noisy or scaled as they are, about the mean of their frame.
  DamageReport (*apply_to_vectors)(VectorMotion& motion, Random& random,
                                   const OptionValues& values);
};

std::span<const Damage> damages();
/// Applies the damage called `name`. Damages compose by calling this again. Of joints, calibration
/// frames at the start are left alone. Of markers, angles are arcs of a quarter of the body height
/// (`body_height`); those that are not seen, and points that are no positions, stay as they are.
/// Errors: `ErrorKind::usage` for an unknown name or option or a value out of range, and for a
/// damage that needs a skeleton, if the take has none.
DamageReport apply_damage(Take& take, std::string_view name, const OptionValues& values,
                          Random& random);
DamageReport apply_damage(VectorMotion& motion, std::string_view name, const OptionValues& values,
                          Random& random);

}  // namespace kinemend
