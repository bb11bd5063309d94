// Checks cutoffs against the Nyquist frequency; all methods share the text of the warning.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// A cutoff must be below half the frame rate, or the filter removes nothing.
bool is_below_nyquist(double cutoff_hz, double frame_rate_hz);
/// "cutoff_hz: 100 Hz is not below the Nyquist frequency of 60 Hz (half the frame rate)", the same
/// in every method.
std::string cutoff_warning(std::string_view option, double cutoff_hz, double frame_rate_hz);

}  // namespace kinemend
