// Brings a take into the form that a format can hold.
#pragma once

#include <string>
#include <vector>

#include "kinemend/io.hpp"

namespace kinemend::cli {

/// How joints are converted to markers.
struct FitSettings {
  bool positions = false;   ///< converts even if the format can hold joints
  bool end_sites = false;   ///< includes the positions of end sites
  bool keeps_unit = false;  ///< keeps the unit of the take instead of millimetres
};

/// Metres per unit of length; 0 if unknown. Adds a note about a guess to `notes`, so call it once
/// per take.
double metres_per_unit_of(const Take& take, std::vector<std::string>& notes);
/// The take in another unit. `metres` is the length of the take's unit, 0 if unknown. Errors:
/// `ErrorKind::usage` if it is unknown.
Take in_unit(const Take& take, const std::string& unit, double metres);

/// Refuses a format that can hold neither the take nor the result of `fitted`. Errors:
/// `ErrorKind::usage`.
void check_can_fit(const Take& take, const Format& format);
/// The take in a form that the format can hold: a format of markers gets markers instead of joints.
/// Adds notes for the user to `notes`. Errors: those of `check_can_fit`.
Take fitted(Take take, const Format& format, const FitSettings& settings,
            std::vector<std::string>& notes);

}  // namespace kinemend::cli
