// The entry of `recurrent` in the table of methods, and its models.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"

namespace kinemend {

inline constexpr ModelKind recurrent_models{"recurrent", 1, "kinemend-train"};
Method recurrent_method();

}  // namespace kinemend
