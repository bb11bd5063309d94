// The entries of `example` in the tables of learned methods and of methods.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/train.hpp"

namespace kinemend {

LearnedMethod example_learned();
Method example_method();

}  // namespace kinemend
