// Tries several ways to fill a gap on observed spans of the take, and judges from these trials and
// the gap itself which is best and how large its error is.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fill/track.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::fill {

enum class CandidateKind : std::uint8_t {
  model,   ///< made from other markers or joints
  spline,  ///< the natural cubic, the reference in a gap of a few frames
  curve,   ///< another curve through the track's own samples
  line     ///< never used: the others' distance from it measures the motion
};

/// A spline is hard to beat in gaps of up to this length: another candidate is preferred only if
/// its mean square error is smaller by this factor. Chosen on the takes that docs/measured/fill.md
/// names.
inline constexpr double short_gap_s = 0.1;
inline constexpr double clearly_better = 4;

/// The candidates' proposals for some frames of a span, C x frames. Each is an offset: from the
/// ground truth in a trial, from any one of them in the gap.
using Proposals = std::vector<std::vector<Vec3>>;

/// Returns the mean scalar products of the offsets: C x C.
Eigen::MatrixXd products_of(const Proposals& offsets);

/// Spans of the take that were filled to see how the candidates do.
struct Trials {
  std::vector<Eigen::MatrixXd> products;  ///< of the candidates' errors; empty: no trials
  double longer = 1;    ///< the gap's length relative to theirs; its errors grow with it
  bool at_end = false;  ///< at an end of the take, where one side of the gap has no samples
  double weight = 0;    ///< number of disjoint trials, reduced if they are shorter than the gap
};

/// Judges the candidates for one gap by trials (one at least). The gap may be harder than the
/// trials, and then candidates differ more in it than in the trials. Mean square errors of the
/// trials are therefore multiplied by (D / D')^g, where D is the mean square difference of the
/// candidates in the gap and D' that in the trials.
class Judgement {
 public:
  /// `gap`: products of the candidates' proposals for it. `grain`: smaller lengths are ignored.
  Judgement(std::vector<CandidateKind> kinds, Eigen::MatrixXd gap, Trials trials, double grain);

  /// The expected mean square error of each candidate, scaled by how much the models differ from
  /// each other, and a curve from the line; infinite for the line. The spline has its typical
  /// error: a single trial with a large error does not count against it.
  const std::vector<double>& squares() const { return squares_; }
  /// Weights of the candidates in their average, as 1 / square^2; their sum is 1. The spline's
  /// square is divided by `favour` first.
  std::vector<double> weights(double favour) const;
  /// Returns the root mean square distance to the ground truth of the average with these weights,
  /// scaled by how much all candidates differ from it and by its distance from the straight line.
  double expected_error(std::span<const double> weights) const;

 private:
  void judge_models();
  void judge_curve(std::size_t candidate);

  std::vector<CandidateKind> kinds_;
  Eigen::MatrixXd gap_;
  Trials trials_;
  double floor_;
  std::vector<double> squares_;
};

/// Returns the frames that a gap is filled from: a minute on either side, or ten times its length
/// if that is more. The cost of a gap therefore does not grow with the take.
FrameSpan evidence_around(FrameSpan gap, std::size_t frames, double frame_rate_hz);

/// Returns spans as long as the gap in which all is seen, with a frame on either side: the six
/// nearest to the gap, at least half a length apart, for the local motion; and three evenly over
/// the frames, for the rest. The spans are shorter (half, a quarter, ...) if fewer than three would
/// fit, and empty if none fits. `usable[i]` belongs to frame `first_frame` + i and is 0 in the gap
/// itself.
std::vector<FrameSpan> trial_places(std::span<const std::uint8_t> usable, std::size_t first_frame,
                                    FrameSpan gap);

/// A gap of a take, and the frames around it in which it can be tried.
struct TrialRoom {
  FrameSpan gap;
  TakeEnds ends;                     ///< whether the gap starts or ends the take
  FrameSpan evidence;                ///< `evidence_around`
  std::vector<std::uint8_t> usable;  ///< of its frames, as in `trial_places`; all 0 at first
};
TrialRoom room_around(FrameSpan gap, std::size_t frames, double frame_rate_hz);

/// Fills a span as if it were a gap and returns each candidate's offsets from the ground truth in
/// these frames of it.
using TryOn = std::function<Proposals(FrameSpan span, const std::vector<std::size_t>& frames)>;

/// Tries the candidates on the `trial_places`, each compared in up to `trial_frames` frames.
Trials try_out(const TrialRoom& room, const TryOn& try_on);

inline constexpr std::size_t trial_frames = 12;  ///< for speed; not swept

}  // namespace kinemend::fill
