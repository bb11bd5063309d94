// Compares takes with a reference: all error figures at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Mean and standard deviation (divided by n, as in NumPy) over frames.
struct MeanAndDeviation {
  double mean = 0;
  double deviation = 0;
};

struct FootSlideSettings {
  Axis up = Axis::y;
  std::vector<std::size_t> joints;  ///< empty: `foot_joints`
  /// A joint is in contact if at both ends of a step it is less than this above its own floor (the
  /// 2nd percentile of its height in the reference), as a share of the skeleton's height: 0.03 is 5
  /// cm of 1.7 m.
  double contact_height = 0.03;
  /// A joint is in contact only if its reference also moves slower than this, in skeleton heights
  /// per second: 0.25 is 0.4 m/s for 1.7 m.
  double contact_speed = 0.25;
};

struct FootSlide {
  /// Mean horizontal travel of a joint in contact from a frame to the next, file units.
  double per_frame = 0;
  std::size_t contact_steps = 0;  ///< joints x steps in contact, over which the mean is taken
};

struct ComparisonSettings {
  std::size_t first_frame = 0;
  double psnr_peak = pi / 2;              ///< see `psnr_db`
  std::optional<double> metres_per_unit;  ///< empty: `guess_length_unit`
  FootSlideSettings foot_slide;
};

/// One joint of a comparison.
struct JointComparison {
  double geodesic_rms_deg = 0;
  double geodesic_max_deg = 0;
  /// Largest angular speeds, as in the report of `clean`: the turn within `peak_frames` frames,
  /// which is the shortest time (one frame to 50 ms) in which noise adds less than a tenth. Spikes
  /// are left out.
  double peak_speed_reference_deg_s = 0;
  double peak_speed_other_deg_s = 0;
  std::size_t peak_frames = 1;
};

/// All figures at once.
struct Comparison {
  std::size_t frames = 0;  ///< compared
  double rms_deg = 0;
  double geodesic_rms_deg = 0;
  double geodesic_p99_deg = 0;
  double geodesic_max_deg = 0;
  double mpjpe = 0;                                   ///< file units
  std::optional<double> mpjpe_cm;                     ///< where the scale is known
  double accel_error = 0;                             ///< file units / s^2
  double psnr_db = 0;                                 ///< infinity for equal clips
  double psnr_peak = 0;                               ///< the peak it was taken with
  std::optional<MeanAndDeviation> rmse_per_marker_m;  ///< where the scale is known
  double mse_rad2 = 0;
  FootSlide foot_slide;                 ///< slide of the other clip
  FootSlide foot_slide_reference;       ///< slide of the reference itself, for comparison
  std::vector<JointComparison> joints;  ///< J
};

/// Errors: `ErrorKind::usage` when joints or numbers of frames differ, saying how.
Comparison compare_clips(const Take& reference, const Take& other,
                         const ComparisonSettings& settings = {});

/// How a reference is fitted to a recording of the same motion by another system.
enum class MarkerFit : std::uint8_t {
  none,
  rigid,        ///< one turn and one shift of the whole take (Kabsch 1976)
  gain_offset,  ///< a gain and an offset for each channel, so that calibration errors do not appear
                ///< as noise
};

struct MarkerComparisonSettings {
  MarkerFit fit = MarkerFit::none;
  /// The take that the reference is fitted to; null: `other`. Fit to the take before cleaning: a
  /// separate fit to each of several cleaned takes favours a take that barely moves.
  const Take* fit_to = nullptr;
  /// Number of frames by which the compared takes lag behind the reference.
  std::int64_t lag_frames = 0;
  /// Channels whose reference has a smaller standard deviation are ignored, file units (>= 0).
  double least_motion = 0;
};

/// Errors of a marker, or of a whole take, in file units of the reference. Root mean squares are
/// taken over samples that both takes have.
struct MarkerErrors {
  std::size_t samples = 0;  ///< number of marker samples
  double rms_distance = 0;  ///< root mean square of distances
  double max_distance = 0;
  double rms = 0;           ///< along an axis, over the channels that are compared
  double velocity_rms = 0;  ///< `rms` of velocities by central differences, per second
  /// `rms` of the error's parts below 2 Hz, from 2 to 6, 6 to 15 and above 15 Hz: differences of
  /// fourth-order Butterworth filters, forward and backward. A band is empty if its cutoff is at or
  /// above half the rate, or for under 16 frames.
  std::array<std::optional<double>, 4> bands;
  std::optional<double> above_6_hz;  ///< jitter
};

struct MarkerComparison {
  std::size_t frames = 0;  ///< compared
  MarkerErrors all;
  double p99_distance = 0;
  /// Lag of the other take behind the reference in seconds: the shift within half a second at which
  /// their velocities agree best. It is not applied. 0 if they hardly move.
  double lag_s = 0;
  std::vector<std::string> names;  ///< markers that both takes have, as the reference spells them
  std::vector<MarkerErrors> markers;   ///< errors of each marker in `names`
  std::vector<std::string> unmatched;  ///< markers of the reference without a counterpart
};

/// Compares two takes of markers. Markers are paired by name, with or without their subject;
/// lengths of `other` are converted to the reference's unit if both files state theirs. Errors:
/// `ErrorKind::usage` if numbers of frames or rates differ, no marker is in both, or too few frames
/// remain after the lag.
MarkerComparison compare_markers(const Take& reference, const Take& other,
                                 const MarkerComparisonSettings& settings = {});

}  // namespace kinemend
