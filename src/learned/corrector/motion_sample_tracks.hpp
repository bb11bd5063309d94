// What is done to the tracks of a training sample, of joints or of markers.
#pragma once

#include "learned/corrector/motion_samples.hpp"

namespace kinemend {

/// The channel is 0 throughout, which is to the network as if it were not there.
void stand_still(MotionSample& sample, std::size_t channel);

/// Each track but one with this chance.
void lose_whole_tracks(MotionSample& sample, double share, Random& random);

/// Of a sample at this rate.
std::size_t sample_frames(const MotionSampling& sampling, double rate_hz);

}  // namespace kinemend
