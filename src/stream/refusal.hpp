#pragma once

#include "kinemend/error.hpp"

namespace kinemend {

[[noreturn]] inline void refuse_whole_take_method() {
  throw Error(ErrorKind::usage,
              "this method needs the whole take; for live use choose one with a window, or its "
              "causal form");
}

}  // namespace kinemend
