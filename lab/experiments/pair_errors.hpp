// The errors of one of two systems that captured the same motion.
#pragma once

namespace kinemend::papers {

/// Root mean squares of the error, of its velocity, and of its part above 6 Hz.
struct PairErrors {
  double value = 0, velocity = 0, fast = 0;
};

}  // namespace kinemend::papers
