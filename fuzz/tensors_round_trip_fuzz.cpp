// Reads any bytes as tensors: they are written back as equal tensors, and from then on as the same
// bytes, or give a one-line error that names the file.
#include <cstdint>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/extend/tensor.hpp"
#include "laws.hpp"

namespace {

using namespace kinemend;

void check_same(const TensorFile& a, const TensorFile& b) {
  check(a.metadata == b.metadata && a.tensors.size() == b.tensors.size());
  for (auto left = a.tensors.begin(), right = b.tensors.begin(); left != a.tensors.end();
       ++left, ++right) {
    check(left->first == right->first && left->second.stored == right->second.stored);
    check(left->second.shape == right->second.shape);
    check(left->second.values == right->second.values);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = text_of(data, size);
  TensorFile file;
  try {
    file = parse_tensors(bytes, "fuzz");
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input}, "fuzz: byte ");
    return 0;
  }
  const std::string written = write_tensors(file);
  const TensorFile again = parse_tensors(written, "again");
  check_same(file, again);
  check(write_tensors(again) == written);
  return 0;
}
