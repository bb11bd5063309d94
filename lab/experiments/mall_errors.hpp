// The error figure of Mall et al. 2017, with and without the joints that turn over.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"

namespace kinemend::papers {

/// Errors of a take, with and without the joints that turn over, that is, joints with an Euler
/// channel that spans more than a whole turn. The deviation of such a channel, by which noise of k
/// is scaled, is that of the turn and not of a motion, so one such channel would decide the error
/// of a take.
class TakeErrors {
 public:
  explicit TakeErrors(Take truth) : truth_(std::move(truth)), turns_over_(truth_.joint_count()) {
    constexpr double whole_turn_deg = 360, moving_deg = 1e-3;
    double moving = 0, turning = 0, all = 0, all_turning = 0;
    for (std::size_t j = 0; j < truth_.joint_count(); ++j) {
      const RotationOrder order = truth_.skeleton.rotation_order(j);
      if (truth_.skeleton.parents[j] < 0 || order.count == 0) continue;
      double own_moving = 0;
      for (const double span : spans_deg(j, order)) {
        own_moving += span > moving_deg ? 1 : 0;
        if (span > whole_turn_deg) turns_over_[j] = 1;
      }
      const auto count = static_cast<double>(order.count);
      moving += own_moving;
      all += count;
      turning += turns_over_[j] != 0 ? own_moving : 0;
      all_turning += turns_over_[j] != 0 ? count : 0;
    }
    plain_factor_ = std::sqrt(moving / std::max(1.0, moving - turning));
    share_that_moves_ = moving / all;
    plain_share_that_moves_ = (moving - turning) / std::max(1.0, all - all_turning);
  }

  const Take& truth() const { return truth_; }
  bool has_turning() const { return plain_factor_ > 1; }
  /// Share of moving channels, with and without the joints that turn over; other channels have no
  /// error.
  double share_that_moves(bool plain) const {
    return plain ? plain_share_that_moves_ : share_that_moves_;
  }
  /// `rms_deg_per_frame` of a result.
  std::vector<double> per_frame(const Take& result, bool plain) const {
    if (!plain || !has_turning()) return rms_deg_per_frame(truth_, result);
    Take own = result;
    for (std::size_t i = 0; i < own.rotations.size(); ++i) {
      if (turns_over_[i % own.joint_count()] != 0) own.rotations[i] = truth_.rotations[i];
    }
    std::vector<double> errors = rms_deg_per_frame(truth_, own);
    for (double& error : errors) error *= plain_factor_;
    return errors;
  }
  double mean(const Take& result, bool plain) const {
    double sum = 0;
    const std::vector<double> errors = per_frame(result, plain);
    for (const double error : errors) sum += error;
    return errors.empty() ? 0 : sum / static_cast<double>(errors.size());
  }

 private:
  std::vector<double> spans_deg(std::size_t joint, const RotationOrder& order) const {
    std::array<double, 3> angles{}, least{}, most{};
    for (std::size_t f = 0; f < truth_.frame_count(); ++f) {
      angles = to_euler_near(truth_.rotation(f, joint), order, angles);
      for (std::size_t c = 0; c < order.count; ++c) {
        least[c] = f == 0 ? angles[c] : std::min(least[c], angles[c]);
        most[c] = f == 0 ? angles[c] : std::max(most[c], angles[c]);
      }
    }
    std::vector<double> spans;
    for (std::size_t c = 0; c < order.count; ++c)
      spans.push_back(degrees_per_radian * (most[c] - least[c]));
    return spans;
  }

  Take truth_;
  std::vector<std::uint8_t> turns_over_;  // per joint
  double plain_factor_ = 1, share_that_moves_ = 1, plain_share_that_moves_ = 1;
};

}  // namespace kinemend::papers
