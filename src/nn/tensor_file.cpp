#include "kinemend/tensor.hpp"
