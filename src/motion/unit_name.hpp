// Names a unit of length by its size.
#pragma once

#include <string>

namespace kinemend {

/// The usual name of a unit of length of so many metres; empty for lengths that have none.
std::string unit_name(double metres);

}  // namespace kinemend
