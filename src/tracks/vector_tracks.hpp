#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend {

/// F frames of N tracks of vectors, one track behind the other, in degrees: rotations in their
/// moving charts, or positions brought to the same scale. Noise on a track is alike in all
/// directions.
struct VectorTracks {
  std::vector<Vec3> values;  ///< N x F
  /// N: 1 where the noise is alike only along those axes that have any (`make_round`).
  std::vector<std::uint8_t> has_quiet_axes;

  VectorTracks(std::size_t frames, std::size_t tracks)
      : values(frames * tracks), has_quiet_axes(tracks), frames_(frames) {}
  std::size_t frames() const noexcept { return frames_; }
  std::size_t tracks() const noexcept { return has_quiet_axes.size(); }
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

/// One mark a sample of some tracks.
struct SampleMarks {
  std::size_t frames = 0;
  std::size_t tracks = 0;
  std::vector<std::uint8_t> marks;  ///< N x F

  SampleMarks(std::size_t frame_count, std::size_t track_count)
      : frames(frame_count), tracks(track_count), marks(frame_count * track_count) {}
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

/// Marked in one or the other.
SampleMarks either(const SampleMarks& a, const SampleMarks& b);

/// Puts the straight line between its unmarked neighbours (the nearest one at the ends) into each
/// marked sample of a track; one without any unmarked sample stays.
void fill_marked(std::span<Vec3> track, std::span<const std::uint8_t> marked);

/// Standard deviation per axis of the white noise on each track, degrees; 0 for takes under 6
/// frames. Differences of order 3 and 5 hardly see the motion; the smaller of their medians counts,
/// or that of the quietest quarter of the take, each made unbiased for white noise. Differences
/// that touch a marked sample are left out. Of a track with quiet axes it is the noise on the
/// others.
std::vector<double> noise_levels(const VectorTracks& tracks, const SampleMarks& marked);
/// That of one track, with its own marks.
double noise_level(std::span<const Vec3> track, std::span<const std::uint8_t> marked,
                   bool has_quiet_axes);

/// Fifth differences of a track that touch no marked sample, scaled so that white noise keeps its
/// deviation.
std::vector<Vec3> fifth_differences(std::span<const Vec3> track,
                                    std::span<const std::uint8_t> marked);
/// Standard deviation of such differences in three directions (unit vectors), those that lie far
/// off cut short. 0 for none.
Vec3 noise_along(std::span<const Vec3> differences, const std::array<Vec3, 3>& directions);

/// How far each track is to be smoothed, 0 (left alone) to 1: a ramp over its noise, so that a take
/// as clean as a good capture is not touched. Where the median track is quiet the ramp starts
/// later; below 120 Hz too, where motion looks like noise.
std::vector<double> cleaning_shares(const std::vector<double>& noise, double frame_rate_hz);

}  // namespace kinemend
