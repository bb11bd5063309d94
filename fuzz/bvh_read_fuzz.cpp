// Reads any bytes as BVH and checks the requirements on readers.
#include "read_law.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return check_read_law(data, size, "bvh");
}
