// Holds the data of the steps of `auto`, tracks of vectors in degrees and marks of samples, and
// measures their white noise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/rotation.hpp"
#include "methods/auto/tuning.hpp"

namespace kinemend {

/// F frames of N tracks of vectors, one track after the other, in degrees: rotations in their
/// charts, or positions on the same scale. Noise is assumed to have the same variance along each
/// axis.
struct VectorTracks {
  std::vector<Vec3> values;  ///< N x F
  /// N: 1 for a track that `whiten` has mapped; axes without noise stay without noise.
  std::vector<std::uint8_t> is_whitened;

  VectorTracks(std::size_t frames, std::size_t tracks)
      : values(frames * tracks), is_whitened(tracks), frames_(frames) {}
  /// Sets each vector to `vector(frame, track)`.
  template <class Vector>
  VectorTracks(std::size_t frames, std::size_t tracks, const Vector& vector)
      : VectorTracks(frames, tracks) {
    for (std::size_t n = 0; n < tracks; ++n) {
      for (std::size_t t = 0; t < frames; ++t) set(t, n, vector(t, n));
    }
  }
  std::size_t frames() const noexcept { return frames_; }
  std::size_t tracks() const noexcept { return is_whitened.size(); }
  Vec3 at(std::size_t frame, std::size_t track) const { return values[track * frames_ + frame]; }
  void set(std::size_t frame, std::size_t track, Vec3 vector) {
    values[track * frames_ + frame] = vector;
  }
  std::span<Vec3> track(std::size_t track) {
    return std::span(values).subspan(track * frames_, frames_);
  }
  std::span<const Vec3> track(std::size_t track) const {
    return std::span(values).subspan(track * frames_, frames_);
  }

 private:
  std::size_t frames_;
};

/// One mark per sample of N tracks.
struct SampleMarks {
  std::size_t frames = 0;
  std::size_t tracks = 0;
  std::vector<std::uint8_t> marks;  ///< N x F

  SampleMarks(std::size_t frame_count, std::size_t track_count)
      : frames(frame_count), tracks(track_count), marks(frame_count * track_count) {}
  /// Marks each sample for which `is_marked(frame, track)`.
  template <class IsMarked>
  SampleMarks(std::size_t frame_count, std::size_t track_count, const IsMarked& is_marked)
      : SampleMarks(frame_count, track_count) {
    for (std::size_t n = 0; n < tracks; ++n) {
      for (std::size_t t = 0; t < frames; ++t) (*this)(t, n) = is_marked(t, n) ? 1 : 0;
    }
  }
  std::uint8_t& operator()(std::size_t frame, std::size_t track) {
    return marks[track * frames + frame];
  }
  std::uint8_t operator()(std::size_t frame, std::size_t track) const {
    return marks[track * frames + frame];
  }
  std::span<std::uint8_t> track(std::size_t track) {
    return std::span(marks).subspan(track * frames, frames);
  }
  std::span<const std::uint8_t> track(std::size_t track) const {
    return std::span(marks).subspan(track * frames, frames);
  }
  friend bool operator==(const SampleMarks&, const SampleMarks&) = default;
};

/// The union of both.
SampleMarks either(const SampleMarks& a, const SampleMarks& b);

/// Interpolates the marked samples of a track linearly, and holds the nearest unmarked one at the
/// ends; a track without unmarked samples is not changed.
void fill_marked(std::span<Vec3> track, std::span<const std::uint8_t> marked);

/// Standard deviation per axis of the white noise on each track, degrees; 0 for takes under 6
/// frames: the smaller of the medians of the differences of order 3 and 5, both unbiased for white
/// noise, which respond little to motion. Differences that touch a marked sample are left out. For
/// a whitened track it is the noise along the axes that have some.
std::vector<double> noise_levels(const VectorTracks& tracks, const SampleMarks& marked,
                                 const NoiseTuning& tuning = {});
/// The same for one track, with its own marks.
double noise_level(std::span<const Vec3> track, std::span<const std::uint8_t> marked,
                   bool is_whitened, const NoiseTuning& tuning = {});

/// Fifth differences of a track that touch no marked sample, scaled so that white noise keeps its
/// deviation.
std::vector<Vec3> fifth_differences(std::span<const Vec3> track,
                                    std::span<const std::uint8_t> marked);
/// Huber's estimate of the standard deviation of such differences along three unit vectors. 0 for
/// no differences.
Vec3 noise_along(std::span<const Vec3> differences, const std::array<Vec3, 3>& directions);

/// 0 up to `start`, 1 from `full` on; between them a cubic that is level at both ends.
double smooth_ramp(double value, double start, double full);

/// How much more motion looks like noise than at 120 Hz: 1 from there up.
double rate_factor_of(double frame_rate_hz, const DeadZoneTuning& tuning = {});

/// Share of smoothing of each track, 0 (not changed) to 1: a ramp over its noise, so that a take as
/// clean as a good capture is not changed. The ramp starts later where the median track is quiet,
/// and below 120 Hz, where differences respond to motion.
std::vector<double> smoothing_shares(const std::vector<double>& noise, double frame_rate_hz,
                                     const DeadZoneTuning& tuning = {});
/// The same, times the agreement of these tracks.
std::vector<double> smoothing_shares(const VectorTracks& tracks, const std::vector<double>& noise,
                                     double frame_rate_hz, const TrackTuning& tuning = {});

/// Confidence that damage is not motion, 0 to 1, from the tracks that show it (`is_damaged`, one
/// per track). A few seconds below 50 Hz do not distinguish a snappy keyed move from noise or an
/// outlier. The errors of a system are on all tracks that it measures, moves are on some joints:
/// such a take is damaged when most moving tracks, of at least six, are. 1 for all other takes.
double agreement_of(const VectorTracks& tracks, std::span<const std::uint8_t> is_damaged,
                    double frame_rate_hz, const AgreementTuning& tuning = {});
/// The same from the tracks whose noise exceeds the least that is smoothed.
double noise_agreement(const VectorTracks& tracks, const std::vector<double>& noise,
                       double frame_rate_hz, const TrackTuning& tuning = {});

/// Whether a take is too short, at its rate, for its quiet moments to distinguish fast motion from
/// noise.
bool is_brief(std::size_t frames, double frame_rate_hz, const AgreementTuning& tuning = {});

}  // namespace kinemend
