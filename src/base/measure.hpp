// Measured values with units, for people.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// In what unit noise, changes and errors are shown: in metres they would begin with zeros.
struct ShownUnit {
  double factor = 1;  ///< from the unit that was measured in
  std::string name;   ///< "mm" of "m"; others as they are, "units" of a length without one
};
ShownUnit shown_unit(std::string_view unit);

/// "6.95 mm" of 0.00695 m, "1.78 m", "1.50 deg", "12.5 units".
std::string measure_text(double value, std::string_view unit);

}  // namespace kinemend
