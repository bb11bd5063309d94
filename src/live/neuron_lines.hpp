// Lines of the BVH broadcast of Axis Neuron, which comes without a header, and its skeleton.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace kinemend {

/// What a line "0 Char00 v v v ..." says of itself.
struct NeuronForm {
  std::string_view avatar;  ///< the first word
  bool displaced = false;   ///< each joint has a position and a rotation; else the first alone
  std::size_t skipped_words = 0;  ///< before the values of the joints
};
/// None where the number of words fits neither form.
std::optional<NeuronForm> neuron_form(std::string_view line);

/// The header of a BVH file with the 59 joints in the order of the broadcast: of a person of 1.75 m
/// in a T-pose, in centimetres, at 60 Hz.
std::string neuron_skeleton(bool displaced);

}  // namespace kinemend
