// The entry of `learned` in the table of methods, and its models.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"

namespace kinemend {

inline constexpr ModelKind learned_models{"learned", 1, "kinemend-train"};
Method learned_method();

}  // namespace kinemend
