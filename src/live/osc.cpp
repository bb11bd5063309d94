// Walks the elements of a packet, and checks every size before it is used.
#include "live/osc.hpp"

#include <cstdint>

#include "base/bytes.hpp"
#include "base/portable.hpp"

namespace kinemend {

namespace {

constexpr std::size_t word = 4;
// "#bundle" with its terminating zero, followed by the time tag.
constexpr std::string_view bundle_begin{"#bundle\0", 8};
constexpr std::size_t bundle_head = 16;

// Reads the message in [begin, end).
bool read_osc_message(std::string_view packet, std::size_t begin, std::size_t end,
                      std::vector<OscMessage>& messages) {
  const auto address = osc_string(packet, begin, end);
  if (!address || !address->starts_with('/')) return false;
  OscMessage message{*address, {}, begin + osc_string_bytes(address->size()), end};
  if (message.arguments < end && packet[message.arguments] == ',') {
    const auto types = osc_string(packet, message.arguments, end);
    if (!types) return false;
    message.types = types->substr(1);
    message.arguments += osc_string_bytes(types->size());
  }
  messages.push_back(message);
  return true;
}

bool read_osc_element(std::string_view packet, std::size_t begin, std::size_t end,
                      std::size_t depth, std::vector<OscMessage>& messages) {
  if (!packet.substr(begin, end - begin).starts_with(bundle_begin))
    return read_osc_message(packet, begin, end, messages);
  if (end - begin < bundle_head || depth == most_osc_depth) return false;
  for (std::size_t place = begin + bundle_head; place < end;) {
    if (end - place < word) return false;
    const std::size_t size = read_word<std::uint32_t>(packet.data() + place, true);
    place += word;
    if (size == 0 || size % word != 0 || size > end - place) return false;
    if (!read_osc_element(packet, place, place + size, depth + 1, messages)) return false;
    place += size;
  }
  return true;
}

}  // namespace

bool read_osc(std::string_view packet, std::vector<OscMessage>& messages) {
  const std::size_t before = messages.size();
  if (!packet.empty() && packet.size() % word == 0 &&
      read_osc_element(packet, 0, packet.size(), 0, messages))
    return true;
  messages.resize(before);
  return false;
}

std::optional<std::string_view> osc_string(std::string_view packet, std::size_t place,
                                           std::size_t end) {
  if (place >= end) return std::nullopt;
  const std::string_view rest = packet.substr(place, end - place);
  const std::size_t length = rest.find('\0');
  if (length == rest.npos || osc_string_bytes(length) > rest.size()) return std::nullopt;
  return rest.substr(0, length);
}

float osc_float(std::string_view packet, std::size_t place) {
  return bits_as<float>(read_word<std::uint32_t>(packet.data() + place, true));
}

void set_osc_float(std::string& packet, std::size_t place, float value) {
  put_word(packet.data() + place, bits_as<std::uint32_t>(value), true);
}

}  // namespace kinemend
