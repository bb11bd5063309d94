#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/train.hpp"

// The entries of `example` in the tables of learned methods and of methods.
namespace kinemend {

LearnedMethod example_learned();
Method example_method();

}  // namespace kinemend
