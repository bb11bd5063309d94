// The entries of `sparse` in the tables of learned methods and of methods.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/train.hpp"

namespace kinemend {

LearnedMethod sparse_learned();
Method sparse_method();

}  // namespace kinemend
