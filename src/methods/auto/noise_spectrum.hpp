// Describes and estimates the noise of a take: its colour, and its strength on each track and axis.
#pragma once

#include <optional>
#include <vector>

#include "methods/auto/tuning.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

struct Whitening;

/// What tracks are: joints turn with corners, markers have mass and move smoothly.
enum class TrackKind { rotations, positions };

/// The noise of a take as its evidence shows it: of one colour, at a strength of each track and
/// axis. Its spectrum is flat up to a corner and falls with the square of the frequency beyond it.
struct NoiseSpectrum {
  double correlation = 0;        ///< from frame to frame; 0: white
  std::vector<Vec3> deviations;  ///< N, degrees, of each axis; empty: white
  /// What is left of it at the highest frequencies, as the deviation of white noise that is as
  /// strong there: degrees, and over the speed of the motion in milliseconds. Medians of the tracks
  /// and axes.
  double fast_noise = 0, fast_noise_ms = 0;
  bool is_clear = false;  ///< more than motion could be taken for
  bool is_slow = false;   ///< of positions, and mostly below their motion's highest frequencies

  /// Deviation of the white noise that is as strong as this at the highest frequencies, over that
  /// of this noise.
  double fast_share() const;
  /// Of each track: the root mean square of its deviations over the axes, degrees.
  std::vector<double> strengths() const;
};

/// How far each track is to be smoothed under such noise times `scale`, 0 to 1: a track on which
/// there is next to none, at the highest frequencies, is left alone.
std::vector<double> coloured_shares(const NoiseSpectrum& spectrum, double scale,
                                    double frame_rate_hz, const ColourTuning& tuning = {});

/// Estimates the noise of a take whose marked samples are gone. The evidence of windows (1 s, at
/// most 24, evenly over the take) is summed over those of one track and axis for each strength of
/// the noise, every window with its own likeliest motion, and over all for each colour: noise is
/// what goes on while motion comes and goes. Of positions under noise that is slow, the strength is
/// then estimated from two stretches of 30 s, as the rest of a motion whose third differences are
/// white, up to four times what the windows show. Takes under 24 frames (positions: 4 s) and of
/// fewer than four tracks that move are not looked at. A colour that more than a quarter of the
/// tracks find less likely than white is none. Where the `correlation` is known (above 0),
/// the strength alone is estimated, and is clear.
/// `whitenings`, one a track, if any, are undone on what is looked at.
NoiseSpectrum noise_spectrum_of(const VectorTracks& tracks, const SampleMarks& marked,
                                double frame_rate_hz, TrackKind kind,
                                std::optional<double> correlation = std::nullopt,
                                const std::vector<Whitening>* whitenings = nullptr,
                                const ColourTuning& tuning = {});

}  // namespace kinemend
