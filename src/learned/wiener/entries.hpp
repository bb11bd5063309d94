// The entries of `wiener` in the tables of learned methods and of methods.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/train.hpp"

namespace kinemend {

LearnedMethod wiener_learned();
Method wiener_method();

}  // namespace kinemend
