// Runs a linear filter on the channels of a take's tracks, several tracks side by side. Checks
// cutoffs against the Nyquist frequency; all methods share the text of the warning.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "cleaner/pieces.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

enum class ChannelChoice {
  quaternion,  ///< for linear filters: they commute with rotating the frame on either side
  suitable     ///< tangent space if the joint allows it: the noise is uniform there
};

/// Runs `filter` in place on the channels of the changeable tracks, and passes these to `sink`. It
/// gets up to eight pieces over the same frames at a time, side by side: for positions three
/// channels each, from their first sample on. Blocks run in parallel.
void filter_channels(const TakeView& take, ChannelChoice choice, const TrackSink& sink,
                     const std::function<void(double)>& tell,
                     const std::function<void(PoseMatrix&)>& filter);
/// The same for one piece, with rotations as channels of quaternions.
void filter_channels(Piece<Quat>& piece, const std::function<void(PoseMatrix&)>& filter);
void filter_channels(Piece<Vec3>& piece, const std::function<void(PoseMatrix&)>& filter);

/// A cutoff must be below half the frame rate, or the filter removes nothing.
bool is_below_nyquist(double cutoff_hz, double frame_rate_hz);
/// "cutoff_hz: 100 Hz is not below the Nyquist frequency of 60 Hz (half the frame rate)", the same
/// in every method.
std::string cutoff_warning(std::string_view option, double cutoff_hz, double frame_rate_hz);

}  // namespace kinemend
