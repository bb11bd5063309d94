// Deflates bytes by zlib. Without zlib, as in a module for JavaScript, they are only framed.
#include "report/page/codec.hpp"

#if __has_include(<zlib.h>)
#include <zlib.h>

#include <new>
#else
#include <algorithm>
#include <cstdint>
#endif

namespace kinemend::page {

#if __has_include(<zlib.h>)

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 7);
  // The buffer is always large enough, so the only possible error is lack of memory.
  if (status != Z_OK) throw std::bad_alloc();
  result.resize(size);
  return result;
}

#else

namespace {

void append_little(std::string& bytes, std::uint32_t value) {
  bytes += static_cast<char>(value & 0xFF);
  bytes += static_cast<char>(value >> 8 & 0xFF);
}

// Returns the checksum of RFC 1950, section 9.
std::uint32_t adler32_of(std::string_view bytes) {
  // By definition.
  constexpr std::uint32_t prime = 65521;
  std::uint32_t a = 1, b = 0;
  for (const char byte : bytes) {
    a = (a + static_cast<unsigned char>(byte)) % prime;
    b = (b + a) % prime;
  }
  return b << 16 | a;
}

}  // namespace

// Writes stored blocks (RFC 1951, section 3.2.4) in the frame of RFC 1950.
std::string deflated(std::string_view bytes) {
  // By definition.
  constexpr std::size_t most = 65535;
  std::string result = "\x78\x01";
  std::size_t first = 0;
  do {
    const std::size_t size = std::min(most, bytes.size() - first);
    result += first + size == bytes.size() ? '\1' : '\0';
    append_little(result, static_cast<std::uint32_t>(size));
    append_little(result, ~static_cast<std::uint32_t>(size));
    result.append(bytes.substr(first, size));
    first += size;
  } while (first < bytes.size());
  const std::uint32_t sum = adler32_of(bytes);
  for (int shift = 24; shift >= 0; shift -= 8) result += static_cast<char>(sum >> shift & 0xFF);
  return result;
}

#endif

}  // namespace kinemend::page
