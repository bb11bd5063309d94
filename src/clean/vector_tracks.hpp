#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/pose_matrix.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// F frames of N tracks of vectors, frame-major, in degrees: rotations in their moving charts, or
/// positions brought to the same scale. Noise on a track is alike in all directions.
struct VectorTracks {
  PoseMatrix values;  ///< F x 3N
  /// N: 1 where the noise is alike only along those axes that have any (`make_round`).
  std::vector<std::uint8_t> has_quiet_axes;

  VectorTracks(std::size_t frames, std::size_t tracks)
      : values(frames, 3 * tracks), has_quiet_axes(tracks) {}
  std::size_t frames() const noexcept { return values.frames; }
  std::size_t tracks() const noexcept { return values.channels / 3; }
  Vec3 at(std::size_t frame, std::size_t track) const {
    const double* v = values.values.data() + frame * values.channels + 3 * track;
    return {v[0], v[1], v[2]};
  }
  void set(std::size_t frame, std::size_t track, Vec3 vector) {
    double* v = values.values.data() + frame * values.channels + 3 * track;
    v[0] = vector.x;
    v[1] = vector.y;
    v[2] = vector.z;
  }
};

/// One mark a sample of some tracks.
struct SampleMarks {
  std::size_t frames = 0;
  std::size_t tracks = 0;
  std::vector<std::uint8_t> marks;  ///< F x N

  SampleMarks(std::size_t frame_count, std::size_t track_count)
      : frames(frame_count), tracks(track_count), marks(frame_count * track_count) {}
  std::uint8_t& operator()(std::size_t frame, std::size_t track) {
    return marks[frame * tracks + track];
  }
  std::uint8_t operator()(std::size_t frame, std::size_t track) const {
    return marks[frame * tracks + track];
  }
  friend bool operator==(const SampleMarks&, const SampleMarks&) = default;
};

/// Marked in one or the other.
SampleMarks either(const SampleMarks& a, const SampleMarks& b);

/// Puts the straight line between its unmarked neighbours (the nearest one at the ends) into each
/// marked sample.
void fill_marked(VectorTracks& tracks, const SampleMarks& marked);

/// Standard deviation per axis of the white noise on each track, degrees; 0 for takes under 6
/// frames. Differences of order 3 and 5 hardly see the motion; the smaller of their medians counts,
/// or that of the quietest quarter of the take, each made unbiased for white noise. Differences
/// that touch a marked sample are left out. Of a track with quiet axes it is the noise on the
/// others.
std::vector<double> noise_levels(const VectorTracks& tracks, const SampleMarks& marked);

/// Fifth differences of a track that touch no marked sample, scaled so that white noise keeps its
/// deviation.
std::vector<Vec3> fifth_differences(const VectorTracks& tracks, const SampleMarks& marked,
                                    std::size_t track);
/// Standard deviation of such differences in three directions (unit vectors), those that lie far
/// off cut short. 0 for none.
Vec3 noise_along(std::span<const Vec3> differences, const std::array<Vec3, 3>& directions);

/// How far each track is to be smoothed, 0 (left alone) to 1: a ramp over its noise, so that a take
/// as clean as a good capture is not touched. Where the median track is quiet the ramp starts
/// later; below 120 Hz too, where motion looks like noise.
std::vector<double> cleaning_shares(const std::vector<double>& noise, double frame_rate_hz);

}  // namespace kinemend
