// Paths from narrow strings are UTF-8 on Windows. The standard library of GCC converts a wide path
// to UTF-8, but reads a narrow one byte by byte if no locale is set; the linker replaces that
// function by this one (--wrap, see CMakeLists.txt).
#if defined(_WIN32) && defined(__GNUC__)
#include <cstddef>
#include <cstdint>
#include <cwchar>
#include <locale>

namespace {

struct Decoded {
  std::uint32_t letter = 0;
  std::size_t bytes = 1;
};

// A byte that starts no valid UTF-8 character is taken as a character itself, so that every string
// is a path.
Decoded decoded(const char* from, const char* end) {
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return static_cast<unsigned char>(from[i]);
  };
  const std::uint32_t first = byte(0);
  const std::size_t count = first >= 0xF0 && first < 0xF5   ? 4
                            : first >= 0xE0 && first < 0xF0 ? 3
                            : first >= 0xC2 && first < 0xE0 ? 2
                                                            : 1;
  if (count == 1 || static_cast<std::size_t>(end - from) < count) return {first, 1};
  std::uint32_t letter = first & (0x7FU >> count);
  for (std::size_t i = 1; i < count; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {first, 1};
    letter = letter << 6 | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = letter >= 0xD800 && letter < 0xE000;
  if (letter < least[count] || letter > 0x10FFFF || is_surrogate) return {first, 1};
  return {letter, count};
}

}  // namespace

// Replaces std::codecvt<wchar_t, char, std::mbstate_t>::do_in.
extern "C" std::codecvt_base::result __wrap__ZNKSt7codecvtIwciE5do_inERiPKcS3_RS3_PwS5_RS5_(
    const void* /*self*/, std::mbstate_t& /*state*/, const char* from, const char* end,
    const char*& next, wchar_t* to, wchar_t* to_end, wchar_t*& to_next) {
  std::codecvt_base::result result = std::codecvt_base::ok;
  while (from < end) {
    const Decoded read = decoded(from, end);
    const std::ptrdiff_t units = read.letter > 0xFFFF ? 2 : 1;
    if (to_end - to < units) {
      result = std::codecvt_base::partial;
      break;
    }
    if (units == 2) {
      *to++ = static_cast<wchar_t>(0xD800 + ((read.letter - 0x10000) >> 10));
      *to++ = static_cast<wchar_t>(0xDC00 + ((read.letter - 0x10000) & 0x3FF));
    } else {
      *to++ = static_cast<wchar_t>(read.letter);
    }
    from += read.bytes;
  }
  next = from;
  to_next = to;
  return result;
}
#endif
