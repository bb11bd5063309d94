// The version of the program.
#include "kinemend/experimental/version.hpp"

namespace kinemend {

std::string_view version() noexcept { return KINEMEND_VERSION; }

}  // namespace kinemend
