#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/train.hpp"

// The entries of `sparse` in the tables of learned methods and of methods.
namespace kinemend {

LearnedMethod sparse_learned();
Method sparse_method();

}  // namespace kinemend
