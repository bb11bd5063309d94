// Ridge regression that can leave out the frames of any span.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/frame_span.hpp"

namespace kinemend::fill {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The training frames of a regression, which can leave out those of any span.
struct TrainingRows {
  std::vector<std::size_t> frames;  ///< ascending
  Rows rows;                        ///< frames x (1, further columns)
  Rows sums;                        ///< rows^T rows

  /// Returns the sums of products of these columns over the frames outside the span.
  template <class Columns>
  Rows sums_without(FrameSpan span, const Columns& columns) const {
    const auto first = std::lower_bound(frames.begin(), frames.end(), span.first);
    const auto last = std::upper_bound(first, frames.end(), span.last);
    Rows kept = sums(columns, columns);
    if (first == last) return kept;
    const Rows hidden = rows.middleRows(first - frames.begin(), last - first)(Eigen::all, columns);
    kept.noalias() -= hidden.transpose() * hidden;
    return kept;
  }
};

/// Ridge regression of three outputs y on inputs x:
///
///     B = argmin |Y - X B|^2 + n stiffness^2 |B|^2,      y = mean(Y) + (x - mean(X)) B.
///
/// `sums`: of products of (1, x, y) over the training frames. Predicts y for each row of `inputs`
/// and each stiffness (in the unit of x; with infinity y is its mean).
std::vector<Rows> ridge_regression(const Rows& sums, const Rows& inputs,
                                   std::span<const double> stiffness);

}  // namespace kinemend::fill
