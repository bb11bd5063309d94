// Noise of a given spectrum, and random paths, the same at every frame rate.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::corrupt {

/// One-sided power spectral density proportional to (1 + (f / corner_hz)^2)^(-slope / 2): flat up
/// to the corner, falling by 3 `slope` dB an octave above it.
struct NoiseShape {
  double corner_hz = 1;  ///< above 0
  double slope = 2;      ///< above 1, so that the variance over all frequencies is finite
};

/// Returns the density (1/Hz) at `frequency_hz` of a process of unit variance over [0, infinity).
double noise_density(NoiseShape shape, double frequency_hz);

/// Returns stationary Gaussian noise with that density up to half the rate and nothing above, as
/// the sum of its harmonics over a period longer than the take. Frequencies that a rate cannot hold
/// are left out, not folded: the density below them does not depend on the rate. Rates that differ
/// by powers of two give the same harmonics from the same generator. Rates above 1,000 Hz are
/// treated as 1,000 Hz.
std::vector<double> coloured_noise(NoiseShape shape, std::size_t frames, double rate_hz,
                                   const Random& random);
/// Returns such noise independently along each axis.
std::vector<Vec3> coloured_vectors(NoiseShape shape, std::size_t frames, double rate_hz,
                                   const Random& random);

/// Returns the integral of slow noise: a path that starts at zero and has a standard deviation of
/// sqrt(t / 60 s) after t seconds, without steps from frame to frame.
std::vector<double> random_path(std::size_t frames, double rate_hz, const Random& random);

}  // namespace kinemend::corrupt
