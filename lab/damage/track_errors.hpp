// The errors of one track of a capture system: noise, drift, and events such as losses and jumps.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"
#include "lab/damage/system_noise.hpp"

namespace kinemend::corrupt {

/// An event that begins `start_s` seconds after frame 0 (may be negative) and lasts for
/// `duration_s`.
struct NoiseEvent {
  double start_s = 0;
  double duration_s = 0;
};

/// Returns a Poisson process of events, including earlier ones that reach into [0, seconds);
/// durations are uniform in [shortest_s, longest_s).
std::vector<NoiseEvent> uniform_events(double per_minute, double shortest_s, double longest_s,
                                       double seconds, const Random& random);
/// Returns such events with exponential durations, cut at ten times their mean.
std::vector<NoiseEvent> exponential_events(double per_minute, double mean_s, double seconds,
                                           const Random& random);

/// Returns the strength of an event at a time, 0 to 1: a raised cosine that rises and falls over
/// `edge_s` each, or over half the duration if that is shorter, and is 1 between.
double event_window(NoiseEvent event, double edge_s, double time_s);

/// The data on which the error of a track depends.
struct NoisyTrack {
  std::size_t number = 0;  ///< selects its generator
  std::size_t limb = 0;
  bool is_arm = false;
  int depth_axis = -1;                 ///< 0, 1, 2; -1: no axis is depth
  std::span<const double> speed;       ///< F, m/s
  std::span<const Vec3> displacement;  ///< F, mm from the track's mean; empty: no leaks
};

/// The errors of the tracks of one take. Each is the same whatever other tracks are requested. The
/// parts that tracks share are made once.
class TrackErrors {
 public:
  /// `noise`: all numbers must be set.
  TrackErrors(const SystemNoise& noise, std::size_t frames, double rate_hz, const Random& random)
      : noise_(noise), frames_(frames), rate_hz_(rate_hz), random_(random) {}

  /// Returns F vectors in mm.
  std::vector<Vec3> errors_of(const NoisyTrack& track);

 private:
  // Slow noise and floor of unit variance.
  struct Stationary {
    std::vector<Vec3> slow, floor;
  };
  struct Limb {
    Stationary common;
    std::vector<Vec3> errors;  // of the whole limb, mm; empty: none
  };

  Stationary stationary(const Random& random) const;
  const Limb& limb(std::size_t number);
  std::vector<Vec3> limb_errors(const Random& random) const;
  void add_leaks(std::vector<Vec3>& errors, const NoisyTrack& track, Random random) const;
  void add_bursts(std::vector<Vec3>& errors, const std::vector<Vec3>& deviations,
                  const Random& random) const;

  SystemNoise noise_;
  std::size_t frames_;
  double rate_hz_;
  Random random_;
  Stationary body_;
  std::map<std::size_t, Limb> limbs_;
};

}  // namespace kinemend::corrupt
