#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/options.hpp"
#include "kinemend/random.hpp"

namespace kinemend {

/// What a damage did, as realised by this seed.
struct DamageReport {
  std::string kind;
  std::size_t samples = 0;  ///< joint samples in the clip
  std::size_t samples_damaged = 0;
  double rms_deg = 0;  ///< geodesic, over all joint samples
  double max_deg = 0;
  double rms_position = 0;         ///< of joint positions, file units
  std::vector<std::string> notes;  ///< anything realised otherwise than asked
};

/// An entry of the table of damages.
struct Damage {
  std::string name;     ///< "gaussian", "outliers", ...
  std::string summary;  ///< one line
  std::string paper;    ///< whose definition it is
  std::vector<OptionSpec> options;
  /// Applies to all frames of the clip, in place.
  DamageReport (*apply)(Clip& clip, Random& random, const OptionValues& values);
};

std::span<const Damage> damages();
/// Applies the damage called `name`, leaving calibration frames at the start alone. Damages compose
/// by calling this again. Errors: `ErrorKind::usage` for an unknown name or option or a value out
/// of range.
DamageReport apply_damage(Clip& clip, std::string_view name, const OptionValues& values,
                          Random& random);

}  // namespace kinemend
