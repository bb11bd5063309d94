// Leave-one-out predictions of the samples of a track, by second-order Whittaker smoothers over a
// coarse grid of cutoffs.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "signal/whittaker.hpp"

namespace kinemend::signal {

// By definition.
inline constexpr std::size_t lane_tracks = block_channels;
inline constexpr std::size_t lane_row = 3 * lane_tracks;

/// F frames of eight tracks of vectors: in each row the first axis of all eight, then the second,
/// then the third. Unused tracks are zero.
struct LaneBlock {
  std::size_t frames = 0;
  std::vector<double> values;

  explicit LaneBlock(std::size_t frame_count)
      : frames(frame_count), values(frame_count * lane_row) {}
  double* row(std::size_t frame) { return values.data() + frame * lane_row; }
  const double* row(std::size_t frame) const { return values.data() + frame * lane_row; }
};

class LeaveOneOut {
 public:
  /// No smoothers for takes of up to three frames.
  LeaveOneOut(std::size_t frames, double frame_rate_hz, const CutoffGrid& cutoffs = {0.3, 30, 10});

  std::size_t smoothers() const noexcept { return factors_.size(); }
  /// The weight of all other samples in the fit of each, F; at least a thousandth. The prediction
  /// error of a sample is the sample less its fit, divided by this weight.
  const std::vector<double>& weights_of_others(std::size_t smoother) const {
    return weights_[smoother];
  }

  /// The smoother that predicts each track best: the least sum of squared errors, each limited to
  /// the track's `caps`.
  std::array<std::size_t, lane_tracks> best_smoothers(const LaneBlock& y,
                                                      const BlockRow& caps) const;

  /// Rows of the fit x, in the layout of `LaneBlock`: `count` frames from `first` on.
  using FitVisitor = std::function<void(std::size_t first, std::size_t count, const double* x)>;
  /// Visits the fit of one smoother, from the first frame to the last, a tile at a time.
  void fit(std::size_t smoother, const LaneBlock& y, const FitVisitor& visit) const;

 private:
  std::vector<SharedFactor> factors_;
  std::vector<std::size_t> memories_;  ///< frames after which a sample's influence is negligible
  std::vector<std::vector<double>> weights_;  ///< of the others, F each
};

}  // namespace kinemend::signal
