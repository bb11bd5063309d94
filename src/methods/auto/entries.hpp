#pragma once

#include "kinemend/cleaner.hpp"

// The entry of `auto` in the table of methods.
namespace kinemend {

Method auto_method();

}  // namespace kinemend
