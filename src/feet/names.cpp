// The names of the parts of a foot.
#include "kinemend/feet.hpp"

namespace kinemend {

std::string_view to_string(FootPart part) { return part == FootPart::heel ? "heel" : "toe"; }

}  // namespace kinemend
