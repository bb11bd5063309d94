// Draws the noise and the variation of motion that samples of joints and of markers share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// The standard deviation of each channel, degrees.
std::vector<double> deviations_of(const PoseMatrix& poses);

/// Applies a zero-phase Butterworth filter, with the cutoff limited to what the rate allows.
void low_pass(PoseMatrix& poses, int order, double cutoff_hz, double rate_hz);

/// Adds noise of one kind to all channels: white, of the first order or, with `has_slow`,
/// low-passed, with `strengths` (degrees, one per channel), which are spread further in some
/// samples, and in bursts in some. Returns whether the noise is slow: mostly below a few hertz.
bool add_random_noise(PoseMatrix& poses, double rate_hz, std::vector<double> strengths,
                      bool has_slow, Random& random);

/// Strengths of noise on joints, degrees, one per channel: equal or, with this chance, in
/// proportion to each channel's motion.
std::vector<double> random_strengths(const PoseMatrix& poses, double chance_of_shares,
                                     Random& random);
/// Low-passes with this chance, as pipelines do; returns whether it did.
bool low_pass_at_random(PoseMatrix& poses, double rate_hz, double chance, Random& random);

/// The damage of a sample.
enum class SampleDamage : std::uint8_t { none, quick, slow };
/// Whether the user declares the sample's system as one of slow errors: mostly if the damage is
/// slow.
bool is_said_to_be_slow(SampleDamage damage, Random& random);

/// Regular fast motion of a body: a tremor, a drum roll, a shaking hand, breathing.
struct Shaking {
  double chance = 0.1;      ///< that a sample has some
  double largest_deg = 20;  ///< at 2 Hz and less
};

/// Varies clean motion as takes vary: optical ones are low-passed too, some are keyed by hand, some
/// are exaggerated, and bodies shake.
void vary_motion(PoseMatrix& poses, double rate_hz, const Shaking& shaking, Random& random);

/// A uniformly random rotation of axes.
Quat random_turn(Random& random);
/// Rotates the vectors of a track to random axes.
void turn_track(PoseMatrix& poses, std::size_t track, Random& random);

/// `frames` frames from a random one on; all frames of a shorter motion.
PoseMatrix random_part(const PoseMatrix& motion, std::size_t frames, Random& random);

/// A random index with probability in proportion to its weight.
std::size_t drawn_index(std::span<const double> weights, Random& random);

/// Mostly 120, else 20 to 240.
double random_rate_hz(Random& random);
/// A random factor on the speed of a motion.
double random_pace(Random& random);

}  // namespace kinemend
