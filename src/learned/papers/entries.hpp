// The entries of these methods in the tables of learned methods and of methods.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/train.hpp"

namespace kinemend {

LearnedMethod recurrent_learned();
Method recurrent_method();
LearnedMethod kalman_learned_learned();
Method kalman_learned_method();

}  // namespace kinemend
