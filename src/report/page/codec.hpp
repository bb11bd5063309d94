// Samples the channels of a take and packs them into few bytes, which the page unpacks again
// (web/src/codec.ts).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::page {

/// One number over time as multiples of a quantum. `after` is empty if there is one take.
struct Quantised {
  std::vector<std::int32_t> before;
  std::vector<std::int32_t> after;
};

/// Returns the multiples nearest to the values; a non-finite value becomes 0. No value may be
/// farther than 2^30 quanta from 0 (`quantum_for`).
std::vector<std::int32_t> quantised(std::span<const double> values, double quantum);
/// Returns `quantum`, enlarged if values of that size require it.
double quantum_for(double quantum, double largest);

/// Frames are stored in two parts, so that a long take is visible before all of it has arrived:
/// every `stride`-th frame, then those between. With stride 1 one part holds all.
///
/// For each channel a part holds a byte for the take that comes first (0: after, 1: before; it is
/// the smoother one), that take, then the other minus it. With one take it holds only that take,
/// and nothing if there are no frames. A take is coded as a byte for the prediction, then the four
/// bytes of the remainders in separate planes, lowest first. Remainders are whole numbers modulo
/// 2^32, folded so that small ones of either sign are small. Predictions of the first part are 0:
/// zero, 1: the previous sample, 2: the line through the two previous ones. Predictions of
/// the second part are 0: zero, 1: the line between the frames of the first part, rounded down, and
/// after the last of them its value.
std::string first_part(std::span<const Quantised> channels, std::size_t stride);
std::string second_part(std::span<const Quantised> channels, std::size_t stride);

/// Returns the bytes deflated, in zlib's frame.
std::string deflated(std::string_view bytes);

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
