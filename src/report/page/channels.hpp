// A take as the channels that the page holds.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"
#include "report/page/codec.hpp"

namespace kinemend::page {

/// Half a quantum is the largest error of a value, unless it is too large for 2^30 quanta. These
/// are the coarsest quanta: speeds and accelerations of short takes deserve finer ones. Chosen by
/// hand, not swept.
inline constexpr double rotation_quantum_deg = 0.04;
/// Of positions, file units: a seventeen thousandth of the body, 0.1 mm of a person.
double position_quantum(double body_height);

/// More samples than this, of one take, and not every frame goes in. Chosen by hand, not swept.
inline constexpr std::size_t most_samples = 10'000'000;
/// More than this, and frames go in in two parts. Chosen by hand, not swept.
inline constexpr std::size_t most_samples_at_once = 2'500'000;
inline constexpr std::size_t stride_of_parts = 8;

/// Every how many frames of the take are told, so that no more than `most_samples` are.
std::size_t frame_step(std::size_t frames, std::size_t channels);
/// The stride of `first_part` for so many frames that are told.
std::size_t part_stride(std::size_t frames, std::size_t channels);

/// Channels of all tracks: what the page reads them by is their order. Frames 0, step, 2 step, ...
struct Channels {
  std::vector<Quantised> samples;
  std::vector<double> quanta;
  std::size_t step = 1;
  std::size_t frames = 0;  ///< told
};
std::size_t channel_count(const Take& take);
/// The axes a joint's rotation is told by: those of its channels, or Z X Y where it turns without
/// any; none where it never turns.
RotationOrder told_order(const Take& before, const Take* after, std::size_t joint);
/// x, y, z of joint 0, then of each translated joint; then the angles of each joint about the axes
/// of `told_order`, degrees, without whole turns between frames, those after nearest to those
/// before. Of markers x, y, z of each, where a missing sample repeats the one before. `share`: of
/// the coarsest quanta.
Channels channels_of(const Take& before, const Take* after, double body_height, double share = 1);

}  // namespace kinemend::page
