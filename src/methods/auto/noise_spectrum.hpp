// Describes and estimates the noise of a take: its colour, its strength for each track and axis,
// and how much of it shows in the distances between tracks, which motion hardly changes.
#pragma once

#include <optional>
#include <vector>

#include "methods/auto/tuning.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

struct Whitening;

/// The kind of tracks: joints turn abruptly, markers have mass and move smoothly.
enum class TrackKind { rotations, positions };

/// The noise of a take, estimated from its evidence: of one colour, with a strength for each track
/// and axis. Its spectrum is flat up to a corner and falls with the square of the frequency beyond
/// it.
struct NoiseSpectrum {
  double correlation = 0;        ///< from frame to frame; 0: white
  std::vector<Vec3> deviations;  ///< N, degrees, of each axis; empty: white
  /// Strength of the noise at the highest frequencies, as the deviation of equally strong white
  /// noise there: degrees, and divided by the speed of the motion in milliseconds. Medians over the
  /// tracks and axes.
  double fast_noise = 0, fast_noise_ms = 0;
  bool is_clear = false;  ///< more than motion could be mistaken for
  bool is_slow = false;   ///< of positions, and mostly below their motion's highest frequencies

  /// The deviation of white noise that is equally strong at the highest frequencies, relative to
  /// that of this noise.
  double fast_share() const;
  /// For each track, the root mean square of its deviations over the axes, degrees.
  std::vector<double> strengths() const;
};

/// Share of smoothing of each track under such noise times `scale`, 0 to 1. A track with next to no
/// noise at the highest frequencies is unchanged.
std::vector<double> coloured_shares(const NoiseSpectrum& spectrum, double scale,
                                    double frame_rate_hz, const ColourTuning& tuning = {});

/// Estimates the noise of a take without its marked samples. The evidence of windows (1 s, at most
/// 24, evenly over the take) is summed for each track and axis and each strength of the noise,
/// every window with its own likeliest motion, and over all tracks for each colour: noise is
/// constant while motion varies. For positions under slow noise, the strength is then estimated
/// from two stretches of 30 s, as the residual of a motion with white third differences, up to four
/// times that of the windows. Takes under 24 frames (positions: 4 s) and with fewer than four
/// moving tracks are not estimated. A colour that more than a quarter of the tracks find less
/// likely than white is rejected. If the `correlation` is known (above 0), only the strength is
/// estimated, and the noise is clear. `whitenings`, one per track, if given, are undone first.
NoiseSpectrum noise_spectrum_of(const VectorTracks& tracks, const SampleMarks& marked,
                                double frame_rate_hz, TrackKind kind,
                                std::optional<double> correlation = std::nullopt,
                                const std::vector<Whitening>* whitenings = nullptr,
                                const ColourTuning& tuning = {});

/// How much of a noise is visible in the distances between tracks, from 0 (none) to about 1 (all):
/// noise moves the markers of one segment against each other, motion does not. For each track with
/// noise: the change of its distance to another from frame to frame, relative to the change that
/// independent noise of these `deviations` (N, of each axis) and this `correlation` from frame to
/// frame would cause; the least over the other tracks. Returns the median over the tracks. `marked`
/// samples are ignored. 0 if no two tracks are seen together.
double noise_in_distances(const VectorTracks& tracks, const SampleMarks& marked,
                          const std::vector<Vec3>& deviations, double correlation);

}  // namespace kinemend
