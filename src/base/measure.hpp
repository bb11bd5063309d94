// Formats measured values with units.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// The unit in which noise, changes and errors are shown: in metres they would begin with zeros.
struct ShownUnit {
  double factor = 1;  ///< from the unit of the measurement
  std::string name;   ///< "mm" for "m"; other units are kept, "units" for a length without one
};
ShownUnit shown_unit(std::string_view unit);

/// Returns "6.95 mm" for 0.00695 m, "1.78 m", "1.50 deg", "12.5 units".
std::string measure_text(double value, std::string_view unit);

}  // namespace kinemend
