// Compares two takes of joints: that they have the same joints and frames, error figures of
// rotations, of positions and their accelerations, peak speeds, and how far feet slide.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/metrics.hpp"
#include "metrics/track_noise.hpp"
#include "motion/rotation.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

// Throws `ErrorKind::usage` if the two clips cannot be compared frame by frame and joint by joint.
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

// Returns the angles (radians) between the local rotations of each joint, for every frame from
// `first_frame` on, frame-major.
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

using Angles = std::array<double, 3>;

// Channels that turn less over a take are constant except for rounding. Chosen by hand, not swept.
constexpr double moving_range = 0.001 * radians_per_degree;

bool counts_in_rms(const Skeleton& skeleton, std::size_t joint) {
  return skeleton.parents[joint] >= 0 && skeleton.rotation_order(joint).count > 0;
}

// Adds the squared differences of one joint's moving channels to `sums` frame by frame; each uses
// the other clip's nearest equivalent angles. Returns the channels.
std::size_t add_channel_errors(const Take& reference, const Take& other, std::size_t joint,
                               std::size_t first_frame, std::vector<double>& sums) {
  const RotationOrder order = reference.skeleton.rotation_order(joint);
  const std::size_t frames = sums.size();
  std::vector<Angles> wanted(frames);
  Angles previous{}, least, most;
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < frames; ++f) {
    previous = to_euler_near(reference.rotation(first_frame + f, joint), order, previous);
    wanted[f] = previous;
    for (std::size_t c = 0; c < order.count; ++c) {
      least[c] = std::min(least[c], previous[c]);
      most[c] = std::max(most[c], previous[c]);
    }
  }
  std::array<bool, 3> moves{};
  for (std::size_t c = 0; c < order.count; ++c) moves[c] = most[c] - least[c] > moving_range;
  const auto channels = static_cast<std::size_t>(std::count(moves.begin(), moves.end(), true));
  if (channels == 0) return 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const Angles found = to_euler_near(other.rotation(first_frame + f, joint), order, wanted[f]);
    for (std::size_t c = 0; c < order.count; ++c) {
      if (!moves[c]) continue;
      const double difference = degrees_per_radian * (found[c] - wanted[f][c]);
      sums[f] += difference * difference;
    }
  }
  return channels;
}

double mean_of(const std::vector<double>& values) {
  return values.empty() ? 0.0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

double sum_of_squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

}  // namespace

std::vector<double> rms_deg_per_frame(const Take& reference, const Take& other,
                                      std::size_t first_frame) {
  check_pair(reference, other, first_frame);
  std::vector<double> figures(reference.frame_count() - first_frame, 0.0);
  std::size_t channels = 0;
  for (std::size_t j = 0; j < reference.joint_count(); ++j) {
    if (counts_in_rms(reference.skeleton, j)) {
      channels += add_channel_errors(reference, other, j, first_frame, figures);
    }
  }
  if (channels == 0) return figures;
  for (double& figure : figures) figure = std::sqrt(figure / static_cast<double>(channels));
  return figures;
}

double rms_deg(const Take& reference, const Take& other, std::size_t first_frame) {
  return mean_of(rms_deg_per_frame(reference, other, first_frame));
}

double geodesic_rms_deg(const Take& reference, const Take& other, std::size_t first_frame) {
  check_pair(reference, other, first_frame);
  const auto angles = geodesic_angles(reference, other, first_frame);
  if (angles.empty()) return 0;
  return degrees_per_radian *
         std::sqrt(sum_of_squares(angles) / static_cast<double>(angles.size()));
}

std::vector<double> geodesic_rms_deg_per_joint(const Take& reference, const Take& other,
                                               std::size_t first_frame) {
  check_pair(reference, other, first_frame);
  const auto angles = geodesic_angles(reference, other, first_frame);
  const std::size_t joints = reference.joint_count();
  std::vector<double> figures(joints, 0.0);
  for (std::size_t i = 0; i < angles.size(); ++i) figures[i % joints] += angles[i] * angles[i];
  const auto frames = static_cast<double>(reference.frame_count() - first_frame);
  for (double& figure : figures) figure = degrees_per_radian * std::sqrt(figure / frames);
  return figures;
}

