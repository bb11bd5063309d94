// The entry of `example` in the table of methods, and its models.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"

namespace kinemend {

inline constexpr ModelKind example_models{"example", 1, "kinemend train"};
Method example_method();

}  // namespace kinemend
