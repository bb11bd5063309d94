// Reads packets of OSC 1.0 in place, and replaces single floats in them; every other byte is
// unchanged.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// Bundles within bundles beyond this depth make a packet unreadable.
inline constexpr std::size_t most_osc_depth = 16;

/// A message of a packet. Positions count bytes from the start of the packet.
struct OscMessage {
  std::string_view address;   ///< "/VMC/Ext/Bone/Pos"
  std::string_view types;     ///< "sfffffff", without the comma; empty if the sender gives no types
  std::size_t arguments = 0;  ///< where the first argument begins
  std::size_t end = 0;        ///< where the message ends
};

/// Appends the messages of a packet, including those of bundles, to `messages` in order; they refer
/// to `packet`. Returns false and leaves `messages` unchanged if the packet breaks a rule of OSC: a
/// size that is not a multiple of 4 or exceeds its bundle, an unterminated string, an address
/// without its slash, or bundles deeper than `most_osc_depth`. Never throws for any bytes.
bool read_osc(std::string_view packet, std::vector<OscMessage>& messages);

/// Returns the string that begins at `place` and ends before `end`; none if it does not end there.
std::optional<std::string_view> osc_string(std::string_view packet, std::size_t place,
                                           std::size_t end);
/// Returns the padded size, in bytes, of a string of this length.
constexpr std::size_t osc_string_bytes(std::size_t length) { return (length / 4 + 1) * 4; }

/// Returns the float at `place`; all 4 bytes must be in the packet.
float osc_float(std::string_view packet, std::size_t place);
void set_osc_float(std::string& packet, std::size_t place, float value);

}  // namespace kinemend
