// Reads numbers and weights of networks from a model and rejects invalid ones.
#include "models/network_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "kinemend/error.hpp"
#include "nn/layers.hpp"

namespace kinemend {

void refuse_network(const std::string& what) { throw Error(ErrorKind::unreadable_input, what); }

std::size_t whole_number(const Model& model, const std::string& name, std::size_t least,
                         std::size_t most) {
  const double value = model.number(name);
  if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)))
    refuse_network(fmt::format("the model's {} is not between {} and {}", name, least, most));
  return static_cast<std::size_t>(value);
}

std::vector<float> network_numbers(const Model& model, const char* name, std::size_t count,
                                   bool is_positive) {
  std::vector<float> values = nn::floats_of(model.tensor(name, {count}));
  if (is_positive && std::any_of(values.begin(), values.end(), [](float v) { return !(v > 0); }))
    refuse_network(fmt::format("the model's {} is not positive everywhere", name));
  return values;
}

void check_width(const std::string& layer, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  refuse_network(
      fmt::format("the model's layer {}: expected {} numbers, found {}", layer, expected, found));
}

}  // namespace kinemend
