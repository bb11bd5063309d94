// Compares a length with the usual units.
#include "motion/unit_name.hpp"

#include <cmath>

#include "kinemend/take.hpp"

namespace kinemend {

std::string unit_name(double metres) {
  for (const char* const name : {"m", "cm", "mm", "in"}) {
    const double known = metres_per_unit(name);
    if (std::fabs(metres - known) <= 1e-9 * known) return name;
  }
  return "";
}

}  // namespace kinemend
