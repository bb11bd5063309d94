// Runs the steps of `auto` in order: samples of a lower rate, whitening, spikes, colour of the
// noise, smoothing.
#include "methods/auto/track_cleaning.hpp"

#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "methods/auto/held_samples.hpp"
#include "methods/auto/noise_spectrum.hpp"
#include "methods/auto/smoothing.hpp"
#include "methods/auto/spikes.hpp"

namespace kinemend {

namespace {

// Whether a take has enough noise, as white noise, to estimate its colour.
bool may_be_coloured(std::vector<double> levels, double frame_rate_hz, const ColourTuning& tuning) {
  return !levels.empty() && median_of(levels) > tuning.least_noise * rate_factor_of(frame_rate_hz);
}

bool shows_in_distances(VectorTracks tracks, const std::vector<Whitening>& whitenings,
                        const SampleMarks& missing, const NoiseSpectrum& spectrum,
                        const ColourTuning& tuning) {
  undo_whitening(tracks, whitenings);
  return noise_in_distances(tracks, missing, spectrum.deviations, spectrum.correlation) >
         tuning.least_in_distances;
}

// A track with few observed samples keeps its bridges unsmoothed.
void leave_hardly_observed(const SampleMarks& missing, std::vector<double>& shares) {
  for (std::size_t n = 0; n < shares.size(); ++n) {
    std::size_t seen = 0;
    for (std::size_t t = 0; t < missing.frames; ++t) seen += missing(t, n) == 0;
    if (seen < 2 * fewest_clean_frames) shares[n] = 0;
  }
}

// The noise of tracks whose marked samples are `missing`; white unless it has a clear colour.
NoiseSpectrum spectrum_of(const VectorTracks& tracks, const SampleMarks& missing,
                          const std::vector<Whitening>& whitenings, double frame_rate_hz,
                          const TrackCleaningSettings& settings) {
  NoiseSpectrum spectrum =
      noise_spectrum_of(tracks, missing, frame_rate_hz, settings.kind, settings.correlation,
                        &whitenings, settings.tuning.colour);
  if (settings.correlation || !spectrum.is_clear || settings.kind == TrackKind::rotations)
    return spectrum;
  spectrum.is_clear =
      shows_in_distances(tracks, whitenings, missing, spectrum, settings.tuning.colour);
  return spectrum;
}

bool is_known(const std::vector<double>& noise, std::size_t track) {
  return track < noise.size() && noise[track] > 0;
}

// Replaces measured noise by known noise.
void take_known(const std::vector<double>& known, CleanedTracks& cleaned) {
  for (std::size_t n = 0; n < known.size(); ++n) {
    if (!is_known(known, n)) continue;
    cleaned.noise[n] = known[n];
    if (cleaned.spectrum.is_clear) cleaned.spectrum.deviations[n] = {known[n], known[n], known[n]};
  }
}

// Cleans tracks in which every frame is a measurement.
CleanedTracks clean_measurements(VectorTracks& tracks, const SampleMarks& spike_candidates,
                                 const SampleMarks& always_missing,
                                 const std::vector<std::vector<std::size_t>>& nearby,
                                 double frame_rate_hz, const TrackCleaningSettings& settings,
                                 ShareProgress* progress) {
  const TrackTuning& tuning = settings.tuning;
  const std::vector<Whitening> whitenings =
      estimate_whitening(tracks, always_missing, frame_rate_hz, tuning.noise);
  whiten(tracks, whitenings);
  CleanedTracks cleaned{SampleMarks(tracks.frames(), tracks.tracks()), {}, {}, {}, {}};
  if (settings.despike) {
    DetectedSpikes found = find_spikes(tracks, spike_candidates, nearby, frame_rate_hz,
                                       &always_missing, progress, tuning);
    cleaned.marked = std::move(found.marked);
    cleaned.noise = std::move(found.noise);
  } else {
    cleaned.noise = noise_levels(tracks, always_missing, tuning.noise);
  }
  const SampleMarks missing = either(cleaned.marked, always_missing);
  const bool looks_for_colour = settings.correlation
                                    ? *settings.correlation > 0
                                    : may_be_coloured(cleaned.noise, frame_rate_hz, tuning.colour);
  if (looks_for_colour) {
    cleaned.spectrum = spectrum_of(tracks, missing, whitenings, frame_rate_hz, settings);
    if (cleaned.spectrum.is_clear) undo_whitening(tracks, whitenings);
  }
  if (cleaned.spectrum.is_clear) cleaned.noise = cleaned.spectrum.strengths();
  take_known(settings.noise, cleaned);
  if (cleaned.spectrum.is_clear) {
    cleaned.shares =
        coloured_shares(cleaned.spectrum, settings.sensitivity, frame_rate_hz, tuning.colour);
    leave_hardly_observed(missing, cleaned.shares);
    if (settings.smooth) {
      smooth_coloured(tracks, missing, cleaned.spectrum, settings.sensitivity, cleaned.shares,
                      frame_rate_hz, progress, tuning.colour);
    }
  } else {
    std::vector<double> assumed = cleaned.noise;
    for (double& level : assumed) level *= settings.sensitivity;
    cleaned.shares = smoothing_shares(assumed, frame_rate_hz, tuning.dead_zone);
    const double agreement = noise_agreement(tracks, assumed, frame_rate_hz, tuning);
    for (std::size_t n = 0; n < cleaned.shares.size(); ++n)
      if (!is_known(settings.noise, n)) cleaned.shares[n] *= agreement;
    leave_hardly_observed(missing, cleaned.shares);
    if (settings.smooth) {
      smooth_tracks(tracks, missing, assumed, cleaned.shares, frame_rate_hz, progress,
                    tuning.smoothing);
    }
    undo_whitening(tracks, whitenings);
  }
  return cleaned;
}

}  // namespace

CleanedTracks clean_tracks(VectorTracks& tracks, const SampleMarks& spike_candidates,
                           const SampleMarks& always_missing,
                           const std::vector<std::vector<std::size_t>>& nearby,
                           double frame_rate_hz, const TrackCleaningSettings& settings,
                           ShareProgress* progress) {
  const SamplePattern pattern = find_sample_pattern(tracks, always_missing, settings.tuning.held);
  if (pattern.join == SampleJoin::none) {
    return clean_measurements(tracks, spike_candidates, always_missing, nearby, frame_rate_hz,
                              settings, progress);
  }
  VectorTracks samples = measured_samples(tracks, pattern);
  CleanedTracks cleaned = clean_measurements(samples, marks_of_samples(spike_candidates, pattern),
                                             marks_of_samples(always_missing, pattern), nearby,
                                             frame_rate_hz / pattern.step, settings, progress);
  cleaned.marked = spread_samples(samples, cleaned.marked, cleaned.shares, pattern, tracks);
  cleaned.pattern = pattern;
  return cleaned;
}

}  // namespace kinemend
