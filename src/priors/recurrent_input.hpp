#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// What the network of the method `recurrent` sees of a take and what its outputs do to it. One
// path for training and cleaning; at the model's rate, F frames of D channels in degrees, in
// floats.
namespace kinemend {

/// Frames of one step of the network.
inline constexpr std::size_t recurrent_step = 4;
/// Smoothing kernels whose differences a channel is made of: six bands of what `auto` took away
/// (u), four of what it left (a).
inline constexpr std::size_t recurrent_bands = 10;

/// Of each channel over the takes of the training.
struct RecurrentStatistics {
  std::vector<float> mean;       ///< D, degrees
  std::vector<float> deviation;  ///< D, of the poses
  std::vector<float> speed;      ///< D, of the change from step to step
};

/// A take before and after `auto`.
struct RecurrentTake {
  std::size_t frames = 0;
  std::size_t channels = 0;         ///< D, three a track
  std::vector<float> measured;      ///< F x D, y
  std::vector<float> automatic;     ///< F x D, a; bridges where nothing was measured
  std::vector<std::uint8_t> marks;  ///< F x D / 3, 1: missing or a spike
};

struct RecurrentInput {
  std::size_t frames = 0;
  std::size_t steps = 0;  ///< T, F / recurrent_step rounded up
  std::size_t channels = 0;
  std::vector<float> scales;    ///< D, deviation of u, degrees
  std::vector<float> features;  ///< T x recurrent_feature_count(D)
  std::vector<float> bands;     ///< F x recurrent_bands x D, degrees
};

/// Pose and its change (D each), u / scale and the quick part of a / scale in each frame of the
/// step (4 D each), the logarithm of the scales (D), marks (4 D / 3).
std::size_t recurrent_feature_count(std::size_t channels);
/// Gains of the bands (recurrent_bands x D), and a residual for each frame of the step (4 D).
std::size_t recurrent_output_count(std::size_t channels);

RecurrentInput recurrent_input(const RecurrentTake& take, const RecurrentStatistics& statistics);

/// What is to be added to a (F x D): the gains, joined by straight lines from step to step, times
/// the bands, and the residual times the scale; both fade out where u does.
///
///     delta[f, d] = w_d (s_d r[t, f mod 4, d] + sum_k g_k[f, d] band_k[f, d]),
///     w_d = s_d / (s_d + 0.02 deg)
void recurrent_correction(const RecurrentInput& input, std::span<const float> outputs,
                          std::span<float> correction);
/// Its adjoint: the derivative by the outputs (T x O) from that by the correction (F x D).
void recurrent_correction_adjoint(const RecurrentInput& input, std::span<const float> derivative,
                                  std::span<float> outputs);

}  // namespace kinemend
