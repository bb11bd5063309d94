// The entries of the table of trainings. The file of each training defines its own.
#pragma once

#include "kinemend/lab/train.hpp"

namespace kinemend {

Training example_training();
Training kalman_learned_training();
Training sparse_training();
Training wiener_training();

}  // namespace kinemend
