// Compares two takes of joints in every figure, joint by joint, after checking that they have the
// same joints and frames.
#include "metrics/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/metrics.hpp"
#include "metrics/track_noise.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

// Either track may be noisy, so the larger noise is used and the spikes of both are left out.
Peaks peaks_of(const std::vector<Quat>& reference, const std::vector<Quat>& other,
               double frame_rate_hz) {
  const double noise = std::max(track_noise(reference), track_noise(other));
  std::vector<std::uint8_t> spikes(reference.size());
  peaks::leave_out_spikes(other, noise, spikes);
  return measure_peaks(reference, other, std::move(spikes), {noise, noise}, frame_rate_hz);
}

void fill_joints(const Take& reference, const Take& other, std::size_t first_frame,
                 Comparison& result) {
  const std::size_t joints = reference.joint_count();
  if (joints == 0) return;
  const auto rms = geodesic_rms_deg_per_joint(reference, other, first_frame);
  result.joints.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const Peaks peaks = peaks_of(rotations_of(reference, j, first_frame),
                                 rotations_of(other, j, first_frame), reference.frame_rate_hz);
    result.joints[j] = {rms[j], 0, degrees_per_radian * peaks.before,
                        degrees_per_radian * peaks.after, peaks.frames};
  }
  const auto angles = metrics::geodesic_angles(reference, other, first_frame);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    double& largest = result.joints[i % joints].geodesic_max_deg;
    largest = std::max(largest, degrees_per_radian * angles[i]);
  }
  for (const JointComparison& joint : result.joints) {
    result.geodesic_max_deg = std::max(result.geodesic_max_deg, joint.geodesic_max_deg);
  }
}

}  // namespace

Comparison compare_clips(const Take& reference, const Take& other,
                         const ComparisonSettings& settings) {
  const std::size_t first = settings.first_frame;
  metrics::check_pair(reference, other, first);
  Comparison result;
  result.frames = reference.frame_count() - first;
  result.rms_deg = rms_deg(reference, other, first);
  result.geodesic_rms_deg = geodesic_rms_deg(reference, other, first);
  result.geodesic_p99_deg = geodesic_percentile_deg(reference, other, 99, first);
  result.mpjpe = mpjpe(reference, other, first);
  result.accel_error = accel_error(reference, other, first);
  result.psnr_peak = settings.psnr_peak;
  result.psnr_db = psnr_db(reference, other, first, settings.psnr_peak);
  result.mse_rad2 = mse_rad2(reference, other, first);
  result.foot_slide = foot_slide(reference, other, settings.foot_slide, first);
  result.foot_slide_reference = foot_slide(reference, reference, settings.foot_slide, first);
  fill_joints(reference, other, first, result);

  std::optional<double> metres = settings.metres_per_unit;
  if (!metres) {
    if (const auto unit = guess_length_unit(reference.skeleton)) metres = unit->metres;
  }
  if (metres) {
    result.mpjpe_cm = 100 * *metres * result.mpjpe;
    result.rmse_per_marker_m = rmse_per_marker_m(reference, other, *metres, first);
  }
  return result;
}

}  // namespace kinemend

namespace kinemend::metrics {

void check_pair(const Take& reference, const Take& other, std::size_t first_frame) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorKind::usage, message); };
  if (reference.joint_count() != other.joint_count()) {
    refuse(fmt::format("the clips differ in joints: {} and {}", reference.joint_count(),
                       other.joint_count()));
  }
  for (std::size_t j = 0; j < reference.joint_count(); ++j) {
    if (reference.skeleton.names[j] != other.skeleton.names[j]) {
      refuse(fmt::format("the clips differ in joints: joint {} is \"{}\" and \"{}\"", j,
                         reference.skeleton.names[j], other.skeleton.names[j]));
    }
  }
  if (reference.frame_count() != other.frame_count()) {
    refuse(fmt::format("the clips differ in frames: {} and {}", reference.frame_count(),
                       other.frame_count()));
  }
  if (first_frame >= reference.frame_count()) {
    refuse(fmt::format("no frames to compare: {} frames, starting at frame {}",
                       reference.frame_count(), first_frame));
  }
}

std::vector<double> geodesic_angles(const Take& reference, const Take& other,
                                    std::size_t first_frame) {
  std::vector<double> angles;
  const std::size_t first = first_frame * reference.joint_count();
  angles.reserve(reference.rotations.size() - first);
  for (std::size_t i = first; i < reference.rotations.size(); ++i) {
    angles.push_back(angle_between(reference.rotations[i], other.rotations[i]));
  }
  return angles;
}

double percentile_of(std::vector<double> values, double percentile) {
  if (values.empty()) return 0;
  const double position = percentile / 100 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double low = of_rank(values, below);
  const auto above = values.begin() + static_cast<std::ptrdiff_t>(below) + 1;
  if (above == values.end()) return low;
  const double high = *std::min_element(above, values.end());
  return low + (position - static_cast<double>(below)) * (high - low);
}

}  // namespace kinemend::metrics