double geodesic_percentile_deg(const Take& reference, const Take& other, double percentile,
                               std::size_t first_frame) {
  check_pair(reference, other, first_frame);
  if (!(percentile >= 0 && percentile <= 100)) {
    throw Error(ErrorKind::usage, fmt::format("percentile {} is outside 0 to 100", percentile));
  }
  return degrees_per_radian *
         percentile_of(geodesic_angles(reference, other, first_frame), percentile);
}

double psnr_db(const Take& reference, const Take& other, std::size_t first_frame, double peak) {
  check_pair(reference, other, first_frame);
  if (!(peak > 0)) {
    throw Error(ErrorKind::usage, fmt::format("PSNR peak {} is not positive", peak));
  }
  const auto angles = geodesic_angles(reference, other, first_frame);
  // The logarithm of the quaternion is half the rotation vector and has three channels.
  const double mean_square = sum_of_squares(angles) / 4 / (3 * static_cast<double>(angles.size()));
  // NaN is kept: a clip with such values is not the same as the reference.
  return mean_square == 0 ? std::numeric_limits<double>::infinity()
                          : 10 * portable::log10(peak * peak / mean_square);
}

double mse_rad2(std::span<const Quat> reference, std::span<const Quat> other) {
  if (reference.size() != other.size()) {
    throw Error(ErrorKind::usage,
                fmt::format("signals differ in length: {} and {}", reference.size(), other.size()));
  }
  double sum = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double angle = angle_between(reference[i], other[i]);
    sum += angle * angle;
  }
  return reference.size() > 1 ? sum / static_cast<double>(reference.size() - 1) : sum;
}

double mse_rad2(const Take& reference, const Take& other, std::size_t first_frame) {
  check_pair(reference, other, first_frame);
  const std::size_t frames = reference.frame_count() - first_frame;
  const double terms = static_cast<double>(std::max<std::size_t>(frames - 1, 1)) *
                       static_cast<double>(reference.joint_count());
  return sum_of_squares(geodesic_angles(reference, other, first_frame)) / terms;
}

std::vector<double> peak_angular_speed_deg_s(const Take& clip, std::size_t first_frame) {
  std::vector<double> peaks(clip.joint_count(), 0.0);
  for (std::size_t f = first_frame + 1; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      peaks[j] = std::max(peaks[j], angle_between(clip.rotation(f - 1, j), clip.rotation(f, j)));
    }
  }
  for (double& peak : peaks) peak *= degrees_per_radian * clip.frame_rate_hz;
  return peaks;
}

namespace {

// Returns the joint positions from `first_frame` on.
std::vector<Vec3> positions_from(const Take& clip, std::size_t first_frame) {
  std::vector<Vec3> positions = joint_positions(clip);
  positions.erase(positions.begin(), positions.begin() + static_cast<std::ptrdiff_t>(
                                                             first_frame * clip.joint_count()));
  return positions;
}

MeanAndDeviation mean_and_deviation(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  MeanAndDeviation result;
  for (const double value : values) result.mean += value / count;
  for (const double value : values) {
    result.deviation += (value - result.mean) * (value - result.mean) / count;
  }
  result.deviation = std::sqrt(result.deviation);
  return result;
}

}  // namespace

double mpjpe(const Take& reference, const Take& other, std::size_t first_frame, double scale) {
  check_pair(reference, other, first_frame);
  const auto wanted = positions_from(reference, first_frame);
  const auto found = positions_from(other, first_frame);
  double sum = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) sum += norm(found[i] - wanted[i]);
  return scale * sum / static_cast<double>(wanted.size());
}

double accel_error(const Take& reference, const Take& other, std::size_t first_frame) {
  check_pair(reference, other, first_frame);
  if (reference.frame_count() - first_frame < 3) return 0;
  std::vector<Vec3> difference = positions_from(other, first_frame);
  const auto wanted = positions_from(reference, first_frame);
  for (std::size_t i = 0; i < wanted.size(); ++i) difference[i] = difference[i] - wanted[i];
  const std::size_t joints = reference.joint_count();
  const std::size_t inner = difference.size() - 2 * joints;
  double sum = 0;
  for (std::size_t i = 0; i < inner; ++i) {
    sum += norm(difference[i] - 2.0 * difference[i + joints] + difference[i + 2 * joints]);
  }
  return sum / static_cast<double>(inner) * reference.frame_rate_hz * reference.frame_rate_hz;
}

