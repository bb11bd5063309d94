#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinemend/check.hpp"
#include "kinemend/clean.hpp"

namespace kinemend::cli {

/// Something wrong with a take that cleaning leaves as it is.
struct Leftover {
  std::string what;  ///< "34 frozen or bridged spans left"
  std::string mend;  ///< the command or option that mends it
};

/// What the report of a take of either kind says, joints and markers in the same words.
struct ReportView {
  /// A joint or a marker, in degrees or file units.
  struct Row {
    std::string name;
    double noise = 0;
    double rms_change = 0;
    double max_change = 0;
    std::size_t frames_changed = 0;
    std::size_t frames_repaired = 0;
    double peak_speed_before = 0;
    double peak_speed_after = 0;
    std::size_t peak_frames = 1;
    std::size_t gaps_left = 0;       ///< markers only
    std::size_t frames_missing = 0;  ///< markers only
  };

  bool is_markers = false;
  std::string contents;         ///< of a file without markers: "4,564 analog frames, no points"
  std::string unit;             ///< "deg", "mm"; "units" where a marker file does not say
  double noticeable_noise = 0;  ///< below this much jitter a take is not called noisy
  std::string method;
  std::size_t frames = 0;
  std::int64_t first_frame = 1;  ///< the number that the file gives to the first
  std::string format;            ///< of the file that was read
  std::size_t calibration_frames = 0;
  double frame_rate_hz = 0;
  std::vector<Row> rows;
  double root_rms_change = 0;
  double root_max_change = 0;
  std::vector<ReportSpan> spans;
  FillReport fill;
  std::optional<FeetReport> feet;
  std::vector<MarkerSwap> swaps;  ///< undone
  std::vector<Leftover> leftovers;
  std::vector<FallBack> fall_backs;
  std::vector<std::string> warnings;
  double seconds = 0;

  const char* noun() const { return is_markers ? "marker" : "joint"; }
};

ReportView view_of(CleanReport report);
ReportView view_of(MarkerReport report);

}  // namespace kinemend::cli
