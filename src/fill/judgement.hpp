// How much trust each of several ways to fill a gap deserves, and what error is to be expected:
// from trials on spans that were measured, and from what the gap itself shows.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend::fill {

enum class CandidateKind : std::uint8_t {
  model,   ///< made of what other markers or joints show
  spline,  ///< the natural cubic, by which all are judged in a gap of a few frames
  curve,   ///< another curve through the track's own samples
  line     ///< never used: the distance of the others from it tells how much the track moves
};

/// In gaps of up to this length a spline is hard to beat: another candidate's mean square error has
/// to be so much less to count as much. Chosen on the takes that docs/methods/fill.md names.
inline constexpr double short_gap_s = 0.1;
inline constexpr double clearly_better = 4;

/// What the candidates propose for some frames of a span, as offsets: from the truth in a trial, in
/// the gap from any one of them. C x frames.
using Proposals = std::vector<std::vector<Vec3>>;

/// Their mean scalar products: C x C.
Eigen::MatrixXd products_of(const Proposals& offsets);

/// Spans of the take that were filled to see how the candidates do.
struct Trials {
  std::vector<Eigen::MatrixXd> products;  ///< of the candidates' errors; empty: no room
  double longer = 1;                      ///< the gap is, than these; its errors grow with it
  bool at_end = false;                    ///< of the take: one side of the gap tells nothing
  double weight = 0;  ///< trials that share no frame, fewer where they are shorter than the gap
};

/// What trials (one at least) tell about the candidates for one gap. The gap may be harder than the
/// trials were, and candidates that differ more in it than in the trials say so: mean square errors
/// of the trials are multiplied by (D / D')^g, with D the mean square by which candidates differ in
/// the gap and D' that in the trials.
class Judgement {
 public:
  /// `gap`: products of what the candidates propose for it. `grain`: lengths below it mean nothing.
  Judgement(std::vector<CandidateKind> kinds, Eigen::MatrixXd gap, Trials trials, double grain);

  /// The mean square error to be expected of each candidate, by how much the models differ from
  /// each other, and a curve from the line; infinite for the line. The spline's is its typical one:
  /// a single trial in which it went astray says nothing against it.
  const std::vector<double>& squares() const { return squares_; }
  /// Weights of the candidates in their average, as 1 / square^2; their sum is 1. The spline's
  /// square is divided by `favour` first.
  std::vector<double> weights(double favour) const;
  /// Root mean square distance to the truth of the average with these weights, by how much all
  /// differ from it and by how far it is from the straight line.
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

}  // namespace kinemend::fill
