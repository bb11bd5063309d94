// Looks up numbers and tensors of a model, with errors that name what is missing.
#include "kinemend/experimental/model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

const Tensor& find_tensor(const Model& model, std::string_view name) {
  const auto found = model.tensors.find(name);
  if (found == model.tensors.end()) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("the model has no tensor \"{}\", which {} needs", name, model.method));
  }
  return found->second;
}

}  // namespace

double Model::number(std::string_view name) const {
  const auto found = numbers.find(name);
  if (found == numbers.end()) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("the model has no number \"{}\", which {} needs", name, method));
  }
  return found->second;
}

const Tensor& Model::tensor(std::string_view name, const std::vector<std::size_t>& shape) const {
  const Tensor& found = find_tensor(*this, name);
  if (found.shape != shape) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("tensor \"{}\" of the model: expected shape {}, found {}", name, shape,
                            found.shape));
  }
  return found;
}

// Without this overload `{3}` would be a count of dimensions.
const Tensor& Model::tensor(std::string_view name, std::initializer_list<std::size_t> shape) const {
  return tensor(name, std::vector<std::size_t>(shape));
}

const Tensor& Model::tensor(std::string_view name, std::size_t dimensions) const {
  const Tensor& found = find_tensor(*this, name);
  if (found.shape.size() != dimensions) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("tensor \"{}\" of the model: expected {} dimensions, found {}", name,
                            dimensions, found.shape.size()));
  }
  return found;
}

}  // namespace kinemend
