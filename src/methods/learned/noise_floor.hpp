// Bounds the removals of the learned cleaner by the noise that the take shows, for whole takes and
// frame by frame, and measures the errors that it finds.
//
// Measurement noise is present all the time and on all tracks. The removals of a cleaner from a
// noisy track thus have a floor, visible in quiet moments. Its false removals from a clean track of
// an unfamiliar body occur on few tracks and at few moments: fast moves, ends, steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/take_view.hpp"
#include "methods/learned/motion_filter.hpp"

namespace kinemend {

/// Length of the windows over which removals are averaged, seconds. Chosen on takes of other data
/// sets (docs/details/learned.md): 1 s lets markers lose three times as much.
inline constexpr double floor_window_s = 0.5;
/// The share of a track's windows that are quieter than its floor. A tenth removes less of the
/// noise of video systems and protects no take more; a half lets gestures lose 1.7 degrees.
inline constexpr double floor_share = 0.25;
/// The largest removal at a moment, in floors of its track. Three lets fast markers lose half as
/// much again.
inline constexpr double most_floors = 2;
/// The shortest take, unless it is noisy as a whole, in which slow noise gives a floor to tracks
/// that the model does not know and in which no noise is measured, seconds: a dash of three seconds
/// is fast from its first frame to its last.
inline constexpr double shortest_floor_s = 4;
/// A window is a burst of noise when the lower quartile of its squared changes within a 60th of a
/// second, halved, exceeds this share of its mean square. White noise has 0.4, noise with a
/// correlation of 0.8 at 120 Hz 0.14; a step, a flip and a fast move have less than 0.1.
inline constexpr double least_burst_share = 0.2, burst_lag_s = 1.0 / 60;
/// Below this rate changes within a 60th of a second cannot be measured, hertz.
inline constexpr double lowest_burst_rate_hz = 50;
/// A take is noisy when at least this share of its moving tracks has a floor: of 129 takes of
/// cameras and markerless systems nine in ten have more than 0.76; of clean takes only dashes of
/// two seconds and clips of four joints have more than 0.5.
inline constexpr double least_noisy_share = 0.7;
/// A track has a floor when that is at least this share of the root mean square of its removals.
inline constexpr double least_floor_share = 0.1;
/// A track is stepped when at least this share of its samples repeat the one before, to the last
/// bit: its keys are held on purpose, or it comes from a lower rate. Smoothing steps is wrong
/// unless the take is noisy. Chosen by hand: keys on every second frame have 0.5.
inline constexpr double least_stepped_share = 0.25;
/// Fewer moving tracks cannot decide for the take, such as one arm that waves.
inline constexpr std::size_t fewest_noisy_tracks = 6;

/// Keeps the result of a noisy take. In any other take moves each track of `result` (channels 3 n
/// to 3 n + 2) towards `take.values` where it removes more, within half a second, than the larger
/// of
///
/// - `most_floors` times the floor of the track: the lower quartile over its windows, if the model
///   knows the track, or the measured noise requires a change of it, or the take is long enough;
/// - the removals of the smoothing by the measured noise (`take.measured`) there, except for joints
///   that the model does not know in short takes of a low rate: there a fast keyed move measures as
///   noise.
///
/// Bursts of white noise are not limited. `is_known`, `is_stepped`: one per track, 1 if the model
/// knows its joint and if it is stepped. A stepped track has neither floor nor bursts, and makes no
/// take noisy unless noise is measured in it. Deviations are unchanged. Returns for each track the
/// root mean square of what was put back, per axis, degrees.
std::vector<double> keep_to_noise_floor(const MotionTake& take,
                                        std::span<const std::uint8_t> is_known,
                                        std::span<const std::uint8_t> is_stepped,
                                        MotionResult& result);

/// One per track of `numbers`: 1 if it is stepped.
std::vector<std::uint8_t> stepped_tracks(const TakeView& take,
                                         std::span<const std::size_t> numbers);

/// Mean squares per axis of a track, degrees squared.
struct TrackError {
  double removed = 0, left = 0;
  double quick = 0;        ///< the part of `removed` that changes within 1/25 s
  double correlation = 0;  ///< of the removed error from frame to frame

  double all() const { return removed + left; }
};

/// The errors of channels 3 `track` to 3 `track` + 2.
TrackError track_error(const MotionTake& take, const MotionResult& result, std::size_t track);

/// Whether a change exceeds a tenth of the remaining error. Smaller changes are not made: a clean
/// track keeps its samples.
bool is_worth_a_change(const TrackError& error);

/// The removed noise of the tracks that are worth a change: the median, degrees per axis.
ColouredNoise removed_noise(std::span<const TrackError> errors);

/// Slow noise of those tracks: the median, degrees per axis; 0 if errors are small or vary from
/// frame to frame.
double slow_noise(std::span<const TrackError> errors);

/// `keep_to_noise_floor` for a stream: windows end at the frame, floors are those of the last 16
/// seconds, and no noise is measured. A stream is noisy after three seconds at the earliest, and a
/// track that the model does not know has no floor in the first `shortest_floor_s`.
class LiveNoiseFloor {
 public:
  /// `counts`: one per track, 1 if it helps decide whether the stream is noisy.
  LiveNoiseFloor(double frame_rate_hz, std::vector<std::uint8_t> counts);

  /// Moves `cleaned` (3 per track, degrees) of the next frame towards `samples`. `is_known`:
  /// whether the model knows the body now; `may_be_known`: one per track, 1 if its joint belongs to
  /// the body. Does not allocate.
  void bound(std::span<const float> samples, bool is_known,
             std::span<const std::uint8_t> may_be_known, std::span<float> cleaned);

 private:
  void look_back(bool is_known, std::span<const std::uint8_t> may_be_known);
  bool has_floor(std::size_t track, double& floor);
  double middle_of_last(std::size_t track);

  double frame_rate_hz_;
  std::vector<std::uint8_t> counts_, moves_;
  bool is_noisy_ = false;
  std::vector<float> first_;  // tracks x 3: the first samples
  std::size_t tracks_, window_, lag_, hop_, spike_;
  std::vector<double> last_;  // spike_ x tracks: squared lengths of removals
  std::size_t frames_ = 0;
  std::vector<float> removals_;    // window x tracks x 3, a ring
  std::vector<double> squares_;    // window x tracks: medians of those
  std::vector<double> changes_;    // window x tracks: half their squared changes
  std::vector<double> sums_;       // tracks: of `squares_`
  std::vector<double> lost_;       // tracks: root mean squares of the window
  std::vector<double> levels_;     // kept levels x tracks: root mean squares at every hop, a ring
  std::vector<double> floors_;     // tracks
  std::vector<double> quartiles_;  // tracks, of `changes_`
  std::vector<double> sorted_;
};

}  // namespace kinemend
