// Bounds what the learned cleaner takes out of a track by the noise floor of that track.
//
// Noise is there all the time: what a cleaner takes out of a noisy track has a floor, which the
// quiet moments show. What it takes out of a clean track of a body that it has never seen is found
// at a few moments only: fast moves, ends, steps. So a moment loses at most a multiple of what the
// quieter moments of its track lose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "learned/corrector/motion_filter.hpp"

namespace kinemend {

/// Length of the windows over which removals are averaged, seconds. Chosen on takes of other worlds
/// (docs/methods/learned.md): 1 s lets markers lose three times as much.
inline constexpr double floor_window_s = 0.5;
/// The share of the windows of a track that are quieter than its floor. A tenth keeps less of what
/// video systems make and protects no take more; a half lets gestures lose 1.7 degrees.
inline constexpr double floor_share = 0.25;
/// What a moment may lose, in floors of its track. Three lets fast markers lose half as much again.
inline constexpr double most_floors = 2;
/// The shortest take in which slow noise shows a floor on tracks that neither the model knows nor
/// the measurement finds noisy, seconds: a dash of three seconds is fast from its first frame to
/// its last.
inline constexpr double shortest_floor_s = 4;
/// A window is taken for a burst of noise when the lower quartile of its squared changes within a
/// 60th of a second, halved, exceeds this share of its mean square. White noise has 0.4, noise with
/// a correlation of 0.8 at 120 Hz 0.14; a step, a flip and a fast move have less than 0.1.
inline constexpr double least_burst_share = 0.2;
/// Below this rate changes within a 60th of a second cannot be seen, hertz.
inline constexpr double lowest_burst_rate_hz = 50;
/// Below that rate, in takes that are shorter than `shortest_floor_s`, a fast keyed move measures
/// as noise. A system's noise is on most of the joints, a fast move on few: at least this share of
/// the joints that turn has to be noisy. Of 27 clean clips that were measured to be noisy 25 had
/// 0.07 to 0.43; takes under white noise of 0.3 degrees have 1.
inline constexpr double least_noisy_share = 0.5;

/// Brings each track of `result` (channels 3 n to 3 n + 2) towards `take.values` where it takes out
/// more, within half a second, than the larger of
///
/// - `most_floors` times the floor of the track: the lower quartile over its windows, if the model
///   knows the track, or the measured noise asks for a change of it, or the take is long enough;
/// - what the smoothing by the measured noise (`take.measured`) takes out there, unless that may be
///   fast motion (`least_noisy_share`);
/// - everything, where it is a burst of white noise.
///
/// `is_known`: one a track, 1 where the model knows its joint. Deviations stay. Returns for each
/// track the root mean square of what was put back, per axis, degrees.
std::vector<double> keep_to_noise_floor(const MotionTake& take,
                                        std::span<const std::uint8_t> is_known,
                                        MotionResult& result);

}  // namespace kinemend
