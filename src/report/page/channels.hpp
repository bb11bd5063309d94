// The channels of a take as the page stores them.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"
#include "report/page/codec.hpp"

namespace kinemend::page {

/// The largest error of a value is half a quantum, unless the value exceeds 2^30 quanta. These are
/// the coarsest quanta; short takes get finer ones for their speeds and accelerations. Chosen by
/// hand, not swept.
inline constexpr double rotation_quantum_deg = 0.04;
/// Returns the quantum of positions in file units: a seventeen thousandth of the body, 0.1 mm for a
/// person.
double position_quantum(double body_height);

/// Frames are skipped if one take has more samples than this. Chosen by hand, not swept.
inline constexpr std::size_t most_samples = 10'000'000;
/// Frames are sent in two parts if there are more samples than this. Chosen by hand, not swept.
inline constexpr std::size_t most_samples_at_once = 2'500'000;
inline constexpr std::size_t stride_of_parts = 8;

/// Returns the step between stored frames that keeps them within `most_samples`.
std::size_t frame_step(std::size_t frames, std::size_t channels);
/// Returns the stride of `first_part` for this number of stored frames.
std::size_t part_stride(std::size_t frames, std::size_t channels);

/// Channels of all tracks, which the page identifies by their order. Frames are 0, step, 2 step,
/// ...
struct Channels {
  std::vector<Quantised> samples;
  std::vector<double> quanta;
  std::size_t step = 1;
  std::size_t frames = 0;  ///< stored frames
};
std::size_t channel_count(const Take& take);
/// Returns the axes about which a joint's rotation is stored: those of its channels, or Z X Y if it
/// turns without channels; none if it never turns.
RotationOrder told_order(const Take& before, const Take* after, std::size_t joint);
/// Returns x, y, z of joint 0, then of each translated joint; then the angles of each joint about
/// the axes of `told_order`, in degrees. Angles have no whole turns between frames, and those after
/// are nearest to those before. For markers: x, y, z of each; a missing sample repeats the previous
/// one. `share`: the quanta relative to the coarsest ones.
Channels channels_of(const Take& before, const Take* after, double body_height, double share = 1);

}  // namespace kinemend::page
