// Chooses the unit in which a value is shown.
#include "base/measure.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kinemend/experimental/text.hpp"

namespace kinemend {

ShownUnit shown_unit(std::string_view unit) {
  constexpr double mm_per_m = 1000;
  if (unit == "m") return {mm_per_m, "mm"};
  return {1, unit.empty() ? "units" : std::string(unit)};
}

std::string measure_text(double value, std::string_view unit) {
  // Shorter lengths are shown in millimetres. Chosen by hand.
  constexpr double small_m = 0.1;
  const bool is_long = unit == "m" && std::fabs(value) >= small_m;
  const ShownUnit shown = is_long ? ShownUnit{1, "m"} : shown_unit(unit);
  return fmt::format("{} {}", figure(shown.factor * value), shown.name);
}

}  // namespace kinemend
