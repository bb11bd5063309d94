// The entry of `bilateral` in the table of methods.
#pragma once

#include "kinemend/cleaner.hpp"

namespace kinemend {

Method bilateral_method();

}  // namespace kinemend
