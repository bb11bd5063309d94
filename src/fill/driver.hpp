// Fills the gaps of a take of joints or markers in rounds. A request says how a gap may be filled;
// a doubted sample beside it may be a spike.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fill/methods.hpp"
#include "fill/track.hpp"
#include "kinemend/fill.hpp"

namespace kinemend::fill {

/// A missing span that may be filled.
struct OpenGap {
  Gap gap;                   ///< `track` as the report names it: a joint or marker
  bool is_position = false;  ///< the joint's position, not its rotation
  std::size_t track = 0;     ///< among the tracks of the take
  const GapRequest* request = nullptr;

  FrameSpan span() const { return {gap.first_frame, gap.last_frame}; }
};

/// A take whose gaps are filled. It hides the differences between joints and markers. Errors and
/// distances are in file units; those of rotations are in degrees.
class GappedTake {
 public:
  virtual ~GappedTake() = default;

  std::size_t frames = 0;
  double frame_rate_hz = 0;
  std::string_view never_seen = {};  ///< the reason for refusing a gap as long as the take
  /// Whether doubted samples beside a gap are used where no method fills it without them.
  bool rests_on_doubted = false;

  /// Returns the unit of the gap's expected error.
  virtual std::string unit_of(const OpenGap& gap) const = 0;
  /// Returns the samples around a gap, at least `doubt_reach` on either side.
  virtual Track around(const OpenGap& gap) const = 0;
  /// Returns the distance from a filling beyond which a sample beside the gap is a spike.
  virtual double spike_size(const OpenGap& gap) const = 0;
  /// Fills `span`: the gap, or the gap with doubted samples beside it. Called in parallel.
  virtual Filling fill(const OpenGap& gap, FrameSpan span) const = 0;
  /// Called before each round. From here on the fillings of earlier rounds are known.
  virtual void begin_round() {}
  virtual void learn(const OpenGap&, const Filling&) {}
  /// Whether refilling a filled gap helps now that all others are filled.
  virtual bool gains(const OpenGap&) const { return false; }
  /// Writes a gap's filling as observed. Called at the end, in the order of the gaps.
  virtual void store(const OpenGap& gap, const Filling& filling) = 0;
};

/// The outcome of a gap, and the markers that it was filled from.
struct FilledGap {
  GapOutcome outcome;
  std::vector<std::size_t> markers_used = {};
  std::string left_to_auto = {};  ///< as `Filling::left_to_auto`
};

/// Called before each attempted gap, from several threads; an exception ends the run before
/// anything is stored.
using Check = std::function<void()>;

/// Fills the gaps in rounds, because the fillings of one round may be evidence for the next.
/// Returns one result for each gap.
std::vector<FilledGap> fill_take(GappedTake& take, const std::vector<OpenGap>& gaps,
                                 const Check& check);
/// `names`: joints or markers, for the messages about gaps that a model has left to `auto`.
FillReport report_of(const std::vector<FilledGap>& gaps, const std::vector<std::string>& names);

/// Returns the request for a gap of the take (frames as the take counts them), or null if the gap
/// is to be left open and not listed.
using RequestOf = std::function<const GapRequest*(const Gap& gap, bool is_position)>;

/// Fills the gaps of a take that have a request. Gaps in the calibration pose are separate and
/// never filled.
std::vector<FilledGap> fill_asked(Take& clip, const RequestOf& request_of, const Check& check);
std::vector<FilledGap> fill_asked_joints(Take& clip, const RequestOf& request_of,
                                         const Check& check);
std::vector<FilledGap> fill_asked_markers(Take& clip, const RequestOf& request_of,
                                          const Check& check);
/// Returns all gaps of a take with the frames as it counts them, in the order in which they are
/// filled. The track index and the request are not set.
std::vector<OpenGap> open_gaps(const Take& clip);
std::vector<OpenGap> open_joint_gaps(const Take& clip);
std::vector<OpenGap> open_marker_gaps(const Take& clip);
/// Returns the donor's marker by its name or a shell pattern, or `no_marker` for an empty name.
/// Throws `ErrorKind::usage` if no marker matches.
std::size_t donor_of(const Take& clip, const std::string& name);

inline bool lies_within(const Gap& gap, const FillSettings& settings) {
  return !settings.range ||
         (gap.first_frame >= settings.range->first && gap.last_frame <= settings.range->second);
}

/// The number of samples on either side of a gap that may be spikes: 0 or 2.
struct Doubt {
  std::size_t before = 0, behind = 0;

  bool any() const { return before + behind > 0; }
  FrameSpan widened(FrameSpan gap) const { return {gap.first - before, gap.last + behind}; }
  friend bool operator==(const Doubt&, const Doubt&) = default;
};

/// A sample beside a gap has no neighbour on one side that would distinguish a spike from motion.
/// It is doubted if its second difference exceeds three times any other within half a second, and
/// exceeds `least` (file units or degrees). A doubted sample is a spike only if it is also far from
/// a filling that does not use it.
Doubt doubt_beside(const Track& track, FrameSpan gap, double frame_rate_hz, double least);

/// Returns the number of frames on either side of a gap that `doubt_beside` reads.
std::size_t doubt_reach(double frame_rate_hz);

/// Returns the size of an offset between two samples of the track, in file units or degrees.
inline double size_of(const Track& track, Vec3 offset) {
  return track.is_position ? norm(offset) : norm(offset) * degrees_per_radian;
}

}  // namespace kinemend::fill
