// Any bytes: a model whose body keeps the rules and that is written back as the same model, or an
// error of one line that names the file.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"

namespace {

void check(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  Model model;
  try {
    model = parse_model(bytes, "fuzz");
  } catch (const Error& error) {
    const std::string message = error.what();
    check(error.kind() == ErrorKind::unreadable_input && message.rfind("fuzz: ", 0) == 0);
    check(message.find_first_of("\r\n") == message.npos);
    return 0;
  }
  model.layout.validate();
  const std::string written = write_model(model);
  check(write_model(parse_model(written, "again")) == written);
  return 0;
}
