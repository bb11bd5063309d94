// Converts joints to markers, applies rest rotations, and refuses what a format cannot hold.
#include "fit_format.hpp"

#include <fmt/format.h>

#include <utility>

#include "kinemend/extend/motion.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

/// The joint positions as markers, in millimetres if the unit is known.
Take as_markers(const Take& take, const FitSettings& settings, std::vector<std::string>& notes) {
  const double metres = settings.keeps_unit ? 0 : metres_per_unit_of(take, notes);
  if (metres == 0) return joint_markers(take, settings.end_sites);
  return joint_markers(in_unit(take, "mm", metres), settings.end_sites);
}

bool becomes_markers(const Take& take, const Format& format, const FitSettings& settings) {
  return take.has_joints() && (format.write == nullptr || settings.positions);
}

}  // namespace

double metres_per_unit_of(const Take& take, std::vector<std::string>& notes) {
  const double metres = likely_metres_per_unit(take);
  const bool is_guess = take.has_joints() && !(take.metres_per_unit > 0) && metres > 0;
  if (is_guess) {
    notes.push_back(
        fmt::format("{}: the unit is taken to be {}: the skeleton then has the size of a person",
                    take.source.name, guess_length_unit(take.skeleton)->name));
  }
  return metres;
}

Take in_unit(const Take& take, const std::string& unit, double metres) {
  if (metres == 0) {
    throw Error(ErrorKind::usage, fmt::format("{}: the unit of its lengths is unknown, so they "
                                              "cannot be converted to {}",
                                              take.source.name, unit));
  }
  const double factor = metres / metres_per_unit(unit);
  if (!take.has_joints()) return scale_lengths(take, factor, unit);
  Take scaled = scale_lengths(take, factor);
  scaled.metres_per_unit = metres_per_unit(unit);
  return scaled;
}

void check_can_fit(const Take& take, const Format& format) {
  if (becomes_markers(take, format, {})) return;
  if (const std::string contents = pointless_text(take);
      !contents.empty() && format.name != take.source.format) {
    throw Error(ErrorKind::usage, fmt::format("{}: {}; {} files hold markers only",
                                              take.source.name, contents, format.name));
  }
  check_can_hold(take.source.name, take, format.name);
}

Take fitted(Take take, const Format& format, const FitSettings& settings,
            std::vector<std::string>& notes) {
  if (becomes_markers(take, format, settings)) return as_markers(take, settings, notes);
  check_can_fit(take, format);
  // BVH has no rest rotations.
  if (take.has_joints() && format.name == "bvh") {
    for (const Quat rest : take.skeleton.rest_rotations) {
      if (!(rest == Quat{})) return without_rest_rotations(take);
    }
  }
  return take;
}

}  // namespace kinemend::cli
