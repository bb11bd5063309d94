// Lines of the BVH broadcast of Axis Neuron, which comes without a header, and its skeleton.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace kinemend {

/// The form of a line "0 Char00 v v v ...".
struct NeuronForm {
  std::string_view avatar;        ///< the first word
  bool displaced = false;         ///< each joint has a position and a rotation; else only the first
  std::size_t skipped_words = 0;  ///< before the values of the joints
};
/// Returns none if the number of words fits neither form.
std::optional<NeuronForm> neuron_form(std::string_view line);

/// Returns the header of a BVH file with the 59 joints in the order of the broadcast: a person of
/// 1.75 m in a T-pose, in centimetres, at 60 Hz.
std::string neuron_skeleton(bool displaced);

}  // namespace kinemend
