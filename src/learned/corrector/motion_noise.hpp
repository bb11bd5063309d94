// What samples of joints and samples of markers have in common: how motion varies, and noise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/experimental/pose_matrix.hpp"
#include "kinemend/experimental/random.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// Of each channel, degrees.
std::vector<double> deviations_of(const PoseMatrix& poses);

/// Butterworth, zero phase, at a frequency that the rate allows.
void low_pass(PoseMatrix& poses, int order, double cutoff_hz, double rate_hz);

/// Adds noise of one kind to all channels: white, of the first order or, with `has_slow`,
/// low-passed; by `strengths` (degrees, one a channel), which are spread further in some samples,
/// in bursts in some. Returns whether the noise is slow: mostly below a few hertz.
bool add_random_noise(PoseMatrix& poses, double rate_hz, std::vector<double> strengths,
                      bool has_slow, Random& random);

/// Strengths of noise on joints, degrees, one a channel: alike or, with this chance, in proportion
/// to how far each channel moves.
std::vector<double> random_strengths(const PoseMatrix& poses, double chance_of_shares,
                                     Random& random);
/// Filters with this chance, as pipelines do; returns whether it has.
bool low_pass_at_random(PoseMatrix& poses, double rate_hz, double chance, Random& random);

/// The damage of a sample.
enum class SampleDamage : std::uint8_t { none, quick, slow };
/// Whether a person says of a sample that its system errs slowly: mostly of those that do.
bool is_said_to_be_slow(SampleDamage damage, Random& random);

/// What a body does that is regular and fast: a tremor, a drum roll, a hand that shakes, breathing.
struct Shaking {
  double chance = 0.1;      ///< of a sample that has some
  double largest_deg = 20;  ///< at 2 Hz and less
};

/// Clean takes are not all alike: optical ones come low-passed too, some are keyed by hand, some
/// exaggerated, and bodies shake.
void vary_motion(PoseMatrix& poses, double rate_hz, const Shaking& shaking, Random& random);

/// Of axes, drawn evenly.
Quat random_turn(Random& random);
/// The vectors of a track in other axes.
void turn_track(PoseMatrix& poses, std::size_t track, Random& random);

/// So many frames from a random one on; all of them where there are no more.
PoseMatrix random_part(const PoseMatrix& motion, std::size_t frames, Random& random);

/// The index of a weight, drawn in proportion to them.
std::size_t drawn_index(std::span<const double> weights, Random& random);

/// 120 mostly, else 20 to 240.
double random_rate_hz(Random& random);
/// At which a motion is shown.
double random_pace(Random& random);

}  // namespace kinemend
