#pragma once

#include "kinemend/train.hpp"

// Each kind of model defines its entry in the table of training methods; `train.cpp` lists them.
namespace kinemend {

TrainMethod example_training();
TrainMethod wiener_training();
TrainMethod kalman_learned_training();

}  // namespace kinemend
