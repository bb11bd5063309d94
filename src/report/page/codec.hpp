// Packs channels into few bytes, which the page unpacks again (web/src/codec.ts).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::page {

/// One number over time as whole multiples of a quantum. `after` is empty where there is one take.
struct Quantised {
  std::vector<std::int32_t> before;
  std::vector<std::int32_t> after;
};

/// The multiples nearest to the values; a value that is not finite is 0. No value may be further
/// than 2^30 quanta from 0 (`quantum_for`).
std::vector<std::int32_t> quantised(std::span<const double> values, double quantum);
/// `quantum`, or as much more as values of that size need.
double quantum_for(double quantum, double largest);

/// Frames are told in two parts, so that a long take is seen before all of it is there: every
/// `stride`-th frame, then those between. One part holds all where the stride is 1.
///
/// Of each channel a part holds which take comes first (a byte, 0: after, 1: before: the smoother
/// one), that take, then the other less it; of one take only that take, of no frames nothing. What
/// is coded is a byte for the prediction, then the four bytes of each remainder apart, lowest
/// first: remainders are whole numbers modulo 2^32, folded so that small ones of either sign are
/// small. Predictions of the first part are 0: zero, 1: the sample before, 2: the line through the
/// two before; of the second 0: zero, 1: the line between the frames of the first part, rounded
/// down, and behind the last of them that one.
std::string first_part(std::span<const Quantised> channels, std::size_t stride);
std::string second_part(std::span<const Quantised> channels, std::size_t stride);

/// Deflated, in zlib's frame.
std::string deflated(std::string_view bytes);
std::string base64(std::string_view bytes);

}  // namespace kinemend::page
