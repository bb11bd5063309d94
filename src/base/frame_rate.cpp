// Rejects frame rates that no take may have.
#include "kinemend/experimental/frame_rate.hpp"

#include <fmt/format.h>

#include "kinemend/error.hpp"

namespace kinemend {

void check_frame_rate(double frame_rate_hz) {
  if (is_usable_frame_rate(frame_rate_hz)) return;
  throw Error(ErrorKind::usage,
              fmt::format("a frame rate of {} Hz is outside {} to {} Hz", frame_rate_hz,
                          least_frame_rate_hz, most_frame_rate_hz));
}

}  // namespace kinemend
