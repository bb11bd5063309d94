// Checks a stated frame rate, and notes one that is out of range as a repair.
#include "io/reading_limits.hpp"

#include <fmt/format.h>

#include "kinemend/extend/frames.hpp"

namespace kinemend {

double usable_rate(const SourceText& text, Diagnostics& diagnostics, double stated_hz,
                   std::size_t place) {
  if (is_usable_frame_rate(stated_hz)) return stated_hz;
  if (stated_hz > 0) {
    note_repair(text, diagnostics, "frame_rate_unusable", place, unusable_rate_text(stated_hz));
  }
  return 0;
}

std::string unusable_rate_text(double stated_hz) {
  return fmt::format("a rate of {:.6g} Hz is outside {} to {} Hz: taken as unknown", stated_hz,
                     least_frame_rate_hz, most_frame_rate_hz);
}

}  // namespace kinemend
