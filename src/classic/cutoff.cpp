// Compares a cutoff with half the frame rate and writes the warning.
#include "classic/cutoff.hpp"

#include <fmt/format.h>

#include "kinemend/experimental/text.hpp"

namespace kinemend {

bool is_below_nyquist(double cutoff_hz, double frame_rate_hz) {
  return cutoff_hz < frame_rate_hz / 2;
}

std::string cutoff_warning(std::string_view option, double cutoff_hz, double frame_rate_hz) {
  return fmt::format("{}: {} Hz is not below the Nyquist frequency of {} Hz (half the frame rate)",
                     option, figure(cutoff_hz), figure(frame_rate_hz / 2));
}

}  // namespace kinemend
