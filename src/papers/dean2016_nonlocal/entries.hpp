// The entry of `nonlocal` in the table of methods.
#pragma once

#include "kinemend/cleaner.hpp"

namespace kinemend {

Method nonlocal_method();

}  // namespace kinemend
