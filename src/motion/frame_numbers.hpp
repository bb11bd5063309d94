#pragma once

#include <string_view>

namespace kinemend {

/// The fact of a source that numbers its frames from elsewhere than 1.
inline constexpr std::string_view first_frame_fact = "first frame";

}  // namespace kinemend
