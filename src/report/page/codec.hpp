// Packs channels into few bytes, which the page unpacks again (web/src/codec.ts).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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
std::string base64(std::string_view bytes);

}  // namespace kinemend::page