MeanAndDeviation rmse_per_marker(std::span<const Vec3> reference, std::span<const Vec3> other,
                                 std::size_t markers, std::span<const std::uint8_t> noisy) {
  if (reference.size() != other.size() || (!noisy.empty() && noisy.size() != reference.size())) {
    throw Error(ErrorKind::usage, fmt::format("marker arrays differ in length: {}, {} and {}",
                                              reference.size(), other.size(), noisy.size()));
  }
  if (markers == 0 || reference.size() % markers != 0) {
    throw Error(ErrorKind::usage, fmt::format("{} positions are no whole frames of {} markers",
                                              reference.size(), markers));
  }
  std::vector<double> figures;
  for (std::size_t start = 0; start < reference.size(); start += markers) {
    double sum = 0;
    std::size_t counted = 0;
    for (std::size_t i = start; i < start + markers; ++i) {
      const Vec3 d = other[i] - reference[i];
      sum += dot(d, d);
      if (noisy.empty() || noisy[i]) ++counted;
    }
    if (counted > 0) figures.push_back(std::sqrt(sum / static_cast<double>(counted)));
  }
  return mean_and_deviation(figures);
}

MeanAndDeviation rmse_per_marker_m(const Take& reference, const Take& other, double metres_per_unit,
                                   std::size_t first_frame) {
  check_pair(reference, other, first_frame);
  const auto figure = rmse_per_marker(positions_from(reference, first_frame),
                                      positions_from(other, first_frame), reference.joint_count());
  return {figure.mean * metres_per_unit, figure.deviation * metres_per_unit};
}

namespace {

double horizontal(Vec3 v, Axis up) {
  const double height = component(v, up);
  return std::sqrt(std::max(0.0, dot(v, v) - height * height));
}

double floor_height(const std::vector<Vec3>& track, Axis up) {
  std::vector<double> heights;
  heights.reserve(track.size());
  for (const Vec3 p : track) heights.push_back(component(p, up));
  return percentile_of(std::move(heights), 2);
}

std::vector<Vec3> track_of(const std::vector<Vec3>& positions, std::size_t joints,
                           std::size_t joint, std::size_t first_frame) {
  std::vector<Vec3> track;
  for (std::size_t i = first_frame * joints + joint; i < positions.size(); i += joints) {
    track.push_back(positions[i]);
  }
  return track;
}

}  // namespace

std::vector<std::size_t> foot_joints(const Skeleton& skeleton) {
  static constexpr std::array<std::string_view, 5> fragments{"foot", "ankle", "heel", "toe",
                                                             "ball"};
  std::vector<std::size_t> found;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const std::string name = lower_case(skeleton.names[j]);
    const auto in_name = [&](std::string_view fragment) {
      return name.find(fragment) != std::string::npos;
    };
    if (std::any_of(fragments.begin(), fragments.end(), in_name)) found.push_back(j);
  }
  return found;
}

FootSlide foot_slide(const Take& reference, const Take& other, const FootSlideSettings& settings,
                     std::size_t first_frame) {
  check_pair(reference, other, first_frame);
  const auto joints = settings.joints.empty() ? foot_joints(reference.skeleton) : settings.joints;
  for (const std::size_t j : joints) {
    if (j >= reference.joint_count()) {
      throw Error(ErrorKind::usage,
                  fmt::format("foot joint {} of {} joints", j, reference.joint_count()));
    }
  }
  const double height = body_height(reference.skeleton);
  const double largest_step =
      settings.contact_speed * height / std::max(reference.frame_rate_hz, 1e-9);
  const auto wanted = joint_positions(reference), found = joint_positions(other);
  FootSlide slide;
  for (const std::size_t j : joints) {
    const auto truth = track_of(wanted, reference.joint_count(), j, first_frame);
    const auto track = track_of(found, reference.joint_count(), j, first_frame);
    const double ceiling = floor_height(truth, settings.up) + settings.contact_height * height;
    for (std::size_t f = 1; f < truth.size(); ++f) {
      const bool low = component(truth[f - 1], settings.up) < ceiling &&
                       component(truth[f], settings.up) < ceiling;
      if (!low || norm(truth[f] - truth[f - 1]) >= largest_step) continue;
      slide.per_frame += horizontal(track[f] - track[f - 1], settings.up);
      ++slide.contact_steps;
    }
  }
  if (slide.contact_steps > 0) slide.per_frame /= static_cast<double>(slide.contact_steps);
  return slide;
}

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
  const auto angles = geodesic_angles(reference, other, first_frame);
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
  check_pair(reference, other, first);
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
