#include "kinemend/check.hpp"
