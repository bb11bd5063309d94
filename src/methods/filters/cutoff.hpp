// Checks cutoffs against the Nyquist frequency and words the warning in one way for all methods.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// Only a cutoff below half the frame rate leaves a filter something to take away.
bool is_below_nyquist(double cutoff_hz, double frame_rate_hz);
/// "cutoff_hz: 100 Hz is not below the Nyquist frequency of 60 Hz (half the frame rate)", the same
/// in every method.
std::string cutoff_warning(std::string_view option, double cutoff_hz, double frame_rate_hz);

}  // namespace kinemend
