// Makes OSC packets for tests, independently of the code under test.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::test {

inline std::string osc_text(std::string_view text) {
  std::string bytes(text);
  bytes.append(4 - text.size() % 4, '\0');
  return bytes;
}

inline std::string osc_number(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<char>(value >> shift & 0xFF));
  return bytes;
}

inline std::string osc_real(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return osc_number(bits);
}

inline std::string osc_message(std::string_view address, std::string_view types,
                               const std::string& arguments = {}) {
  return osc_text(address) + osc_text(std::string(",").append(types)) + arguments;
}

inline std::string osc_bundle(const std::vector<std::string>& elements, std::uint32_t seconds = 0,
                              std::uint32_t fraction = 1) {
  std::string bytes = osc_text("#bundle") + osc_number(seconds) + osc_number(fraction);
  for (const std::string& element : elements)
    bytes += osc_number(static_cast<std::uint32_t>(element.size())) + element;
  return bytes;
}

}  // namespace kinemend::test
