// A model of one joint with the tensors of a fixture.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "kinemend/extend/model.hpp"

namespace kinemend::test {

/// A body of one joint with a position, and the tensors of a file in tests/fixtures/nn.
inline Model model_of_one_joint(const std::string& method, const std::string& tensors) {
  const std::string path = KINEMEND_TEST_FIXTURES "/nn/" + tensors;
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  Model model;
  model.method = method;
  model.rate_hz = 120;
  model.layout.names = {"Hips"};
  model.layout.parents = {-1};
  model.layout.references = {Quat{}};
  model.layout.bones = {Vec3{0, 1, 0}};
  model.tensors = parse_tensors(bytes, path).tensors;
  return model;
}

}  // namespace kinemend::test
