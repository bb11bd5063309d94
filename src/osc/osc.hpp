// Reads packets of OSC 1.0 in place, and replaces single floats of them; every other byte stays.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// Bundles within bundles beyond this depth make a packet unreadable.
inline constexpr std::size_t most_osc_depth = 16;

/// A message of a packet. Places count bytes from the start of the packet.
struct OscMessage {
  std::string_view address;   ///< "/VMC/Ext/Bone/Pos"
  std::string_view types;     ///< "sfffffff", without the comma; empty if the sender names none
  std::size_t arguments = 0;  ///< where the first argument begins
  std::size_t end = 0;        ///< where the message ends
};

/// The messages of a packet, those of bundles too, in their order, which is appended to `messages`
/// and refers to `packet`. False if the packet breaks a rule of OSC: a size that is no multiple of
/// 4 or goes beyond its bundle, a string without an end, an address without its slash, bundles
/// deeper than `most_osc_depth`. `messages` is then as it was. Never throws for any bytes.
bool read_osc(std::string_view packet, std::vector<OscMessage>& messages);

/// The string that begins at `place` and ends before `end`; none if it has no end there.
std::optional<std::string_view> osc_string(std::string_view packet, std::size_t place,
                                           std::size_t end);
/// The bytes of a string of this length with its zeros.
constexpr std::size_t osc_string_bytes(std::size_t length) { return (length / 4 + 1) * 4; }

/// The float at `place`, of which all 4 bytes are in the packet.
float osc_float(std::string_view packet, std::size_t place);
void set_osc_float(std::string& packet, std::size_t place, float value);

}  // namespace kinemend
