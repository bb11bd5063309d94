// Reads the bytes of a value as another type.
#pragma once

namespace kinemend {

/// Like std::bit_cast, which the standard library of Emscripten lacks.
template <class To, class From>
constexpr To bits_as(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

}  // namespace kinemend
