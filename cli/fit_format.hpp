// Brings a take into the form that a format can hold.
#pragma once

#include <string>
#include <vector>

#include "kinemend/io.hpp"

namespace kinemend::cli {

/// How joints become markers.
struct FitSettings {
  bool positions = false;   ///< also for a format that can hold the joints
  bool end_sites = false;   ///< with the positions of end sites
  bool keeps_unit = false;  ///< in the unit of the take instead of millimetres
};

/// Metres per unit of length; 0 where nothing tells. A guess is added to `notes`, so ask once a
/// take.
double metres_per_unit_of(const Take& take, std::vector<std::string>& notes);
/// The take in another unit. `metres`: per unit of the take, 0 where it is unknown. Errors:
/// `ErrorKind::usage` where it is unknown.
Take in_unit(const Take& take, const std::string& unit, double metres);

/// Refuses a format that can hold neither the take nor what `fitted` makes of it. Errors:
/// `ErrorKind::usage`.
void check_can_fit(const Take& take, const Format& format);
/// The take in the form that the format can hold: joints become markers in a format of markers.
/// Adds notes for the user to `notes`. Errors: as of `check_can_fit`.
Take fitted(Take take, const Format& format, const FitSettings& settings,
            std::vector<std::string>& notes);

}  // namespace kinemend::cli
