// The entry of `sparse` in the table of methods, and its models.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"

namespace kinemend {

inline constexpr ModelKind sparse_models{"sparse", 1, "kinemend train"};
Method sparse_method();

}  // namespace kinemend
