// How the gaps of a take are filled, whether it is one of joints or of markers.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fill/filling.hpp"
#include "fill/request.hpp"
#include "fill/track.hpp"
#include "kinemend/fill.hpp"

namespace kinemend::fill {

/// A missing span that may be filled.
struct OpenGap {
  Gap gap;                   ///< `track` as the report names it: a joint or marker
  bool is_position = false;  ///< of a joint
  std::size_t track = 0;     ///< among the tracks of the take
  const GapRequest* request = nullptr;

  FrameSpan span() const { return {gap.first_frame, gap.last_frame}; }
};

/// A take whose gaps are filled: all in which joints and markers differ. Errors and distances are
/// in file units, of rotations in degrees.
class GappedTake {
 public:
  virtual ~GappedTake() = default;

  std::size_t frames = 0;
  double frame_rate_hz = 0;
  std::string_view never_seen = {};  ///< why a gap as long as the take is refused
  /// A gap is filled from doubted samples beside it where no method fills it without them.
  bool rests_on_doubted = false;

  /// Of its expected error.
  virtual std::string unit_of(const OpenGap& gap) const = 0;
  /// The samples around a gap, `doubt_reach` of them at least.
  virtual Track around(const OpenGap& gap) const = 0;
  /// A sample beside a gap is a spike where it is farther than this from a filling without it.
  virtual double spike_size(const OpenGap& gap) const = 0;
  /// Fills `span`: the gap, or that and doubted samples beside it. Called in parallel.
  virtual Filling fill(const OpenGap& gap, FrameSpan span) const = 0;
  /// Before each round: a filling of an earlier one is known from here on.
  virtual void begin_round() {}
  virtual void learn(const OpenGap&, const Filling&) {}
  /// Whether a filled gap gains from a second look, now that all others are filled.
  virtual bool gains(const OpenGap&) const { return false; }
  /// Writes what filled a gap, as observed. Called in the order of the gaps, at last.
  virtual void store(const OpenGap& gap, const Filling& filling) = 0;
};

/// What became of a gap, and the markers that it was filled from.
struct FilledGap {
  GapOutcome outcome;
  std::vector<std::size_t> markers_used = {};
  std::string left_to_auto = {};  ///< as `Filling::left_to_auto`
};

/// Called before each gap that is tried, from several threads; what it throws ends the run before
/// anything is stored.
using Check = std::function<void()>;

/// Fills the gaps in rounds: what one round fills may be evidence for the next. By gap.
std::vector<FilledGap> fill_take(GappedTake& take, const std::vector<OpenGap>& gaps,
                                 const Check& check);
/// `names`: of joints or markers, for what is said of gaps that a model has left to `auto`.
FillReport report_of(const std::vector<FilledGap>& gaps, const std::vector<std::string>& names);

/// Says what is asked for a gap of the take, frames as the take counts them; null: the gap is left
/// alone, and is not listed.
using RequestOf = std::function<const GapRequest*(const Gap& gap, bool is_position)>;

/// The gaps of a take for which something is asked. Those in the calibration pose are gaps of their
/// own, which nothing fills.
std::vector<FilledGap> fill_asked(Take& clip, const RequestOf& request_of, const Check& check);
std::vector<FilledGap> fill_asked_joints(Take& clip, const RequestOf& request_of,
                                         const Check& check);
std::vector<FilledGap> fill_asked_markers(Take& clip, const RequestOf& request_of,
                                          const Check& check);
/// All gaps of a take with the frames as it counts them, in the order in which they are filled; the
/// track among tracks and the request are not set.
std::vector<OpenGap> open_gaps(const Take& clip);
std::vector<OpenGap> open_joint_gaps(const Take& clip);
std::vector<OpenGap> open_marker_gaps(const Take& clip);
/// The donor's marker, by its name or a shell pattern; `no_marker` for an empty name. Errors:
/// `ErrorKind::usage` where there is none.
std::size_t donor_of(const Take& clip, const std::string& name);

inline bool lies_within(const Gap& gap, const FillSettings& settings) {
  return !settings.range ||
         (gap.first_frame >= settings.range->first && gap.last_frame <= settings.range->second);
}

}  // namespace kinemend::fill
