// Makes further training data from a motion: the same in a mirror and backwards.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/extend/body.hpp"

namespace kinemend {

/// The counterparts of tracks in a mirror.
struct BodyMirror {
  std::vector<std::size_t> partners;  ///< each track's counterpart in the mirror (with the place)
  std::size_t turns = 0;              ///< number of tracks that turn; positions follow them
};

/// Pairs tracks by the prefixes Left and Right, or L and R, of their names; a track without a
/// partner, or whose partner has another, is its own.
BodyMirror mirror_of(const BodyLayout& layout);

struct MotionForm {
  bool is_mirrored = false;
  bool is_reversed = false;
};

/// Values (F x D) in that form; applying it twice restores them. The mirror is exact if the
/// references of the layout are symmetrical.
std::vector<float> in_form(const std::vector<float>& values, MotionForm form,
                           const BodyMirror& mirror);

}  // namespace kinemend
