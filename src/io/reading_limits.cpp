// Says which frame rates a take can have.
#include "io/reading_limits.hpp"

#include <fmt/format.h>

#include "kinemend/extend/frames.hpp"

namespace kinemend {

std::string unusable_rate_text(double stated_hz) {
  return fmt::format("a rate of {:.6g} Hz is outside {} to {} Hz: taken as unknown", stated_hz,
                     least_frame_rate_hz, most_frame_rate_hz);
}

}  // namespace kinemend
