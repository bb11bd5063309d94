// The version of the program.
#include "kinemend/extend/system.hpp"

namespace kinemend {

std::string_view version() noexcept { return KINEMEND_VERSION; }

}  // namespace kinemend
