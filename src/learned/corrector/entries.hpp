// The entries of `learned` in the tables of learned methods and of methods.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/train.hpp"

namespace kinemend {

LearnedMethod learned_learned();
Method learned_method();

}  // namespace kinemend
