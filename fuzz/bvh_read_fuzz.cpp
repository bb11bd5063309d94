// Any bytes: a clip that keeps the rules and is written back to the byte, or an error that names
// the file.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    const Clip clip = read_clip(bytes, "fuzz.bvh").clip;
    clip.validate();
    if (write_clip(clip) != bytes) std::abort();
  } catch (const Error& error) {
    const std::string message = error.what();
    const bool names_file = message.rfind("fuzz.bvh:", 0) == 0;
    if (error.kind() != ErrorKind::unreadable_input || !names_file) std::abort();
    if (message.find_first_of("\r\n") != message.npos) std::abort();
  }
  return 0;
}
