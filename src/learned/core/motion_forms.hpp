// Makes further training data from a motion: the same in a mirror and backwards.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/experimental/body.hpp"

namespace kinemend {

/// How tracks look in a mirror.
struct BodyMirror {
  std::vector<std::size_t> partners;  ///< of each track (with the place) which one it is there
  std::size_t turns = 0;              ///< tracks that turn; behind them are positions
};

/// By Left and Right, or L and R, before the names; a track without a partner, or whose partner has
/// another, is its own.
BodyMirror mirror_of(const BodyLayout& layout);

struct MotionForm {
  bool is_mirrored = false;
  bool is_reversed = false;
};

/// Values (F x D) in that form; once more, and they are themselves. In the mirror exact where the
/// references of the layout are symmetrical.
std::vector<float> in_form(const std::vector<float>& values, MotionForm form,
                           const BodyMirror& mirror);

}  // namespace kinemend
