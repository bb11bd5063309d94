// Finds numbers that are not finite in parameters, header and samples, and replaces them.
#include "io/c3d/c3d_not_finite.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/bits.hpp"
#include "io/c3d/c3d_points.hpp"
#include "io/text/text.hpp"

namespace kinemend {

namespace {

void put(std::string& bytes, C3dProcessor processor, std::size_t offset, float value) {
  with_words(processor, [&](auto words) { words.put_real(bytes.data() + offset, value); });
}

float real_at(const std::string& bytes, C3dProcessor processor, std::size_t offset) {
  return with_words(processor, [&](auto words) { return words.real(bytes.data() + offset); });
}

bool is_in_group(const C3dParameters& parameters, const C3dParameter& entry,
                 std::string_view name) {
  return std::any_of(parameters.groups.begin(), parameters.groups.end(), [&](const C3dGroup& g) {
    return g.number == entry.group && equal_ignoring_case(g.name, name);
  });
}

// Whether the parameter is SCALE, SCALE2, ... or GEN_SCALE.
bool is_scale(const std::string& name) {
  return equal_ignoring_case(std::string_view(name).substr(0, 5), "SCALE") ||
         equal_ignoring_case(name, "GEN_SCALE");
}

// Whether a row of stored reals has one that is not finite, which has all bits of the exponent set.
// The loop has no branch so that it is fast for the usual file.
template <C3dProcessor processor>
bool has_not_finite(const char* row, std::size_t count) {
  constexpr std::uint32_t exponent = 0x7F800000u;
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = bits_as<std::uint32_t>(C3dWords<processor>::real(row + 4 * i));
    found |= (bits & exponent) == exponent ? 1u : 0u;
  }
  return found != 0;
}

template <C3dProcessor processor>
std::size_t mend_analog(std::string& bytes, const C3dLayout& layout) {
  using Words = C3dWords<processor>;
  const std::size_t channels = std::max<std::size_t>(layout.analog_count, 1);
  std::size_t mended = 0;
  for (std::size_t f = 0; f < layout.frame_count; ++f) {
    char* const row =
        bytes.data() + layout.data_begin + f * layout.frame_bytes() + layout.point_bytes();
    if (!has_not_finite<processor>(row, layout.analog_values)) continue;
    for (std::size_t i = 0; i < layout.analog_values; ++i) {
      if (std::isfinite(Words::real(row + 4 * i))) continue;
      float held = 0;
      if (i >= channels) {
        held = Words::real(row + 4 * (i - channels));
      } else if (f > 0 && layout.analog_values >= channels) {
        held = Words::real(row - layout.frame_bytes() + 4 * (layout.analog_values - channels + i));
      }
      Words::put_real(row + 4 * i, held);
      ++mended;
    }
  }
  return mended;
}

}  // namespace

std::size_t mend_c3d_parameters(std::string& bytes, C3dProcessor processor,
                                C3dParameters& parameters) {
  std::size_t mended = 0;
  for (C3dParameter& entry : parameters.entries) {
    if (entry.type != C3dType::real) continue;
    const bool of_analog = is_in_group(parameters, entry, "ANALOG");
    if (!of_analog && !is_in_group(parameters, entry, "POINT")) continue;
    const float neutral = of_analog && is_scale(entry.name) ? 1 : 0;
    for (std::size_t i = 0; i < entry.numbers.size(); ++i) {
      if (std::isfinite(entry.numbers[i])) continue;
      entry.numbers[i] = static_cast<double>(neutral);
      put(bytes, processor, entry.data_begin + 4 * i, neutral);
      ++mended;
    }
  }
  return mended;
}

std::size_t mend_c3d_header(std::string& bytes, C3dProcessor processor, C3dHeader& header,
                            const C3dParameters& parameters) {
  constexpr std::size_t scale_word = 7, rate_word = 11;
  std::size_t mended = 0;
  const auto mend = [&](float& value, std::size_t word, std::string_view name) {
    if (std::isfinite(value)) return;
    value = static_cast<float>(parameters.number("POINT", name).value_or(0));
    if (!std::isfinite(value)) value = 0;
    put(bytes, processor, header.begin + 2 * (word - 1), value);
    ++mended;
  };
  mend(header.scale, scale_word, "SCALE");
  mend(header.rate_hz, rate_word, "RATE");
  return mended;
}

std::size_t mend_c3d_points(std::string& bytes, C3dProcessor processor, const C3dLayout& layout) {
  std::size_t mended = 0;
  for (std::size_t f = 0; layout.is_float && f < layout.frame_count; ++f) {
    for (std::size_t p = 0; p < layout.point_count; ++p) {
      const std::size_t sample = layout.data_begin + f * layout.frame_bytes() + 16 * p;
      float sum = 0;
      for (std::size_t i = 0; i < 4; ++i) sum += 0 * real_at(bytes, processor, sample + 4 * i);
      if (std::isfinite(sum)) continue;
      for (std::size_t i = 0; i < 3; ++i) put(bytes, processor, sample + 4 * i, 0);
      put(bytes, processor, sample + 12, static_cast<float>(missing_point_word));
      ++mended;
    }
  }
  return mended;
}

std::size_t mend_c3d_analog(std::string& bytes, C3dProcessor processor, const C3dLayout& layout) {
  if (!layout.is_float || layout.analog_values == 0) return 0;
  // Every real of a DEC file is a finite number.
  if (processor == C3dProcessor::dec) return 0;
  return processor == C3dProcessor::mips ? mend_analog<C3dProcessor::mips>(bytes, layout)
                                         : mend_analog<C3dProcessor::intel>(bytes, layout);
}

}  // namespace kinemend
