#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/rotation.hpp"

// How much trust each of several ways to fill a gap deserves in it, and what error is to be
// expected: from trials on spans that were measured, and from what the gap itself shows.
namespace kinemend::fill {

enum class CandidateKind : std::uint8_t {
  model,  ///< made of what other markers or joints show
  curve,  ///< made of the track's own samples beside the gap
  line    ///< never used: the distance of the curves from it tells how much the track moves
};

/// Mean scalar products, over the frames of one span, of what the candidates propose: C x C. Of a
/// trial about the truth, so that they are products of errors; of the gap about any one of them.
Eigen::MatrixXd products_of(const std::vector<std::vector<Vec3>>& proposals,
                            std::span<const Vec3> origin);

struct Judgement {
  std::vector<double> weights;  ///< of the candidates; their sum is 1
  double expected_error = 0;    ///< root mean square distance to the truth
};

/// The trials tell a candidate's mean square error; the gap may be harder than they are, and
/// candidates that differ more in it than in the trials say so: a candidate's mean square error is
/// multiplied by (D / D')^g, with D the mean square by which those of its kind differ in the gap
/// (models from each other, a curve from the line) and D' that in the trials. The candidates are
/// averaged with the weights 1 / square^2. A curve goes before the models unless these were clearly
/// better in the trials. The error of that average in the trials, with the ratio of the differences
/// of all, is the error to be expected.
/// `longer`: length of the gap over that of the trials; the mean square error grows with it.
/// `grain`: lengths below it mean nothing.
Judgement judge(std::span<const CandidateKind> kinds, const Eigen::MatrixXd& gap,
                std::span<const Eigen::MatrixXd> trials, double longer, double grain);

}  // namespace kinemend::fill
