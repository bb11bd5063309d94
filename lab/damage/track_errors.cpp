// Draws the errors of a track from its own noise and the noise shared with its limb and body.
#include "lab/damage/track_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable.hpp"
#include "lab/damage/coloured_noise.hpp"
#include "lab/damage/normal_vector.hpp"

namespace kinemend::corrupt {

namespace {

// The slope of floor and motion noise. It is steep, so that there is a corner; chosen by hand, not
// swept.
constexpr double fast_slope = 4;

// The generators of shared noise, beyond the numbers of any track. Any such numbers would do. By
// definition.
constexpr std::uint64_t body_stream = std::uint64_t{1} << 40;
constexpr std::uint64_t limb_stream = std::uint64_t{1} << 41;

constexpr double Vec3::*axes[] = {&Vec3::x, &Vec3::y, &Vec3::z};

Vec3 along_axes(double value, double depth_value, int depth_axis) {
  return {depth_axis == 0 ? depth_value : value, depth_axis == 1 ? depth_value : value,
          depth_axis == 2 ? depth_value : value};
}

Vec3 product(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

Vec3 root(Vec3 a) {
  return {std::sqrt(std::max(0.0, a.x)), std::sqrt(std::max(0.0, a.y)),
          std::sqrt(std::max(0.0, a.z))};
}

}  // namespace

TrackErrors::Stationary TrackErrors::stationary(const Random& random) const {
  Stationary result;
  if (noise_.std_mm > 0)
    result.slow = coloured_vectors({noise_.fc_hz, noise_.slope}, frames_, rate_hz_, random.fork(0));
  if (noise_.floor_mm > 0)
    result.floor =
        coloured_vectors({noise_.floor_hz, fast_slope}, frames_, rate_hz_, random.fork(1));
  return result;
}

const TrackErrors::Limb& TrackErrors::limb(std::size_t number) {
  const auto known = limbs_.find(number);
  if (known != limbs_.end()) return known->second;
  const Random own = random_.fork(limb_stream + number);
  Limb made;
  if (noise_.limb_correlation > 0 || noise_.depth_limb_correlation > 0)
    made.common = stationary(own);
  made.errors = limb_errors(own.fork(2));
  return limbs_.emplace(number, std::move(made)).first->second;
}

// The depth factor is not applied here: each track applies its own.
std::vector<Vec3> TrackErrors::limb_errors(const Random& random) const {
  // A tracker that loses a limb or finds it again does so within two frames of 30 Hz. Chosen by
  // hand, not swept.
  constexpr double edge_s = 2 / 30.0;
  std::vector<Vec3> errors;
  if (!(noise_.limb_error_mm > 0)) return errors;
  const auto events = exponential_events(noise_.limb_errors_per_min, noise_.limb_error_s,
                                         static_cast<double>(frames_) / rate_hz_, random.fork(0));
  if (!events.empty()) errors.resize(frames_);
  Random own = random.fork(1);
  for (const NoiseEvent event : events) {
    const Vec3 offset = noise_.limb_error_mm * normal_vector(own);
    const double last = std::ceil((event.start_s + event.duration_s) * rate_hz_);
    for (auto f = static_cast<std::size_t>(std::max(0.0, event.start_s * rate_hz_));
         f < frames_ && static_cast<double>(f) < last; ++f)
      errors[f] += event_window(event, edge_s, static_cast<double>(f) / rate_hz_) * offset;
  }
  return errors;
}

void TrackErrors::add_leaks(std::vector<Vec3>& errors, const NoisyTrack& track,
                            Random random) const {
  const Vec3 sizes = noise_.leak * along_axes(1, noise_.leak_depth_factor, track.depth_axis);
  if (sizes == Vec3{}) return;
  for (double Vec3::*const to : axes) {
    for (double Vec3::*const from : axes) {
      // A displacement that leaks into its own axis is a gain, not an error of this kind.
      const double share = from == to ? 0 : sizes.*to * random.normal();
      for (std::size_t f = 0; f < track.displacement.size(); ++f)
        errors[f].*to += share * track.displacement[f].*from;
    }
  }
}

void TrackErrors::add_bursts(std::vector<Vec3>& errors, const std::vector<Vec3>& deviations,
                             const Random& random) const {
  const auto events = uniform_events(noise_.bursts_per_min, noise_.burst_min_s, noise_.burst_max_s,
                                     static_cast<double>(frames_) / rate_hz_, random.fork(0));
  Random own = random.fork(1);
  for (const NoiseEvent event : events) {
    Vec3 heights;
    for (double Vec3::*const axis : axes) {
      const double height = own.uniform(noise_.burst_min_height, noise_.burst_max_height);
      heights.*axis = own.chance(0.5) ? height : -height;
    }
    const double last = std::ceil((event.start_s + event.duration_s) * rate_hz_);
    for (auto f = static_cast<std::size_t>(std::max(0.0, event.start_s * rate_hz_));
         f < frames_ && static_cast<double>(f) < last; ++f) {
      const double window =
          event_window(event, event.duration_s / 2, static_cast<double>(f) / rate_hz_);
      errors[f] += window * product(heights, deviations[f]);
    }
  }
}

std::vector<Vec3> TrackErrors::errors_of(const NoisyTrack& track) {
  std::vector<Vec3> errors(frames_);
  if (frames_ == 0) return errors;
  const int depth = track.depth_axis;
  const Vec3 body_share = along_axes(noise_.correlation, noise_.depth_correlation, depth);
  const Vec3 limb_share = along_axes(noise_.limb_correlation, noise_.depth_limb_correlation, depth);
  const Vec3 of_body = root(body_share), of_limb = root(limb_share),
             of_track = root(Vec3{1, 1, 1} - body_share - limb_share);

  if (body_.slow.empty() && body_.floor.empty() && !(body_share == Vec3{}))
    body_ = stationary(random_.fork(body_stream));
  const Limb& whole = limb(track.limb);
  const Random own = random_.fork(track.number);
  const Stationary single = stationary(own);
  const auto add = [&](const std::vector<Vec3> Stationary::*part, Vec3 deviation) {
    const Vec3 body = product(deviation, of_body), common = product(deviation, of_limb),
               rest = product(deviation, of_track);
    const auto& of_all = body_.*part;
    const auto& of_part = whole.common.*part;
    const auto& of_one = single.*part;
    for (std::size_t f = 0; f < of_one.size(); ++f) {
      errors[f] += product(rest, of_one[f]);
      if (!of_all.empty()) errors[f] += product(body, of_all[f]);
      if (!of_part.empty()) errors[f] += product(common, of_part[f]);
    }
  };
  const Vec3 depth_factors = along_axes(1, noise_.depth_factor, depth);
  const double slow = noise_.std_mm * (track.is_arm ? noise_.arm_factor : 1);
  const Vec3 floor = noise_.floor_mm * along_axes(1, noise_.floor_depth_factor, depth);
  add(&Stationary::slow, slow * depth_factors);
  add(&Stationary::floor, floor);

  std::vector<Vec3> deviations(frames_, floor);
  if (noise_.motion_mm > 0) {
    const auto motion =
        coloured_vectors({noise_.motion_hz, fast_slope}, frames_, rate_hz_, own.fork(2));
    const Vec3 at_1_m_s = noise_.motion_mm * along_axes(1, noise_.motion_depth_factor, depth);
    for (std::size_t f = 0; f < frames_; ++f) {
      const Vec3 deviation = track.speed[f] * at_1_m_s;
      errors[f] += product(deviation, motion[f]);
      for (double Vec3::*const axis : axes)
        deviations[f].*axis = portable::hypot(floor.*axis, deviation.*axis);
    }
  }
  add_leaks(errors, track, own.fork(5));
  add_bursts(errors, deviations, own.fork(3));
  for (std::size_t f = 0; f < whole.errors.size(); ++f)
    errors[f] += product(depth_factors, whole.errors[f]);
  return errors;
}

}  // namespace kinemend::corrupt
