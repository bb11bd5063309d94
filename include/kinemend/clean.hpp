#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/clip.hpp"

namespace kinemend {

/// What the user asks for beside the method.
struct CleanSettings {
  double strength = 1.0;  ///< 0..1: geodesic blend from the input (0) to the cleaned rotation (1)
  /// No observed sample turns further than this from its input (0..180). Positions have no limit.
  double max_change_deg = 180;
  std::vector<std::string> joints;   ///< names or shell patterns (`Left*`); empty: all joints
  std::vector<std::string> exclude;  ///< taken out again
  bool root_position = true;         ///< also clean the root position, where joint 0 is selected
  /// Frames [first, last] that may change, counted from 0; the method sees all of the take, and the
  /// result is blended in over 0.1 s at either end that is not an end of the take.
  std::optional<std::pair<std::size_t, std::size_t>> range;
  double peak_loss_limit = 0.10;  ///< a larger loss of a joint's peak speed is a warning (0..1)
};

/// A run of frames in which one thing was done to one joint.
struct ReportSpan {
  std::int32_t joint = 0;  ///< -1 for the root position
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
  Action action = Action::kept;
  double max_change = 0;  ///< degrees; file units for the root position
  double rms_change = 0;
};

/// One joint over the whole take.
struct JointSummary {
  std::string name;
  double noise_deg = 0;  ///< estimated noise per axis before; 0 where the method estimates none
  double rms_change_deg = 0;
  double max_change_deg = 0;
  std::size_t frames_changed = 0;
  std::size_t frames_repaired = 0;  ///< despiked, filled or foot-adjusted
  /// Largest angular speed, repaired samples left out: the turn within `peak_frames` frames, which
  /// is the shortest time (one frame to 50 ms) in which the noise adds less than a tenth.
  double peak_speed_before_deg_s = 0;
  double peak_speed_after_deg_s = 0;
  std::size_t peak_frames = 1;
};

struct CleanReport {
  std::string method;
  std::size_t frames = 0;
  std::size_t calibration_frames = 0;  ///< at the start, left alone
  double frame_rate_hz = 0;
  std::vector<JointSummary> joints;  ///< J
  double root_rms_change = 0;        ///< file units
  double root_max_change = 0;
  std::vector<ReportSpan> spans;  ///< by joint, then frame; spans of `kept` are left out
  std::vector<std::string> warnings;
  double seconds = 0;  ///< time the cleaning took
};

struct CleanResult {
  Clip clip;
  CleanReport report;
};

/// The main path: takes calibration frames off, runs the cleaner, blends by strength, range and
/// largest change, and reports. Samples outside the selection, joints without rotation channels and
/// samples whose change is below 1e-9 degrees keep their exact value; the rotations of joints with
/// one or two rotation channels are those that the channels can hold. Errors: `ErrorKind::usage`
/// for settings out of range and for a joint pattern that matches nothing.
CleanResult clean_clip(const Clip& clip, const Cleaner& cleaner, const CleanSettings& settings = {},
                       std::string method_name = {});

}  // namespace kinemend
