#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/pose_matrix.hpp"
#include "priors/example_prior.hpp"

// Filter bases of a noisy take itself (named as future work by Lou & Chai 2010, section 5).
namespace kinemend {

/// The rate at which the bases of a take are learned: its own, divided by a whole number so that it
/// is about 30 Hz.
double self_rate_hz(double clip_rate_hz);

/// Bases of `poses`, in which spikes and gaps have been replaced, with white noise of standard
/// deviation `noise` in each channel (L, degrees, > 0). In channels whose noise is 1, chance
/// patterns have variances up to the edge (1 + sqrt(g))^2 of Marchenko and Pastur, g twice the
/// values of a window over the frames of the take; patterns beyond it are kept, their variances
/// without what noise adds to them (Baik & Silverstein 2006). None where the take is too short, or
/// nothing stands out: `bases.count` is then 0. `clean`: the take has been filtered already; its
/// patterns are those with the `clean` largest variances, taken as they are. 0: it has not.
ExamplePrior self_bases(const PoseMatrix& poses, double clip_rate_hz, std::span<const double> noise,
                        std::size_t clean = 0);

}  // namespace kinemend
