// Reads any bytes as a model: it has a valid body and is written back as an equal model, or gives a
// one-line error that names the file.
#include <cstdint>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/extend/model.hpp"
#include "laws.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  const std::string bytes = text_of(data, size);
  Model model;
  try {
    model = parse_model(bytes, "fuzz");
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input}, "fuzz: ");
    return 0;
  }
  model.layout.validate();
  const std::string written = write_model(model);
  check(write_model(parse_model(written, "again")) == written);
  return 0;
}
