// The entry of `wiener` in the table of methods, and its models.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"

namespace kinemend {

inline constexpr ModelKind wiener_models{"wiener", 1, "kinemend train"};
Method wiener_method();

}  // namespace kinemend
