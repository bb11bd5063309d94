// Reads numbers of networks from a model file. All of these functions throw
// `ErrorKind::unreadable_input`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinemend/experimental/model.hpp"

namespace kinemend {

[[noreturn]] void refuse_network(const std::string& what);

/// A whole number of the model, between `least` and `most`.
std::size_t whole_number(const Model& model, const std::string& name, std::size_t least,
                         std::size_t most);
/// A tensor of `count` numbers, all above zero if `is_positive`.
std::vector<float> network_numbers(const Model& model, const char* name, std::size_t count,
                                   bool is_positive);
void check_width(const std::string& layer, std::size_t found, std::size_t expected);

}  // namespace kinemend
