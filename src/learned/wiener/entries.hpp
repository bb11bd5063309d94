#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/train.hpp"

// The entries of `wiener` in the tables of learned methods and of methods.
namespace kinemend {

LearnedMethod wiener_learned();
Method wiener_method();

}  // namespace kinemend
