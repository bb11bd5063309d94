// The entry of `auto` in the table of methods.
#pragma once

#include "kinemend/cleaner.hpp"

namespace kinemend {

Method auto_method();

}  // namespace kinemend
